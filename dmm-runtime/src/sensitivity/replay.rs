//! The steps and transitions of a solution, made again over scalars that carry derivatives.

use crate::arithmetic::{Derived, Scalar, Time, Vector, noise};
use crate::contract::{Dynamics, DynamicsVisitor, Guards, System};
use crate::driver::happening;
use crate::error::{Error, ErrorKind};
use crate::method::{Method, Variation};
use crate::output::{Point, Solution, Transition, TransitionKind};

/// Why there is no derivative where a formula has none.
pub(super) const NONE: &str = "the step has none";

/// A time and the state at it, over any scalar.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place<S, const N: usize> {
    pub(super) t: S,
    pub(super) x: Vector<S, N>,
}

impl<S: Scalar, const N: usize> Place<S, N> {
    /// A point whose numbers, the state and then the time, have derivatives.
    pub(super) fn of<R>(point: &Point<R, N>, number: impl Fn(f64, usize) -> S) -> Self {
        Self {
            x: Vector::from_fn(|i, _| number(point.x[i], i)),
            t: number(point.t, N),
        }
    }

    /// The state, then the time.
    pub(super) fn into_rows(self) -> impl Iterator<Item = S> {
        (0..=N).map(move |i| if i < N { self.x[i] } else { self.t })
    }
}

/// What leads from one point of a solution to a later one: a step, a transition, or a step that a
/// transition ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stage<'a, Region, const N: usize> {
    /// The index of the point that it starts at.
    pub(super) index: usize,
    pub(super) from: &'a Point<Region, N>,
    pub(super) end: Time,
    pub(super) met: Option<&'a Transition<Region, N>>,
}

impl<Region, const N: usize> Stage<'_, Region, N> {
    /// Whether it begins with a step.
    pub(super) fn moves(&self) -> bool {
        self.from.time != self.end
    }

    /// The index of the point that it leads to.
    pub(super) fn to(&self) -> usize {
        self.index + usize::from(self.moves()) + usize::from(self.met.is_some())
    }
}

/// The stages of a solution.
pub(super) struct Replay<'a, Sys: System<N>, Met: Method, const N: usize> {
    solution: &'a Solution<Sys, Met, N>,
    pub(super) stages: Vec<Stage<'a, Sys::Region, N>>,
}

impl<'a, Sys: System<N>, Met: Method, const N: usize> Replay<'a, Sys, Met, N> {
    /// Of a solution that keeps every step, and does not end at a transition.
    pub(super) fn new(solution: &'a Solution<Sys, Met, N>) -> Result<Self, Error> {
        let points = solution.points();
        let steps = points
            .windows(2)
            .filter(|pair| pair[0].time != pair[1].time);
        if points.is_empty() || steps.count() as u64 != solution.statistics().steps {
            return Err(ErrorKind::NoDerivative {
                reason: "not every step of the solution is kept: run it without `every` and \
                         `output_times`",
            }
            .into());
        }
        let mut transitions = solution.transitions().iter().peekable();
        let mut stages: Vec<Stage<'a, Sys::Region, N>> = Vec::with_capacity(points.len());
        for (index, pair) in points.windows(2).enumerate() {
            let [from, to] = [&pair[0], &pair[1]];
            let moves = from.time != to.time;
            let met = transitions.next_if(|next| !moves && next.time == to.time);
            match stages.last_mut() {
                Some(step) if met.is_some() && step.to() == index && step.met.is_none() => {
                    step.met = met;
                }
                _ if moves || met.is_some() => stages.push(Stage {
                    index,
                    from,
                    end: to.time,
                    met,
                }),
                _ => {}
            }
        }
        let replay = Self { solution, stages };
        match replay.stages.last().and_then(|last| last.met) {
            Some(met) => Err(replay.refuse_at(met, "a transition is at the end time")),
            None => Ok(replay),
        }
    }

    /// The parameters.
    pub(super) fn parameters(&self) -> Vec<f64> {
        self.solution.system().parameters()
    }

