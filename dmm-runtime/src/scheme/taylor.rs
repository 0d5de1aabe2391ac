//! Taylor's method of high order, with conservation.

use crate::error::{Error, StepFailure};
use crate::events::ends::Decay;
use crate::level::Level;
use crate::linear::is_finite;
use crate::observer::Observer;
use crate::scheme::drive::check_tolerance;
use crate::scheme::{Drive, Stuck};
use crate::series::jet::Jet;
use crate::series::radius::OtherUnit;
use crate::series::{Choice, MOST_COEFFICIENTS, Rolled, Unroll};
use crate::state::State;
use crate::system::{Flow, System, Vector};
use crate::time::Time;
use crate::transition::Locator;
use crate::walk::{SegmentEnd, Walk};

/// Taylor's method
///
/// x₁ = P(τ) − Λᵀ(ΛΛᵀ)⁻¹ (ψ(x₁) − ψ_ref), P(τ) = Σ xₖ τᵏ,
///
/// of an order and with steps that a tolerance decides: the fast scheme, from three digits to
/// all that a double has. The coefficients come from recurrences that `pws!` derives from f.
///
/// A step is the part of the radius of convergence, estimated by the root test on the last two
/// coefficients, over which the first neglected term is below the tolerance relative to the
/// state (Jorba & Zou, Experimental Mathematics 14, 2005, sections 3.1–3.2). After each step,
/// and at each transition, the state is put back on the level of the conserved quantities.
/// Every zero of a switching function in a step is found, however slowly its own series
/// converges: see [the front page](crate#every-crossing).
///
/// ```
/// use dmm_runtime::{Integrator, Taylor, pws};
///
/// pws! {
///     /// A pendulum.
///     pub system Pendulum {
///         state q, p;
///         der(q) = p;
///         der(p) = -sin(q);
///         conserved energy = p^2 / 2 - cos(q);
///     }
/// }
///
/// let solution = Integrator::new(&Pendulum {}, Taylor::tolerance(1e-12))
///     .initial(0.0, [0.5, 1.0])
///     .run_until(100.0)?;
/// assert!(solution.statistics().steps < 200);
/// let x = solution.at(100.0)?;
/// assert!((x[1] * x[1] / 2.0 - x[0].cos() - (0.5 - 0.5f64.cos())).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Taylor {
    tolerance: f64,
    level_correction: bool,
}

impl Taylor {
    /// An error of at most about `tolerance` a step, relative to the size of the state: between
    /// 2⁻⁵² and 10⁻¹; the integrator refuses others.
    pub fn tolerance(tolerance: f64) -> Self {
        Self {
            tolerance,
            level_correction: true,
        }
    }

    /// Whether the state is put back on the level of the conserved quantities (default: yes).
    #[must_use]
    pub fn level_correction(self, level_correction: bool) -> Self {
        Self {
            level_correction,
            ..self
        }
    }

    pub(crate) fn corrects_level(&self) -> bool {
        self.level_correction
    }

    /// The order: where the cost of a unit of time is about least, of a few that straight-line
    /// code is compiled for.
    pub(crate) fn order(&self) -> usize {
        match self.tolerance {
            tolerance if tolerance >= 1e-7 => 12,
            tolerance if tolerance >= 2e-12 => 18,
            _ => 22,
        }
    }

    /// The part of g's terms that g may be off by along a step.
    pub(crate) fn undecided(&self) -> f64 {
        /// Errors of the state enter g by its gradient.
        const MARGIN: f64 = 8.0;
        MARGIN * self.tolerance
    }

    /// The part of a step whose error is below rounding.
    fn finest(&self) -> f64 {
        (f64::EPSILON / self.tolerance).powf(1.0 / self.order() as f64)
    }

    /// The part of the radius of convergence that a step takes.
    pub(crate) fn fraction(&self) -> f64 {
        self.fraction_at(self.order())
    }

    /// The same with steps of another order.
    pub(crate) fn fraction_at(&self, order: usize) -> f64 {
        self.tolerance.powf(1.0 / order as f64)
    }
}

/// The progress of steps of a scheme's own choice.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    pub(crate) end: f64,
    /// The part of the radius of convergence that a step takes.
    pub(crate) fraction: f64,
    /// The part of such a step whose error is below rounding.
    pub(crate) finest: f64,
    pub(crate) decay: Decay,
    /// The size of the step before, or 0.
    pub(crate) step: f64,
    /// The unit of time of the coefficients.
    pub(crate) unit: f64,
}

