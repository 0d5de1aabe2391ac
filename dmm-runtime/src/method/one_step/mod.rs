//! One-step methods: a map x₀ → x₁ = x₀ + d over a step τ, in uniform steps or in steps that a
//! tolerance decides.
//!
//! A map conserves ψ if it is made from the discrete vector field. Step size, tolerance, level and
//! the search for crossings belong to [`Uniform`] and [`Adaptive`], the same for every map (Hirani,
//! Wan & Wojtalewicz, Algorithm 2.1).

mod adaptive;
mod composed;
mod compositions;
mod conclusion;
mod crossing;
mod dip;
mod grid;
mod history;
mod map;
mod newton;
mod propagator;
mod resolution;
mod runge_kutta;
mod search;
mod segment;
mod step_size;
mod step_sizes;
mod sweep;
mod symmetric;
mod taylor_coefficients;
mod uniform;
mod variation;
mod watch;

pub use adaptive::Adaptive;
pub use composed::{Composed, SubSteps};
pub use compositions::Composition;
pub use crossing::{Crossing, Located, Locator, NewtonLocator};
pub use map::{Correction, OneStep, Step};
pub use runge_kutta::{EmbeddedRungeKutta, ErrorEstimate, RungeKutta};
pub use symmetric::Symmetric;
pub use taylor_coefficients::TaylorCoefficients;
pub use uniform::Uniform;
