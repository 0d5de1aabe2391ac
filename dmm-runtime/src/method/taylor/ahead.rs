//! What a Taylor step meets: by the ends of the step, or a shorter one, where they tell enough; else
//! by all coefficients of g, or by enclosures of it.

use super::segment::{Here, Segment};
use crate::arithmetic::linear::{dot, is_finite};
use crate::arithmetic::{State, Time};
use crate::contract::{Dynamics, Guards};
use crate::events::cubic::Course;
use crate::events::ends::Ends;
use crate::events::{Enclosed, Met, Path, Root, Search, Series};
use crate::expansion::jet::Jet;
use crate::level::Found;
use crate::method::Sink;
use crate::series::Unroll;

/// What a step meets: nothing, if it meets no interface or cannot be made at all.
pub(super) type Ahead = Result<Option<Found>, Undecided>;

/// Why it is not decided what a step meets.
pub(super) enum Undecided {
    /// It comes so close to an interface that a shorter step has to decide.
    Shorter(Part),
    /// Whether this interface is met cannot be decided.
    Never(usize),
}

/// A part of the step that the tolerance allows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) share: f64,
    /// Whether the error of such a step is below rounding.
    is_finest: bool,
}

impl Part {
    pub(super) const WHOLE: Self = Self {
        share: 1.0,
        is_finest: false,
    };

    /// Half of it. The ends of a shorter step tell more, at less than the cost of all coefficients
    /// of g, until that has been tried in vain.
    #[inline(always)]
    fn half(self) -> Option<Self> {
        const SMALLEST: f64 = 0.25;
        let half = Self {
            share: 0.5 * self.share,
            ..self
        };
        (half.share >= SMALLEST && !self.is_finest).then_some(half)
    }
}

