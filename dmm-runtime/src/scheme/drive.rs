//! How schemes move through a segment: by uniform steps, or by steps of their own choice.

use std::fmt::Debug;

use crate::error::{Error, StepFailure, invalid, number};
use crate::observer::Observer;
use crate::scheme::{OneStep, Step, Taylor};
use crate::statistics::Statistics;
use crate::system::{Flow, System, Vector};
use crate::time::Grid;
use crate::transition::Locator;
use crate::walk::{SegmentEnd, Walk};

/// What the integrator asks of a scheme.
pub trait Drive: Clone + Sync {
    /// What is carried from segment to segment.
    type Progress: Clone + Debug;

    /// Checks the settings.
    fn check(&self, t0: f64, t_end: f64) -> Result<(), Error>;

    /// The scheme as one that an ensemble can integrate in lanes.
    fn in_lanes(&self) -> Option<Taylor> {
        None
    }

    /// The beginning of a run.
    fn progress(&self, t0: f64, t_end: f64) -> Self::Progress;

    /// Steps in one region until its boundary or the end time is reached.
    fn segment<Sys, Loc, Obs, F, const N: usize, const M: usize>(
        walk: &mut Walk<'_, Sys, Self, Loc, Obs, N>,
        flow: &F,
    ) -> Result<SegmentEnd, Error>
    where
        Sys: System<N>,
        Loc: Locator,
        Obs: Observer<Sys::Region, N>,
        F: Flow<f64, N, M>;

    /// The state at time `to` of the solution through `from`, in the same region.
    fn reach<F, const N: usize, const M: usize>(
        &self,
        progress: &Self::Progress,
        flow: &F,
        from: (f64, Vector<f64, N>),
        to: f64,
    ) -> Result<Vector<f64, N>, Stuck<N>>
    where
        F: Flow<f64, N, M>;
}

/// A scheme that moves by a one-step map, in steps of one size or of several.
pub trait Maps: Drive {
    /// The map.
    type Map: OneStep;

    /// The map.
    fn map(&self) -> &Self::Map;

    /// The size of the present steps, of which one may be a part.
    fn typical_step(&self, progress: &Self::Progress) -> f64;

    /// Notes that the walk has left the steps' ends, for a transition.
    fn leave(_progress: &mut Self::Progress) {}
}

impl<Sch: OneStep> Maps for Sch {
    type Map = Sch;

    fn map(&self) -> &Sch {
        self
    }

    fn typical_step(&self, progress: &Uniform) -> f64 {
        progress.grid.step_size
    }

    fn leave(progress: &mut Uniform) {
        progress.at_node = false;
    }
}

/// Refuses a tolerance that no step can have.
pub(super) fn check_tolerance(tolerance: f64) -> Result<(), Error> {
    if (f64::EPSILON..=0.1).contains(&tolerance) {
        return Ok(());
    }
    let requirement = "must lie between 2.2e-16 and 0.1";
    invalid("tolerance", number(tolerance), requirement)
}

/// A step that could not be made.
#[derive(Clone, Copy, Debug)]
pub struct Stuck<const N: usize> {
    /// Why.
    pub failure: StepFailure,
    /// Its start.
    pub t: f64,
    /// The state there.
    pub x: Vector<f64, N>,
    /// Its size.
    pub tau: f64,
}

/// The progress of uniform steps.
#[derive(Clone, Copy, Debug)]
pub struct Uniform {
    pub(crate) grid: Grid,
    /// The node of the grid that the next step ends at.
    pub(crate) node: u64,
    /// Whether the walk is at the node before, so that the next step is a full one.
    pub(crate) at_node: bool,
}

impl<Sch: OneStep> Drive for Sch {
    type Progress = Uniform;

    fn check(&self, t0: f64, t_end: f64) -> Result<(), Error> {
        let step_size = self.step_size();
        if !(step_size > 0.0 && step_size.is_finite()) {
            let requirement = "must be positive and finite";
            return invalid("step size", number(step_size), requirement);
        }
        let largest = t0.abs().max(t_end.abs());
        if t_end > t0 && largest.is_finite() && largest + step_size == largest {
            let requirement = "is below the rounding error of the time";
            return invalid("step size", number(step_size), requirement);
        }
        Ok(())
    }

    fn progress(&self, t0: f64, t_end: f64) -> Uniform {
        Uniform {
            grid: Grid::new(t0, t_end, self.step_size()),
            node: 1,
            at_node: true,
        }
    }

    fn segment<Sys, Loc, Obs, F, const N: usize, const M: usize>(
        walk: &mut Walk<'_, Sys, Self, Loc, Obs, N>,
        flow: &F,
    ) -> Result<SegmentEnd, Error>
    where
        Sys: System<N>,
        Loc: Locator,
        Obs: Observer<Sys::Region, N>,
        F: Flow<f64, N, M>,
    {
        walk.uniform_segment(flow)
    }

    fn reach<F, const N: usize, const M: usize>(
        &self,
        progress: &Uniform,
        flow: &F,
        (mut t, mut x): (f64, Vector<f64, N>),
        to: f64,
    ) -> Result<Vector<f64, N>, Stuck<N>>
    where
        F: Flow<f64, N, M>,
    {
        let grid = &progress.grid;
        let mut node = grid.node_after(t);
        while t < to {
            let end = grid.value(node).min(to);
            let tau = end - t;
            let step = Step {
                flow,
                t0: t,
                x0: &x,
                tau,
            };
            let increment = self
                .step(&step, &mut Statistics::default())
                .map_err(|failure| Stuck { failure, t, x, tau })?;
            x += increment;
            t = end;
            node += 1;
        }
        Ok(x)
    }
}
