//! Expression → formula.

use num_traits::{One, Signed};

use super::formula::{Formula, FormulaId, Formulas};
use super::symbol::Symbol;
use crate::algebra::{Dag, Function, Id, Math, PairFunction, Rational};

/// A sum or a product is taken apart into no more operands than this; what is left stays
/// together (as a tree an expression may be exponentially larger than its DAG).
const MOST_OPERANDS: usize = 1_000;

/// The outermost operation of an expression, with the operands that are written in it.
enum Shape {
    Leaf(Formula),
    Call(Function, Id),
    Pair(PairFunction, [Id; 2]),
    Power(Id, Id),
    Sum(Vec<(bool, Id)>),
    Product {
        negative: bool,
        factors: Vec<Factor>,
    },
}

/// A factor, or a power of one; and whether it is divided by.
struct Factor {
    inverse: bool,
    base: Id,
    exponent: Option<Rational>,
}

impl Shape {
    fn of(formulas: &Formulas, dag: &Dag, id: Id) -> Self {
        match &dag[id] {
            Math::Pi => Self::Leaf(Formula::Pi),
            Math::Constant(value) => Self::Leaf(Formula::Constant(value.clone())),
            Math::Variable(name) => {
                let symbol = match formulas.written_as.get(name) {
                    Some(symbol) => symbol.clone(),
                    None => Symbol::from(name),
                };
                Self::Leaf(Formula::Symbol(symbol))
            }
            Math::Call(function, u) => Self::Call(*function, *u),
            Math::Pair(function, pair) => Self::Pair(*function, *pair),
            Math::Pow([base, exponent]) if !is_negative_constant(dag, *exponent) => {
                Self::Power(*base, *exponent)
            }
            Math::Add(_) | Math::Sub(_) => Self::Sum(terms(dag, id)),
            _ => product(dag, id),
        }
    }

    fn operands(&self) -> Vec<Id> {
        match self {
            Self::Leaf(_) => Vec::new(),
            Self::Call(_, u) => vec![*u],
            Self::Pair(_, [u, v]) | Self::Power(u, v) => vec![*u, *v],
            Self::Sum(terms) => terms.iter().map(|(_, term)| *term).collect(),
            Self::Product { factors, .. } => factors.iter().map(|factor| factor.base).collect(),
        }
    }
}

fn is_negative_constant(dag: &Dag, id: Id) -> bool {
    dag.as_constant(id).is_some_and(Signed::is_negative)
}

/// The signed terms of a sum, in order.
fn terms(dag: &Dag, root: Id) -> Vec<(bool, Id)> {
    let mut terms = Vec::new();
    let mut stack = vec![(false, root)];
    while let Some((negative, id)) = stack.pop() {
        match dag[id] {
            // the operands of the root itself always stand apart
            _ if id != root && terms.len() + stack.len() >= MOST_OPERANDS => {
                terms.push((negative, id));
            }
            Math::Add([u, v]) => stack.extend([(negative, v), (negative, u)]),
            Math::Sub([u, v]) => stack.extend([(!negative, v), (negative, u)]),
            Math::Neg(u) => stack.push((!negative, u)),
            _ => terms.push((negative, id)),
        }
    }
    terms
}

/// A product taken apart.
fn product(dag: &Dag, root: Id) -> Shape {
    let mut negative = false;
    let mut factors = Vec::new();
    let mut stack = vec![(false, root)];
    while let Some((inverse, id)) = stack.pop() {
        match &dag[id] {
            _ if id != root && factors.len() + stack.len() >= MOST_OPERANDS => {
                factors.push(Factor::whole(inverse, id));
            }
            Math::Neg(u) => {
                negative = !negative;
                stack.push((inverse, *u));
            }
            Math::Mul([u, v]) => stack.extend([(inverse, *v), (inverse, *u)]),
            Math::Div([u, v]) => stack.extend([(!inverse, *v), (inverse, *u)]),
            Math::Pow([base, exponent]) if is_negative_constant(dag, *exponent) => {
                factors.push(Factor {
                    inverse: !inverse,
                    base: *base,
                    exponent: dag.as_constant(*exponent).map(|value| -value),
                });
            }
            _ => factors.push(Factor::whole(inverse, id)),
        }
    }
    Shape::Product { negative, factors }
}

impl Factor {
    fn whole(inverse: bool, base: Id) -> Self {
        Self {
            inverse,
            base,
            exponent: None,
        }
    }
}

impl Formulas {
    /// The formula of an expression. All calls must be with the same `dag`.
    pub fn build(&mut self, dag: &Dag, root: Id) -> FormulaId {
        let mut stack = vec![(root, Shape::of(self, dag, root))];
        while let Some((id, shape)) = stack.pop() {
            let missing: Vec<Id> = shape
                .operands()
                .into_iter()
                .filter(|operand| !self.image.contains_key(operand))
                .collect();
            if missing.is_empty() {
                let formula = self.formula(shape);
                self.image.insert(id, formula);
            } else {
                stack.push((id, shape));
                for operand in missing {
                    stack.push((operand, Shape::of(self, dag, operand)));
                }
            }
        }
        self.image[&root]
    }

    /// A formula whose operands are there.
    fn formula(&mut self, shape: Shape) -> FormulaId {
        match shape {
            Shape::Leaf(leaf) => self.insert(leaf),
            Shape::Call(function, u) => self.insert(Formula::Call(function, self.image[&u])),
            Shape::Pair(function, pair) => {
                let pair = pair.map(|id| self.image[&id]);
                self.insert(Formula::Pair(function, pair))
            }
            Shape::Power(base, exponent) => {
                let (base, exponent) = (self.image[&base], self.image[&exponent]);
                self.insert(Formula::Power(base, exponent))
            }
            Shape::Sum(terms) => {
                let terms: Vec<(bool, FormulaId)> = terms
                    .into_iter()
                    .map(|(negative, term)| (negative, self.image[&term]))
                    .collect();
                self.sum(terms)
            }
            Shape::Product { negative, factors } => {
                let factors: Vec<(bool, FormulaId)> = factors
                    .into_iter()
                    .map(|factor| {
                        let base = self.image[&factor.base];
                        let exponent = factor.exponent.unwrap_or_else(Rational::one);
                        (factor.inverse, self.power(base, exponent))
                    })
                    .collect();
                self.product(negative, factors)
            }
        }
    }
}
