//! Nested roots, taken apart where they can be.
//!
//! | constant | becomes |
//! |---|---|
//! | √(A + B√c), A > 0, d = √(A² − B²c) simple | √((A + d)/2) ± √((A − d)/2) |
//! | ∛(A + B√c) | p + q√c, where its third power is the base |
//!
//! A root is guessed in floating-point numbers at most, and accepted where its power is the base
//! exactly and its sign is certain.

use super::Obstacle;
use super::algebra::{Algebra, Kind};
use super::approximate::Approximate;
use super::fraction::Fraction;
use super::monomial::Exponent;
use super::number::{Coefficient, Number};
use super::polynomial::Polynomial;

type Result<T> = std::result::Result<T, Obstacle>;

/// Nested roots are taken apart up to this depth.
const DEEPEST_ROOT: usize = 4;
/// Parts of a third root are looked for among the multiples of one over this.
const DENOMINATOR: f64 = 12.0;
/// Third roots are looked for among those of multiples up to this one.
const LARGEST_SCALE: i64 = 7;

impl Algebra {
    /// What `base`^(1/2) or `base`^(1/3) is without nesting, with the degree; `base` is made of
    /// roots.
    pub(super) fn simpler_root(
        &mut self,
        base: &Fraction,
        r: Exponent,
    ) -> Result<Option<(Fraction, i64)>> {
        if !self.decides || !self.is_algebraic(base) || self.depth > 0 {
            return Ok(None);
        }
        let Number::Small(_, denominator) = r.to_number() else {
            return Ok(None);
        };
        if denominator % 2 == 0
            && let Some(root) = self.denested(base, 0)?
        {
            return Ok(Some((root, 2)));
        }
        if denominator % 3 == 0
            && let Some(root) = self.scaled_third_root(base)?
        {
            return Ok(Some((root, 3)));
        }
        Ok(None)
    }

    /// √x of a positive x made of roots, as a sum of roots of rational numbers.
    pub(super) fn denested(&mut self, x: &Fraction, depth: usize) -> Result<Option<Fraction>> {
        let half = Number::Small(1, 2);
        if self.approximate(x).and_then(Approximate::sign) != Some(1) {
            return Ok(None);
        }
        if x.as_number().is_some() {
            return self.rational_power(x, &half).map(Some);
        }
        if depth > DEEPEST_ROOT {
            return Ok(None);
        }
        let Some((atom, parts)) = self.by_latest_root(&x.numerator) else {
            return Ok(None);
        };
        let ([a, b], Some(Kind::Root(base))) = (parts.as_slice(), self.kind(atom).cloned()) else {
            return Ok(None);
        };
        let square = self.mul(a, a)?;
        let other = self.mul(b, b)?;
        let other = self.mul(&other, &base)?;
        let norm = self.sub(&square, &other)?;
        if norm.is_zero() || self.approximate(a).and_then(Approximate::sign) != Some(1) {
            return Ok(None);
        }
        let Some(d) = self.denested(&norm, depth + 1)? else {
            return Ok(None);
        };
        let half = Coefficient::real(half);
        let first = self.add(a, &d)?.scaled(&half);
        let second = self.sub(a, &d)?.scaled(&half);
        let Some(first) = self.denested(&first, depth + 1)? else {
            return Ok(None);
        };
        let Some(second) = self.denested(&second, depth + 1)? else {
            return Ok(None);
        };
        for root in [self.add(&first, &second)?, self.sub(&first, &second)?] {
            if self.is_power(&root, 2, x)? {
                return Ok(Some(root));
            }
        }
        Ok(None)
    }

    /// Whether `root` is positive and `root`ⁿ = `power`.
    fn is_power(&mut self, root: &Fraction, n: i64, power: &Fraction) -> Result<bool> {
        if self.approximate(root).and_then(Approximate::sign) != Some(1) {
            return Ok(false);
        }
        let own = self.integer_power(root, n)?;
        Ok(self.sub(&own, power)?.is_zero())
    }

    /// ∛x by ∛(nx)/∛n for a small integer n.
    fn scaled_third_root(&mut self, x: &Fraction) -> Result<Option<Fraction>> {
        for n in 1..=LARGEST_SCALE {
            let n = Number::integer(n);
            let scaled = x.scaled(&Coefficient::real(n.clone()));
            if let Some(root) = self.third_root(&scaled)? {
                let n = Fraction::number(n);
                let scale = self.rational_power(&n, &Number::Small(-1, 3))?;
                return self.mul(&root, &scale).map(Some);
            }
        }
        Ok(None)
    }

    /// ∛x of x = A + B√c with rational A, B, c, if it is p + q√c.
    fn third_root(&mut self, x: &Fraction) -> Result<Option<Fraction>> {
        let Some((atom, parts)) = self.by_latest_root(&x.numerator) else {
            return Ok(None);
        };
        let ([a, b], Some(Kind::Root(base))) = (parts.as_slice(), self.kind(atom).cloned()) else {
            return Ok(None);
        };
        let numbers = [a, b, &base].map(|part| part.as_number().and_then(|value| value.to_f64()));
        let [Some(a), Some(b), Some(c)] = numbers else {
            return Ok(None);
        };
        let (one, other) = ((a + b * c.sqrt()).cbrt(), (a - b * c.sqrt()).cbrt());
        let guess = |value: f64| {
            let scaled = (DENOMINATOR * value).round();
            (scaled.abs() < 1e12).then(|| Fraction::number(Number::integer(scaled as i64)))
        };
        let (Some(p), Some(q)) = (
            guess((one + other) / 2.0),
            guess((one - other) / (2.0 * c.sqrt())),
        ) else {
            return Ok(None);
        };
        let half = Exponent::from_number(&Number::Small(1, 2))?;
        let rooted = self.mul(&q, &Polynomial::atom(atom, half).into())?;
        let scale = Coefficient::real(Number::Small(1, DENOMINATOR as i64));
        let root = self.add(&p, &rooted)?.scaled(&scale);
        let holds = self.is_power(&root, 3, x)?;
        Ok(holds.then_some(root))
    }
}
