//! What the stages read of a function.

use super::{Function, PairFunction};
use crate::algebra::evaluate::Interval;
use crate::algebra::{Dag, Id};

/// What is known of a function w = h(u).
pub(crate) struct Properties {
    /// The name that the language, the listing and the runtime's scalars use.
    pub(super) name: &'static str,
    /// How LaTeX writes it.
    pub(super) latex: Latex,
    /// Whether a declaration may call it.
    pub(super) is_declarable: bool,
    /// What u needs for h(u) to have a value.
    pub(crate) domain: Domain,
    /// Whether no value is negative.
    pub(crate) is_not_negative: bool,
    /// u and h(u) where both are integers that the DAG folds.
    pub(in crate::algebra) integers: &'static [(i64, i64)],
    /// The function g with h(g(u)) = u wherever g has a value.
    pub(in crate::algebra) right_inverse: Option<Function>,
    /// How the normal form writes h(u).
    pub(in crate::algebra) form: Form,
    /// h′(u)
    pub(in crate::algebra) derivative: fn(&mut Dag, Id) -> Id,
    /// The factor in Δh(u) = factor·Δu over a step, exact and symmetric.
    pub(in crate::algebra) difference: Difference,
    /// h(u)
    pub(crate) value: fn(f64) -> f64,
    /// h′(u) or a bound of its size, up to the sign.
    pub(in crate::algebra) slope: fn(f64) -> f64,
    /// An interval of the values of h.
    pub(in crate::algebra) enclosure: fn(Interval) -> Interval,
    /// What the Taylor coefficients of w follow from.
    pub(crate) equation: Equation,
}

impl Properties {
    /// Whether h(−u) = −h(u), or else h(−u) = h(u); nothing of other functions.
    pub(crate) fn is_odd(&self) -> Option<bool> {
        match self.form {
            Form::Root | Form::Exponential | Form::Logarithm | Form::Complement(_) => None,
            Form::Size | Form::Cardinal(_) => Some(false),
            Form::Ratio(_) | Form::Arc | Form::CardinalPrime(_) => Some(true),
            Form::Circular { is_odd } | Form::Hyperbolic { is_odd } => Some(is_odd),
        }
    }
}

/// How LaTeX writes a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Latex {
    /// By a name in front of the argument.
    Name(&'static str),
    /// As a root.
    Root,
    /// Between bars.
    Bars,
}

/// Where a function has values.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Domain {
    /// Everywhere.
    All,
    /// u ≥ 0
    NotNegative,
    /// u > 0
    Positive,
    /// −1 ≤ u ≤ 1
    WithinOne,
    /// Where this function of u is not zero.
    NonZero(Function),
}

impl Domain {
    /// Whether it ends somewhere, with no values beyond.
    pub(crate) fn has_border(self) -> bool {
        matches!(self, Self::NotNegative | Self::Positive | Self::WithinOne)
    }

    /// Whether values need u ≥ 0.
    pub(crate) fn is_half_line(self) -> bool {
        matches!(self, Self::NotNegative | Self::Positive)
    }
}

/// How the normal form writes h(u).
#[derive(Clone, Copy)]
pub(in crate::algebra) enum Form {
    /// u^(1/2)
    Root,
    /// (u²)^(1/2)
    Size,
    /// By powers of exp(u).
    Exponential,
    /// By logarithms of the factors of u.
    Logarithm,
    /// (e^(iu) + e^(−iu))/2, or with a minus sign over 2i.
    Circular {
        /// Whether with a minus sign.
        is_odd: bool,
    },
    /// (eᵘ ± e^(−u))/2
    Hyperbolic {
        /// Whether with a minus sign.
        is_odd: bool,
    },
    /// p(u)/q(u)
    Ratio([Function; 2]),
    /// An atom, odd.
    Arc,
    /// π/2 − p(u)
    Complement(Function),
    /// p(u)/u, 1 at 0
    Cardinal(Function),
    /// (p(u)/u)′ = (p′(u) − p(u)/u)/u, 0 at 0; p and p′.
    CardinalPrime([Function; 2]),
}

/// The factor in Δh(u) = factor·Δu over a step, exact and symmetric.
pub(in crate::algebra) enum Difference {
    /// p(ū)·q(Δu/2) of p and q, with ū the mean of the ends.
    AtMean([Function; 2]),
    /// −p(ū)·q(Δu/2)
    MinusAtMean([Function; 2]),
    /// q(Δu)/(p(u₀) p(u₁)) of p and q.
    AtEnds([Function; 2]),
    /// h\[u₀, u₁\]
    Pair(PairFunction),
    /// −h\[u₀, u₁\]
    MinusPair(PairFunction),
    /// p/q of the p and q that are made of u₀ and u₁.
    Quotient(fn(&mut Dag, [Id; 2]) -> [Id; 2]),
    /// That of the quotient that defines h, which takes the place of h.
    Definition(fn(&mut Dag, Id) -> Id),
}

/// The divided difference h\[a, b\] as a function of its own, of a function with an elementary
/// derivative h′ = v^r.
pub(in crate::algebra) struct Pair {
    /// h\[a, b\]
    pub(in crate::algebra) value: fn(f64, f64) -> f64,
    /// The distance of a and b from where h is not analytic, or what is less.
    pub(in crate::algebra) to_singularity: fn(f64, f64) -> f64,
    /// c of v = 1 + c·u², nothing of v = u.
    pub(in crate::algebra) square: Option<i64>,
    /// Whether r is −1/2, and not −1.
    pub(in crate::algebra) is_root: bool,
    /// c, k and p of h″ = c·uᵏ·h′ᵖ.
    pub(in crate::algebra) second: (i64, u8, u8),
}

impl Pair {
    /// h″(u) from h′(u).
    pub(in crate::algebra) fn second_derivative(&self, u: f64, slope: f64) -> f64 {
        let (c, k, p) = self.second;
        c as f64 * u.powi(k.into()) * slope.powi(p.into())
    }
}

/// The equation from which the Taylor coefficients of w = h(u) follow, when u = u(t).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Equation {
    /// There is none here.
    Missing,
    /// w² = u
    Root,
    /// w′ = w u′
    Exponential,
    /// w′ = u′/u
    Logarithm,
    /// p′ = q u′ and q′ = ±p u′; w is p or q.
    Pair {
        /// p and q.
        functions: [Function; 2],
        /// Whether q′ = −p u′.
        is_negative: bool,
    },
    /// w′ = (1 ± w²) u′
    Tangent {
        /// Whether the sign is −.
        is_negative: bool,
    },
    /// w′ = u′/(1 + u²)
    ArcTangent,
    /// w′ = ±u′/√(1 − u²)
    ArcSine {
        /// Whether the sign is −.
        is_negative: bool,
    },
}
