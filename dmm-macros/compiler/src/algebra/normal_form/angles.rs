//! Angles that are constants, for the zero test.
//!
//! | angle | becomes |
//! |---|---|
//! | atan(p/q) | Σ nⱼ atan(bⱼ/aⱼ) + k π/4 by the prime factors aⱼ + i bⱼ of q + i p |
//! | atan u = π n/120 | that multiple of π |
//! | atan u with n atan u ± m atan b = π k/12 for an earlier b | by atan b |
//! | asin u | atan(u/√(1 − u²)) |
//! | atan u, where 2u/(1 − u²) = b and u² < 1 is evident | (atan b)/2, and the other way round |
//! | exp(iπ n/q) | by roots for q = 2ʲ, 3, 5 and products of them |
//!
//! Which multiple of π it is, is seen from floating-point values; that it is one is proved.

use super::Obstacle;
use super::algebra::{Algebra, Kind};
use super::fraction::Fraction;
use super::monomial::{Atom, Exponent};
use super::number::{Coefficient, Number};
use super::polynomial::Polynomial;
use crate::algebra::Function;

use std::f64::consts::PI;

type Result<T> = std::result::Result<T, Obstacle>;

/// Floating-point values of angles agree within this.
const CLOSE: f64 = 1e-9;
/// Roots of unity of this degree are recognised by their tangents.
const TURNS: i64 = 120;
/// Halves of angles are taken up to this power of two.
const LARGEST_POWER_OF_TWO: i64 = 64;

impl Algebra {
    /// asin or atan of `u` by another angle, where that is known.
    pub(super) fn arc_by_another(
        &mut self,
        function: Function,
        u: &Fraction,
    ) -> Result<Option<Fraction>> {
        if !self.decides {
            return Ok(None);
        }
        match function {
            // asin u = atan(u/√(1 − u²)) for |u| < 1, and at the ends by continuity
            Function::Asin => match self.tangent_of_asin(u) {
                Ok(tangent) => self.arc(Function::Atan, &tangent).map(Some),
                Err(Obstacle::Undefined) => Ok(None),
                Err(obstacle) => Err(obstacle),
            },
            _ if self.is_algebraic(u) => self.constant_angle(u),
            _ => self.by_double_angle(u),
        }
    }

    fn tangent_of_asin(&mut self, u: &Fraction) -> Result<Fraction> {
        let square = self.mul(u, u)?;
        let rest = self.sub(&Fraction::one(), &square)?;
        if rest.as_number().is_some_and(|number| number.is_negative()) {
            return Err(Obstacle::Undefined);
        }
        let inverse = self.rational_power(&rest, &Number::Small(-1, 2))?;
        self.mul(u, &inverse)
    }

    /// tan 2θ for u = tan θ, if |u| < 1 is evident.
    fn double_tangent(&mut self, u: &Fraction) -> Result<Option<Fraction>> {
        let square = self.mul(u, u)?;
        let rest = self.sub(&Fraction::one(), &square)?;
        let rest = self.cancel(rest);
        if !self.is_evident_quotient(&rest) {
            return Ok(None);
        }
        let two = Coefficient::real(Number::integer(2));
        self.div(&u.scaled(&two), &rest).map(Some)
    }

    /// atan u by an earlier atan b, where one is twice the other.
    fn by_double_angle(&mut self, u: &Fraction) -> Result<Option<Fraction>> {
        let own = self.double_tangent(u)?;
        let mut atom: Atom = 0;
        while let Some(kind) = self.kind(atom).cloned() {
            if let Kind::Call(Function::Atan, b) = kind
                && b != *u
            {
                for (sign, scale) in [(1, Number::ONE), (-1, Number::integer(-1))] {
                    let b = if sign < 0 { b.neg() } else { b.clone() };
                    if let Some(own) = &own
                        && self.sub(own, &b)?.is_zero()
                    {
                        let half = Coefficient::real(scale.mul(&Number::Small(1, 2)));
                        return Ok(Some(Fraction::atom(atom).scaled(&half)));
                    }
                    if let Some(double) = self.double_tangent(&b)?
                        && self.sub(&double, u)?.is_zero()
                    {
                        let two = Coefficient::real(scale.mul(&Number::integer(2)));
                        return Ok(Some(Fraction::atom(atom).scaled(&two)));
                    }
                }
            }
            atom += 1;
        }
        Ok(None)
    }

