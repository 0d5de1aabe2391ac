//! Formula → text in the notation of declarations.

use num_traits::{One, Signed};

use super::formula::{FormulaId, Formulas, Product};
use super::symbol::{End, Position, Symbol};
use super::writer::{Notation, Precedence, Writer, Written};
use crate::algebra::{Function, PairFunction, Rational};

/// The letters of a text that a declaration has a say in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Letters {
    /// Counts rows of the same form.
    pub row: String,
    /// Counts terms of the same form.
    pub term: String,
    /// Shared formulas, with a number as subscript.
    pub shared: String,
    /// The step size.
    pub step: String,
}

impl Default for Letters {
    fn default() -> Self {
        Self {
            row: "i".into(),
            term: "j".into(),
            shared: "u".into(),
            step: "τ".into(),
        }
    }
}

/// `root` as text.
pub fn write(formulas: &Formulas, root: FormulaId) -> String {
    write_with(formulas, root, &Letters::default())
}

/// `root` as text with these letters.
pub fn write_with(formulas: &Formulas, root: FormulaId, letters: &Letters) -> String {
    Writer::new(formulas, letters).operand(root, Precedence::Sum)
}

/// The terms of `root`, if it is a sum: each with its sign, ` + ` or ` - ` between them.
pub fn terms(formulas: &Formulas, root: FormulaId, letters: &Letters) -> Vec<String> {
    Writer::new(formulas, letters).terms(root)
}

/// A symbol as text.
pub fn symbol(symbol: &Symbol, letters: &Letters) -> String {
    let position = |position: Option<Position>| match position {
        None => String::new(),
        Some(position) => format!("[{}]", index(position, letters)),
    };
    let end = match symbol.end {
        None => "",
        Some(End::Start) => "₀",
        Some(End::End) => "₁",
    };
    match &symbol.component {
        Some(component) => format!(
            "{}[{component}{}]{end}",
            symbol.base,
            position(symbol.position)
        ),
        None => format!("{}{}{end}", symbol.base, position(symbol.position)),
    }
}

/// An index as text: `3`, `i`, `i+1`.
pub fn index(position: Position, letters: &Letters) -> String {
    let (letter, distance) = match position {
        Position::At(index) => return index.to_string(),
        Position::InRow(distance) => (&letters.row, distance),
        Position::InSum(distance) => (&letters.term, distance),
    };
    match distance {
        0 => letter.clone(),
        distance => format!("{letter}{distance:+}"),
    }
}

/// The name of a shared formula as text: `u₁₂`, `u₃[i]`.
pub fn shared(number: usize, in_row: bool, letters: &Letters) -> String {
    let digits = number.to_string();
    let subscript = digits.chars().filter_map(|digit| {
        let value = digit.to_digit(10)?;
        char::from_u32('₀' as u32 + value)
    });
    let mut name: String = letters.shared.chars().chain(subscript).collect();
    if in_row {
        name.push_str(&format!("[{}]", letters.row));
    }
    name
}

impl Notation for &Letters {
    const DOTS: &'static str = "…";
    const PI: &'static str = "pi";
    const EXPONENT: Precedence = Precedence::Atom;
    const TOTAL: Precedence = Precedence::Sum;

    fn constant(&self, value: &Rational) -> Written {
        let precedence = if value.is_negative() || !value.is_integer() {
            Precedence::Product
        } else {
            Precedence::Atom
        };
        (value.to_string(), precedence)
    }

    fn symbol(&self, variable: &Symbol) -> Written {
        (symbol(variable, self), Precedence::Atom)
    }

    fn shared(&self, number: usize, in_row: bool) -> String {
        shared(number, in_row, self)
    }

    fn call(&self, function: Function, argument: &str) -> Written {
        (format!("{function}({argument})"), Precedence::Atom)
    }

    fn pair(&self, function: PairFunction, [a, b]: [&str; 2]) -> Written {
        (format!("{function}({a}, {b})"), Precedence::Atom)
    }

    fn power(&self, base: &str, exponent: &str) -> String {
        format!("{base}^{exponent}")
    }

    fn total(&self, term: &str, first: usize, last: usize) -> Written {
        let (letter, end) = (&self.term, last + 1);
        let total = format!("sum({letter} in {first}..{end}, {term})");
        (total, Precedence::Atom)
    }

    fn product(writer: &mut Writer<'_, Self>, product: &Product) -> Written {
        let (numerator, denominator) = (product.constant.numer(), product.constant.denom());
        let mut above: Vec<String> = Vec::new();
        if !numerator.is_one() || product.above.is_empty() {
            above.push(numerator.to_string());
        }
        let mut below: Vec<String> = Vec::new();
        if !denominator.is_one() {
            below.push(denominator.to_string());
        }
        let mut factor = |factor: &FormulaId| writer.operand(*factor, Precedence::Factor);
        above.extend(product.above.iter().map(&mut factor));
        below.extend(product.below.iter().map(&mut factor));
        let sign = if product.negative { "-" } else { "" };
        let (above, count, below) = (above.join("*"), below.len(), below.join("*"));
        let text = match count {
            0 => format!("{sign}{above}"),
            1 => format!("{sign}{above}/{below}"),
            _ => format!("{sign}{above}/({below})"),
        };
        (text, Precedence::Product)
    }

    fn in_parentheses(text: &str) -> String {
        format!("({text})")
    }
}
