//! Lowering: from mathematics to operations of a floating-point machine.
//!
//! Integer powers become chains of products (x³ = x²·x, x² shared), half-integer powers
//! square roots, and factors that depend on parameters alone are brought together, so that
//! their product is computed once before an integration. Signs are moved outwards, so that a − b and
//! b − a are one operation and (a − b)² is (b − a)². No form is chosen that rounds more often than the
//! mathematics as written: u/3 stays a division, because 1/3 is not a double.

use std::collections::{BTreeSet, HashMap};

use egg::Language;
use num_traits::{One, ToPrimitive, Zero};

use super::constant::{fold, is_double};
use super::optimise::{Optimiser, Source};
use crate::algebra::{Dag, Function, Id, Math, Name, Rational};
use crate::model::Model;

/// Integer powers up to this one become chains of products.
const LONGEST_CHAIN: i64 = 64;

/// Lowered expressions: a DAG in which [`Math::Mul`] of a node with itself is a square.
#[derive(Debug)]
pub struct Lowered {
    dag: Dag,
    /// The variables that do not change within an integration.
    parameters: Vec<Name>,
    image: HashMap<Id, Id>,
    /// By node of `dag`: whether it depends on parameters alone.
    fixed: Vec<bool>,
}

impl Lowered {
    /// Nothing yet.
    pub(crate) fn new(parameters: Vec<Name>) -> Self {
        Self {
            dag: Dag::new(),
            parameters,
            image: HashMap::new(),
            fixed: Vec::new(),
        }
    }

    /// The variables that do not change within an integration.
    pub(super) fn parameters(&self) -> &[Name] {
        &self.parameters
    }

    /// The lowered operations.
    pub fn dag(&self) -> &Dag {
        &self.dag
    }

    /// Whether a node depends on parameters and constants alone.
    pub fn is_fixed(&self, id: Id) -> bool {
        self.fixed.get(usize::from(id)).copied().unwrap_or(false)
    }

    /// Whether a node is a variable or a constant, or one with a sign.
    pub fn is_leaf(&self, id: Id) -> bool {
        match self.dag[id] {
            Math::Constant(_) | Math::Variable(_) => true,
            Math::Neg(a) => self.is_leaf(a),
            _ => false,
        }
    }

    /// The factors of ±p·t, p fixed: an exponent that grows with the time, and the rounding
    /// error of the product with it.
    pub fn secular(&self, id: Id) -> Option<(bool, Id, Id)> {
        match self.dag[id] {
            Math::Neg(a) => {
                let (negative, p, t) = self.secular(a)?;
                Some((!negative, p, t))
            }
            Math::Mul([p, t]) if self.is_fixed(p) => match &self.dag[t] {
                Math::Variable(name) if *name == Model::time() => Some((false, p, t)),
                _ => None,
            },
            _ => None,
        }
    }

    /// Whether a node is the exponential of a [`Self::secular`] exponent.
    fn is_secular_exponential(&self, id: Id) -> bool {
        matches!(self.dag[id], Math::Call(Function::Exp, exponent) if self.secular(exponent).is_some())
    }

    /// The nodes that `roots` need and that are not known, in the order in which they are
    /// evaluated: children before parents.
    pub fn order(&self, roots: &[Id], is_known: impl Fn(Id) -> bool) -> Vec<Id> {
        let mut nodes = BTreeSet::new();
        let mut stack = roots.to_vec();
        while let Some(id) = stack.pop() {
            if !is_known(id) && nodes.insert(id) {
                self.dag[id].for_each(|child| stack.push(child));
            }
        }
        nodes.into_iter().collect()
    }

    /// Replaces the roots of `functions` in `source` by optimised ones of this DAG.
    pub(super) fn optimise(
        &mut self,
        source: &Self,
        functions: Vec<Vec<&mut Id>>,
        optimiser: &mut Optimiser,
    ) {
        let roots = functions
            .iter()
            .map(|function| function.iter().map(|root| **root).collect());
        let source = Source {
            dag: &source.dag,
            is_fixed: &|id| source.is_fixed(id),
            is_atom: &|id| source.is_secular_exponential(id),
            functions: roots.collect(),
        };
        let optimised = optimiser.optimise(&source, &mut |node| match node {
            Math::Mul([a, b]) => self.multiply(a, b),
            node => self.insert(node),
        });
        for (function, images) in functions.into_iter().zip(optimised) {
            for (root, image) in function.into_iter().zip(images) {
                *root = image;
            }
        }
    }

