//! The constructors of sums, products, powers and calls. They fold exact constants and apply
//! the identities that never lose accuracy or change a domain (0 + u, 1·u, −(−u), signs moved
//! outwards, constant factors collected in front), and nothing else: distribution,
//! cancellation and cost belong to later passes.

use egg::Id;
use num_traits::{Signed, Zero};

use super::super::{Function, Math, PairFunction, Rational};
use super::Dag;

/// Integer powers of constants are folded up to this exponent; larger ones stay symbolic.
const LARGEST_FOLDED_EXPONENT: u64 = 512;

impl Dag {
    /// a + b
    pub fn add(&mut self, a: Id, b: Id) -> Id {
        if self.is_zero(a) {
            return b;
        }
        if self.is_zero(b) {
            return a;
        }
        match (self[a].clone(), self[b].clone()) {
            (Math::Constant(p), Math::Constant(q)) => self.constant(p + q),
            (Math::Neg(p), Math::Neg(q)) => {
                let sum = self.add(p, q);
                self.neg(sum)
            }
            (_, Math::Neg(q)) => self.sub(a, q),
            (Math::Neg(p), _) => self.sub(b, p),
            (_, Math::Constant(q)) if q.is_negative() => {
                let q = self.constant(-q);
                self.sub(a, q)
            }
            _ if a == b => {
                let two = self.integer(2);
                self.mul(two, a)
            }
            _ => self.insert_commutative(Math::Add, a, b),
        }
    }

    /// a − b
    pub fn sub(&mut self, a: Id, b: Id) -> Id {
        if self.is_zero(b) {
            return a;
        }
        if self.is_zero(a) {
            return self.neg(b);
        }
        if a == b {
            return self.integer(0);
        }
        match (self[a].clone(), self[b].clone()) {
            (Math::Constant(p), Math::Constant(q)) => self.constant(p - q),
            (_, Math::Neg(q)) => self.add(a, q),
            (Math::Neg(p), _) => {
                let sum = self.add(p, b);
                self.neg(sum)
            }
            (_, Math::Constant(q)) if q.is_negative() => {
                let q = self.constant(-q);
                self.add(a, q)
            }
            _ => self.insert(Math::Sub([a, b])),
        }
    }

    /// −a
    pub fn neg(&mut self, a: Id) -> Id {
        match self[a].clone() {
            Math::Constant(p) => self.constant(-p),
            Math::Neg(p) => p,
            Math::Sub([p, q]) => self.sub(q, p),
            _ => self.insert(Math::Neg(a)),
        }
    }

    /// a·b
    pub fn mul(&mut self, a: Id, b: Id) -> Id {
        if self.is_zero(a) || self.is_one(b) {
            return a;
        }
        if self.is_zero(b) || self.is_one(a) {
            return b;
        }
        match (self[a].clone(), self[b].clone()) {
            (Math::Constant(p), Math::Constant(q)) => self.constant(p * q),
            (Math::Neg(p), Math::Neg(q)) => self.mul(p, q),
            (Math::Neg(p), _) => {
                let product = self.mul(p, b);
                self.neg(product)
            }
            (_, Math::Neg(q)) => {
                let product = self.mul(a, q);
                self.neg(product)
            }
            (Math::Constant(p), _) if p.is_negative() => {
                let p = self.constant(-p);
                let product = self.mul(p, b);
                self.neg(product)
            }
            (_, Math::Constant(_)) => self.mul(b, a),
            // constant factors are collected in front: p·(q·u) = (p·q)·u, u·(q·v) = q·(u·v)
            (Math::Constant(_), Math::Mul([q, u])) if self.as_constant(q).is_some() => {
                let factor = self.mul(a, q);
                self.mul(factor, u)
            }
            (Math::Constant(_), Math::Div([q, u])) if self.as_constant(q).is_some() => {
                let factor = self.mul(a, q);
                self.div(factor, u)
            }
            (Math::Mul([q, u]), _) if self.as_constant(q).is_some() => {
                let product = self.mul(u, b);
                self.mul(q, product)
            }
            (_, Math::Mul([q, u])) if self.as_constant(q).is_some() => {
                let product = self.mul(a, u);
                self.mul(q, product)
            }
            _ if a == b => {
                let two = self.integer(2);
                self.pow(a, two)
            }
            _ => self.insert_commutative(Math::Mul, a, b),
        }
    }

