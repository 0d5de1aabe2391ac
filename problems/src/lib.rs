//! Reference problems for conservative integration of piecewise-smooth systems, and the
//! studies that the program `pws` runs on them.
//!
//! - [`systems`]: one file a system, with its source and initial value problem;
//! - [`problem`]: the same operations on all of them, whatever their dimension; [`registry`]: every
//!   problem by name, compiled with the program or at run time; [`method`]: the schemes by name;
//! - [`mod@reference`]: solutions known to 32 digits; [`accurate`]: an independent integrator of
//!   high order, for what the reference does not list;
//! - [`convergence`], [`conservation`], [`work_precision`] and [`stress`]: the studies; [`fit`] and
//!   [`growth`]: orders and exponents of errors; the crate `dmm_picture`: their figures;
//! - [`perturbed`]: the perturbed locator that Hirani, Wan & Wojtalewicz compare with; [`standard`]:
//!   Runge–Kutta steps without detection of switches, which Nurkanović, Sperl, Albrecht & Diehl compare
//!   with;
//! - [`random`] numbers and [`threads`] of studies.

#[macro_use]
mod declaration;

pub mod accurate;
pub mod conservation;
pub mod convergence;
pub mod fit;
pub mod growth;
pub mod method;
pub mod perturbed;
pub mod problem;
pub mod random;
pub mod reference;
pub mod registry;
pub mod standard;
pub mod stress;
pub mod systems;
pub mod threads;
pub mod truth;
pub mod work_precision;
