//! Logarithms and powers with constant exponents.
//!
//! ln(uv) = ln u + ln v and (uv)^r = u^r v^r need positive u and v. What is known to be positive
//! wherever it is real (rational numbers, exponentials, roots) or by the
//! [`domain`](super::domain) is split off; the rest stays one argument.

use super::super::Function;
use super::Obstacle;
use super::algebra::{Algebra, Kind};
use super::fraction::Fraction;
use super::monomial::{Atom, Exponent, Power};
use super::number::{Coefficient, Number};
use super::polynomial::{Polynomial, Term};

type Result<T> = std::result::Result<T, Obstacle>;

impl Algebra {
    /// ln u
    pub(super) fn ln(&mut self, u: &Fraction) -> Result<Fraction> {
        let split = self.split_positive(u)?;
        let mut sum = Fraction::zero();
        for (prime, exponent) in prime_factors(&split.content)? {
            let atom = self.intern(Kind::Call(Function::Ln, Fraction::number(prime)))?;
            let term = Fraction::atom(atom).scaled(&Coefficient::real(Number::integer(exponent)));
            sum = self.add(&sum, &term)?;
        }
        for (base, exponent) in split.assumed {
            let atom = self.intern(Kind::Call(Function::Ln, base))?;
            let factor = Coefficient::real(exponent.to_number());
            sum = self.add(&sum, &Fraction::atom(atom).scaled(&factor))?;
        }
        for power in split.positive {
            let logarithm = match self.kind(power.atom).cloned() {
                Some(Kind::Exp(key)) => key,
                Some(Kind::Root(base)) => self.ln(&base)?,
                _ => self.ln_of_atom(power.atom, Exponent::ONE)?,
            };
            let factor = Coefficient::real(power.exponent.to_number());
            sum = self.add(&sum, &logarithm.scaled(&factor))?;
        }
        let rest = match split.rest {
            Rest::One => return Ok(sum),
            Rest::Power(atom, exponent) => self.ln_of_atom(atom, exponent)?,
            Rest::Inverse(denominator) => self.ln(&denominator)?.neg(),
            Rest::Fraction(rest) => match self.ln_by_earlier(&rest)? {
                Some(logarithm) => logarithm,
                None => {
                    let atom = self.intern(Kind::Call(Function::Ln, rest))?;
                    Fraction::atom(atom)
                }
            },
        };
        self.add(&sum, &rest)
    }

    /// ln aᵏ = k ln a; (k/2) ln a² for an even k, because a may be negative.
    fn ln_of_atom(&mut self, atom: Atom, k: Exponent) -> Result<Fraction> {
        let two = Exponent::integer(2);
        let (base, factor) = if k.is_even() {
            (two, k.mul(Exponent::from_number(&Number::Small(1, 2))?)?)
        } else {
            (Exponent::ONE, k)
        };
        let argument = Fraction::from(Polynomial::atom(atom, base));
        let logarithm = self.intern(Kind::Call(Function::Ln, argument))?;
        Ok(Fraction::atom(logarithm).scaled(&Coefficient::real(factor.to_number())))
    }

