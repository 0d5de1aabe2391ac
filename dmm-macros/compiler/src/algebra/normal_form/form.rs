//! Expression → normal form, node by node.

use std::collections::{HashMap, HashSet};

use egg::Language;

use super::super::{BuildQuick, Dag, Function, Id, Math};
use super::Obstacle;
use super::algebra::{Algebra, Kind};
use super::fraction::Fraction;
use super::number::Number;

/// The normal form of `root`.
pub(super) fn normal_form(
    algebra: &mut Algebra,
    dag: &Dag,
    root: Id,
) -> Result<Fraction, Obstacle> {
    Forms::new(algebra, dag).of(root)
}

/// The forms of nodes, each computed once.
pub(super) struct Forms<'a> {
    algebra: &'a mut Algebra,
    dag: &'a Dag,
    known: HashMap<Id, Fraction, BuildQuick>,
}

impl<'a> Forms<'a> {
    pub(super) fn new(algebra: &'a mut Algebra, dag: &'a Dag) -> Self {
        Self {
            algebra,
            dag,
            known: HashMap::default(),
        }
    }

    pub(super) fn algebra(&mut self) -> &mut Algebra {
        self.algebra
    }

    /// The form of `root`.
    pub(super) fn of(&mut self, root: Id) -> Result<Fraction, Obstacle> {
        self.complete(root)?;
        self.known.get(&root).cloned().ok_or(Obstacle::Undefined)
    }

    /// The form of 1/`root`.
    pub(super) fn inverse_of(&mut self, root: Id) -> Result<Fraction, Obstacle> {
        self.complete(root)?;
        self.inverse(root)
    }

    fn complete(&mut self, root: Id) -> Result<(), Obstacle> {
        if self.known.contains_key(&root) {
            return Ok(());
        }
        for id in self.below(root) {
            let form = self.node(id)?;
            self.known.insert(id, form);
        }
        Ok(())
    }

    /// The nodes that `root` is made of and whose forms are not known, children first.
    fn below(&self, root: Id) -> Vec<Id> {
        let mut seen: HashSet<Id> = HashSet::from([root]);
        let mut stack = vec![root];
        let mut reached = Vec::new();
        while let Some(id) = stack.pop() {
            reached.push(id);
            for &child in self.dag[id].children() {
                if !self.known.contains_key(&child) && seen.insert(child) {
                    stack.push(child);
                }
            }
        }
        reached.sort_unstable();
        reached
    }
    /// The form of a node whose children have theirs.
    fn node(&mut self, id: Id) -> Result<Fraction, Obstacle> {
        let of = |id: &Id| known(&self.known, *id);
        let algebra = &mut *self.algebra;
        match &self.dag[id] {
            Math::Pi => Ok(Fraction::atom(algebra.intern(Kind::Pi)?)),
            Math::Constant(value) => Ok(Fraction::number(Number::from_rational(value))),
            Math::Variable(name) => Ok(Fraction::atom(algebra.variable(name))),
            Math::Neg(u) => Ok(of(u)?.neg()),
            Math::Add([u, v]) => algebra.add(of(u)?, of(v)?),
            Math::Sub([u, v]) => algebra.sub(of(u)?, of(v)?),
            Math::Mul([u, v]) => algebra.mul(of(u)?, of(v)?),
            Math::Div([u, v]) => {
                let inverse = self.inverse(*v)?;
                self.algebra.mul(known(&self.known, *u)?, &inverse)
            }
            Math::Pow([base, v]) => {
                let (u, v) = (of(base)?, of(v)?);
                match v.as_number() {
                    Some(exponent) => self.power(*base, &exponent),
                    None => {
                        let logarithm = algebra.ln(u)?;
                        let product = algebra.mul(v, &logarithm)?;
                        algebra.exp(&product)
                    }
                }
            }
            Math::Call(Function::Sqrt, u) => self.power(*u, &Number::Small(1, 2)),
            Math::Call(function, u) => algebra.call(*function, of(u)?),
            Math::Pair(function, [a, b]) => algebra.pair(*function, of(a)?, of(b)?),
        }
    }

    /// The form of `base`^`exponent`. Where `base` is a power itself, an odd or a fractional one,
    /// it is defined and not negative where *its* base is not: (uⁿ)^r = u^(nr); of an even power,
    /// (uⁿ)^r = (u²)^(nr/2).
    fn power(&mut self, base: Id, exponent: &Number) -> Result<Fraction, Obstacle> {
        let whole = known(&self.known, base)?;
        let inner = match self.dag[base] {
            _ if !self.algebra.decides || exponent.as_integer().is_some() => None,
            Math::Pow([u, v]) => Some((u, known(&self.known, v)?.as_number())),
            Math::Call(Function::Sqrt, u) => Some((u, Some(Number::Small(1, 2)))),
            _ => None,
        };
        let Some((u, Some(inner))) = inner else {
            return self.algebra.rational_power(whole, exponent);
        };
        let u = known(&self.known, u)?;
        if inner.as_integer().is_some_and(|n| n % 2 == 0) {
            let square = self.algebra.mul(u, u)?;
            let half = inner.mul(&Number::Small(1, 2));
            return self.algebra.rational_power(&square, &half.mul(exponent));
        }
        self.algebra.rational_power(u, &inner.mul(exponent))
    }

    /// The form of 1/`id`. Products and powers are inverted factor by factor, which keeps the
    /// factors of the denominator apart.
    fn inverse(&mut self, id: Id) -> Result<Fraction, Obstacle> {
        match self.dag[id] {
            Math::Mul([u, v]) => {
                let u = self.inverse(u)?;
                let v = self.inverse(v)?;
                return self.algebra.mul(&u, &v);
            }
            Math::Pow([u, v]) => {
                if let Some(exponent) = known(&self.known, v)?.as_number() {
                    return self.power(u, &exponent.neg());
                }
            }
            _ => {}
        }
        self.algebra.inverse(known(&self.known, id)?)
    }
}

fn known(forms: &HashMap<Id, Fraction, BuildQuick>, id: Id) -> Result<&Fraction, Obstacle> {
    forms.get(&id).ok_or(Obstacle::Undefined)
}
