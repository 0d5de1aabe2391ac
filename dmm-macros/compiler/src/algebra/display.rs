//! Readable mathematics: expression → text in the notation of declarations, with no more
//! parentheses than its grammar needs.
//!
//! Products and quotients are collected into one numerator over one denominator, sums are
//! written with their signs: `k*(x₁ + x₀)/2`, `x^2 - 2*x + 1`.

use num_traits::{One, Signed};

use super::{Dag, Id, Math, Rational};

/// An expression is cut off with `…` after this many nodes (as a tree it may be exponentially
/// larger than its DAG).
const LARGEST_TEXT: usize = 4_000;
/// Operands are cut off with `…` below this many levels.
const DEEPEST_NESTING: usize = 120;

/// `root` as text.
pub fn to_text(dag: &Dag, root: Id) -> String {
    let mut writer = Writer {
        dag,
        budget: LARGEST_TEXT,
        depth: 0,
    };
    writer.operand(root, Precedence::Sum)
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
    dag: &'a Dag,
    budget: usize,
    depth: usize,
}

/// A product: sign, numerator and denominator.
#[derive(Default)]
struct Product {
    negative: bool,
    constant: Option<Rational>,
    numerator: Vec<Factor>,
    denominator: Vec<Factor>,
}

/// A node, or a power of a node that stands in the denominator for a negative exponent.
enum Factor {
    Node(Id),
    Power(Id, Rational),
}

