//! The declaration as text: one item a line, spacing normalised, parentheses as written.

use std::fmt::{self, Display, Formatter, Write};

use syn::{Attribute, Expr, ExprLit, Lit, Meta, Visibility};

use super::{Condition, Declaration, Definition, Expression, ExpressionKind, Item, Operator};

impl Display for Expression {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.kind {
            ExpressionKind::Number { text, .. } => f.write_str(text),
            ExpressionKind::Name(ident) => write!(f, "{ident}"),
            ExpressionKind::Call {
                function,
                arguments,
            } => {
                write!(f, "{function}(")?;
                for (index, argument) in arguments.iter().enumerate() {
                    let comma = if index == 0 { "" } else { ", " };
                    write!(f, "{comma}{argument}")?;
                }
                f.write_char(')')
            }
            ExpressionKind::Negative(operand) => write!(f, "-{operand}"),
            ExpressionKind::Binary {
                operator,
                left,
                right,
            } => match operator {
                Operator::Power => write!(f, "{left}^{right}"),
                // a short quotient such as 3/2 reads best as one token
                Operator::Divide if is_number(left) && is_number(right) => {
                    write!(f, "{left}/{right}")
                }
                _ => write!(f, "{left} {} {right}", operator.symbol()),
            },
            ExpressionKind::Parenthesised(inner) => write!(f, "({inner})"),
        }
    }
}

fn is_number(expression: &Expression) -> bool {
    matches!(expression.kind, ExpressionKind::Number { .. })
}

impl Display for Condition {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} 0", self.interface, self.relation.symbol())
    }
}

impl Display for Declaration {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        documentation(f, &self.attributes, "")?;
        let visibility = match &self.visibility {
            Visibility::Inherited => String::new(),
            Visibility::Public(_) => "pub ".into(),
            Visibility::Restricted(restricted) => {
                let path = restricted.path.segments.iter();
                let path: Vec<String> = path.map(|segment| segment.ident.to_string()).collect();
                let word = if restricted.in_token.is_some() {
                    "in "
                } else {
                    ""
                };
                format!("pub({word}{}) ", path.join("::"))
            }
        };
        writeln!(f, "{visibility}system {} {{", self.name)?;
        items(f, &self.items, "    ")?;
        f.write_char('}')
    }
}

fn items(f: &mut Formatter<'_>, items: &[Item], indent: &str) -> fmt::Result {
    items.iter().try_for_each(|item| print(f, item, indent))
}

fn print(f: &mut Formatter<'_>, item: &Item, indent: &str) -> fmt::Result {
    match item {
        Item::State(states) => print_states(f, states, indent),
        Item::Parameter(item) => definition(f, "param", item, indent),
        Item::Constant(item) => definition(f, "const", item, indent),
        Item::Let(item) => definition(f, "let", item, indent),
        Item::Interface(item) => definition(f, "interface", item, indent),
        Item::Conserved(item) => definition(f, "conserved", item, indent),
        Item::Derivative(item) => {
            documentation(f, &item.attributes, indent)?;
            writeln!(f, "{indent}der({}) = {};", item.state, item.formula)
        }
        Item::Region(region) => {
            documentation(f, &region.attributes, indent)?;
            write!(f, "{indent}region {}", region.ident)?;
            for (index, condition) in region.conditions.iter().enumerate() {
                let word = if index == 0 { "where" } else { "and" };
                write!(f, " {word} {condition}")?;
            }
            f.write_str(" {\n")?;
            items(f, &region.items, &format!("{indent}    "))?;
            writeln!(f, "{indent}}}")
        }
    }
}

/// Undocumented states share a line, documented ones have their own.
fn print_states(f: &mut Formatter<'_>, states: &[super::Documented], indent: &str) -> fmt::Result {
    if states.iter().all(|state| state.attributes.is_empty()) {
        let names: Vec<String> = states.iter().map(|state| state.ident.to_string()).collect();
        return writeln!(f, "{indent}state {};", names.join(", "));
    }
    states.iter().try_for_each(|state| {
        documentation(f, &state.attributes, indent)?;
        writeln!(f, "{indent}state {};", state.ident)
    })
}

fn definition(
    f: &mut Formatter<'_>,
    keyword: &str,
    item: &Definition,
    indent: &str,
) -> fmt::Result {
    documentation(f, &item.attributes, indent)?;
    writeln!(f, "{indent}{keyword} {} = {};", item.ident, item.formula)
}

fn documentation(f: &mut Formatter<'_>, attributes: &[Attribute], indent: &str) -> fmt::Result {
    for attribute in attributes {
        if let Meta::NameValue(meta) = &attribute.meta
            && let Expr::Lit(ExprLit {
                lit: Lit::Str(text),
                ..
            }) = &meta.value
        {
            for line in text.value().lines() {
                writeln!(f, "{}", format!("{indent}/// {}", line.trim()).trim_end())?;
            }
        }
    }
    Ok(())
}
