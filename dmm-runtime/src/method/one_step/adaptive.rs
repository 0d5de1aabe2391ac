//! Steps that a tolerance decides.

use super::crossing::{Locator, NewtonLocator};
use super::map::OneStep;
use super::search::{Dense, watches};
use super::segment::Segment;
use super::step_sizes::{Carried, Made, Output, StepSizes, shorten};
use super::taylor_coefficients::TaylorCoefficients;
use crate::arithmetic::{Scalar, Time};
use crate::contract::{Dynamics, Vector};
use crate::error::Error;
use crate::events::Path;
use crate::events::ends::Decay;
use crate::level::Level;
use crate::method::{Cursor, Ended, Failure, Method, Sink, Variation, check_tolerance};

/// A [`OneStep`] scheme with steps that a tolerance decides; made by
/// [`Symmetric::tolerance`](crate::Symmetric::tolerance),
/// [`Composed::tolerance`](crate::Composed::tolerance) and
/// [`EmbeddedRungeKutta::tolerance`](crate::EmbeddedRungeKutta::tolerance).
///
/// There are two ways to decide on a step. By an [`ErrorEstimate`](crate::ErrorEstimate) it is as
/// long as the estimate of the error of the step before allows, and rejected if its own is too large.
/// By [`TaylorCoefficients`] (default), which are there for every scheme, a step from x is as long as
/// those of the solution at x allow: over it the first neglected one, relative to the largest size
/// that each component has had, contributes about the tolerance. They come from the recurrences of
/// [`Taylor`](crate::Taylor), up to order 9. Steps are rejected only where they cannot be made, or end
/// where less than half of them is asked for.
///
/// ψ is conserved whatever the steps are. Errors of phase grow no faster than the time either,
/// without the steps being reversible: on Kepler orbits of eccentricity 0.9 (a thousand of them)
/// and in the Hénon–Heiles potential, the reversible control of Hairer & Söderlind (SIAM J. Sci.
/// Comput. 26, 2005), with the exact derivative of the same step size function, had the same
/// error for the same number of steps at order 2 and 4, and lost touch with the tolerance where
/// steps were long, at order 8.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Adaptive<Map, Loc = NewtonLocator, Sizes = TaylorCoefficients> {
    map: Map,
    tolerance: f64,
    level_correction: bool,
    locator: Loc,
    sizes: Sizes,
}

impl<Map: OneStep> Adaptive<Map> {
    /// Each step leaves an error of about `tolerance` relative to the size of the state. Between
    /// 2.2·10⁻¹⁶ and 0.1; the integrator refuses others.
    pub fn new(map: Map, tolerance: f64) -> Self {
        Self::by(map, tolerance)
    }
}

impl<Map, Sizes: Default> Adaptive<Map, NewtonLocator, Sizes> {
    pub(super) fn by(map: Map, tolerance: f64) -> Self {
        Self {
            map,
            tolerance,
            level_correction: true,
            locator: NewtonLocator,
            sizes: Sizes::default(),
        }
    }
}

impl<Map, Loc, Sizes> Adaptive<Map, Loc, Sizes> {
    /// Whether the rounding errors of ψ are corrected towards the level at the entry into the
    /// region (default: yes).
    #[must_use]
    pub fn level_correction(self, level_correction: bool) -> Self {
        Self {
            level_correction,
            ..self
        }
    }

    /// Replaces the locator of crossings (default: [`NewtonLocator`]).
    #[must_use]
    pub fn locator<Other: Locator>(self, locator: Other) -> Adaptive<Map, Other, Sizes> {
        Adaptive {
            map: self.map,
            tolerance: self.tolerance,
            level_correction: self.level_correction,
            locator,
            sizes: self.sizes,
        }
    }
}

/// What steps of varying size carry from segment to segment.
#[derive(Clone, Debug)]
pub struct Memory<R, const N: usize> {
    carried: Carried<N>,
    /// Of a segment that was stopped between two steps.
    stopped: Option<R>,
}

