//! The elementary functions of fractions.
//!
//! | function | normal form |
//! |---|---|
//! | exp(Σ cₖ mₖ) | Π E\[mₖ\]^cₖ |
//! | exp(i Σ cₖ mₖ) | Π P\[mₖ\]^cₖ; roots of unity for rational multiples of π |
//! | sin, cos, tan | by exp(i u) |
//! | sinh, cosh, tanh | by exp(u) |
//! | ln(c·E\[m\]·Rᵉ·p) | ln c + m + e·ln R + L\[p\] for positive c |
//! | asin, atan | atoms, odd; acos u = π/2 − asin u |
//! | \|u\| | (u²)^(1/2) |

use super::super::functions::{Form, Pair};
use super::super::{Function, PairFunction, Rational};
use super::Obstacle;
use super::algebra::{Algebra, Kind};
use super::fraction::Fraction;
use super::monomial::Exponent;
use super::number::{Coefficient, Number};
use super::polynomial::{Polynomial, Term};

/// exp(i n asin u) and exp(i n atan u) are expanded up to this n.
const LARGEST_MULTIPLE: i64 = 16;

type Result<T> = std::result::Result<T, Obstacle>;

/// A real argument Σ c·key, the keys monomials (coefficient 1) over denominators.
type Linear = Vec<(Number, Fraction)>;

impl Algebra {
    pub(super) fn call(&mut self, function: Function, u: &Fraction) -> Result<Fraction> {
        match function.properties().form {
            Form::Root => self.rational_power(u, &Number::Small(1, 2)),
            Form::Size => {
                let square = self.mul(u, u)?;
                self.rational_power(&square, &Number::Small(1, 2))
            }
            Form::Exponential => self.exp(u),
            Form::Logarithm => self.ln(u),
            Form::Circular { is_odd: true } => {
                self.trigonometric(u, Coefficient::I.neg(), Coefficient::I)
            }
            Form::Circular { is_odd: false } => {
                self.trigonometric(u, Coefficient::ONE, Coefficient::ONE)
            }
            Form::Hyperbolic { is_odd: true } => self.hyperbolic(u, Coefficient::ONE.neg()),
            Form::Hyperbolic { is_odd: false } => self.hyperbolic(u, Coefficient::ONE),
            Form::Ratio([above, below]) => self.ratio(above, below, u),
            Form::Arc => self.arc(function, u),
            Form::Complement(of) => {
                let right_angle = self.pi_times(1, 2)?;
                let angle = self.arc(of, u)?;
                self.sub(&right_angle, &angle)
            }
            Form::Cardinal(_) if u.is_zero() => Ok(Fraction::one()),
            Form::CardinalPrime(_) if u.is_zero() => Ok(Fraction::zero()),
            Form::Cardinal(h) => self.cardinal(h, u),
            Form::CardinalPrime([h, first]) => self.cardinal_prime(h, first, u),
        }
    }

    fn ratio(&mut self, above: Function, below: Function, u: &Fraction) -> Result<Fraction> {
        let above = self.call(above, u)?;
        let below = self.call(below, u)?;
        self.div(&above, &below)
    }

    /// h(u)/u
    fn cardinal(&mut self, function: Function, u: &Fraction) -> Result<Fraction> {
        let value = self.call(function, u)?;
        self.div(&value, u)
    }

    /// (h′(u) − h(u)/u)/u
    fn cardinal_prime(&mut self, h: Function, first: Function, u: &Fraction) -> Result<Fraction> {
        let cardinal = self.cardinal(h, u)?;
        let first = self.call(first, u)?;
        let difference = self.sub(&first, &cardinal)?;
        self.div(&difference, u)
    }

    /// (plus·exp(i u) + minus·exp(−i u))/2
    fn trigonometric(
        &mut self,
        u: &Fraction,
        plus: Coefficient,
        minus: Coefficient,
    ) -> Result<Fraction> {
        let forward = self.phase(u)?.scaled(&plus);
        let backward = self.phase(&u.neg())?.scaled(&minus);
        let sum = self.add(&forward, &backward)?;
        Ok(sum.scaled(&Coefficient::real(Number::Small(1, 2))))
    }