    /// The point that a stage leads to.
    pub(super) fn end(&self, stage: &Stage<'_, Sys::Region, N>) -> &'a Point<Sys::Region, N> {
        &self.solution.points()[stage.to()]
    }

    /// The state at a fixed time, by a step from a place at the time and the state of a point.
    pub(super) fn state_at<S: Scalar>(
        &self,
        point: &Point<Sys::Region, N>,
        place: &Place<S, N>,
        parameters: &[S],
        time: Time,
    ) -> Result<Vector<S, N>, Error> {
        let step = Step {
            method: self.solution.method(),
            place,
            // the place is at the time of the point, but for derivatives
            tau: S::from_f64(time.since(point.time)) - (place.t - S::from_f64(point.t)),
        };
        let system = self.solution.system();
        let state = system.visit_with(point.region, |index| parameters[index], step);
        let is_finite = |x: &Vector<S, N>| x.iter().all(|x| x.to_f64().is_finite());
        state
            .filter(is_finite)
            .ok_or_else(|| self.refuse(point, NONE))
    }

    /// The state at the end of a stage's step, at the time that it has in the solution.
    pub(super) fn step<S: Scalar>(
        &self,
        stage: &Stage<'_, Sys::Region, N>,
        place: &Place<S, N>,
        parameters: &[S],
    ) -> Result<Vector<S, N>, Error> {
        self.state_at(stage.from, place, parameters, stage.end)
    }

    /// The step of a stage to its transition: the places in front of it and behind it.
    pub(super) fn meet<S: Derived>(
        &self,
        stage: &Stage<'_, Sys::Region, N>,
        met: &Transition<Sys::Region, N>,
        place: &Place<S, N>,
        parameters: &[S],
    ) -> Result<[Place<S, N>; 2], Error> {
        let refuse = |reason| self.refuse_at(met, reason);
        let system = self.solution.system();
        if self.meets_several(met) {
            return Err(refuse("several interfaces are met at once"));
        }
        let mut before = *place;
        if stage.moves() {
            let constant = |index: usize| S::from_f64(parameters[index].to_f64());
            let values = Place::of(stage.from, |value, _| S::from_f64(value));
            let arrival = Arrival {
                method: self.solution.method(),
                guard: met.guard,
                place: &values,
                tau: stage.end.since(stage.from.time),
            };
            let rate = system.visit_with(met.from, constant, Rate(&arrival));
            let inverse = 1.0 / rate.ok_or_else(|| refuse(NONE))?;
            if !inverse.is_finite() {
                let reason = "the switching function is tangential to the solution";
                return Err(refuse(reason));
            }
            let arrival = Arrival { place, ..arrival };
            let located = Located {
                arrival,
                start: place.t - values.t,
                inverse,
            };
            before = system
                .visit_with(met.from, |index| parameters[index], located)
                .ok_or_else(|| refuse(NONE))?;
        }
        // the values are those of the solution
        before.t = before.t + S::from_f64(met.t - before.t.to_f64());
        for (x, value) in before.x.iter_mut().zip(&met.x) {
            *x += S::from_f64(value - x.to_f64());
        }
        let x = self.jumped(met, &before, parameters).map_err(refuse)?;
        let after = Place { t: before.t, x };
        Ok([before, after])
    }

    /// Whether another guard is zero where one is met.
    fn meets_several(&self, met: &Transition<Sys::Region, N>) -> bool {
        let Transition { t, x, guard, .. } = met;
        self.solution.system().visit(
            met.from,
            Others {
                guard: *guard,
                t: *t,
                x: *x,
            },
        )
    }

    /// The state behind the event of a transition.
    fn jumped<S: Scalar>(
        &self,
        met: &Transition<Sys::Region, N>,
        before: &Place<S, N>,
        parameters: &[S],
    ) -> Result<Vector<S, N>, &'static str> {
        let mut state = before.x;
        if met.kind != TransitionKind::Jumped {
            return Ok(state);
        }
        let system = self.solution.system();
        let on = (met.interface, met.rate_from);
        let mut events = 0;
        for event in happening(system, met.from, on, &[met.interface], met.t, &met.x) {
            let Place { t, x } = before;
            let jump = system.jump_with(met.from, event, *t, x, |index| parameters[index]);
            let Some((after, discrete)) = jump else {
                continue;
            };
            let is_constant = |value: &S| (*value - S::from_f64(value.to_f64())).is_zero();
            if !discrete.iter().all(is_constant) {
                return Err(
                    "a discrete state depends on the state or on a parameter: declare it as a \
                     state u with `der(u) = 0;`",
                );
            }
            events += 1;
            state = after;
        }
        if events > 1 {
            return Err("several events happen at once");
        }
        Ok(state)
    }