    /// u^r for a rational r. Powers of positive factors are taken one by one; what is left is
    /// the base of a root, because (uv)^r = u^r v^r needs positive u, v.
    pub(super) fn rational_power(&mut self, u: &Fraction, r: &Number) -> Result<Fraction> {
        if let Some(n) = r.as_integer() {
            return self.integer_power(u, n);
        }
        if u.is_zero() {
            return if r.is_negative() {
                Err(Obstacle::Undefined)
            } else {
                Ok(Fraction::zero())
            };
        }
        let r = Exponent::from_number(r)?;
        let split = self.split_positive(u)?;
        let mut product = Fraction::one();
        for (prime, exponent) in prime_factors(&split.content)? {
            let exponent = Exponent::from_number(&Number::integer(exponent))?.mul(r)?;
            let factor = self.root(Fraction::number(prime), exponent)?;
            product = self.mul(&product, &factor)?;
        }
        for (base, exponent) in split.assumed {
            let factor = self.root(base, exponent.mul(r)?)?;
            product = self.mul(&product, &factor)?;
        }
        for power in split.positive {
            let exponent = power.exponent.mul(r)?;
            let factor = match self.kind(power.atom).cloned() {
                Some(Kind::Root(base)) => self.root(base, exponent)?,
                _ => Polynomial::atom(power.atom, exponent).into(),
            };
            product = self.mul(&product, &factor)?;
        }
        let rest = match split.rest {
            Rest::One => return Ok(product),
            Rest::Power(atom, exponent) => self.power_of_atom(atom, exponent, r)?,
            Rest::Inverse(denominator) => {
                self.rational_power(&denominator, &r.neg()?.to_number())?
            }
            Rest::Fraction(rest) => {
                let mut simpler = self.evident_root(&rest)?.map(|root| (root, 2));
                if simpler.is_none() {
                    simpler = self.simpler_root(&rest, r)?;
                }
                match simpler {
                    Some((root, degree)) => {
                        let exponent = r.to_number().mul(&Number::integer(degree));
                        self.rational_power(&root, &exponent)?
                    }
                    None => self.root(rest, r)?,
                }
            }
        };
        self.mul(&product, &rest)
    }

    /// (aᵏ)^r for an atom that may be negative: |a|^(kr) for an even k.
    fn power_of_atom(&mut self, atom: Atom, k: Exponent, r: Exponent) -> Result<Fraction> {
        let exponent = k.mul(r)?;
        if !k.is_even() || exponent.is_even() {
            return Ok(Polynomial::atom(atom, exponent).into());
        }
        let square = Fraction::from(Polynomial::atom(atom, Exponent::integer(2)));
        let half = Exponent::from_number(&Number::Small(1, 2))?;
        self.root(square, exponent.mul(half)?)
    }

    /// baseᵉ as a power of a root atom, its integer part multiplied out.
    fn root(&mut self, base: Fraction, exponent: Exponent) -> Result<Fraction> {
        let (base, exponent) = self.upright(base, exponent)?;
        let whole = exponent.floor();
        let rest = exponent.sub(Exponent::integer(whole))?;
        let power = self.integer_power(&base, whole.into())?;
        if rest.is_zero() {
            return Ok(power);
        }
        if rest.to_number() == Number::Small(1, 2)
            && let Some(root) = self.by_earlier_root(&base)?
        {
            return self.mul(&power, &root);
        }
        let atom = self.intern(Kind::Root(base))?;
        self.mul(&power, &Polynomial::atom(atom, rest).into())
    }

    /// A monomial base turned so that its first exponent is positive: (1/b)ᵉ = b⁻ᵉ.
    fn upright(&mut self, base: Fraction, exponent: Exponent) -> Result<(Fraction, Exponent)> {
        let first = base
            .numerator
            .as_term()
            .and_then(|term| term.monomial.first());
        let turned =
            base.denominator.is_empty() && first.is_some_and(|power| power.exponent.is_negative());
        if turned {
            return Ok((self.inverse(&base)?, exponent.neg()?));
        }
        Ok((base, exponent))
    }

