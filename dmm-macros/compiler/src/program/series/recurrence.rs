//! The recurrences that there are. In their equations u and v are power series in h = t − t₀,
//! and w is the series that is computed.

use crate::algebra::{Function, Id};

/// Where the coefficients of a series are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// Those of a state, by its number.
    State(usize),
    /// Those of a slot, by its number.
    Slot(usize),
}

/// How coefficient k of a node is computed from those of its operands, of order k, and from
/// series with coefficients below k, or up to k where they are computed before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Recurrence {
    /// The operation of the node on the coefficients of its operands, as for numbers.
    Linear,
    /// w = ±u ± c, c constant in time: c counts in the coefficient of order zero only.
    Shifted(Shifted),
    /// w = u²
    Square(Place),
    /// w = u v, the one that is known last in the second place
    Product([Place; 2]),
    /// w = u/v
    Quotient {
        /// u
        numerator: Id,
        /// v
        denominator: Place,
        /// w
        own: Place,
        /// 1/v at order zero
        inverse: Place,
        /// Whether u is known last, where sums run together.
        is_late: bool,
    },
    /// w = u^c, c constant in time
    Power {
        /// u
        base: Place,
        /// c
        exponent: Id,
        /// w
        own: Place,
        /// 1/u at order zero
        inverse: Place,
        /// h dw/dh
        derivative: Place,
    },
    /// w = u^v = e^(v ln u)
    VariablePower {
        /// u
        base: Base,
        /// v
        exponent: Id,
        /// h d(v ln u)/dh
        derivative: Place,
        /// w
        own: Place,
    },
    /// w = √u
    SquareRoot {
        /// u
        argument: Id,
        /// w
        own: Place,
        /// 1/(2√u) at order zero
        inverse: Place,
    },
    /// w = eᵘ, h dw/dh = w h du/dh
    Exponential {
        /// u
        argument: Id,
        /// h du/dh
        derivative: Place,
        /// w
        own: Place,
    },
    /// sin u and cos u, or sinh u and cosh u: each is the integral of the other
    Pair {
        /// Sine and cosine.
        functions: [Function; 2],
        /// Whether the derivative of the cosine is −sine.
        is_negative: bool,
        /// u
        argument: Id,
        /// h du/dh
        derivative: Place,
        /// The two series.
        places: [Place; 2],
        /// The one that is w.
        own: Place,
    },
    /// A series that a [`Recurrence::Pair`] before computes together with its own.
    Computed(Place),
    /// w = tan u or tanh u, h dw/dh = v h du/dh with v = 1 ± w²
    Tangent {
        /// Which of them.
        function: Function,
        /// Whether v = 1 − w².
        is_negative: bool,
        /// u
        argument: Id,
        /// h du/dh
        derivative: Place,
        /// w
        own: Place,
        /// v
        partner: Place,
    },
    /// w = ln u = ∫ du/u
    Logarithm(Primitive),
    /// w = arctan u = ∫ du/v with v = 1 + u²
    ArcTangent {
        /// u
        argument: Place,
        /// The integral.
        primitive: Primitive,
    },
    /// w = arcsin u or arccos u = ±∫ du/v with v = √(1 − u²)
    ArcSine {
        /// Which of them.
        function: Function,
        /// u
        argument: Place,
        /// 1/(2v) at order zero
        inverse: Place,
        /// The integral.
        primitive: Primitive,
    },
    /// An operation that has no recurrence here.
    Missing,
}

/// A sum over coefficients of orders 1 to k − 1: what a recurrence takes of the orders below, which is
/// known before anything of order k is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sum {
    /// Σ uⱼ vₖ₋ⱼ over 1 ≤ j < k
    Inner([Place; 2]),
    /// Σ uⱼ uₖ₋ⱼ over 1 ≤ j < k/2
    Half(Place),
}

impl Recurrence {
    /// The factors of a product.
    pub fn factors(&self) -> Vec<Place> {
        match *self {
            Self::Square(of) => vec![of],
            Self::Product(of) => of.into(),
            _ => Vec::new(),
        }
    }

    /// The sums of those that are nothing but sums; of the others, nothing.
    pub fn sums(&self) -> Vec<Sum> {
        match *self {
            Self::Square(of) => vec![Sum::Half(of)],
            Self::Product(of) => vec![Sum::Inner(of)],
            Self::Quotient {
                denominator, own, ..
            } => vec![Sum::Inner([denominator, own])],
            Self::SquareRoot { own, .. } => vec![Sum::Half(own)],
            Self::Exponential {
                derivative, own, ..
            } => vec![Sum::Inner([derivative, own])],
            Self::Power {
                base,
                own,
                derivative,
                ..
            } => [own, derivative].map(|of| Sum::Inner([of, base])).into(),
            Self::Pair {
                derivative, places, ..
            } => places.map(|place| Sum::Inner([derivative, place])).into(),
            _ => Vec::new(),
        }
    }

    /// The series of which it takes more than a sum, the first coefficient and that of order k.
    pub fn whole_series(&self) -> Vec<Place> {
        let integral = |of: &Primitive| [of.divisor, of.slope, of.inverse];
        match *self {
            Self::Linear | Self::Shifted(_) | Self::Missing => Vec::new(),
            Self::Square(_) | Self::Product(_) | Self::Computed(_) => Vec::new(),
            Self::Exponential { .. } | Self::Pair { .. } => Vec::new(),
            Self::Quotient { inverse, .. }
            | Self::SquareRoot { inverse, .. }
            | Self::Power { inverse, .. } => vec![inverse],
            Self::VariablePower {
                base,
                derivative,
                own,
                ..
            } => match base {
                Base::Fixed { logarithm, .. } => vec![derivative, own, logarithm],
                Base::Moving {
                    base,
                    exponent,
                    logarithm,
                    primitive,
                } => {
                    let places = [derivative, own, base, exponent, logarithm];
                    [&places[..], &integral(&primitive)].concat()
                }
            },
            Self::Tangent {
                derivative,
                own,
                partner,
                ..
            } => vec![derivative, own, partner],
            Self::Logarithm(primitive) => integral(&primitive).into(),
            Self::ArcTangent {
                argument,
                primitive,
            } => [&[argument][..], &integral(&primitive)].concat(),
            Self::ArcSine {
                argument,
                inverse,
                primitive,
                ..
            } => [&[argument, inverse][..], &integral(&primitive)].concat(),
        }
    }
}

/// ±u ± c
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shifted {
    /// Whether u is subtracted, and u.
    pub moving: (bool, Id),
    /// Whether c is subtracted, and c.
    pub fixed: (bool, Id),
}

/// w = ±∫ du/v, e = h dw/dh = ±(h du/dh)/v
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Primitive {
    /// u
    pub argument: Id,
    /// v
    pub divisor: Place,
    /// e
    pub slope: Place,
    /// 1/v at order zero
    pub inverse: Place,
    /// Whether the sign is −.
    pub is_negative: bool,
}

/// The base of a power whose exponent changes with the time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Base {
    /// u changes with the time as well.
    Moving {
        /// u
        base: Place,
        /// v
        exponent: Place,
        /// ln u
        logarithm: Place,
        /// ln u = ∫ du/u
        primitive: Primitive,
    },
    /// u is constant in time.
    Fixed {
        /// u
        base: Id,
        /// ln u, at order zero
        logarithm: Place,
    },
}
