//! Divided differences of elementary functions, free of cancellation, and [`exp_product`].
//!
//! The Discrete Multiplier Method replaces the derivative of every elementary function in a
//! conserved quantity ψ by its divided difference h[a, b] = (h(b) − h(a))/(b − a), and Newton's
//! method then asks for ∂h[a, b]/∂b. Evaluated as written, both lose all their digits as the
//! step, and with it b − a, becomes small. Each function here is instead a closed form without
//! such a difference, so that nothing special happens at b = a:
//!
//! | h | h[a, b] | with |
//! |---|---|---|
//! | exp | exp(m) sinhc(δ) | m = (a + b)/2, δ = (b − a)/2 |
//! | sin, cos | cos(m) sinc(δ), −sin(m) sinc(δ) | |
//! | ln | 2 A(−z²)/(a + b) | z = (b − a)/(a + b) |
//! | asin | 2 A(w²)/(p + q) | w = (b − a)/(p + q), p = √(1 − a²), q = √(1 − b²) |
//! | atan | A(w²)/(1 + ab) | w = (b − a)/(1 + ab) |
//!
//! where A(w²) = atan(w)/w and A(−z²) = atanh(z)/z are one analytic function; see
//! `arc_remainder` in the source for how it is evaluated. Where the arguments are far apart
//! another form, accurate there, takes over.
//!
//! Conventions: the divided differences are symmetric to the last bit, h[a, b] = h[b, a];
//! outside the domain and at NaN they are NaN; limits at 0 and ∞ are stated with each
//! function. `benches/special_accuracy.rs` measures what follows against arbitrary precision.
//!
//! # Accuracy of the functions
//!
//! Every value is within 2 ulp of the exact one, units in the last place of the exact value,
//! down to the subnormal numbers. The bound rests on elementary functions of the platform that
//! are within 0.55 ulp, as those of the C libraries in use are.
//!
//! # Accuracy of the derivatives
//!
//! sinc′, sinhc′ and ∂h[a, b]/∂b are entries of a Jacobian: they lead Newton's method to a
//! solution and are no part of it. Their relative error is below 1e-14 where they are normal
//! numbers, also for nearly equal arguments, and they are finite wherever the derivative is. The
//! derivatives of sinc, of asin and of atan change their sign; there the two terms of
//! (h′(b) − h[a, b])/(b − a), or of (cos u − sinc u)/u, cancel, and the error is relative to the
//! terms.

mod arc;
mod arcsine;
mod arctangent;
mod cardinal;
mod exponential;
mod logarithm;
mod pairs;
mod real;
mod series;

pub use arcsine::{asin_dd, asin_dd_prime};
pub use arctangent::{atan_dd, atan_dd_prime};
pub use cardinal::{sinc, sinc_prime, sinhc, sinhc_prime};
pub use exponential::exp_product;
pub use logarithm::{ln_dd, ln_dd_prime};
