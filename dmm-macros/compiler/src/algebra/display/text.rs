//! Formula → text in the notation of declarations.

use num_traits::{One, Signed};

use super::formula::{Formula, FormulaId, Formulas, Product, Term};
use super::symbol::{End, Position, Symbol};
use crate::algebra::Rational;

/// A formula is cut off with `…` after this many parts (as a tree it may be exponentially
/// larger than its arena).
const LARGEST_TEXT: usize = 4_000;
/// Parts are cut off with `…` below this many levels.
const DEEPEST_NESTING: usize = 120;

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
    let mut writer = Writer::new(formulas, letters);
    match &formulas[root] {
        Formula::Sum(terms) => (terms.iter().enumerate())
            .map(|(place, &term)| writer.term(place == 0, term))
            .collect(),
        _ => vec![writer.operand(root, Precedence::Sum)],
    }
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

/// How tightly the outermost operation of a text binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Precedence {
    Sum,
    Product,
    Power,
    Atom,
}

/// A text with its outermost operation.
type Written = (String, Precedence);

struct Writer<'a> {
    formulas: &'a Formulas,
    letters: &'a Letters,
    budget: usize,
    depth: usize,
}

impl<'a> Writer<'a> {
    fn new(formulas: &'a Formulas, letters: &'a Letters) -> Self {
        Self {
            formulas,
            letters,
            budget: LARGEST_TEXT,
            depth: 0,
        }
    }

    /// `id`, in parentheses where it binds less tightly than `least`.
    fn operand(&mut self, id: FormulaId, least: Precedence) -> String {
        let (text, precedence) = self.formula(id);
        parenthesised(text, precedence < least)
    }

    fn formula(&mut self, id: FormulaId) -> Written {
        if self.budget == 0 || self.depth >= DEEPEST_NESTING {
            return ("…".into(), Precedence::Atom);
        }
        self.budget -= 1;
        self.depth += 1;
        let formulas = self.formulas;
        let written = match &formulas[id] {
            Formula::Constant(value) => constant(value),
            Formula::Pi => ("pi".into(), Precedence::Atom),
            Formula::Symbol(variable) => (symbol(variable, self.letters), Precedence::Atom),
            Formula::Shared { number, in_row } => {
                (shared(*number, *in_row, self.letters), Precedence::Atom)
            }
            Formula::Call(function, u) => {
                let argument = self.operand(*u, Precedence::Sum);
                (format!("{function}({argument})"), Precedence::Atom)
            }
            Formula::Pair(function, [a, b]) => {
                let a = self.operand(*a, Precedence::Sum);
                let b = self.operand(*b, Precedence::Sum);
                (format!("{function}({a}, {b})"), Precedence::Atom)
            }
            Formula::Power(base, exponent) => {
                let base = self.operand(*base, Precedence::Atom);
                let exponent = self.operand(*exponent, Precedence::Atom);
                (format!("{base}^{exponent}"), Precedence::Power)
            }
            Formula::Total { term, first, last } => {
                let term = self.operand(*term, Precedence::Sum);
                let (letter, end) = (&self.letters.term, last + 1);
                (
                    format!("sum({letter} in {first}..{end}, {term})"),
                    Precedence::Atom,
                )
            }
            Formula::Sum(terms) => {
                let terms = (terms.iter().enumerate())
                    .map(|(place, &term)| self.term(place == 0, term))
                    .collect();
                (terms, Precedence::Sum)
            }
            Formula::Product(product) => self.product(product),
        };
        self.depth -= 1;
        written
    }

    /// A term with its sign.
    fn term(&mut self, is_first: bool, term: Term) -> String {
        let sign = match (is_first, term.negative) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        let (text, precedence) = self.formula(term.formula);
        let text = parenthesised(text, precedence == Precedence::Sum);
        format!("{sign}{text}")
    }

    fn product(&mut self, product: &Product) -> Written {
        let number = |value: String| (value, Precedence::Atom);
        let mut above: Vec<Written> = Vec::new();
        if !product.constant.numer().is_one() || product.above.is_empty() {
            above.push(number(product.constant.numer().to_string()));
        }
        let mut below: Vec<Written> = Vec::new();
        if !product.constant.denom().is_one() {
            below.push(number(product.constant.denom().to_string()));
        }
        above.extend(product.above.iter().map(|&factor| self.formula(factor)));
        below.extend(product.below.iter().map(|&factor| self.formula(factor)));
        let mut text = if product.negative { "-" } else { "" }.to_owned();
        text.push_str(&joined(&above));
        match below.len() {
            0 => {}
            1 => text.extend(["/", &joined(&below)]),
            _ => text.extend(["/(", &joined(&below), ")"]),
        }
        (text, Precedence::Product)
    }
}

fn constant(value: &Rational) -> Written {
    let precedence = if value.is_negative() || !value.is_integer() {
        Precedence::Product
    } else {
        Precedence::Atom
    };
    (value.to_string(), precedence)
}

fn joined(factors: &[Written]) -> String {
    let texts: Vec<String> = factors
        .iter()
        .map(|(text, precedence)| parenthesised(text.clone(), *precedence < Precedence::Power))
        .collect();
    texts.join("*")
}

fn parenthesised(text: String, needed: bool) -> String {
    if needed { format!("({text})") } else { text }
}
