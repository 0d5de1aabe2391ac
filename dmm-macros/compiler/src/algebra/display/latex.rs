//! Formula → LaTeX, for mathematical mode with amsmath; ASCII only.
//!
//! The ends of a step are subscripts, `x_{0}` and `x_{1}`; the index of an element of a group
//! is a subscript in brackets, `q_{[2]}`, and both are `q_{[2],1}`. The underscore of an
//! identifier is printed as it stands, so that `x_1` cannot be taken for the later end of `x`.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use num_traits::{One, Signed};

use super::formula::{FormulaId, Formulas, Product};
use super::symbol::{End, Symbol};
use super::text::{self, Letters};
use super::unicode;
use super::writer::{Notation, Precedence, Writer, Written};
use crate::algebra::{Function, Latex, PairFunction, Rational};

/// How names are written; different names always differently.
#[derive(Debug, Clone)]
pub struct Style {
    /// The letters that the text of the same formulas uses.
    pub letters: Letters,
    names: BTreeMap<String, String>,
}

impl Style {
    /// A style for the names that a declaration uses.
    pub fn new<'a>(letters: Letters, names: impl IntoIterator<Item = &'a str>) -> Self {
        let mut written: BTreeMap<String, String> = BTreeMap::new();
        let mut taken: BTreeSet<String> = BTreeSet::new();
        for name in names {
            if written.contains_key(name) {
                continue;
            }
            let mut latex = variable(name);
            while !taken.insert(latex.clone()) {
                latex.push('\'');
            }
            written.insert(name.to_owned(), latex);
        }
        Self {
            letters,
            names: written,
        }
    }

    /// The name of a variable.
    pub fn name(&self, name: &str) -> String {
        match self.names.get(name) {
            Some(latex) => latex.clone(),
            None => unicode::mathematics(name),
        }
    }
}

/// The name of a variable: a letter, a Greek letter by its name, or a word.
fn variable(name: &str) -> String {
    // τ, λ and ψ have another meaning in what surrounds the formulas
    const GREEK: &[&str] = &[
        "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
        "mu", "nu", "xi", "rho", "sigma", "upsilon", "phi", "chi", "omega", "Gamma", "Theta", "Xi",
        "Phi", "Omega",
    ];
    let mut letters = name.chars();
    match (letters.next(), letters.next()) {
        (Some(letter), None) if letter.is_ascii_alphabetic() => name.to_owned(),
        _ if GREEK.contains(&name) => format!("\\{name}"),
        (Some(_), None) => unicode::mathematics(name),
        _ if name.is_ascii() => format!(r"\mathit{{{}}}", unicode::escaped(name)),
        _ => format!(r"\mathit{{{}}}", unicode::mathematics(name)),
    }
}

/// `root` in LaTeX.
pub fn write(formulas: &Formulas, root: FormulaId, style: &Style) -> String {
    Writer::new(formulas, style).operand(root, Precedence::Sum)
}

/// The terms of `root`, if it is a sum: each with its sign.
pub fn terms(formulas: &Formulas, root: FormulaId, style: &Style) -> Vec<String> {
    Writer::new(formulas, style).terms(root)
}

/// A symbol in LaTeX.
pub fn symbol(symbol: &Symbol, style: &Style) -> String {
    let index = symbol
        .position
        .map(|position| format!("[{}]", text::index(position, &style.letters)));
    let end = symbol.end.map(|end| match end {
        End::Start => "0".to_owned(),
        End::End => "1".to_owned(),
    });
    let scripted = |base: String, scripts: [Option<String>; 2]| {
        let scripts: Vec<String> = scripts.into_iter().flatten().collect();
        if scripts.is_empty() {
            base
        } else {
            format!("{base}_{{{}}}", scripts.join(","))
        }
    };
    match &symbol.component {
        Some(component) => {
            let component = scripted(style.name(component), [index, None]);
            format!("{}[{component}]", unicode::mathematics(&symbol.base))
        }
        None => scripted(style.name(&symbol.base), [index, end]),
    }
}

/// The name of a shared formula.
pub fn shared(number: usize, in_row: bool, style: &Style) -> String {
    let letter = unicode::mathematics(&style.letters.shared);
    if in_row {
        format!("{letter}_{{{number},[{}]}}", style.letters.row)
    } else {
        format!("{letter}_{{{number}}}")
    }
}