    /// atan of a constant in its canonical form.
    fn constant_angle(&mut self, u: &Fraction) -> Result<Option<Fraction>> {
        let Some(value) = self.approximate(u) else {
            return Ok(None);
        };
        match value.sign() {
            Some(1) => {}
            Some(_) => {
                let angle = self.arc_of_positive(&u.neg(), -value.re)?;
                return Ok(Some(angle.neg()));
            }
            None => return Ok(None),
        }
        self.arc_of_positive(u, value.re).map(Some)
    }

    fn arc_of_positive(&mut self, u: &Fraction, value: f64) -> Result<Fraction> {
        match self.known_angle(u, value)? {
            Some(angle) => Ok(angle),
            None => Ok(Fraction::atom(
                self.intern(Kind::Call(Function::Atan, u.clone()))?,
            )),
        }
    }

    fn known_angle(&mut self, u: &Fraction, value: f64) -> Result<Option<Fraction>> {
        if let Some(Number::Small(p, q)) = u.as_number() {
            return self.by_gaussian_primes(p, q);
        }
        let angle = value.atan();
        if let Some(n) = nearest(angle, PI / TURNS as f64)
            && n < TURNS / 2
        {
            let phase = self.root_of_unity(&Number::from_ratio(n, TURNS))?;
            let inverse = self.root_of_unity(&Number::from_ratio(-n, TURNS))?;
            // sin − u cos = 0, times 2i
            let sine = self.sub(&phase, &inverse)?;
            let cosine = self.add(&phase, &inverse)?.scaled(&Coefficient::I);
            let other = self.mul(u, &cosine)?;
            if self.sub(&sine, &other)?.is_zero() {
                return self.pi_times(n, TURNS).map(Some);
            }
        }
        // half of the angle of a rational number
        let square = self.mul(u, u)?;
        let rest = self.sub(&Fraction::one(), &square)?;
        if value < 0.99 {
            let double = self.div(&u.scaled(&Coefficient::real(Number::integer(2))), &rest)?;
            if double.as_number().is_some() {
                let angle = self.arc(Function::Atan, &double)?;
                let half = Coefficient::real(Number::Small(1, 2));
                return Ok(Some(angle.scaled(&half)));
            }
        }
        self.by_earlier_angle(u, angle)
    }

    /// atan u by that of an earlier constant b: n atan u + m atan b = π k/12.
    fn by_earlier_angle(&mut self, u: &Fraction, angle: f64) -> Result<Option<Fraction>> {
        const MULTIPLES: [(i64, i64); 8] = [
            (1, 1),
            (1, -1),
            (1, 2),
            (1, -2),
            (2, 1),
            (2, -1),
            (1, 3),
            (1, -3),
        ];
        let mut atom: Atom = 0;
        while let Some(kind) = self.kind(atom).cloned() {
            if let Kind::Call(Function::Atan, b) = kind
                && self.is_algebraic(&b)
                && b != *u
                && let Some(other) = self.approximate(&b)
            {
                for (n, m) in MULTIPLES {
                    let sum = n as f64 * angle + m as f64 * other.re.atan();
                    let Some(k) = nearest(sum, PI / 12.0) else {
                        continue;
                    };
                    if !self.is_real_turn([(u, n), (&b, m)], k)? {
                        continue;
                    }
                    let turns = self.pi_times(k, 12)?;
                    let rest = Fraction::atom(atom).scaled(&Coefficient::real(Number::integer(m)));
                    let scale = Coefficient::real(Number::Small(1, n));
                    return Ok(Some(self.sub(&turns, &rest)?.scaled(&scale)));
                }
            }
            atom += 1;
        }
        Ok(None)
    }

    /// Whether Π (1 + i u)ⁿ exp(−iπ k/12) is real.
    fn is_real_turn(&mut self, angles: [(&Fraction, i64); 2], k: i64) -> Result<bool> {
        let mut value = self.root_of_unity(&Number::from_ratio(-k, 12))?;
        let mut conjugate = self.root_of_unity(&Number::from_ratio(k, 12))?;
        for (u, n) in angles {
            let i = if n < 0 {
                Coefficient::I.neg()
            } else {
                Coefficient::I
            };
            let one = Fraction::one();
            let [up, down] = [
                self.add(&one, &u.scaled(&i))?,
                self.sub(&one, &u.scaled(&i))?,
            ];
            for _ in 0..n.unsigned_abs() {
                value = self.mul(&value, &up)?;
                conjugate = self.mul(&conjugate, &down)?;
            }
        }
        Ok(self.sub(&value, &conjugate)?.is_zero())
    }