    /// a/b; a division by the constant zero stays as it is, for the caller to refuse.
    pub fn div(&mut self, a: Id, b: Id) -> Id {
        if self.is_zero(b) {
            return self.insert(Math::Div([a, b]));
        }
        if self.is_zero(a) || self.is_one(b) {
            return a;
        }
        if a == b {
            return self.integer(1);
        }
        match (self[a].clone(), self[b].clone()) {
            (_, Math::Constant(q)) => {
                let factor = self.constant(q.recip());
                self.mul(factor, a)
            }
            (Math::Neg(p), Math::Neg(q)) => self.div(p, q),
            (Math::Neg(p), _) => {
                let quotient = self.div(p, b);
                self.neg(quotient)
            }
            (_, Math::Neg(q)) => {
                let quotient = self.div(a, q);
                self.neg(quotient)
            }
            _ => self.insert(Math::Div([a, b])),
        }
    }

    /// a^b
    pub fn pow(&mut self, a: Id, b: Id) -> Id {
        if self.is_one(b) {
            return a;
        }
        if self.is_one(a) {
            return a;
        }
        match self.as_integer(b) {
            Some(0) => return self.integer(1),
            Some(n) => return self.integer_power(a, n, b),
            None => {}
        }
        if self
            .as_constant(b)
            .is_some_and(|e| *e == Rational::new(1.into(), 2.into()))
        {
            return self.call(Function::Sqrt, a);
        }
        self.insert(Math::Pow([a, b]))
    }

    fn integer_power(&mut self, a: Id, n: i64, exponent: Id) -> Id {
        match self[a].clone() {
            Math::Constant(value)
                if n.unsigned_abs() <= LARGEST_FOLDED_EXPONENT && !(value.is_zero() && n < 0) =>
            {
                self.constant(value.pow(n as i32))
            }
            Math::Neg(p) => {
                let power = self.pow(p, exponent);
                if n % 2 == 0 { power } else { self.neg(power) }
            }
            Math::Pow([base, inner]) => match self.as_integer(inner).and_then(|m| m.checked_mul(n))
            {
                Some(product) => {
                    let product = self.integer(product);
                    self.pow(base, product)
                }
                None => self.insert(Math::Pow([a, exponent])),
            },
            _ => self.insert(Math::Pow([a, exponent])),
        }
    }

    /// a² and other small integer powers.
    pub fn powi(&mut self, a: Id, n: i64) -> Id {
        let n = self.integer(n);
        self.pow(a, n)
    }

    /// `function(a)`
    pub fn call(&mut self, function: Function, a: Id) -> Id {
        let integers = function.properties().integers;
        let known = self
            .as_integer(a)
            .and_then(|a| integers.iter().find(|(u, _)| *u == a));
        match known {
            Some(&(_, value)) => self.integer(value),
            None => self.insert(Math::Call(function, a)),
        }
    }

    /// `function(a, b)`
    pub fn pair(&mut self, function: PairFunction, a: Id, b: Id) -> Id {
        self.insert(Math::Pair(function, [a, b]))
    }

    /// √a
    pub fn sqrt(&mut self, a: Id) -> Id {
        self.call(Function::Sqrt, a)
    }

    /// Σ terms, 0 if there are none.
    pub fn sum(&mut self, terms: impl IntoIterator<Item = Id>) -> Id {
        let zero = self.integer(0);
        terms
            .into_iter()
            .fold(zero, |sum, term| self.add(sum, term))
    }

    /// s u + (1 − s) v
    pub fn blend(&mut self, s: Id, u: Id, v: Id) -> Id {
        let one = self.integer(1);
        let other = self.sub(one, s);
        let (first, second) = (self.mul(s, u), self.mul(other, v));
        self.add(first, second)
    }

    /// (a + b)/2
    pub fn mean(&mut self, a: Id, b: Id) -> Id {
        let half = self.fraction(1, 2);
        let sum = self.add(a, b);
        self.mul(half, sum)
    }
}