/// A segment with P coefficients.
struct Segment<'w, 'a, Sys: System<N>, Loc, Obs, F, const N: usize, const M: usize> {
    walk: &'w mut Walk<'a, Sys, Taylor, Loc, Obs, N>,
    flow: &'w F,
}

impl<Sys, Loc, Obs, F, const N: usize, const M: usize> Choice
    for Segment<'_, '_, Sys, Loc, Obs, F, N, M>
where
    Sys: System<N>,
    Loc: Locator,
    Obs: Observer<Sys::Region, N>,
    F: Flow<f64, N, M>,
{
    type Output = Result<SegmentEnd, Error>;

    fn with<const P: usize>(self) -> Self::Output {
        match self.walk.progress.unit == 1.0 {
            true => self.walk.expand::<P, M, F, F::Unrolled>(self.flow),
            false => self.walk.expand_in_units(self.flow),
        }
    }
}

/// Steps with P coefficients in one region.
struct Reach<'a, F, const N: usize, const M: usize> {
    scheme: &'a Taylor,
    flow: &'a F,
    from: (f64, Vector<f64, N>),
    to: f64,
    /// The unit of time of the coefficients.
    unit: f64,
}

impl<F: Flow<f64, N, M>, const N: usize, const M: usize> Choice for Reach<'_, F, N, M> {
    type Output = Result<Vector<f64, N>, Stuck<N>>;

    fn with<const P: usize>(self) -> Self::Output {
        match self.unit == 1.0 {
            true => self.run::<P, F::Unrolled>(),
            false => self.run::<MOST_COEFFICIENTS, Rolled>(),
        }
    }
}

impl<F: Flow<f64, N, M>, const N: usize, const M: usize> Reach<'_, F, N, M> {
    fn run<const P: usize, U: Unroll>(self) -> Result<Vector<f64, N>, Stuck<N>> {
        let Self {
            scheme,
            flow,
            from: (t0, x0),
            to,
            unit,
        } = self;
        let mut time = Time::new(t0);
        let mut state = State::new(x0);
        let level = Level::enter(flow, time, &state);
        let mut jet = Jet::<F, U, N, M, P>::new(scheme.order(), unit);
        let mut before = 0.0;
        while time.value < to {
            jet.expand(flow, time.value, &state.x);
            let wanted = match jet.step(flow, time.value, scheme.fraction(), before) {
                Ok(wanted) => wanted,
                Err(OtherUnit(unit)) => {
                    let from = (time.value, state.rounded());
                    let rest = Self { from, unit, ..self };
                    return rest.run::<MOST_COEFFICIENTS, Rolled>();
                }
            };
            let end = time.value + wanted;
            let next = Time::new(if end < to { end } else { to });
            let increment = jet.increment(next.since(time));
            if next.value <= time.value || !is_finite(&increment) {
                return Err(Stuck {
                    failure: StepFailure::NotFinite,
                    t: time.value,
                    x: state.x,
                    tau: wanted,
                });
            }
            let state_after = state.after(&increment);
            state = level.reached(flow, next, state_after, &increment, scheme.corrects_level());
            (time, before) = (next, wanted);
        }
        Ok(state.rounded())
    }
}

impl Drive for Taylor {
    type Progress = Progress;

    fn check(&self, _t0: f64, _t_end: f64) -> Result<(), Error> {
        check_tolerance(self.tolerance)
    }

    fn in_lanes(&self) -> Option<Taylor> {
        Some(*self)
    }

    fn progress(&self, _t0: f64, t_end: f64) -> Progress {
        Progress {
            end: t_end,
            fraction: self.fraction(),
            decay: Decay::new(self.fraction()),
            finest: self.finest(),
            step: 0.0,
            unit: 1.0,
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
        F::Unrolled::choose(
            walk.scheme.order(),
            Segment::<_, _, _, F, N, M> { walk, flow },
        )
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
        let reach = Reach::<F, N, M> {
            scheme: self,
            flow,
            from,
            to,
            unit: progress.unit,
        };
        F::Unrolled::choose(self.order(), reach)
    }
}