    /// atan(p/q) of positive p and q without a common factor.
    fn by_gaussian_primes(&mut self, p: i64, q: i64) -> Result<Option<Fraction>> {
        let Some(factors) = gaussian_factors(p, q) else {
            return Ok(None);
        };
        let mut sum = Fraction::zero();
        let mut value = (p as f64).atan2(q as f64);
        for ([a, b], exponent) in factors {
            let atom = self.intern(Kind::Call(
                Function::Atan,
                Fraction::number(Number::from_ratio(b, a)),
            ))?;
            let term = Fraction::atom(atom).scaled(&Coefficient::real(Number::integer(exponent)));
            sum = self.add(&sum, &term)?;
            value -= exponent as f64 * (b as f64).atan2(a as f64);
        }
        let Some(k) = nearest(value, PI / 4.0) else {
            return Ok(None);
        };
        let turns = self.pi_times(k, 4)?;
        self.add(&sum, &turns).map(Some)
    }

    /// exp(iπ n/q) for 0 < n/q < 1 by roots; nothing where q has other factors than 2ʲ, 3 and 5.
    pub(super) fn root_of_unity_by_roots(&mut self, n: i64, q: i64) -> Result<Option<Fraction>> {
        if !self.decides {
            return Ok(None);
        }
        let power_of_two = q & q.wrapping_neg();
        if power_of_two > LARGEST_POWER_OF_TWO {
            return Ok(None);
        }
        let odd = q / power_of_two;
        let once = |prime: i64| odd % prime == 0 && odd % (prime * prime) != 0;
        let five = if once(5) { 5 } else { 1 };
        let three = if once(3) { 3 } else { 1 };
        let parts = [power_of_two, three, five, odd / (three * five)];
        if parts.iter().filter(|&&part| part > 1).count() > 1 {
            // coprime parts: n/q = Σ mⱼ/qⱼ up to a whole number
            let mut rest = Number::from_ratio(n, q);
            let mut product = Fraction::one();
            for part in parts.into_iter().filter(|&part| part > 1) {
                let cofactor = q / part;
                let Some(inverse) = (1..part).find(|m| cofactor.rem_euclid(part) * m % part == 1)
                else {
                    return Ok(None);
                };
                let numerator = n.rem_euclid(part) * inverse % part;
                let share = Number::from_ratio(numerator, part);
                rest = rest.add(&share.neg());
                let factor = self.root_of_unity(&share)?;
                product = self.mul(&product, &factor)?;
            }
            return match rest.as_integer() {
                Some(whole) if whole % 2 == 0 => Ok(Some(product)),
                Some(_) => Ok(Some(product.neg())),
                None => Ok(None),
            };
        }
        if q == 5 {
            return self.fifth(n).map(Some);
        }
        if odd == 1 && q > 4 {
            return self.halved(n, q).map(Some);
        }
        Ok(None)
    }

    /// exp(iπ n/5): cos(π/5) = (1 + √5)/4, cos(2π/5) = (√5 − 1)/4.
    fn fifth(&mut self, n: i64) -> Result<Fraction> {
        let five = Fraction::number(Number::integer(5));
        let root = self.rational_power(&five, &Number::Small(1, 2))?;
        let quarter = Coefficient::real(Number::Small(1, 4));
        let one = Fraction::one();
        let cosine = match n {
            1 => self.add(&root, &one)?,
            2 => self.sub(&root, &one)?,
            3 => self.sub(&one, &root)?,
            _ => self.add(&root, &one)?.neg(),
        };
        self.with_cosine(cosine.scaled(&quarter))
    }