    /// (exp(u) ± exp(−u))/2
    fn hyperbolic(&mut self, u: &Fraction, sign: Coefficient) -> Result<Fraction> {
        let forward = self.exp(u)?;
        let backward = self.exp(&u.neg())?.scaled(&sign);
        let sum = self.add(&forward, &backward)?;
        Ok(sum.scaled(&Coefficient::real(Number::Small(1, 2))))
    }

    /// π·n/d
    pub(super) fn pi_times(&mut self, n: i64, d: i64) -> Result<Fraction> {
        let pi = self.intern(Kind::Pi)?;
        Ok(Fraction::atom(pi).scaled(&Coefficient::real(Number::Small(n, d))))
    }

    /// The real expression `u` as Σ c·key. Terms with phases go into one symbol.
    fn linear(&mut self, u: &Fraction) -> Result<Linear> {
        let u = self.cancel(u.clone());
        let mut linear = Linear::new();
        let mut complex = Vec::new();
        let whole = !u.denominator.is_empty() && self.is_complex(&u);
        for term in u.numerator.terms() {
            let single = Polynomial::from(term.clone());
            if whole || self.has_phases(&single) {
                complex.push(term.clone());
                continue;
            }
            if !term.coefficient.is_real() {
                return Err(Obstacle::Undefined);
            }
            let key = Fraction {
                numerator: Polynomial::from(Term {
                    monomial: term.monomial.clone(),
                    coefficient: Coefficient::ONE,
                }),
                denominator: u.denominator.clone(),
            };
            linear.push((term.coefficient.re.clone(), key));
        }
        if !complex.is_empty() {
            let part = Fraction {
                numerator: Polynomial::collect(complex),
                denominator: u.denominator,
            };
            let mut content = part.numerator.content();
            if part.leads_negative() {
                content = content.neg();
            }
            let scale = content.recip().ok_or(Obstacle::Undefined)?;
            let part = part.scaled(&Coefficient::real(scale));
            let symbol = self.intern(Kind::Opaque(part))?;
            linear.push((content, Fraction::atom(symbol)));
        }
        Ok(linear)
    }

    /// The kind of the atom that `key` is, if it is one alone.
    fn as_atom(&self, key: &Fraction) -> Option<Kind> {
        let term = key.numerator.as_term()?;
        match term.monomial.as_slice() {
            [only] if only.exponent == Exponent::ONE && key.denominator.is_empty() => {
                self.kind(only.atom).cloned()
            }
            _ => None,
        }
    }

    pub(super) fn exp(&mut self, u: &Fraction) -> Result<Fraction> {
        let mut product = Fraction::one();
        for (c, key) in self.linear(u)? {
            let factor = match self.as_atom(&key) {
                // exp(c ln p) = pᶜ
                Some(Kind::Call(Function::Ln, p)) => self.rational_power(&p, &c)?,
                _ => {
                    let atom = self.intern(Kind::Exp(key))?;
                    Polynomial::atom(atom, Exponent::from_number(&c)?).into()
                }
            };
            product = self.mul(&product, &factor)?;
        }
        Ok(product)
    }

