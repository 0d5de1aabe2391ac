//! Power products of atoms with rational exponents, in lexicographic order.

use std::cmp::Ordering;

use num_integer::Integer;

use super::Obstacle;
use super::number::Number;

/// An atom: an index into the table of the [`Algebra`](super::algebra::Algebra).
pub(super) type Atom = u32;

/// A rational exponent in lowest terms, d > 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Exponent {
    n: i32,
    d: i32,
}

impl Exponent {
    pub(super) const ZERO: Self = Self { n: 0, d: 1 };
    pub(super) const ONE: Self = Self { n: 1, d: 1 };

    pub(super) fn integer(n: i32) -> Self {
        Self { n, d: 1 }
    }

    fn from_wide(n: i64, d: i64) -> Result<Self, Obstacle> {
        let divisor = n.gcd(&d);
        match (i32::try_from(n / divisor), i32::try_from(d / divisor)) {
            (Ok(n), Ok(d)) => Ok(Self { n, d }),
            _ => Err(Obstacle::TooLarge),
        }
    }

    pub(super) fn from_number(value: &Number) -> Result<Self, Obstacle> {
        match value {
            Number::Small(n, d) => Self::from_wide(*n, *d),
            Number::Big(_) => Err(Obstacle::TooLarge),
        }
    }

    pub(super) fn to_number(self) -> Number {
        Number::Small(self.n.into(), self.d.into())
    }

    pub(super) fn is_zero(self) -> bool {
        self.n == 0
    }

    pub(super) fn is_negative(self) -> bool {
        self.n < 0
    }

    /// Whether it is an even integer.
    pub(super) fn is_even(self) -> bool {
        self.d == 1 && self.n % 2 == 0
    }

    /// Whether a real power with this exponent exists for a positive base alone.
    pub(super) fn needs_positive_base(self) -> bool {
        self.d != 1
    }

    pub(super) fn floor(self) -> i32 {
        self.n.div_euclid(self.d)
    }

    pub(super) fn add(self, other: Self) -> Result<Self, Obstacle> {
        if self.d == 1 && other.d == 1 {
            return match self.n.checked_add(other.n) {
                Some(n) => Ok(Self { n, d: 1 }),
                None => Err(Obstacle::TooLarge),
            };
        }
        let [a, b, c, d] = [self.n, self.d, other.n, other.d].map(i64::from);
        // each product is below 2⁶² in size
        Self::from_wide(a * d + c * b, b * d)
    }

    pub(super) fn mul(self, other: Self) -> Result<Self, Obstacle> {
        let [a, b, c, d] = [self.n, self.d, other.n, other.d].map(i64::from);
        Self::from_wide(a * c, b * d)
    }

    pub(super) fn neg(self) -> Result<Self, Obstacle> {
        match self.n.checked_neg() {
            Some(n) => Ok(Self { n, d: self.d }),
            None => Err(Obstacle::TooLarge),
        }
    }

    pub(super) fn sub(self, other: Self) -> Result<Self, Obstacle> {
        self.add(other.neg()?)
    }

    pub(super) fn compare(self, other: Self) -> Ordering {
        if self.d == other.d {
            return self.n.cmp(&other.n);
        }
        let [a, b, c, d] = [self.n, self.d, other.n, other.d].map(i64::from);
        (a * d).cmp(&(c * b))
    }

    pub(super) fn min(self, other: Self) -> Self {
        if other.compare(self).is_lt() {
            other
        } else {
            self
        }
    }

    pub(super) fn max(self, other: Self) -> Self {
        if other.compare(self).is_gt() {
            other
        } else {
            self
        }
    }
}

/// A power of an atom.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Power {
    pub(super) atom: Atom,
    /// Not zero.
    pub(super) exponent: Exponent,
}

/// A power product: rising atoms, no exponent zero.
pub(super) type Monomial = Vec<Power>;

/// The lexicographic order, in which the atom with the smallest index weighs most. It is an
/// order of the *group* of monomials: a < b implies a·c < b·c for negative exponents as well.
pub(super) fn compare(a: &[Power], b: &[Power]) -> Ordering {
    let mut index = 0;
    loop {
        let order = match (a.get(index), b.get(index)) {
            (None, None) => return Ordering::Equal,
            (Some(p), None) => return sign(p.exponent),
            (None, Some(q)) => return sign(q.exponent).reverse(),
            (Some(p), Some(q)) if p.atom == q.atom => p.exponent.compare(q.exponent),
            (Some(p), Some(q)) if p.atom < q.atom => return sign(p.exponent),
            (Some(_), Some(q)) => return sign(q.exponent).reverse(),
        };
        if order != Ordering::Equal {
            return order;
        }
        index += 1;
    }
}

fn sign(exponent: Exponent) -> Ordering {
    exponent.n.cmp(&0)
}

/// a·b
pub(super) fn product(a: &[Power], b: &[Power]) -> Result<Monomial, Obstacle> {
    let mut result = Monomial::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while let (Some(p), Some(q)) = (a.get(i), b.get(j)) {
        match p.atom.cmp(&q.atom) {
            Ordering::Less => {
                result.push(*p);
                i += 1;
            }
            Ordering::Greater => {
                result.push(*q);
                j += 1;
            }
            Ordering::Equal => {
                let exponent = p.exponent.add(q.exponent)?;
                if !exponent.is_zero() {
                    let atom = p.atom;
                    result.push(Power { atom, exponent });
                }
                i += 1;
                j += 1;
            }
        }
    }
    result.extend_from_slice(a.get(i..).unwrap_or_default());
    result.extend_from_slice(b.get(j..).unwrap_or_default());
    Ok(result)
}

/// aᵉ
pub(super) fn power(a: &[Power], exponent: Exponent) -> Result<Monomial, Obstacle> {
    let mut result = Monomial::new();
    if exponent.is_zero() {
        return Ok(result);
    }
    for p in a {
        let exponent = p.exponent.mul(exponent)?;
        result.push(Power {
            atom: p.atom,
            exponent,
        });
    }
    Ok(result)
}

/// 1/a
pub(super) fn inverse(a: &[Power]) -> Result<Monomial, Obstacle> {
    power(a, Exponent::integer(-1))
}

/// The exponent of `atom` in `monomial`.
pub(super) fn exponent_of(monomial: &[Power], atom: Atom) -> Exponent {
    monomial
        .iter()
        .find(|power| power.atom == atom)
        .map_or(Exponent::ZERO, |power| power.exponent)
}
