//! Expression → normal form, node by node.

use std::collections::HashSet;

use egg::Language;
use rustc_hash::FxHashMap;

use super::super::{Dag, Function, Id, Math};
use super::Obstacle;
use super::algebra::{Algebra, Kind};
use super::fraction::Fraction;
use super::number::{Coefficient, Number};

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
    known: FxHashMap<Id, Fraction>,
    /// Whether long sums that are multiplied become symbols.
    folds: bool,
}

/// A sum of fewer terms is no symbol.
const FEWEST_FOLDED: usize = 4;

/// The normal form of `root` with long sums in products and powers as symbols, equal sums as
/// the same one: zero is found without multiplying them out where they cancel as they are.
pub(super) fn folded_form(
    algebra: &mut Algebra,
    dag: &Dag,
    root: Id,
) -> Result<Fraction, Obstacle> {
    let mut forms = Forms::new(algebra, dag);
    forms.folds = true;
    forms.of(root)
}

impl<'a> Forms<'a> {
    pub(super) fn new(algebra: &'a mut Algebra, dag: &'a Dag) -> Self {
        Self {
            algebra,
            dag,
            known: FxHashMap::default(),
            folds: false,
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
        if self.folds
            && let Some(form) = self.folded_product(id)?
        {
            return Ok(form);
        }
        match &self.dag[id] {
            // a function of its inverse, wherever that is defined
            Math::Call(outer, inner) if self.algebra.decides => {
                if let Math::Call(function, u) = &self.dag[*inner]
                    && outer.properties().right_inverse == Some(*function)
                {
                    return known(&self.known, *u).cloned();
                }
            }
            _ => {}
        }
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
            Math::Call(Function::Ln, u) => self.ln(*u),
            Math::Call(Function::Sqrt, u) => self.power(*u, &Number::Small(1, 2)),
            Math::Call(function, u) => algebra.call(*function, of(u)?),
            Math::Pair(function, [a, b]) => algebra.pair(*function, of(a)?, of(b)?),
        }
    }

    /// The form of a product or a power, with long sums in it as symbols.
    fn folded_product(&mut self, id: Id) -> Result<Option<Fraction>, Obstacle> {
        Ok(match self.dag[id] {
            Math::Mul([u, v]) => {
                let (u, v) = (self.folded(u)?, self.folded(v)?);
                Some(self.algebra.mul(&u, &v)?)
            }
            Math::Div([u, v]) => {
                let (u, v) = (self.folded(u)?, self.folded(v)?);
                Some(self.algebra.div(&u, &v)?)
            }
            Math::Pow([u, v]) => match known(&self.known, v)?.as_number() {
                Some(exponent) if exponent.as_integer().is_some() => {
                    let u = self.folded(u)?;
                    Some(self.algebra.rational_power(&u, &exponent)?)
                }
                _ => None,
            },
            _ => None,
        })
    }

    /// The form of a sum as a number times a symbol, if it is long.
    fn folded(&mut self, id: Id) -> Result<Fraction, Obstacle> {
        let form = known(&self.known, id)?;
        let is_sum = matches!(self.dag[id], Math::Add(_) | Math::Sub(_));
        if !is_sum || form.numerator.len() < FEWEST_FOLDED {
            return Ok(form.clone());
        }
        let form = self.algebra.cancel(form.clone());
        let mut content = form.numerator.content();
        if form.leads_negative() {
            content = content.neg();
        }
        let scale = content.recip().ok_or(Obstacle::Undefined)?;
        let symbol = Kind::Opaque(form.scaled(&Coefficient::real(scale)));
        let symbol = self.algebra.intern(symbol)?;
        Ok(Fraction::atom(symbol).scaled(&Coefficient::real(content)))
    }

    /// The form of `base`^`exponent`. Where `base` is a power itself, an odd or a fractional one,
    /// it is defined and not negative where *its* base is not: (uⁿ)^r = u^(nr); of an even power,
    /// (uⁿ)^r = (u²)^(nr/2).
    fn power(&mut self, base: Id, exponent: &Number) -> Result<Fraction, Obstacle> {
        let split = match exponent.as_integer() {
            None => self.as_power(base)?,
            Some(_) => None,
        };
        match split {
            Some((u, inner)) => self.algebra.rational_power(&u, &inner.mul(exponent)),
            None => {
                let whole = known(&self.known, base)?;
                self.algebra.rational_power(whole, exponent)
            }
        }
    }

    /// The form of ln `argument`: of a power, ln uⁿ = n ln u and, for an even n, (n/2) ln u².
    fn ln(&mut self, argument: Id) -> Result<Fraction, Obstacle> {
        match self.as_power(argument)? {
            Some((u, inner)) => {
                let logarithm = self.algebra.ln(&u)?;
                Ok(logarithm.scaled(&Coefficient::real(inner)))
            }
            None => self.algebra.ln(known(&self.known, argument)?),
        }
    }

    fn is_even_power(&self, id: Id) -> bool {
        match self.dag[id] {
            Math::Pow([_, v]) => self.dag.as_integer(v).is_some_and(|n| n % 2 == 0),
            _ => false,
        }
    }

    /// (u, n) of a node uⁿ; (u², n/2) for an even n, so that u ≥ 0 wherever uⁿ ≥ 0.
    fn as_power(&mut self, id: Id) -> Result<Option<(Fraction, Number)>, Obstacle> {
        if let Math::Neg(inner) = self.dag[id]
            && let Some((u, exponent)) = self.as_power(inner)?
            && exponent.as_integer().is_some_and(|n| n % 2 != 0)
            && !self.is_even_power(inner)
        {
            return Ok(Some((u.neg(), exponent)));
        }
        let split = match self.dag[id] {
            _ if !self.algebra.decides => None,
            Math::Pow([u, v]) => {
                let exponent = known(&self.known, v)?.as_number();
                exponent.map(|exponent| (u, exponent))
            }
            Math::Call(Function::Sqrt, u) => Some((u, Number::Small(1, 2))),
            _ => None,
        };
        let Some((u, exponent)) = split else {
            return Ok(None);
        };
        let u = known(&self.known, u)?;
        if exponent.as_integer().is_some_and(|n| n % 2 == 0) {
            let square = self.algebra.mul(u, u)?;
            return Ok(Some((square, exponent.mul(&Number::Small(1, 2)))));
        }
        Ok(Some((u.clone(), exponent)))
    }

    /// The form of 1/`id`. Products and powers are inverted factor by factor, which keeps the
    /// factors of the denominator apart.
    fn inverse(&mut self, id: Id) -> Result<Fraction, Obstacle> {
        match self.dag[id] {
            // a product of constants may be simpler than its factors
            Math::Mul([u, v]) if !self.algebra.is_constant(known(&self.known, id)?) => {
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

fn known(forms: &FxHashMap<Id, Fraction>, id: Id) -> Result<&Fraction, Obstacle> {
    forms.get(&id).ok_or(Obstacle::Undefined)
}