    /// Adds a node of `other` as it is.
    pub(super) fn copy(&mut self, other: &Self, root: Id) -> Id {
        let mut image: HashMap<Id, Id> = HashMap::new();
        for id in other.dag.reachable([root]) {
            let node = other.dag[id].clone();
            let copy = self.insert(node.map_children(|child| image[&child]));
            image.insert(id, copy);
        }
        image[&root]
    }

    /// Lowers `root` of `source`. All calls must be with the same `source`.
    pub(crate) fn lower(&mut self, source: &Dag, root: Id) -> Id {
        for id in source.reachable([root]) {
            if self.image.contains_key(&id) {
                continue;
            }
            let lowered = self.lower_node(&source[id]);
            self.image.insert(id, lowered);
        }
        self.image[&root]
    }

    fn lower_node(&mut self, node: &Math) -> Id {
        let node = node.clone().map_children(|child| self.image[&child]);
        if let Some(value) = fold(&node, |child| self.dag.as_constant(child).cloned()) {
            return self.constant(value);
        }
        match node {
            Math::Add([a, b]) => self.sum(a, b),
            Math::Sub([a, b]) => self.difference(a, b),
            Math::Neg(a) => self.negative(a),
            Math::Mul([a, b]) => self.signed([a, b], Self::product),
            Math::Div([a, b]) => self.signed([a, b], Self::quotient),
            Math::Pow([a, b]) => self.signed_power(a, b),
            Math::Call(function, a) => self.signed_call(function, a),
            node => self.insert(node),
        }
    }

    pub(super) fn insert(&mut self, node: Math) -> Id {
        let fixed = match &node {
            Math::Variable(name) => self.parameters.contains(name),
            node => node.all(|child| self.is_fixed(child)),
        };
        let id = self.dag.insert(node);
        if usize::from(id) == self.fixed.len() {
            self.fixed.push(fixed);
        }
        id
    }

    fn constant(&mut self, value: Rational) -> Id {
        self.insert(Math::Constant(value))
    }

    /// a·b, with what is fixed in front and together, and without reciprocals.
    fn product(&mut self, a: Id, b: Id) -> Id {
        let (a, b) = if self.is_fixed(b) && !self.is_fixed(a) {
            (b, a)
        } else {
            (a, b)
        };
        if let Some(value) = self.dag.as_constant(a).cloned() {
            if value.is_one() {
                return b;
            }
            let inverse = (!value.is_zero()).then(|| value.recip());
            if let (false, Some(inverse)) = (is_double(&value), inverse.filter(is_double)) {
                let divisor = self.constant(inverse);
                return self.insert(Math::Div([b, divisor]));
            }
        }
        match (self.dag[a].clone(), self.dag[b].clone()) {
            (_, Math::Mul([c, d])) if self.is_fixed(a) && self.is_fixed(c) && !self.is_fixed(d) => {
                let factor = self.product(a, c);
                self.product(factor, d)
            }
            (_, Math::Div([one, d])) if self.is_constant_one(one) => self.insert(Math::Div([a, d])),
            (Math::Div([one, d]), _) if self.is_constant_one(one) => self.insert(Math::Div([b, d])),
            _ => self.multiply(a, b),
        }
    }

    /// a/b; (p·u)/q becomes (p/q)·u where p and q are fixed, which rounds as often.
    fn quotient(&mut self, a: Id, b: Id) -> Id {
        match self.dag[a] {
            Math::Mul([p, u]) if self.is_fixed(p) && self.is_fixed(b) && !self.is_fixed(u) => {
                let factor = self.insert(Math::Div([p, b]));
                self.product(factor, u)
            }
            _ => self.insert(Math::Div([a, b])),
        }
    }

    /// a·b in one order: constants in front, then what is fixed.
    fn multiply(&mut self, a: Id, b: Id) -> Id {
        let rank = |id: Id| (self.dag.as_constant(id).is_none(), !self.is_fixed(id), id);
        let factors = if rank(a) <= rank(b) { [a, b] } else { [b, a] };
        self.insert(Math::Mul(factors))
    }

    fn is_constant_one(&self, id: Id) -> bool {
        self.dag.is_one(id)
    }