    /// The error at a transition.
    #[cold]
    fn refuse_at(&self, met: &Transition<Sys::Region, N>, reason: &'static str) -> Error {
        let region = self.solution.system().of_region(met.from).name;
        ErrorKind::NoDerivative { reason }.at(met.t, met.x.as_slice(), region)
    }

    /// The error at a point.
    #[cold]
    pub(super) fn refuse(&self, point: &Point<Sys::Region, N>, reason: &'static str) -> Error {
        let region = self.solution.system().of_region(point.region).name;
        ErrorKind::NoDerivative { reason }.at(point.t, point.x.as_slice(), region)
    }
}

/// A step from a place.
struct Step<'a, Met, S, const N: usize> {
    method: &'a Met,
    place: &'a Place<S, N>,
    tau: S,
}

impl<Met: Method, S: Scalar, const N: usize> Step<'_, Met, S, N> {
    /// The state at its end.
    fn end<D: Dynamics<S, N, M>, const M: usize>(&self, dynamics: &D) -> Option<Vector<S, N>> {
        let variation = Variation {
            dynamics,
            t0: self.place.t,
            x0: self.place.x,
            tau: self.tau,
        };
        let increment = self.method.differentiate::<D, S, N, M>(&variation)?;
        Some(variation.end(&increment))
    }
}

impl<Met: Method, S: Scalar, const N: usize> DynamicsVisitor<N, S> for Step<'_, Met, S, N> {
    type Output = Option<Vector<S, N>>;

    fn visit<const M: usize, D: Dynamics<S, N, M>>(self, dynamics: &D) -> Self::Output {
        self.end(dynamics)
    }
}

/// A step of size τ that leads to a guard.
struct Arrival<'a, Met, S, const N: usize> {
    method: &'a Met,
    guard: usize,
    place: &'a Place<S, N>,
    tau: f64,
}

impl<Met: Method, S: Scalar, const N: usize> Arrival<'_, Met, S, N> {
    /// Where a step of another size leads to, and g there.
    fn after<D: Dynamics<S, N, M>, const M: usize>(
        &self,
        dynamics: &D,
        tau: S,
    ) -> Option<(Place<S, N>, S)> {
        let step = Step {
            method: self.method,
            place: self.place,
            tau,
        };
        let end = Place {
            t: self.place.t + tau,
            x: step.end(dynamics)?,
        };
        let guards = dynamics.guards();
        Some((end, guards.switching_function(self.guard, end.t, &end.x)))
    }
}

/// dg/dτ of a step from a place and with parameters without derivatives.
struct Rate<'a, Met, S, const N: usize>(&'a Arrival<'a, Met, S, N>);

impl<Met: Method, S: Derived, const N: usize> DynamicsVisitor<N, S> for Rate<'_, Met, S, N> {
    type Output = Option<f64>;

    fn visit<const M: usize, D: Dynamics<S, N, M>>(self, dynamics: &D) -> Self::Output {
        S::derivative(self.0.tau, |tau| Some(self.0.after(dynamics, tau)?.1))
    }
}

/// The end of a step whose size has the derivatives that keep it on the guard.
struct Located<'a, Met, S, const N: usize> {
    arrival: Arrival<'a, Met, S, N>,
    /// The derivatives of the time that it starts at.
    start: S,
    /// 1 / (dg/dτ)
    inverse: f64,
}

impl<Met: Method, S: Scalar, const N: usize> DynamicsVisitor<N, S> for Located<'_, Met, S, N> {
    type Output = Option<Place<S, N>>;

    fn visit<const M: usize, D: Dynamics<S, N, M>>(self, dynamics: &D) -> Self::Output {
        let arrival = self.arrival;
        let mut tau = S::from_f64(arrival.tau) - self.start;
        // by Newton's method, like those of an implicit step
        for _ in 0..S::DERIVATIVES {
            let (_, g) = arrival.after(dynamics, tau)?;
            tau -= (g - S::from_f64(g.to_f64())) * S::from_f64(self.inverse);
        }
        Some(arrival.after(dynamics, tau)?.0)
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