impl Writer<'_> {
    /// `id`, in parentheses where it binds less tightly than `least`.
    fn operand(&mut self, id: Id, least: Precedence) -> String {
        if self.budget == 0 || self.depth >= DEEPEST_NESTING {
            return "…".into();
        }
        self.budget -= 1;
        self.depth += 1;
        let (text, precedence) = self.node(id);
        self.depth -= 1;
        parenthesised(text, precedence < least)
    }

    fn node(&mut self, id: Id) -> Written {
        match &self.dag[id] {
            Math::Pi => ("pi".into(), Precedence::Atom),
            Math::Variable(name) => (name.to_string(), Precedence::Atom),
            Math::Call(function, u) => {
                let argument = self.operand(*u, Precedence::Sum);
                (format!("{function}({argument})"), Precedence::Atom)
            }
            Math::Pair(function, [a, b]) => {
                let a = self.operand(*a, Precedence::Sum);
                let b = self.operand(*b, Precedence::Sum);
                (format!("{function}({a}, {b})"), Precedence::Atom)
            }
            Math::Pow([base, exponent]) if !self.is_negative_constant(*exponent) => {
                self.power(*base, *exponent)
            }
            Math::Add(_) | Math::Sub(_) => self.sum(id),
            _ => self.product(id),
        }
    }

    fn is_negative_constant(&self, id: Id) -> bool {
        self.dag.as_constant(id).is_some_and(Signed::is_negative)
    }

    fn power(&mut self, base: Id, exponent: Id) -> Written {
        let base = self.operand(base, Precedence::Atom);
        let exponent = self.operand(exponent, Precedence::Atom);
        (format!("{base}^{exponent}"), Precedence::Power)
    }

    fn sum(&mut self, id: Id) -> Written {
        let mut text = String::new();
        for (negative, term) in self.terms(id) {
            let (term, precedence) = match self.budget.checked_sub(1) {
                Some(budget) => {
                    self.budget = budget;
                    self.node(term)
                }
                None => ("…".into(), Precedence::Atom),
            };
            let (negative, term) = match term.strip_prefix('-') {
                Some(size) if precedence != Precedence::Sum => (!negative, size.to_owned()),
                _ => (negative, parenthesised(term, precedence == Precedence::Sum)),
            };
            text.push_str(match (text.is_empty(), negative) {
                (true, false) => "",
                (true, true) => "-",
                (false, false) => " + ",
                (false, true) => " - ",
            });
            text.push_str(&term);
        }
        (text, Precedence::Sum)
    }

    /// The signed terms of a sum, in order.
    fn terms(&self, root: Id) -> Vec<(bool, Id)> {
        let mut terms = Vec::new();
        let mut stack = vec![(false, root)];
        while let Some((negative, id)) = stack.pop() {
            match self.dag[id] {
                _ if terms.len() > self.budget => break,
                Math::Add([u, v]) => stack.extend([(negative, v), (negative, u)]),
                Math::Sub([u, v]) => stack.extend([(!negative, v), (negative, u)]),
                Math::Neg(u) => stack.push((!negative, u)),
                _ => terms.push((negative, id)),
            }
        }
        terms
    }

    fn product(&mut self, id: Id) -> Written {
        let product = self.factors(id);
        let constant = product.constant.unwrap_or_else(Rational::one);
        let negative = product.negative != constant.is_negative();
        let constant = constant.abs();
        let mut above: Vec<Written> = Vec::new();
        if !constant.numer().is_one() || product.numerator.is_empty() {
            above.push((constant.numer().to_string(), Precedence::Atom));
        }
        let mut below: Vec<Written> = Vec::new();
        if !constant.denom().is_one() {
            below.push((constant.denom().to_string(), Precedence::Atom));
        }
        for factor in &product.numerator {
            above.push(self.factor(factor));
        }
        for factor in &product.denominator {
            below.push(self.factor(factor));
        }
        let alone = above.len() == 1 && below.is_empty() && !negative;
        if alone && let Some(only) = above.pop() {
            return only;
        }
        let mut text = if negative { "-" } else { "" }.to_owned();
        text.push_str(&joined(&above));
        match below.len() {
            0 => {}
            1 => text.extend(["/", &joined(&below)]),
            _ => text.extend(["/(", &joined(&below), ")"]),
        }
        (text, Precedence::Product)
    }

    fn factor(&mut self, factor: &Factor) -> Written {
        match factor {
            Factor::Node(id) => match self.budget.checked_sub(1) {
                Some(budget) => {
                    self.budget = budget;
                    self.depth += 1;
                    let written = if self.depth >= DEEPEST_NESTING {
                        ("…".into(), Precedence::Atom)
                    } else {
                        self.node(*id)
                    };
                    self.depth -= 1;
                    written
                }
                None => ("…".into(), Precedence::Atom),
            },
            Factor::Power(base, exponent) if exponent.is_one() => {
                (self.operand(*base, Precedence::Power), Precedence::Power)
            }
            Factor::Power(base, exponent) => {
                let base = self.operand(*base, Precedence::Atom);
                let exponent = parenthesised(exponent.to_string(), !exponent.is_integer());
                (format!("{base}^{exponent}"), Precedence::Power)
            }
        }
    }

    /// A product taken apart.
    fn factors(&self, root: Id) -> Product {
        let mut product = Product::default();
        let mut stack = vec![(false, root)];
        while let Some((inverse, id)) = stack.pop() {
            match &self.dag[id] {
                Math::Neg(u) => {
                    product.negative = !product.negative;
                    stack.push((inverse, *u));
                }
                Math::Mul([u, v]) => stack.extend([(inverse, *v), (inverse, *u)]),
                Math::Div([u, v]) => stack.extend([(!inverse, *v), (inverse, *u)]),
                // a division by the constant zero is shown as it stands
                Math::Constant(value) if !(inverse && self.dag.is_zero(id)) => {
                    let value = if inverse {
                        value.recip()
                    } else {
                        value.clone()
                    };
                    let constant = product.constant.take().unwrap_or_else(Rational::one);
                    product.constant = Some(constant * value);
                }
                Math::Pow([base, exponent]) if self.is_negative_constant(*exponent) => {
                    let exponent = self.dag.as_constant(*exponent).map(|value| -value);
                    let power = Factor::Power(*base, exponent.unwrap_or_else(Rational::one));
                    product.side(!inverse).push(power);
                }
                _ => product.side(inverse).push(Factor::Node(id)),
            }
            if product.numerator.len() + product.denominator.len() > self.budget {
                break;
            }
        }
        product
    }
}

impl Product {
    fn side(&mut self, inverse: bool) -> &mut Vec<Factor> {
        if inverse {
            &mut self.denominator
        } else {
            &mut self.numerator
        }
    }
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
