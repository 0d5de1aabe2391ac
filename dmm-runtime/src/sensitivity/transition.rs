//! The derivatives across a transition.

use nalgebra::DMatrix;

use super::directions::{Directions, Number, number, state, store};
use super::{TransitionSensitivity, split};
use crate::arithmetic::{Scalar, Vector, noise};
use crate::contract::{Dynamics, DynamicsVisitor, Guards, System};
use crate::driver::happening;
use crate::error::{Error, ErrorKind};
use crate::method::Method;
use crate::output::{Point, Solution, Transition, TransitionKind};

/// The derivatives of a time, and of the state at it.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Behind<const N: usize> {
    /// ∂t, of a transition; empty for a time that is fixed.
    pub(super) time: Vec<f64>,
    /// Of the state at the time that changes.
    pub(super) state: DMatrix<f64>,
    /// Of the state at the fixed time.
    pub(super) at_time: DMatrix<f64>,
}

impl<const N: usize> Behind<N> {
    /// At a time that is fixed.
    pub(super) fn start(state: DMatrix<f64>) -> Self {
        Self {
            time: Vec::new(),
            at_time: state.clone(),
            state,
        }
    }
}

impl<Sys: System<N>, const N: usize> Directions<'_, Sys, N> {
    /// Behind a transition that the step from `earlier` led to.
    pub(super) fn across<Met: Method>(
        &self,
        solution: &Solution<Sys, Met, N>,
        earlier: Option<&Point<Sys::Region, N>>,
        met: &Transition<Sys::Region, N>,
        present: &Behind<N>,
    ) -> Result<(Behind<N>, TransitionSensitivity<N>), Error> {
        let refuse = |reason| {
            let region = self.system.of_region(met.from).name;
            ErrorKind::NoDerivative { reason }.at(met.t, met.x.as_slice(), region)
        };
        if self.meets_several(met) {
            return Err(refuse("several interfaces are met at once"));
        }
        let count = self.count();
        // where a run begins on the interface, its time is fixed
        let velocity = match earlier {
            Some(earlier) => self.velocity(solution, earlier, met.time),
            None => Some(Vector::zeros()),
        };
        let velocity = velocity.ok_or_else(|| refuse("the step has none"))?;
        let mut time = vec![0.0; count];
        let mut before = present.at_time.clone();
        if earlier.is_some() {
            let rate = self.rate(met, &velocity);
            for first in self.firsts() {
                let guard = Guard {
                    guard: met.guard,
                    t: met.t,
                    x: state(&met.x, &present.at_time, first),
                };
                let change = self.visit(met.from, first, guard);
                for k in 0..change.parts.len().min(count - first) {
                    time[first + k] = -change.parts[k] / rate;
                }
            }
            if !time.iter().all(|part| part.is_finite()) {
                return Err(refuse(
                    "the switching function is tangential to the solution",
                ));
            }
            for j in 0..count {
                for i in 0..N {
                    before[(i, j)] += velocity[i] * time[j];
                }
            }
        }
        let mut after = DMatrix::zeros(N, count);
        for first in self.firsts() {
            let x = state(&met.x, &before, first);
            let t = number(met.t, &time, first);
            let x = self.jumped(met, t, x, first).map_err(refuse)?;
            store(&mut after, first, &x);
        }
        let field = self.system.vector_field(met.to, met.t, &met.after);
        let at_time = DMatrix::from_fn(N, count, |i, j| after[(i, j)] - field[i] * time[j]);
        let sensitivity = TransitionSensitivity {
            t: met.t,
            time_by_initial: Vector::from_fn(|i, _| time[i]),
            time_by_parameters: time[N..].to_vec().into(),
            before: split(&before),
            after: split(&after),
        };
        let behind = Behind {
            time,
            state: after,
            at_time,
        };
        Ok((behind, sensitivity))
    }

    /// dg/dt along the map that led to a guard.
    fn rate(&self, met: &Transition<Sys::Region, N>, velocity: &Vector<f64, N>) -> f64 {
        let along = Along {
            guard: met.guard,
            t: met.t,
            x: Vector::from_fn(|i, _| number(met.x[i], &[velocity[i]], 0)),
        };
        self.visit(met.from, self.count(), along)
    }

    /// Whether another guard is zero where one is met.
    fn meets_several(&self, met: &Transition<Sys::Region, N>) -> bool {
        let Transition { t, x, guard, .. } = met;
        self.system.visit(
            met.from,
            Others {
                guard: *guard,
                t: *t,
                x: *x,
            },
        )
    }

    /// The state behind the event of a transition.
    fn jumped(
        &self,
        met: &Transition<Sys::Region, N>,
        t: Number,
        x: Vector<Number, N>,
        first: usize,
    ) -> Result<Vector<Number, N>, &'static str> {
        if met.kind != TransitionKind::Jumped {
            return Ok(x);
        }
        let parameter = |index| self.parameter(index, first);
        let on = (met.interface, met.rate_from);
        let mut state = x;
        let mut events = 0;
        for event in happening(self.system, met.from, on, &[met.interface], met.t, &met.x) {
            let jump = (self.system).jump_with(met.from, event, t, &x, parameter);
            let Some((after, discrete)) = jump else {
                continue;
            };
            let depends = |value: &Number| value.parts.iter().any(|part| *part != 0.0);
            if discrete.iter().any(depends) {
                return Err("a discrete state depends on the state or on a parameter");
            }
            events += 1;
            state = after;
        }
        if events > 1 {
            return Err("several events happen at once");
        }
        Ok(state)
    }
}

/// g over dual numbers.
struct Guard<const N: usize> {
    guard: usize,
    t: f64,
    x: Vector<Number, N>,
}

impl<const N: usize> DynamicsVisitor<N, Number> for Guard<N> {
    type Output = Number;

    fn visit<const M: usize, D: Dynamics<Number, N, M>>(self, dynamics: &D) -> Number {
        let guards = dynamics.guards();
        guards.switching_function(self.guard, Number::from_f64(self.t), &self.x)
    }
}

/// ∂ₜg + ∇g·v, of a state with the derivatives v.
struct Along<const N: usize> {
    guard: usize,
    t: f64,
    x: Vector<Number, N>,
}

impl<const N: usize> DynamicsVisitor<N, Number> for Along<N> {
    type Output = f64;

    fn visit<const M: usize, D: Dynamics<Number, N, M>>(self, dynamics: &D) -> f64 {
        let (guards, t) = (dynamics.guards(), number(self.t, &[1.0], 0));
        guards.switching_function(self.guard, t, &self.x).parts[0]
    }
}

/// Whether a guard other than one is zero.
struct Others<const N: usize> {
    guard: usize,
    t: f64,
    x: Vector<f64, N>,
}

impl<const N: usize> DynamicsVisitor<N> for Others<N> {
    type Output = bool;

    fn visit<const M: usize, D: Dynamics<f64, N, M>>(self, dynamics: &D) -> bool {
        let guards = dynamics.guards();
        let mut others = dynamics
            .sides()
            .iter()
            .filter(|(one, _)| *one != self.guard);
        others.any(|&(one, _)| {
            let value = guards.switching_function(one, self.t, &self.x);
            let size = guards.switching_size(one, self.t, &self.x);
            value.abs() <= noise(size)
        })
    }
}
