//! The functions as they are defined, with digits to spare for every cancellation.

use dashu_float::{FBig, round::mode::HalfEven};

/// A binary number of arbitrary precision.
pub(crate) type Big = FBig<HalfEven, 2>;

/// Whether a number is within the range of doubles; subnormal ones and those that round to 0
/// are.
pub(crate) fn is_representable(exact: &Big) -> bool {
    exact.to_f64().value().is_finite()
}

/// The unit in the last place of a number: 2ᵉ⁻⁵² for 2ᵉ ≤ |exact| < 2ᵉ⁺¹, at least that of the
/// subnormal numbers, 2⁻¹⁰⁷⁴ (Goldberg 1991).
fn ulp(exact: &Big) -> Big {
    let exponent = if *exact == Big::ZERO {
        -1074
    } else {
        // The significand of a `Repr` is an integer: |exact| = significand · 2ᵉ.
        let repr = exact.repr();
        let top = repr.exponent() + repr.digits() as isize - 1;
        (top - 52).max(-1074)
    };
    Big::from_parts(1.into(), exponent)
}

/// |value − exact| in ulp of the exact value, or of `terms` if these are greater; infinite where
/// the value is not a number.
pub(crate) fn distance(value: f64, exact: &Big, terms: Big) -> f64 {
    let Ok(value) = Big::try_from(value) else {
        return f64::INFINITY;
    };
    if !value.repr().is_finite() {
        return f64::INFINITY;
    }
    let size = absolute(exact.clone()).max(terms);
    // The subtraction is rounded to the precision of its operands.
    ((value.with_precision(2 * DIGITS).value() - exact) / ulp(&size))
        .to_f64()
        .value()
        .abs()
}

/// Bits enough for the second difference of a function known to double precision: 106 are
/// lost in it.
const DIGITS: usize = 300;

/// `value` with `DIGITS` bits, and those that the function's behaviour at 0 and ∞ costs: h(u)
/// differs from u by u³ there, and arc tangents from π/2 by 1/u.
fn big(value: f64, others: &[f64]) -> Big {
    let sizes = others.iter().chain([&value]).map(|value| value.abs());
    let largest = sizes.clone().fold(0.0, f64::max);
    let least = sizes.fold(f64::INFINITY, f64::min);
    let magnitude = if largest < 1.0 && largest > 0.0 {
        -2.0 * largest.log2()
    } else {
        2.0 * least.max(1.0).log2()
    };
    Big::try_from(value)
        .unwrap()
        .with_precision(DIGITS + magnitude.ceil() as usize)
        .value()
}

fn absolute(value: Big) -> Big {
    if value < Big::ZERO { -value } else { value }
}

/// 1 with the precision of `like`.
fn one(like: &Big) -> Big {
    Big::ONE.with_precision(like.precision()).value()
}

/// The definitions; functions of one argument ignore the second.
pub(crate) mod exact {
    use super::{Big, big, one};

    pub(crate) fn sinc(u: f64, _: f64) -> Big {
        let u = big(u, &[]);
        if u == Big::ZERO { one(&u) } else { u.sin() / u }
    }

    pub(crate) fn sinc_prime(u: f64, _: f64) -> Big {
        let u = big(u, &[]);
        if u == Big::ZERO {
            return u;
        }
        let (sin, cos) = u.sin_cos();
        (&u * cos - sin) / (&u * &u)
    }

    pub(crate) fn sinhc(u: f64, _: f64) -> Big {
        let u = big(u, &[]);
        if u == Big::ZERO {
            one(&u)
        } else {
            u.sinh() / u
        }
    }

    pub(crate) fn sinhc_prime(u: f64, _: f64) -> Big {
        let u = big(u, &[]);
        if u == Big::ZERO {
            return u;
        }
        let (sinh, cosh) = u.sinh_cosh();
        (&u * cosh - sinh) / (&u * &u)
    }

    /// (h(b) − h(a))/(b − a), or h'(b) where a = b.
    fn difference((a, b): (f64, f64), h: impl Fn(&Big) -> Big, first: impl Fn(&Big) -> Big) -> Big {
        let (x, y) = (big(a, &[b]), big(b, &[a]));
        if a == b {
            first(&y)
        } else {
            (h(&y) - h(&x)) / (y - x)
        }
    }

