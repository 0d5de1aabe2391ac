//! The best that a system allows, region by region.

use crate::error::{Error, StepFailure};
use crate::exact::{Ladder, Ladders, is_exact};
use crate::linear::is_finite;
use crate::observer::Observer;
use crate::scheme::taylor::{self, Taylor};
use crate::scheme::{Drive, Stuck};
use crate::state::State;
use crate::system::{Flow, System, Vector};
use crate::transition::Locator;
use crate::walk::{SegmentEnd, Walk};

/// The best scheme for each region of a system: its exact flow where it has one, [`Taylor`]'s
/// method elsewhere.
///
/// | region | scheme |
/// |---|---|
/// | f = A x + b with A and b depending on parameters alone, at most 8 states, every switching function that bounds the region affine | exact flow |
/// | any other | [`Taylor`] with the tolerance |
///
/// The **exact flow** of ẋ = A x + b over a time h is
///
/// x₁ = exp(hA) x₀ + ∫₀ʰ exp(sA) b ds,
///
/// computed in pairs of doubles once a run and step size: there is no truncation error, whatever
/// the tolerance. A singular or defective A is like any other (Moler & Van Loan, SIAM Review 45,
/// 2003). Steps are as long as the switching functions allow. Every crossing is found: it is
/// excluded by a bound of g⁗ along the step, or located on the flow, to the last bit of a pair of
/// doubles. A stiff region takes short steps only while its fast modes decay. Between crossings
/// there may be few points; ask for output times to see the solution there. Rates ‖A‖ may lie
/// between 10⁻¹⁸ and 10¹⁸ in the unit of time; the powers of others leave the range of doubles, and
/// their crossings are refused.
///
/// Regions of both kinds may be in one system. A crossing changes the scheme, no more.
///
/// ```
/// use dmm_runtime::{Best, Integrator, pws};
///
/// pws! {
///     /// An oscillator whose spring stiffens below y = 0.
///     pub system Oscillator {
///         state x, y;
///         interface spring = y;
///         region above where spring > 0 {
///             der(x) = y;
///             der(y) = -x;
///             conserved energy = (y^2 + x^2) / 2;
///         }
///         region below where spring < 0 {
///             der(x) = y;
///             der(y) = -4 * x;
///             conserved energy = (y^2 + 4 * x^2) / 2;
///         }
///     }
/// }
///
/// let solution = Integrator::new(&Oscillator {}, Best::tolerance(1e-12))
///     .initial(0.0, [0.0, 1.0])
///     .run_until(1000.0)?;
/// // half a circle above, half an ellipse below: a period of π + π/2
/// let crossings = solution.transitions();
/// assert_eq!(crossings.len(), 424);
/// let last = 211.5 * 1.5 * std::f64::consts::PI + 0.25 * std::f64::consts::PI;
/// assert!((crossings[423].t - last).abs() < 1e-11, "{}", crossings[423].t);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Best {
    taylor: Taylor,
}

impl Best {
    /// An error of at most about `tolerance` a step, relative to the size of the state, where a
    /// region has no exact flow: between 2⁻⁵² and 10⁻¹; the integrator refuses others.
    pub fn tolerance(tolerance: f64) -> Self {
        Self {
            taylor: Taylor::tolerance(tolerance),
        }
    }

    /// Whether the state is put back on the level of the conserved quantities (default: yes).
    #[must_use]
    pub fn level_correction(self, level_correction: bool) -> Self {
        Self {
            taylor: self.taylor.level_correction(level_correction),
        }
    }

    pub(crate) fn corrects_level(&self) -> bool {
        self.taylor.corrects_level()
    }
}

/// The progress of steps of either kind.
#[derive(Clone, Debug)]
pub struct Progress {
    /// That of Taylor steps.
    pub(crate) series: taylor::Progress,
    /// What exact flows have computed.
    pub(crate) ladders: Ladders,
}

impl Drive for Best {
    type Progress = Progress;

    fn check(&self, t0: f64, t_end: f64) -> Result<(), Error> {
        self.taylor.check(t0, t_end)
    }

    fn progress(&self, t0: f64, t_end: f64) -> Progress {
        Progress {
            series: self.taylor.progress(t0, t_end),
            ladders: Ladders::default(),
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
        if const { is_exact::<F, N, M>() } {
            walk.march(flow)
        } else {
            by_series(walk, flow)
        }
    }

    fn reach<F, const N: usize, const M: usize>(
        &self,
        progress: &Progress,
        flow: &F,
        from: (f64, Vector<f64, N>),
        to: f64,
    ) -> Result<Vector<f64, N>, Stuck<N>>
    where
        F: Flow<f64, N, M>,
    {
        if const { !is_exact::<F, N, M>() } {
            return self.taylor.reach(&progress.series, flow, from, to);
        }
        let (t, x) = from;
        let tau = to - t;
        if tau <= 0.0 {
            return Ok(x);
        }
        let ladder = Ladder::new(flow, tau);
        let reached = ladder.map(|mut ladder| ladder.reach(&State::new(x), tau).rounded());
        let failure = StepFailure::NotFinite;
        reached
            .filter(is_finite)
            .ok_or(Stuck { failure, t, x, tau })
    }
}

/// A segment by Taylor's method.
fn by_series<Sys, Loc, Obs, F, const N: usize, const M: usize>(
    walk: &mut Walk<'_, Sys, Best, Loc, Obs, N>,
    flow: &F,
) -> Result<SegmentEnd, Error>
where
    Sys: System<N>,
    Loc: Locator,
    Obs: Observer<Sys::Region, N>,
    F: Flow<f64, N, M>,
{
    let mut series = Walk {
        system: walk.system,
        scheme: &walk.scheme.taylor,
        locator: walk.locator,
        observer: &mut *walk.observer,
        progress: walk.progress.series,
        time: walk.time,
        state: walk.state,
        region: walk.region,
        fresh: walk.fresh,
        statistics: walk.statistics,
    };
    let end = Taylor::segment(&mut series, flow);
    walk.progress.series = series.progress;
    walk.time = series.time;
    walk.state = series.state;
    walk.statistics = series.statistics;
    end
}