impl Notation for &Style {
    const DOTS: &'static str = r"\dots";
    const PI: &'static str = r"\pi";
    const EXPONENT: Precedence = Precedence::Sum;
    const TOTAL: Precedence = Precedence::Product;

    fn constant(&self, value: &Rational) -> Written {
        let sign = if value.is_negative() { "-" } else { "" };
        let size = value.abs();
        if size.is_integer() {
            let precedence = if value.is_negative() {
                Precedence::Product
            } else {
                Precedence::Atom
            };
            return (format!("{sign}{size}"), precedence);
        }
        (
            format!(r"{sign}\frac{{{}}}{{{}}}", size.numer(), size.denom()),
            Precedence::Product,
        )
    }

    fn symbol(&self, variable: &Symbol) -> Written {
        let precedence = match variable.component {
            Some(_) => Precedence::Factor,
            None => Precedence::Atom,
        };
        (symbol(variable, self), precedence)
    }

    fn shared(&self, number: usize, in_row: bool) -> String {
        shared(number, in_row, self)
    }

    fn call(&self, function: Function, argument: &str) -> Written {
        match function.latex() {
            Latex::Name(name) => (
                format!(r"{name}\left({argument}\right)"),
                Precedence::Factor,
            ),
            Latex::Root => (format!(r"\sqrt{{{argument}}}"), Precedence::Factor),
            Latex::Bars => (format!(r"\left|{argument}\right|"), Precedence::Atom),
        }
    }

    fn pair(&self, function: PairFunction, [a, b]: [&str; 2]) -> Written {
        let of = match function.of().latex() {
            Latex::Name(name) => name,
            Latex::Root | Latex::Bars => function.of().name(),
        };
        let prime = if function.prime().is_none() { "'" } else { "" };
        let name = format!(r"\operatorname{{dd}}{prime}_{{{of}}}");
        (format!(r"{name}\left({a}, {b}\right)"), Precedence::Factor)
    }

    fn power(&self, base: &str, exponent: &str) -> String {
        format!("{base}^{{{exponent}}}")
    }

    fn total(&self, term: &str, first: usize, last: usize) -> Written {
        let letter = &self.letters.term;
        let total = format!(r"\sum_{{{letter}={first}}}^{{{last}}} {term}");
        (total, Precedence::Product)
    }

    fn product(writer: &mut Writer<'_, Self>, product: &Product) -> Written {
        let sign = if product.negative { "-" } else { "" };
        let (numerator, denominator) = (product.constant.numer(), product.constant.denom());
        let is_fraction = !product.below.is_empty() || !denominator.is_one();
        // the bar of a fraction brackets
        let least = if is_fraction {
            Precedence::Sum
        } else {
            Precedence::Product
        };
        let above = side(writer, numerator.to_string(), &product.above, least);
        if !is_fraction {
            return (format!("{sign}{above}"), Precedence::Product);
        }
        let below = side(writer, denominator.to_string(), &product.below, least);
        let precedence = if product.negative {
            Precedence::Product
        } else {
            Precedence::Factor
        };
        (format!(r"{sign}\frac{{{above}}}{{{below}}}"), precedence)
    }

    fn in_parentheses(text: &str) -> String {
        format!(r"\left({text}\right)")
    }
}

/// A constant and factors; a factor that is alone needs to bind as tightly as `least`.
fn side(
    writer: &mut Writer<'_, &Style>,
    constant: String,
    factors: &[FormulaId],
    least: Precedence,
) -> String {
    let has_constant = constant != "1" || factors.is_empty();
    if let ([only], false) = (factors, has_constant) {
        return writer.operand(*only, least);
    }
    let mut text = String::new();
    if has_constant {
        text.push_str(&constant);
    }
    for &factor in factors {
        let written = writer.operand(factor, Precedence::Factor);
        // 2 3 would be read as 23
        let digit = written.starts_with(|letter: char| letter.is_ascii_digit());
        let _ = if text.is_empty() {
            write!(text, "{written}")
        } else if digit {
            write!(text, r" \cdot {written}")
        } else {
            write!(text, r" \, {written}")
        };
    }
    text
}