impl<Map: OneStep, Loc: Locator, Sizes: StepSizes<Map>> Method for Adaptive<Map, Loc, Sizes> {
    type Memory<const N: usize> = Memory<Sizes::Run<N>, N>;

    fn check(&self, _t0: f64, _t_end: f64) -> Result<(), Error> {
        check_tolerance(self.tolerance)
    }

    fn memory<const N: usize>(&self, _t0: f64, _t_end: f64) -> Self::Memory<N> {
        Memory {
            carried: Carried {
                step: 0.0,
                sizes: Vector::zeros(),
            },
            stopped: None,
        }
    }

    fn segment<D, S, const N: usize, const M: usize>(
        &self,
        dynamics: &D,
        cursor: &mut Cursor<N>,
        until: f64,
        memory: &mut Self::Memory<N>,
        sink: &mut S,
    ) -> Result<Ended, Failure>
    where
        D: Dynamics<f64, N, M>,
        S: Sink<N>,
    {
        let Cursor { time, state, .. } = cursor;
        let mut level = Level::enter(dynamics, *time, state, cursor.level.as_deref());
        let mut watches = watches(dynamics, time.value, &state.x, &cursor.active);
        let until = Time::new(until);
        let by = (&self.map, self.tolerance);
        let stopped = memory.stopped.take().filter(|_| cursor.level.is_some());
        let mut run = stopped
            .unwrap_or_else(|| Sizes::begin(by, dynamics, (time.value, &state.x), &memory.carried));
        let decay = Decay::new(Sizes::decay(&self.map, self.tolerance));
        let mut segment = Segment {
            map: &self.map,
            locator: &self.locator,
            corrects_level: self.level_correction,
            cursor,
            sink: &mut sink.erased(),
        };
        while until.since(segment.cursor.time) > 0.0 {
            let from = (segment.cursor.time, &segment.cursor.state, until);
            let statistics = segment.sink.statistics();
            let made =
                shorten::<Map, Sizes, D, N, M>(&self.map, &mut run, dynamics, from, statistics)?;
            let Made {
                increment,
                tau,
                time,
                known,
            } = made;
            memory.carried.step = tau;
            memory.carried.sizes.copy_from_slice(Sizes::sizes(&run));
            if !watches.as_ref().is_empty() {
                let step = (&segment.cursor.state.x, &increment, tau);
                let Output { unit, coefficients } = Sizes::dense(&self.map, &run, &known, step);
                let dense = Dense {
                    path: Path {
                        t0: segment.cursor.time.value,
                        unit,
                        coefficients: std::array::from_fn(|i| &coefficients[i][..]),
                    },
                    tau,
                    decay,
                };
                if let Some(end) = segment.look(dynamics, &level, &watches, &dense, tau)? {
                    return Ok(end);
                }
            }
            level.rescale(dynamics, time.value, &segment.cursor.state);
            let end = (tau, time);
            let stops = segment.conclude(dynamics, &level, &mut watches, &increment, end)?;
            Sizes::advance(&mut run, known);
            if stops {
                segment.keep(dynamics, &level, &watches);
                memory.stopped = Some(run);
                return Ok(Ended::Stopped);
            }
        }
        Ok(Ended::Finished)
    }

    fn reach<D, const N: usize, const M: usize>(
        &self,
        memory: &Self::Memory<N>,
        dynamics: &D,
        cursor: &mut Cursor<N>,
        to: f64,
    ) -> Result<(), Failure>
    where
        D: Dynamics<f64, N, M>,
    {
        let by = (&self.map, self.tolerance);
        Sizes::reach(by, &memory.carried, dynamics, cursor, to)
    }

    fn differentiate<D, S, const N: usize, const M: usize>(
        &self,
        step: &Variation<'_, D, S, N>,
    ) -> Option<Vector<S, N>>
    where
        D: Dynamics<S, N, M>,
        S: Scalar,
    {
        self.map.differentiate::<D, S, N, M>(step)
    }
}
