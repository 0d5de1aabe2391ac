//! Figs 5, 8 and 9 (left) and Example 3 of Nurkanović, Sperl, Albrecht & Diehl, *Finite elements with
//! switch detection for direct optimal control of nonsmooth systems*, Numer. Math. 156 (2024).
//!
//! Their method is compared with the standard discretisation ([`dmm_problems::standard`]); ours with
//! the same: the same Runge–Kutta methods, whose steps end on interfaces. The level of ψ is not
//! corrected, so that errors are those of the methods.

mod examples;
mod map;
mod objective;
mod orders;
mod runs;

use super::report::Report;
use crate::failure::Failure;
use orders::Sizes;

/// What the files are called.
pub(super) const STEMS: [&str; 4] = [
    "fig5_step_map",
    "fig8_orders",
    "fig9_objective",
    "comparison",
];

/// How much is computed.
pub(super) struct Extent {
    /// Step sizes of Fig. 8.
    sizes: Sizes,
    /// Initial states of Figs 5 and 9.
    points: u32,
}

impl Extent {
    pub(super) fn of(is_brief: bool) -> Self {
        if is_brief {
            Self {
                sizes: Sizes {
                    octaves: 8,
                    of_octave: 4,
                },
                points: 120,
            }
        } else {
            Self {
                sizes: Sizes {
                    octaves: 9,
                    of_octave: 8,
                },
                points: 600,
            }
        }
    }
}

/// Shares of the work.
const EXAMPLES: f64 = 0.01;
const MAP: f64 = 0.02;
const ORDERS: f64 = 0.94;
const OBJECTIVE: f64 = 0.03;

/// Makes all of them.
pub(super) fn figures(report: &mut Report, extent: &Extent) -> Result<(), Failure> {
    report.part(EXAMPLES, examples::table)?;
    report.part(MAP, |report| map::figure(report, extent.points))?;
    report.part(ORDERS, |report| orders::figure(report, extent.sizes))?;
    report.part(OBJECTIVE, |report| objective::figure(report, extent.points))
}