    /// exp(i u)
    fn phase(&mut self, u: &Fraction) -> Result<Fraction> {
        let mut product = Fraction::one();
        for (c, key) in self.linear(u)? {
            let is_small = |n: &i64| (-LARGEST_MULTIPLE..=LARGEST_MULTIPLE).contains(n);
            let multiple = c.as_integer().filter(is_small);
            let factor = match (self.as_atom(&key), multiple) {
                (Some(Kind::Pi), _) => self.root_of_unity(&c)?,
                (Some(Kind::Call(Function::Asin, w)), Some(n)) => {
                    let phase = self.phase_of_asin(&w, n < 0)?;
                    self.integer_power(&phase, n.abs())?
                }
                (Some(Kind::Call(Function::Atan, w)), Some(n)) => {
                    let phase = self.phase_of_atan(&w, n < 0)?;
                    self.integer_power(&phase, n.abs())?
                }
                (Some(Kind::Call(function @ (Function::Asin | Function::Atan), w)), None)
                    if self.decides && self.half_multiple(&c).is_some() =>
                {
                    let n = self.half_multiple(&c).unwrap_or_default();
                    let [forward, backward] = match function {
                        Function::Asin => [false, true].map(|sign| self.phase_of_asin(&w, sign)),
                        _ => [false, true].map(|sign| self.phase_of_atan(&w, sign)),
                    };
                    let (mut forward, mut backward) = (forward?, backward?);
                    if n < 0 {
                        std::mem::swap(&mut forward, &mut backward);
                    }
                    let half = self.half_phase(&forward, &backward)?;
                    self.integer_power(&half, n.abs())?
                }
                _ => {
                    let atom = self.intern(Kind::Phase(key))?;
                    Polynomial::atom(atom, Exponent::from_number(&c)?).into()
                }
            };
            product = self.mul(&product, &factor)?;
        }
        Ok(product)
    }

    /// n, if `c` is n/2 and small.
    fn half_multiple(&self, c: &Number) -> Option<i64> {
        match c {
            Number::Small(n, 2) => Some(*n),
            _ => None,
        }
        .filter(|n| (-LARGEST_MULTIPLE..=LARGEST_MULTIPLE).contains(n))
    }

    /// exp(±i asin w) = √(1 − w²) ± i w
    fn phase_of_asin(&mut self, w: &Fraction, negative: bool) -> Result<Fraction> {
        let square = self.mul(w, w)?;
        let cosine_squared = self.sub(&Fraction::one(), &square)?;
        let cosine = self.rational_power(&cosine_squared, &Number::Small(1, 2))?;
        let i = if negative {
            Coefficient::I.neg()
        } else {
            Coefficient::I
        };
        self.add(&cosine, &w.scaled(&i))
    }

    /// exp(±i atan w) = (1 ± i w)/√(1 + w²)
    fn phase_of_atan(&mut self, w: &Fraction, negative: bool) -> Result<Fraction> {
        let square = self.mul(w, w)?;
        let secant_squared = self.add(&Fraction::one(), &square)?;
        let cosine = self.rational_power(&secant_squared, &Number::Small(-1, 2))?;
        let i = if negative {
            Coefficient::I.neg()
        } else {
            Coefficient::I
        };
        let sum = self.add(&Fraction::one(), &w.scaled(&i))?;
        self.mul(&sum, &cosine)
    }

    /// exp(i π c): by √2 and √3 for multiples of π/4 and π/6, else a power of exp(i π).
    pub(super) fn root_of_unity(&mut self, c: &Number) -> Result<Fraction> {
        let exponent = Exponent::from_number(c)?;
        let whole = exponent.floor();
        let rest = exponent.sub(Exponent::integer(whole))?;
        let sign = if whole % 2 == 0 { 1 } else { -1 };
        let half = Number::Small(1, 2);
        // cos and sin of the rest, an angle in [0, π), as (sign, square)
        let squares = match rest.to_number() {
            Number::Small(0, 1) => Some(((1, 1, 1), (1, 0, 1))),
            Number::Small(1, 6) => Some(((1, 3, 4), (1, 1, 4))),
            Number::Small(1, 4) => Some(((1, 1, 2), (1, 1, 2))),
            Number::Small(1, 3) => Some(((1, 1, 4), (1, 3, 4))),
            Number::Small(1, 2) => Some(((1, 0, 1), (1, 1, 1))),
            Number::Small(2, 3) => Some(((-1, 1, 4), (1, 3, 4))),
            Number::Small(3, 4) => Some(((-1, 1, 2), (1, 1, 2))),
            Number::Small(5, 6) => Some(((-1, 3, 4), (1, 1, 4))),
            _ => None,
        };
        let Some((cosine, sine)) = squares else {
            let mut phase = None;
            if let Number::Small(n, q) = rest.to_number() {
                phase = self.root_of_unity_by_roots(n, q)?;
            }
            let phase = match phase {
                Some(phase) => phase,
                None => self.power_of_half_turn(rest)?,
            };
            return Ok(phase.scaled(&Coefficient::real(Number::integer(sign))));
        };
        let [cosine, sine] = [cosine, sine].map(|(own_sign, n, d)| -> Result<Fraction> {
            let square = Fraction::number(Number::Small(n, d));
            let root = self.rational_power(&square, &half)?;
            Ok(root.scaled(&Coefficient::real(Number::integer(own_sign * sign))))
        });
        self.add(&cosine?, &sine?.scaled(&Coefficient::I))
    }