    /// exp(iπ n/q) for q = 8, 16, …: cos θ = ±√((1 + cos 2θ)/2).
    fn halved(&mut self, n: i64, q: i64) -> Result<Fraction> {
        let [forward, backward] = [
            self.root_of_unity(&Number::from_ratio(n, q / 2))?,
            self.root_of_unity(&Number::from_ratio(-n, q / 2))?,
        ];
        // (2 + 2 cos 2θ)/4
        let sum = self.add(&forward, &backward)?;
        let two = Fraction::number(Number::integer(2));
        let square = self
            .add(&two, &sum)?
            .scaled(&Coefficient::real(Number::Small(1, 4)));
        let cosine = self.rational_power(&square, &Number::Small(1, 2))?;
        let cosine = if 2 * n < q { cosine } else { cosine.neg() };
        self.with_cosine(cosine)
    }

    /// c + i √(1 − c²)
    fn with_cosine(&mut self, cosine: Fraction) -> Result<Fraction> {
        let square = self.mul(&cosine, &cosine)?;
        let rest = self.sub(&Fraction::one(), &square)?;
        let sine = self.rational_power(&rest, &Number::Small(1, 2))?;
        self.add(&cosine, &sine.scaled(&Coefficient::I))
    }

    /// exp(±iθ/2) from exp(±iθ) with |θ| ≤ π/2: c ± i sin θ/(2c), c = √((1 + cos θ)/2).
    pub(super) fn half_phase(
        &mut self,
        forward: &Fraction,
        backward: &Fraction,
    ) -> Result<Fraction> {
        let sum = self.add(forward, backward)?;
        let two = Fraction::number(Number::integer(2));
        let quarter = Coefficient::real(Number::Small(1, 4));
        let square = self.add(&two, &sum)?.scaled(&quarter);
        let cosine = self.rational_power(&square, &Number::Small(1, 2))?;
        let difference = self.sub(forward, backward)?.scaled(&quarter);
        let rest = self.div(&difference, &cosine)?;
        self.add(&cosine, &rest)
    }

    /// exp(iπ e) as a power of exp(iπ), 0 ≤ e < 1.
    pub(super) fn power_of_half_turn(&mut self, e: Exponent) -> Result<Fraction> {
        let pi = self.intern(Kind::Pi)?;
        let atom = self.intern(Kind::Phase(Fraction::atom(pi)))?;
        self.half_turn = Some(atom);
        let power = self.on_circle(Polynomial::atom(atom, e))?;
        Ok(power.into())
    }
}

/// n with n·`unit` equal to `value` up to rounding errors.
fn nearest(value: f64, unit: f64) -> Option<i64> {
    let n = (value / unit).round();
    (n.abs() < 1e6 && (value - n * unit).abs() < CLOSE).then_some(n as i64)
}

/// The prime factors a + i b of q + i p with their exponents, a > b > 0, negative ones for
/// a − i b; without units and powers of 1 + i. Nothing if p² + q² is too large.
fn gaussian_factors(p: i64, q: i64) -> Option<Vec<([i64; 2], i64)>> {
    const LARGEST_DIVISOR: i64 = 2_000;
    let norm = p.checked_mul(p)?.checked_add(q.checked_mul(q)?)?;
    let mut rest = norm;
    while rest % 2 == 0 {
        rest /= 2;
    }
    let mut factors = Vec::new();
    let mut divisor = 3;
    while rest > 1 {
        if divisor > LARGEST_DIVISOR && rest > LARGEST_DIVISOR * LARGEST_DIVISOR {
            return None;
        }
        let prime = if divisor > LARGEST_DIVISOR || divisor * divisor > rest {
            rest
        } else {
            divisor
        };
        let mut exponent = 0;
        while rest % prime == 0 {
            rest /= prime;
            exponent += 1;
        }
        if exponent > 0 {
            let (a, b) = (1..).take_while(|b| 2 * b * b < prime).find_map(|b| {
                let a = num_integer::sqrt(prime - b * b);
                (a * a + b * b == prime).then_some((a, b))
            })?;
            // whether (q + ip)(a − ib) is a multiple of the prime
            let [q, p] = [q % prime, p % prime].map(i128::from);
            let (wide_a, wide_b) = (i128::from(a), i128::from(b));
            let divides = (q * wide_a + p * wide_b) % i128::from(prime) == 0
                && (p * wide_a - q * wide_b) % i128::from(prime) == 0;
            factors.push(([a, b], if divides { exponent } else { -exponent }));
        }
        divisor += 2;
    }
    Some(factors)
}