impl<S: Sink<N>, const N: usize> Segment<'_, S, N> {
    /// Whether a step starts on a guard, whose root there does not count.
    #[inline(always)]
    fn is_active(&self, here: Here<N>, guard: usize) -> bool {
        here.steps == 0 && self.cursor.active.contains(guard)
    }

    /// The first crossing of a step that ends at `state`, if there is one.
    #[inline(always)]
    pub(super) fn look_ahead<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &mut self,
        dynamics: &D,
        jet: &mut Jet<D, U, N, M, P>,
        here: Here<N>,
        (tau, time, state): (f64, Time, &State<N>),
        part: Part,
    ) -> Ahead {
        if <D::Guards as Guards<f64, N>>::MAY_LEAVE_STATE && !dynamics.guards().follows_state() {
            if !is_finite(&state.x) {
                return Ok(None);
            }
            let first = self.first_enclosed::<P, M, D, U>(dynamics, jet, here, tau, part)?;
            return Ok(first);
        }
        let field = dynamics.vector_field(time.value, &state.x);
        let ends = Ends {
            tau: jet.in_units(tau),
            decay: self.memory.decay,
        };
        let mut once: Option<Found> = None;
        let mut near = false;
        let series = jet.first_switching(dynamics, here.time.value);
        for &(guard, side) in dynamics.sides() {
            let c = &series.as_ref()[guard];
            let guards = dynamics.guards();
            let value = guards.switching_function(guard, time.value, &state.x);
            let (by_time, gradient) = guards.switching_gradient(guard, time.value, &state.x);
            let slope = (by_time + dot(&gradient, &field)) * jet.unit();
            let is_active = self.is_active(here, guard);
            match ends.course(c, (value, slope), side.sign(), is_active) {
                Course::Free => {}
                Course::Falls { from, at } => {
                    near |= once.is_some();
                    once = Some(Found {
                        guard,
                        sign: side.sign(),
                        elapsed: at * jet.unit(),
                        bracket: (from * jet.unit(), tau),
                        start: Some((c[0], jet.in_units(c[1]))),
                    });
                }
                Course::Unknown => near = true,
            }
        }
        if !near {
            return Ok(once);
        }
        if let Some(half) = part.half() {
            return Err(Undecided::Shorter(half));
        }
        if !is_finite(&state.x) {
            // the step cannot be made
            return Ok(None);
        }
        // between roots that are close g is smaller than the rounding errors of its series; what is returned
        // in memory is kept apart from what is returned in registers
        let first = if dynamics.guards().is_affine() {
            self.first::<P, M, D, U>(dynamics, jet, here, tau, part)?
        } else {
            self.first_enclosed::<P, M, D, U>(dynamics, jet, here, tau, part)?
        };
        Ok(first)
    }

    /// The first crossing of a step by all coefficients of every g, which is affine. What comes as
    /// close to an interface as the error of the step, and returns, is left undecided.
    #[cold]
    #[inline(never)]
    fn first<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &mut self,
        dynamics: &D,
        jet: &mut Jet<D, U, N, M, P>,
        here: Here<N>,
        tau: f64,
        part: Part,
    ) -> Ahead {
        let band = if part.is_finest {
            0.0
        } else {
            self.method.undecided()
        };
        let (t, x) = (here.time.value, &here.state.x);
        jet.expand_switching(dynamics, t);
        // in units, like the coefficients
        let tau = jet.in_units(tau);
        let mut first: Option<Found> = None;
        let mut horizon = tau;
        for &(guard, side) in dynamics.sides() {
            let sign = side.sign();
            let coefficients = jet.switching(guard).map(|c| sign * c);
            let size = dynamics.guards().switching_size(guard, t, x);
            let is_active = self.is_active(here, guard);
            let Some(series) = Series::new(coefficients, size, is_active, tau) else {
                return Err(Undecided::Never(guard));
            };
            if series.dips(horizon, band) {
                return Err(Undecided::Shorter(Part {
                    share: self.method.finest(),
                    is_finest: true,
                }));
            }
            let (found, touches) = series.first_root(horizon);
            self.sink.statistics().grazes += u64::from(touches);
            if let Some(Root { place, bracket }) = found {
                horizon = place;
                first = Some(Found {
                    guard,
                    sign,
                    elapsed: place * jet.unit(),
                    bracket: (bracket.0 * jet.unit(), bracket.1 * jet.unit()),
                    start: None,
                });
            }
        }
        Ok(first)
    }

    /// The first crossing of a step by enclosures of every g along the solution's polynomial: where
    /// its series may converge more slowly than that of the state, or the ends of the step do not
    /// tell enough.
    #[cold]
    #[inline(never)]
    fn first_enclosed<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &mut self,
        dynamics: &D,
        jet: &Jet<D, U, N, M, P>,
        here: Here<N>,
        tau: f64,
        part: Part,
    ) -> Ahead {
        let path = Path {
            t0: here.time.value,
            unit: jet.unit(),
            coefficients: std::array::from_fn(|i| &jet.coefficients()[i][..]),
        };
        let enclosed = Enclosed::new(dynamics.guards());
        let mut first: Option<Found> = None;
        let mut end = jet.in_units(tau);
        for &(guard, side) in dynamics.sides() {
            let search = Search {
                switching: &enclosed,
                interface: guard,
                sign: side.sign(),
                path: &path,
                end,
                level: 0.0,
            };
            let is_active = self.is_active(here, guard);
            let (met, touches) = if part.is_finest {
                search.first(is_active)
            } else {
                let guards = dynamics.guards();
                let size = |s: f64| guards.switching_size(guard, path.time(s), &path.state(s));
                let size = size(0.0).max(size(end));
                search.first_clear(is_active, self.method.undecided() * size)
            };
            match met {
                Met::Nothing => {}
                Met::Crossing { lower, upper } => {
                    end = search.root(lower, upper);
                    first = Some(Found {
                        guard,
                        sign: side.sign(),
                        elapsed: end * jet.unit(),
                        bracket: (lower * jet.unit(), upper * jet.unit()),
                        start: None,
                    });
                }
                Met::Undecided(_) if part.is_finest => return Err(Undecided::Never(guard)),
                Met::Undecided(_) => {
                    return Err(Undecided::Shorter(Part {
                        share: self.method.finest(),
                        is_finest: true,
                    }));
                }
            }
            self.sink.statistics().grazes += u64::from(touches);
        }
        Ok(first)
    }
}
