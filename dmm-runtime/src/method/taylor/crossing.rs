//! The point where a Taylor step meets a guard: see [`GuardPoint`].

use super::segment::{Here, Segment};
use crate::arithmetic::linear::is_finite;
use crate::arithmetic::{State, Time};
use crate::contract::{Dynamics, Guards, Vector};
use crate::expansion::jet::Jet;
use crate::level::{Found, GuardPoint, Level};
use crate::method::{Ended, Failure, Sink};
use crate::series::Unroll;

impl<S: Sink<N>, const N: usize> Segment<'_, S, N> {
    /// Moves to the guard.
    #[inline(never)]
    pub(super) fn go_to_guard<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &mut self,
        dynamics: &D,
        level: &Level<N, M>,
        jet: &Jet<D, U, N, M, P>,
        found: &Found,
        tau: f64,
    ) -> Result<Ended, Failure> {
        let guard = found.guard;
        let located = self
            .locate::<P, M, D, U>(dynamics, level, jet, found, tau)
            .or_else(|| self.about_condition::<P, M, D, U>(dynamics, jet, found));
        let Some((time, state, rate)) = located else {
            return Err(Failure::not_located(guard, tau));
        };
        let elapsed = time.since(self.cursor.time).clamp(0.0, tau);
        let here = Here::of(self);
        if self.sink.next_output().is_some() {
            self.outputs_along::<P, M, D, U>(dynamics, level, jet, &here, (elapsed, time));
        }
        self.cursor.state = state;
        self.cursor.time = time;
        self.sink.statistics().steps += 1;
        self.memory.step = tau;
        Ok(Ended::AtGuard { guard, rate })
    }

    /// About where the solution comes to the condition of a proof, on which f may have no value;
    /// nothing for an interface.
    #[cold]
    fn about_condition<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &self,
        dynamics: &D,
        jet: &Jet<D, U, N, M, P>,
        found: &Found,
    ) -> Option<(Time, State<N>, f64)> {
        if !dynamics.guards().is_condition(found.guard) {
            return None;
        }
        let state = self
            .cursor
            .state
            .after(&jet.increment(found.elapsed))
            .normalised();
        let time = self.cursor.time.after(found.elapsed);
        is_finite(&state.x).then_some((time, state, f64::NAN))
    }

    /// t̂*, x̂* and dg/dt there.
    #[inline(always)]
    fn locate<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &self,
        dynamics: &D,
        level: &Level<N, M>,
        jet: &Jet<D, U, N, M, P>,
        found: &Found,
        tau: f64,
    ) -> Option<(Time, State<N>, f64)> {
        let start = (self.cursor.time, &self.cursor.state);
        let increment = |elapsed| jet.increment(elapsed);
        let near = match GuardPoint::nearest(dynamics, found, start, tau, increment) {
            Some(near) => near,
            None => self.in_bracket::<P, M, D, U>(dynamics, jet, found, tau)?,
        };
        // beyond a condition ψ may have another value
        let corrects = self.method.corrects_level() && !dynamics.guards().is_condition(found.guard);
        let increment = near.state.x - self.cursor.state.x;
        let how = (corrects, true);
        let (there, settled) = near.settled(dynamics, level, found.guard, &increment, how);
        if settled {
            return Some((there.time, there.state, there.rate));
        }
        corrects
            .then(|| Self::settle_uncorrected(dynamics, level, found.guard, (&near, &increment)))?
    }

    /// Close to the crossing, within its bracket.
    #[cold]
    #[inline(never)]
    fn in_bracket<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &self,
        dynamics: &D,
        jet: &Jet<D, U, N, M, P>,
        found: &Found,
        tau: f64,
    ) -> Option<GuardPoint<N>> {
        let start = (self.cursor.time, &self.cursor.state);
        let increment = |elapsed| jet.increment(elapsed);
        let (near, located) = GuardPoint::near(dynamics, found, start, tau, increment, true);
        located.then_some(near)
    }

    /// The same without a correction of the level, where ψ has no gradient: at a root that is zero
    /// on the guard.
    #[cold]
    #[inline(never)]
    fn settle_uncorrected<const M: usize, D: Dynamics<f64, N, M>>(
        dynamics: &D,
        level: &Level<N, M>,
        guard: usize,
        (near, increment): (&GuardPoint<N>, &Vector<f64, N>),
    ) -> Option<(Time, State<N>, f64)> {
        let how = (false, true);
        let (there, settled) = near.settled(dynamics, level, guard, increment, how);
        settled.then_some((there.time, there.state, there.rate))
    }
}