    /// aᵇ
    pub(super) fn power(&mut self, a: Id, b: Id) -> Id {
        let Some(exponent) = self.dag.as_constant(b).cloned() else {
            return self.insert(Math::Pow([a, b]));
        };
        let doubled = &exponent * Rational::from_integer(2.into());
        let halves = doubled
            .is_integer()
            .then(|| doubled.to_integer().to_i64())
            .flatten()
            .filter(|halves| halves.unsigned_abs() <= 2 * LONGEST_CHAIN.unsigned_abs());
        let Some(halves) = halves else {
            return self.insert(Math::Pow([a, b]));
        };
        let whole = self.chain(a, halves.abs() / 2);
        let power = if halves % 2 == 0 {
            whole
        } else {
            let root = self.insert(Math::Call(Function::Sqrt, a));
            match whole {
                Some(whole) => Some(self.multiply(whole, root)),
                None => Some(root),
            }
        };
        let one = self.constant(Rational::one());
        match power {
            None => one,
            Some(power) if halves < 0 => self.insert(Math::Div([one, power])),
            Some(power) => power,
        }
    }

    /// aⁿ by squaring; nothing for n = 0.
    fn chain(&mut self, a: Id, n: i64) -> Option<Id> {
        match n {
            0 => None,
            1 => Some(a),
            n if n % 2 == 0 => {
                let root = self.chain(a, n / 2)?;
                Some(self.multiply(root, root))
            }
            n => {
                let rest = self.chain(a, n - 1)?;
                Some(self.multiply(rest, a))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::to_text;

    /// The lowered form of a formula in x and y and the parameter k.
    fn lowered(formula: impl FnOnce(&mut Dag, [Id; 3]) -> Id) -> String {
        let mut source = Dag::new();
        let variables = ["x", "y", "k"].map(|name| source.variable(&Name::new(name)));
        let root = formula(&mut source, variables);
        let mut lowered = Lowered::new(vec![Name::new("k")]);
        let root = lowered.lower(&source, root);
        to_text(lowered.dag(), root)
    }

    #[test]
    fn powers_are_products_and_square_roots() {
        assert_eq!(lowered(|dag, [x, ..]| dag.powi(x, 3)), "x*x*x");
        assert_eq!(lowered(|dag, [x, ..]| dag.powi(x, -2)), "1/(x*x)");
        let half_integer = lowered(|dag, [x, ..]| {
            let exponent = dag.fraction(3, 2);
            dag.pow(x, exponent)
        });
        assert_eq!(half_integer, "x*sqrt(x)");
    }

    #[test]
    fn a_fourth_power_takes_two_products() {
        let mut source = Dag::new();
        let x = source.variable(&Name::new("x"));
        let root = source.powi(x, 4);
        let mut lowered = Lowered::new(Vec::new());
        let root = lowered.lower(&source, root);
        let products = lowered.dag().reachable([root]).len() - 1;
        assert_eq!(products, 2);
    }

    #[test]
    fn what_is_fixed_comes_together_in_front() {
        let product = lowered(|dag, [x, y, k]| {
            let sum = dag.add(x, y);
            let product = dag.mul(sum, k);
            let half = dag.fraction(1, 2);
            dag.mul(half, product)
        });
        assert_eq!(product, "k*(x + y)/2");
        let mut source = Dag::new();
        let [x, k] = ["x", "k"].map(|name| source.variable(&Name::new(name)));
        let half = source.fraction(1, 2);
        let product = source.mul(k, x);
        let product = source.mul(half, product);
        let mut lowered = Lowered::new(vec![Name::new("k")]);
        let root = lowered.lower(&source, product);
        let Math::Mul([factor, _]) = lowered.dag()[root] else {
            panic!("{}", to_text(lowered.dag(), root));
        };
        assert!(lowered.is_fixed(factor) && !lowered.is_leaf(factor));
    }

    #[test]
    fn a_factor_that_is_no_double_is_a_division_if_that_is_exact() {
        let operation = |numerator, denominator| {
            let mut source = Dag::new();
            let x = source.variable(&Name::new("x"));
            let factor = source.fraction(numerator, denominator);
            let root = source.mul(factor, x);
            let mut lowered = Lowered::new(Vec::new());
            let root = lowered.lower(&source, root);
            matches!(lowered.dag()[root], Math::Div(_))
        };
        assert!(operation(1, 3));
        assert!(operation(2, 3)); // by 3/2, a double
        assert!(!operation(1, 2));
        assert!(!operation(3, 7)); // neither 3/7 nor 7/3 is a double
    }
}
