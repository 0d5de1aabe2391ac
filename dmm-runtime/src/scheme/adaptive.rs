//! One-step schemes with steps that a tolerance decides.

use crate::error::{Error, StepFailure};
use crate::linear::is_finite;
use crate::observer::Observer;
use crate::scheme::drive::check_tolerance;
use crate::scheme::pace::Pacer;
use crate::scheme::{Composed, Drive, Maps, OneStep, Step, Stuck, Symmetric};
use crate::statistics::Statistics;
use crate::system::{Flow, System, Vector};
use crate::transition::Locator;
use crate::walk::{SegmentEnd, Walk};

/// A [`OneStep`] scheme with steps that a tolerance decides; made by
/// [`Symmetric::tolerance`](crate::Symmetric::tolerance) and
/// [`Composed::tolerance`](crate::Composed::tolerance).
///
/// A step from x is as long as the Taylor coefficients of the solution at x allow: over it the
/// first neglected one, relative to the largest size that each component has had, contributes
/// about the tolerance. They come from the recurrences of [`Taylor`](crate::Taylor). Steps are
/// rejected only where they cannot be made, or end where less than half of them is asked for.
///
/// ψ is conserved whatever the steps are. Errors of phase grow no faster than the time either,
/// without the steps being reversible: on Kepler orbits of eccentricity 0.9 (a thousand of them)
/// and in the Hénon–Heiles potential, the reversible control of Hairer & Söderlind (SIAM J. Sci.
/// Comput. 26, 2005), with the exact derivative of the same step size function, had the same
/// error for the same number of steps at order 2 and 4, and lost touch with the tolerance where
/// steps were long, at order 8.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Adaptive<Sch> {
    pub(super) scheme: Sch,
    pub(super) tolerance: f64,
}

/// The progress of steps of varying size.
#[derive(Clone, Debug)]
pub struct Progress {
    pub(crate) end: f64,
    /// The step that was last wanted.
    pub(crate) step: f64,
    /// The largest size of each component so far.
    pub(crate) sizes: Vec<f64>,
}

impl Adaptive<Symmetric> {
    /// See [`Symmetric::level_correction`].
    #[must_use]
    pub fn level_correction(self, level_correction: bool) -> Self {
        let scheme = self.scheme.level_correction(level_correction);
        Self { scheme, ..self }
    }
}

impl<const ORDER: usize> Adaptive<Composed<ORDER>> {
    /// See [`Composed::level_correction`].
    #[must_use]
    pub fn level_correction(self, level_correction: bool) -> Self {
        let scheme = self.scheme.level_correction(level_correction);
        Self { scheme, ..self }
    }
}

impl<Sch: OneStep> Adaptive<Sch> {
    /// What the tolerance asks for.
    pub(crate) fn pacer<const N: usize>(&self, progress: &Progress) -> Pacer<N> {
        Pacer::new(Sch::ORDER, self.tolerance, &progress.sizes)
    }

    /// The part of the radius of convergence that a step takes.
    pub(crate) fn fraction(&self) -> f64 {
        self.tolerance.powf(1.0 / (Sch::ORDER + 1) as f64)
    }
}

impl<Sch: OneStep> Maps for Adaptive<Sch> {
    type Map = Sch;

    fn map(&self) -> &Sch {
        &self.scheme
    }

    fn typical_step(&self, progress: &Progress) -> f64 {
        progress.step
    }
}

impl<Sch: OneStep> Drive for Adaptive<Sch> {
    type Progress = Progress;

    fn check(&self, _t0: f64, _t_end: f64) -> Result<(), Error> {
        check_tolerance(self.tolerance)
    }

    fn progress(&self, _t0: f64, t_end: f64) -> Progress {
        Progress {
            end: t_end,
            step: 0.0,
            sizes: Vec::new(),
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
        walk.adaptive_segment(flow)
    }

    fn reach<F, const N: usize, const M: usize>(
        &self,
        progress: &Progress,
        flow: &F,
        (mut t, mut x): (f64, Vector<f64, N>),
        to: f64,
    ) -> Result<Vector<f64, N>, Stuck<N>>
    where
        F: Flow<f64, N, M>,
    {
        let mut pacer = self.pacer(progress);
        let mut before = 0.0;
        while t < to {
            let wanted = 1.0 / pacer.expand(flow, t, &x, before).rate;
            let end = match t + wanted < to {
                true => t + wanted,
                // NaN too: the step then fails
                false => to,
            };
            let tau = end - t;
            let step = Step {
                flow,
                t0: t,
                x0: &x,
                tau,
            };
            let stuck = |failure| Stuck { failure, t, x, tau };
            let increment = self.scheme.step(&step, &mut Statistics::default());
            let increment = increment.map_err(stuck)?;
            if !(tau > 0.0 && is_finite(&increment)) {
                return Err(stuck(StepFailure::NotFinite));
            }
            x += increment;
            t = end;
            before = tau;
        }
        Ok(x)
    }
}
