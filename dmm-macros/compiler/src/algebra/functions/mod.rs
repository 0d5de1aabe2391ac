//! The elementary functions, one file each: what every stage knows of a function stands in its
//! file as one [`Properties`], and the list below names the files.
//!
//! What relates several functions to one another is algebra and stands in
//! [`normal_form`](super::normal_form): sums of angles, exp(c ln p) = pᶜ, exp(i n asin w), arcs
//! written by other arcs.

mod abs;
mod acos;
mod asin;
mod atan;
mod cos;
mod cosh;
mod exp;
mod ln;
mod properties;
mod sin;
mod sinc;
mod sinh;
mod sinhc;
mod sqrt;
mod tan;
mod tanh;

use std::fmt;
use std::str::FromStr;

use super::{Dag, Id};
pub use properties::Latex;
use properties::Properties;
pub(super) use properties::{Difference, Form, Pair};
pub(crate) use properties::{Domain, Equation};

/// Writes the enumeration of functions.
macro_rules! functions {
    ($($(#[$doc:meta])* $function:ident = $properties:path,)*) => {
        /// Functions of one argument.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        pub enum Function { $($(#[$doc])* $function,)* }

        impl Function {
            /// Every function of one argument.
            pub const ALL: &[Self] = &[$(Self::$function),*];

            /// What is known of it.
            pub(crate) fn properties(self) -> &'static Properties {
                match self { $(Self::$function => &$properties,)* }
            }
        }
    };
}

functions! {
    /// √u
    Sqrt = sqrt::SQRT,
    /// eᵘ
    Exp = exp::EXP,
    /// Natural logarithm.
    Ln = ln::LN,
    /// Sine.
    Sin = sin::SIN,
    /// Cosine.
    Cos = cos::COS,
    /// Tangent.
    Tan = tan::TAN,
    /// Hyperbolic sine.
    Sinh = sinh::SINH,
    /// Hyperbolic cosine.
    Cosh = cosh::COSH,
    /// Hyperbolic tangent.
    Tanh = tanh::TANH,
    /// Arc sine, in [−π/2, π/2].
    Asin = asin::ASIN,
    /// Arc cosine, in [0, π].
    Acos = acos::ACOS,
    /// Arc tangent, in (−π/2, π/2).
    Atan = atan::ATAN,
    /// |u|; of the compiler's own, for the size of a sum's terms.
    Abs = abs::ABS,
    /// sin(u)/u, 1 at 0.
    Sinc = sinc::SINC,
    /// The derivative of `sinc`.
    SincPrime = sinc::SINC_PRIME,
    /// sinh(u)/u, 1 at 0.
    Sinhc = sinhc::SINHC,
    /// The derivative of `sinhc`.
    SinhcPrime = sinhc::SINHC_PRIME,
}

/// Writes the enumeration of divided differences.
macro_rules! differences {
    ($($function:ident = $pair:path: $plain:ident $name:literal, $prime:ident $prime_name:literal,)*) => {
        /// Functions of two arguments: divided differences (h(u₁) − h(u₀))/(u₁ − u₀), with the
        /// value h′(u) where the arguments coincide, and their derivatives in the second
        /// argument. A divided difference is symmetric, so that its derivative in the first
        /// argument is the same function with the arguments exchanged.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        pub enum PairFunction { $(
            #[doc = concat!("Of `", stringify!($function), "`.")]
            $plain,
            #[doc = concat!("∂ ", $name, "(a, b)/∂b")]
            $prime,
        )* }

        impl PairFunction {
            /// Every function of two arguments.
            pub const ALL: &[Self] = &[$(Self::$plain, Self::$prime),*];

            /// The name that the language, the listing and the runtime's scalars use.
            pub fn name(self) -> &'static str {
                match self { $(Self::$plain => $name, Self::$prime => $prime_name,)* }
            }

            /// The function h that it is a difference of.
            pub fn of(self) -> Function {
                match self { $(Self::$plain | Self::$prime => Function::$function,)* }
            }

            /// What is known of it.
            pub(super) fn properties(self) -> &'static Pair {
                match self { $(Self::$plain | Self::$prime => &$pair,)* }
            }

            /// The derivative in the second argument; nothing of what is one.
            pub fn prime(self) -> Option<Self> {
                match self { $(Self::$plain => Some(Self::$prime), Self::$prime => None,)* }
            }
        }
    };
}

differences! {
    Ln = ln::PAIR: LnDd "ln_dd", LnDdPrime "ln_dd_prime",
    Asin = asin::PAIR: AsinDd "asin_dd", AsinDdPrime "asin_dd_prime",
    Atan = atan::PAIR: AtanDd "atan_dd", AtanDdPrime "atan_dd_prime",
}

impl Function {
    /// The name that the language, the listing and the runtime's scalars use.
    pub fn name(self) -> &'static str {
        self.properties().name
    }

    /// How LaTeX writes it.
    pub fn latex(self) -> Latex {
        self.properties().latex
    }

    /// Whether a declaration may call this function.
    pub fn is_declarable(self) -> bool {
        self.properties().is_declarable
    }

    /// h′(u)
    pub(crate) fn derivative(self, dag: &mut Dag, u: Id) -> Id {
        (self.properties().derivative)(dag, u)
    }
}

/// Gives the names of an enumeration of functions to `egg` and to the listing.
macro_rules! named {
    ($($functions:ident),*) => { $(
        impl fmt::Display for $functions {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(self.name())
            }
        }

        impl FromStr for $functions {
            type Err = String;

            fn from_str(text: &str) -> Result<Self, String> {
                let found = Self::ALL.iter().find(|function| function.name() == text);
                found.copied().ok_or_else(|| format!("no function `{text}`"))
            }
        }
    )* };
}

named!(Function, PairFunction);
