//! How well the conserved quantities are kept, over long runs and over many transitions.

use std::ops::ControlFlow;

use dmm_runtime::{Error, Statistics};

use crate::problem::{AnyObserver, Problem, Record, Run};
use crate::reference::Reference;

/// Steps from one word of progress to the next.
const TOLD: u64 = 1 << 10;

/// What a run did to its conserved quantities.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Conservation {
    /// Counters of the run.
    pub statistics: Statistics,
    /// Largest |ψ − ψ_ref| within a segment in units of ε·Σ|terms of ψ|, ε = 2⁻⁵².
    pub ulps: f64,
    /// Largest |ψ_ref − ψ*| where the exact level ψ* is known.
    pub level_error: Option<f64>,
}

impl Conservation {
    /// Largest |ψ − ψ_ref| within a segment, relative to the size of ψ's terms.
    pub fn relative(&self) -> f64 {
        self.ulps * f64::EPSILON
    }
}

/// Makes the run and measures; `progress` is told of the time now and then, and says whether to go
/// on.
///
/// # Errors
/// Whatever stops the integration.
pub fn measure(
    problem: &Problem,
    run: &Run,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Conservation, Error> {
    let mut meter = Meter {
        exact: exact_levels(problem, run),
        ulps: 0.0,
        level_error: 0.0,
        records: 0,
        progress,
    };
    let finish = problem.integrate(run, &mut meter)?;
    Ok(Conservation {
        statistics: finish.statistics,
        ulps: meter.ulps,
        level_error: meter.exact.is_some().then_some(meter.level_error),
    })
}

/// The exact level of each region, if it is the same in every segment.
fn exact_levels(problem: &Problem, run: &Run) -> Option<Vec<Vec<f64>>> {
    if !problem.is_reference_run(&run.initial) {
        return None;
    }
    let reference = Reference::of(problem).ok()??;
    let mut levels = vec![Vec::new(); problem.regions().len()];
    for side in [-1.0, 1.0] {
        let region = problem.region_on_side(side)?;
        levels
            .get_mut(region)?
            .extend(reference.constant_level(side)?);
    }
    Some(levels)
}

/// The worst so far.
struct Meter<'a> {
    exact: Option<Vec<Vec<f64>>>,
    ulps: f64,
    level_error: f64,
    records: u64,
    progress: &'a mut dyn FnMut(f64) -> ControlFlow<()>,
}

impl AnyObserver for Meter<'_> {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        let ulps = record.error_ulps();
        if ulps > self.ulps || ulps.is_nan() {
            self.ulps = ulps;
        }
        if let Some(exact) = self
            .exact
            .as_ref()
            .and_then(|levels| levels.get(record.mode.region))
        {
            for (level, exact) in record.level.iter().zip(exact) {
                self.level_error = self.level_error.max((level - exact).abs());
            }
        }
        self.records += 1;
        if self.records.is_multiple_of(TOLD) {
            return (self.progress)(record.t);
        }
        ControlFlow::Continue(())
    }
}