    /// (h'(b) − h[a, b])/(b − a), or h''(b)/2 where a = b.
    fn difference_prime(
        (a, b): (f64, f64),
        h: impl Fn(&Big) -> Big,
        first: impl Fn(&Big) -> Big,
        half_second: impl Fn(&Big) -> Big,
    ) -> Big {
        let (x, y) = (big(a, &[b]), big(b, &[a]));
        if a == b {
            half_second(&y)
        } else {
            (first(&y) - difference((a, b), h, &first)) / (y - x)
        }
    }

    fn reciprocal(u: &Big) -> Big {
        one(u) / u
    }

    /// (√(1 − u²), 1 − u²)
    fn cosine(u: &Big) -> (Big, Big) {
        let square = one(u) - u * u;
        (square.sqrt(), square)
    }

    pub(crate) fn exp_product(a: f64, b: f64) -> Big {
        (big(a, &[]) * big(b, &[])).exp()
    }

    pub(crate) fn ln_dd(a: f64, b: f64) -> Big {
        difference((a, b), Big::ln, reciprocal)
    }

    pub(crate) fn ln_dd_prime(a: f64, b: f64) -> Big {
        difference_prime((a, b), Big::ln, reciprocal, |u| -one(u) / (u * u * 2))
    }

    pub(crate) fn asin_dd(a: f64, b: f64) -> Big {
        difference((a, b), Big::asin, |u| one(u) / cosine(u).0)
    }

    pub(crate) fn asin_dd_prime(a: f64, b: f64) -> Big {
        difference_prime(
            (a, b),
            Big::asin,
            |u| one(u) / cosine(u).0,
            |u| {
                let (root, square) = cosine(u);
                u / (root * square * 2)
            },
        )
    }

    pub(crate) fn atan_dd(a: f64, b: f64) -> Big {
        difference((a, b), Big::atan, |u| one(u) / (one(u) + u * u))
    }

    pub(crate) fn atan_dd_prime(a: f64, b: f64) -> Big {
        difference_prime(
            (a, b),
            Big::atan,
            |u| one(u) / (one(u) + u * u),
            |u| {
                let square = one(u) + u * u;
                -u / (&square * &square)
            },
        )
    }
}

/// The size of the terms that cancel where a derivative changes its sign; 0 elsewhere.
pub(crate) mod terms {
    use super::{Big, absolute, big, one};

    /// (|cos u| + |sinc u|)/|u| from π on
    pub(crate) fn sinc_prime(u: f64, _: f64) -> Big {
        let u = big(u.abs(), &[]);
        if u < Big::from(3) {
            return Big::ZERO;
        }
        let (sin, cos) = u.sin_cos();
        (absolute(cos) + absolute(sin / &u)) / u
    }

    pub(crate) fn asin_dd_prime(a: f64, b: f64) -> Big {
        odd((a, b), Big::asin, |u| one(u) / (one(u) - u * u).sqrt())
    }

    pub(crate) fn atan_dd_prime(a: f64, b: f64) -> Big {
        odd((a, b), Big::atan, |u| one(u) / (one(u) + u * u))
    }

    /// ∂h[a, b]/∂b = (h'(b) − h[a, b])/(b − a) = ∫ (u − a) h''(u) du/(b − a)² from a to b, and h''
    /// changes its sign at 0. Its terms are the two of the first form, or the integrals from a to
    /// 0 and from 0 to b, whichever are less.
    fn odd((a, b): (f64, f64), h: fn(&Big) -> Big, first: fn(&Big) -> Big) -> Big {
        if a == 0.0 || b == 0.0 || a.signum() == b.signum() {
            return Big::ZERO;
        }
        let (x, y) = (big(a, &[b]), big(b, &[a]));
        let step = &y - &x;
        let (slope, from, to) = (first(&y), h(&x), h(&y));
        let chord = (&to - &from) / &step;
        let ends = (absolute(slope.clone()) + absolute(chord)) / absolute(step.clone());
        let before = absolute(from - &x);
        let behind = absolute(&step * slope - to + x);
        ends.min((before + behind) / (&step * &step))
    }
}
