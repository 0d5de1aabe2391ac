//! Expression → normal form, node by node.

use std::collections::{HashMap, HashSet};

use egg::Language;

use super::super::{BuildQuick, Dag, Id, Math};
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
            Math::Pow([u, v]) => {
                let (u, v) = (of(u)?, of(v)?);
                match v.as_number() {
                    Some(exponent) => algebra.rational_power(u, &exponent),
                    None => {
                        let logarithm = algebra.ln(u)?;
                        let product = algebra.mul(v, &logarithm)?;
                        algebra.exp(&product)
                    }
                }
            }
            Math::Call(function, u) => algebra.call(*function, of(u)?),
            Math::Pair(function, [a, b]) => algebra.pair(*function, of(a)?, of(b)?),
        }
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
                    let base = known(&self.known, u)?;
                    return self.algebra.rational_power(base, &exponent.neg());
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
