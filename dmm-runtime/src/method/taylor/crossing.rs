//! The point where a Taylor step meets a guard: see [`GuardPoint`].

use super::segment::{Here, Segment};
use crate::arithmetic::linear::is_finite;
use crate::contract::{Dynamics, Guards};
use crate::expansion::jet::Jet;
use crate::level::{Found, GuardPoint, Level, OnGuard};
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
        here: Here<N>,
        found: &Found,
        tau: f64,
    ) -> Result<Ended, Failure> {
        let along = |elapsed| jet.after(&here.state, elapsed);
        if let Some((time, state)) = GuardPoint::nearest(dynamics, found, here.time, tau, along) {
            let increment = state.x - here.state.x;
            let how = (self.corrects(dynamics, found), true);
            let near = (time, &state);
            let (there, is_there) =
                GuardPoint::settled(near, dynamics, level, found.guard, &increment, how);
            if is_there {
                return Ok(self.end_on::<P, M, D, U>(
                    dynamics,
                    level,
                    jet,
                    here,
                    (found, tau),
                    there,
                ));
            }
        }
        let there = self
            .locate::<P, M, D, U>(dynamics, level, jet, here, found, tau)
            .or_else(|| self.about_condition::<P, M, D, U>(dynamics, jet, here, found))
            .ok_or(Failure::not_located(found.guard, tau))?;
        Ok(self.end_on::<P, M, D, U>(dynamics, level, jet, here, (found, tau), there))
    }

    /// Whether the level is corrected on the guard: beyond a condition ψ may have another value.
    #[inline(always)]
    fn corrects<const M: usize, D: Dynamics<f64, N, M>>(
        &self,
        dynamics: &D,
        found: &Found,
    ) -> bool {
        self.method.corrects_level() && !dynamics.guards().is_condition(found.guard)
    }

    /// Ends the segment on the guard.
    #[inline(always)]
    fn end_on<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &mut self,
        dynamics: &D,
        level: &Level<N, M>,
        jet: &Jet<D, U, N, M, P>,
        here: Here<N>,
        (found, tau): (&Found, f64),
        OnGuard { time, state, rate }: OnGuard<N>,
    ) -> Ended {
        if self.sink.next_output().is_some() {
            let elapsed = time.since(here.time).clamp(0.0, tau);
            self.outputs_along::<P, M, D, U>(dynamics, *level, jet, here, (elapsed, time));
        }
        self.cursor.state = state.by_numbers();
        self.cursor.time = time;
        self.sink.statistics().steps += 1;
        self.memory.step = tau;
        self.memory.free = 0.0;
        Ended::AtGuard {
            guard: found.guard,
            rate,
        }
    }

    /// The point on the guard by its bracket, where Halley's method leaves it; without a correction
    /// of the level where ψ has no gradient, at a root that is zero on the guard.
    #[cold]
    #[inline(never)]
    fn locate<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &self,
        dynamics: &D,
        level: &Level<N, M>,
        jet: &Jet<D, U, N, M, P>,
        here: Here<N>,
        found: &Found,
        tau: f64,
    ) -> Option<OnGuard<N>> {
        let along = |elapsed| jet.after(&here.state, elapsed);
        let ((time, state), located) =
            GuardPoint::near(dynamics, found, here.time, tau, along, true);
        let increment = state.x - here.state.x;
        let settled = |corrects: bool| {
            let how = (corrects, true);
            let near = (time, &state);
            let (there, settled) =
                GuardPoint::settled(near, dynamics, level, found.guard, &increment, how);
            settled.then_some(there)
        };
        let corrects = located && self.corrects(dynamics, found);
        let corrected = corrects.then(|| settled(true)).flatten();
        corrected.or_else(|| located.then(|| settled(false)).flatten())
    }

    /// About where the solution comes to the condition of a proof, on which f may have no value;
    /// nothing for an interface.
    #[cold]
    fn about_condition<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &self,
        dynamics: &D,
        jet: &Jet<D, U, N, M, P>,
        here: Here<N>,
        found: &Found,
    ) -> Option<OnGuard<N>> {
        if !dynamics.guards().is_condition(found.guard) {
            return None;
        }
        let state = jet.after(&here.state, found.elapsed);
        let time = here.time.after(found.elapsed);
        let rate = f64::NAN;
        is_finite(&state.x).then_some(OnGuard { time, state, rate })
    }
}