    /// u = content · Π positive powers · rest.
    fn split_positive(&mut self, u: &Fraction) -> Result<Split> {
        let mut u = self.cancel(u.clone());
        if u.is_zero() {
            return Err(Obstacle::Undefined);
        }
        let assumed = self.split_assumed(&mut u)?;
        let (unit, primitive) = match u.numerator.as_term() {
            Some(term) => (term.clone(), Polynomial::one()),
            None => {
                let content = u.numerator.content();
                let monomial = self.common_monomial(&u.numerator)?;
                let unit = Term {
                    monomial,
                    coefficient: Coefficient::real(content),
                };
                let primitive = u.numerator.times_term(&unit.inverse()?)?;
                (unit, primitive)
            }
        };
        if !unit.coefficient.is_real() {
            return Err(Obstacle::Undefined);
        }
        let content = unit.coefficient.re;
        let mut split = Split {
            content: if content.is_negative() {
                content.neg()
            } else {
                content.clone()
            },
            assumed,
            positive: Vec::new(),
            rest: Rest::One,
        };
        let mut signed = Vec::new();
        for power in unit.monomial {
            if self.is_positive(power) {
                split.positive.push(power);
            } else {
                signed.push(power);
            }
        }
        let sign = if content.is_negative() {
            Number::integer(-1)
        } else {
            Number::ONE
        };
        let simple = primitive.is_one() && !content.is_negative();
        split.rest = match signed.as_slice() {
            [] if simple && u.denominator.is_empty() => Rest::One,
            [] if simple => Rest::Inverse(self.expand(&u.denominator)?),
            [only] if simple && u.denominator.is_empty() => Rest::Power(only.atom, only.exponent),
            [] if primitive.is_one() && u.denominator.is_empty() => {
                return Err(Obstacle::Undefined);
            }
            // ±1/(m d) = 1/(±m d), so that both have the same root
            powers
                if primitive.is_one()
                    && self.decides
                    && !u.denominator.is_empty()
                    && powers.iter().all(|power| power.exponent.is_negative()) =>
            {
                let unit = Term {
                    monomial: signed,
                    coefficient: Coefficient::real(sign),
                };
                let below = self.expand(&u.denominator)?;
                let unit = Fraction::from(Polynomial::from(unit.inverse()?));
                Rest::Inverse(self.mul(&below, &unit)?)
            }
            _ => {
                let unit = Term {
                    monomial: signed,
                    coefficient: Coefficient::real(sign),
                };
                Rest::Fraction(Fraction {
                    numerator: primitive.times_term(&unit)?,
                    denominator: u.denominator,
                })
            }
        };
        Ok(split)
    }

    /// The positive powers that all terms have in common.
    pub(super) fn common_monomial(&self, polynomial: &Polynomial) -> Result<Vec<Power>> {
        let mut monomial = Vec::new();
        for (atom, exponent, _) in polynomial.exponent_ranges() {
            let power = Power { atom, exponent };
            if !exponent.is_zero() && !self.is_phase(atom) && self.is_positive(power) {
                monomial.push(power);
            }
        }
        Ok(monomial)
    }
}

/// u = content · Π assumed · Π positive · rest, the content a positive rational.
struct Split {
    content: Number,
    /// Powers of polynomials that are not negative on the domain.
    assumed: Vec<(Fraction, Exponent)>,
    positive: Vec<Power>,
    rest: Rest,
}

/// The part of unknown sign.
enum Rest {
    One,
    /// A power of one atom.
    Power(Atom, Exponent),
    /// One over this.
    Inverse(Fraction),
    Fraction(Fraction),
}

/// A positive rational as a product of powers of primes, and of a factor too large to be
/// factorised.
fn prime_factors(value: &Number) -> Result<Vec<(Number, i64)>> {
    const LARGEST_DIVISOR: i64 = 10_000;
    let Number::Small(numerator, denominator) = value else {
        return Ok(vec![(value.clone(), 1)]);
    };
    if *numerator <= 0 {
        return Err(Obstacle::Undefined);
    }
    let mut factors: Vec<(Number, i64)> = Vec::new();
    for (mut rest, sign) in [(*numerator, 1), (*denominator, -1)] {
        let mut divisor = 2;
        while divisor <= LARGEST_DIVISOR && divisor * divisor <= rest {
            let mut multiplicity = 0;
            while rest % divisor == 0 {
                rest /= divisor;
                multiplicity += 1;
            }
            if multiplicity > 0 {
                factors.push((Number::integer(divisor), sign * multiplicity));
            }
            divisor += if divisor == 2 { 1 } else { 2 };
        }
        if rest > 1 {
            factors.push((Number::integer(rest), sign));
        }
    }
    Ok(factors)
}