    /// asin or atan, odd, with the values that are simple multiples of π.
    pub(super) fn arc(&mut self, function: Function, u: &Fraction) -> Result<Fraction> {
        if u.is_zero() {
            return Ok(Fraction::zero());
        }
        let u = self.cancel(u.clone());
        // the sign of a constant is not that of its first term
        if self.is_algebraic(&u)
            && let Some(angle) = self.arc_by_another(function, &u)?
        {
            return Ok(angle);
        }
        if u.leads_negative() {
            return Ok(self.arc(function, &u.neg())?.neg());
        }
        match (function, u.as_number()) {
            (Function::Asin, Some(Number::Small(1, 2))) => return self.pi_times(1, 6),
            (Function::Asin, Some(Number::Small(1, 1))) => return self.pi_times(1, 2),
            (Function::Atan, Some(Number::Small(1, 1))) => return self.pi_times(1, 4),
            _ => {}
        }
        if let Some(angle) = self.arc_by_another(function, &u)? {
            return Ok(angle);
        }
        let atom = self.intern(Kind::Call(function, u))?;
        Ok(Fraction::atom(atom))
    }

    /// A divided difference h\[a, b\] or its derivative in b.
    pub(super) fn pair(
        &mut self,
        function: PairFunction,
        a: &Fraction,
        b: &Fraction,
    ) -> Result<Fraction> {
        let (outer, pair) = (function.of(), function.properties());
        let distance = self.sub(b, a)?;
        let is_prime = function.prime().is_none();
        if distance.is_zero() {
            let derivative = self.derivative(pair, b)?;
            return if is_prime {
                self.half_second_derivative(pair, b, &derivative)
            } else {
                Ok(derivative)
            };
        }
        let [at_a, at_b] = [self.call(outer, a)?, self.call(outer, b)?];
        let difference = self.sub(&at_b, &at_a)?;
        let quotient = self.div(&difference, &distance)?;
        if !is_prime {
            return Ok(quotient);
        }
        let derivative = self.derivative(pair, b)?;
        let difference = self.sub(&derivative, &quotient)?;
        self.div(&difference, &distance)
    }

    /// h′(u) = v^r
    fn derivative(&mut self, pair: &Pair, u: &Fraction) -> Result<Fraction> {
        let base = match pair.square {
            Some(c) => {
                let square = self.mul(u, u)?;
                let square = square.scaled(&Coefficient::real(Number::integer(c)));
                self.add(&Fraction::one(), &square)?
            }
            None => u.clone(),
        };
        if pair.is_root {
            self.rational_power(&base, &Number::Small(-1, 2))
        } else {
            self.inverse(&base)
        }
    }

    /// h″(u)/2 = c·uᵏ·h′ᵖ/2
    fn half_second_derivative(
        &mut self,
        pair: &Pair,
        u: &Fraction,
        first: &Fraction,
    ) -> Result<Fraction> {
        let (c, k, p) = pair.second;
        let power = self.integer_power(u, k.into())?;
        let slopes = self.integer_power(first, p.into())?;
        let half = Coefficient::real(Number::from_rational(&Rational::new(c.into(), 2.into())));
        Ok(self.mul(&power, &slopes)?.scaled(&half))
    }
}
