//! Events: the first zero of a switching function g along a piece of a trajectory, with certainty.
//!
//! Between two points of a trajectory the sign of g is *certain*, or the piece is divided until it
//! is. A piece of trajectory is a [`Path`], the dense output of a step. On a part of it the
//! functions that the compiler emits, evaluated over [`interval::Interval`]s, enclose g, dg/dt and
//! the coefficients up to the fourth order ([`switching`]). From these [`search`] concludes that g has
//! no zero there, or exactly one, or that the part has to be divided.
//!
//! What lies within rounding errors of zero and returns is a touch: no crossing, but counted.

pub(crate) mod cubic;
pub(crate) mod ends;
pub(crate) mod interval;
pub(crate) mod path;
pub(crate) mod search;
mod series;
pub(crate) mod switching;

pub(crate) use path::Path;
pub(crate) use search::{Met, Search};
pub(crate) use series::{Root, Series};
pub(crate) use switching::{Enclosed, Switching};
