//! The declaration as text: one item a line, spacing normalised, parentheses as written.

use std::fmt::{self, Display, Formatter, Write};

use syn::{Attribute, Expr, ExprLit, Lit, Meta, Visibility};

use super::{
    Assignment, Comparison, Condition, Declaration, Defaults, Definition, EventItem, Expression,
    ExpressionKind, Group, Item, Operator, ParameterItem, Range, Target, Trigger,
};

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
            ExpressionKind::Element { group, index } => write!(f, "{group}[{index}]"),
            ExpressionKind::If {
                condition,
                slides,
                then,
                otherwise,
            } => {
                let sliding = if *slides { " sliding" } else { "" };
                write!(f, "if {condition}{sliding} {{ {then} }} else ")?;
                match otherwise.kind {
                    ExpressionKind::If { .. } => write!(f, "{otherwise}"),
                    _ => write!(f, "{{ {otherwise} }}"),
                }
            }
            ExpressionKind::Sum {
                variable,
                range,
                term,
            } => write!(f, "sum({variable} in {range}, {term})"),
        }
    }
}

fn is_number(expression: &Expression) -> bool {
    matches!(expression.kind, ExpressionKind::Number { .. })
}

impl Display for Range {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let start = self.start.to_string();
        // `1...n` would be three dots
        let space = if start.ends_with('.') { " " } else { "" };
        write!(f, "{start}{space}..{}", self.end)
    }
}

impl Display for Target {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.index {
            Some(index) => write!(f, "{}[{index}]", self.ident),
            None => write!(f, "{}", self.ident),
        }
    }
}

impl Display for Group {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.length {
            Some(length) => write!(f, "{}[{length}]", self.ident),
            None => write!(f, "{}", self.ident),
        }
    }
}

impl Display for Defaults {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Same(formula) => write!(f, "{formula}"),
            Self::Each(formulas, _) => {
                let formulas: Vec<String> = formulas.iter().map(ToString::to_string).collect();
                write!(f, "[{}]", formulas.join(", "))
            }
        }
    }
}

impl Display for Condition {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} 0", self.interface, self.relation.symbol())
    }
}

impl Display for Comparison {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {}", self.left, self.relation.symbol(), self.right)
    }
}

impl Display for Trigger {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::On {
                interface,
                direction,
            } => match direction.word() {
                Some(word) => write!(f, "on {interface} {word}"),
                None => write!(f, "on {interface}"),
            },
            Self::Every(period) => write!(f, "every {period}"),
            Self::At(time) => write!(f, "at {time}"),
        }
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
        Item::Parameter(item) => parameter(f, item, indent),
        Item::Constant(item) => definition(f, "const", item, indent),
        Item::Let(item) => definition(f, "let", item, indent),
        Item::Discrete(item) => definition(f, "discrete", item, indent),
        Item::Interface(item) => {
            let Definition {
                attributes,
                ident,
                formula,
            } = &item.definition;
            documentation(f, attributes, indent)?;
            let sliding = if item.slides { ", sliding" } else { "" };
            writeln!(f, "{indent}interface {ident} = {formula}{sliding};")
        }
        Item::Sliding(sliding) => {
            writeln!(f, "{indent}sliding {} {{", sliding.interface)?;
            items(f, &sliding.items, &format!("{indent}    "))?;
            writeln!(f, "{indent}}}")
        }
        Item::Event(event) => print_event(f, event, indent),
        Item::Conserved(item) if item.assumed => {
            definition(f, "assume conserved", &item.definition, indent)
        }
        Item::Conserved(item) => definition(f, "conserved", &item.definition, indent),
        Item::Function(item) => {
            documentation(f, &item.definition.attributes, indent)?;
            let arguments: Vec<String> = item.arguments.iter().map(ToString::to_string).collect();
            let (name, formula) = (&item.definition.ident, &item.definition.formula);
            writeln!(
                f,
                "{indent}fn {name}({}) = {formula};",
                arguments.join(", ")
            )
        }
        Item::Hamiltonian(item) => {
            documentation(f, &item.definition.attributes, indent)?;
            let pairs: Vec<String> = (item.pairs.iter())
                .map(|(q, p)| format!("({q}, {p})"))
                .collect();
            let (name, formula) = (&item.definition.ident, &item.definition.formula);
            writeln!(
                f,
                "{indent}hamiltonian {name} = {formula} in {};",
                pairs.join(", ")
            )
        }
        Item::For(item) => {
            writeln!(f, "{indent}for {} in {} {{", item.variable, item.range)?;
            items(f, &item.items, &format!("{indent}    "))?;
            writeln!(f, "{indent}}}")
        }
        Item::Derivative(item) => {
            documentation(f, &item.attributes, indent)?;
            writeln!(f, "{indent}der({}) = {};", item.target, item.formula)
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

fn print_event(f: &mut Formatter<'_>, event: &EventItem, indent: &str) -> fmt::Result {
    documentation(f, &event.attributes, indent)?;
    write!(f, "{indent}{}", event.trigger)?;
    for (index, condition) in event.conditions.iter().enumerate() {
        let word = if index == 0 { "where" } else { "and" };
        write!(f, " {word} {condition}")?;
    }
    f.write_str(" {\n")?;
    for Assignment { target, formula } in &event.assignments {
        writeln!(f, "{indent}    {target} = {formula};")?;
    }
    if !event.conserved.is_empty() {
        let names: Vec<String> = event.conserved.iter().map(ToString::to_string).collect();
        writeln!(f, "{indent}    conserves {};", names.join(", "))?;
    }
    writeln!(f, "{indent}}}")
}

/// Undocumented states share a line, documented ones have their own.
fn print_states(f: &mut Formatter<'_>, states: &[Group], indent: &str) -> fmt::Result {
    if states.iter().all(|state| state.attributes.is_empty()) {
        let names: Vec<String> = states.iter().map(ToString::to_string).collect();
        return writeln!(f, "{indent}state {};", names.join(", "));
    }
    states.iter().try_for_each(|state| {
        documentation(f, &state.attributes, indent)?;
        writeln!(f, "{indent}state {state};")
    })
}

fn parameter(f: &mut Formatter<'_>, item: &ParameterItem, indent: &str) -> fmt::Result {
    documentation(f, &item.group.attributes, indent)?;
    writeln!(f, "{indent}param {} = {};", item.group, item.defaults)
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
