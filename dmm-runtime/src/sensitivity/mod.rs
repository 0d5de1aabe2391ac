//! Sensitivities: the derivatives of a solution by its initial state and by the parameters.

mod directions;
mod step;
mod transition;

use nalgebra::{Const, DMatrix, DVector, Dyn, OMatrix};

use crate::arithmetic::{Matrix, Vector};
use crate::contract::System;
use crate::error::{Error, ErrorKind};
use crate::method::Method;
use crate::output::{Point, Solution};
use directions::Directions;
use transition::Behind;

/// The derivatives of a state by the initial state and by the parameters.
#[derive(Clone, PartialEq, Debug)]
pub struct Sensitivity<const N: usize> {
    /// ∂x/∂x₀, a row a component of x.
    pub by_initial: Matrix<f64, N, N>,
    /// ∂x/∂p, a column a parameter in the order of [`Metadata::parameters`](crate::Metadata::parameters).
    pub by_parameters: OMatrix<f64, Const<N>, Dyn>,
}

/// The derivatives of a transition: of its time, and of the states that it has, whose time changes as
/// well. For a periodic orbit that starts behind an event, `after.by_initial` is the derivative of
/// its return map.
#[derive(Clone, PartialEq, Debug)]
pub struct TransitionSensitivity<const N: usize> {
    /// t̂*
    pub t: f64,
    /// ∂t̂*/∂x₀
    pub time_by_initial: Vector<f64, N>,
    /// ∂t̂*/∂p
    pub time_by_parameters: DVector<f64>,
    /// Of the state in front of the transition, x̂*(t̂*).
    pub before: Sensitivity<N>,
    /// Of the state behind it.
    pub after: Sensitivity<N>,
}

/// The sensitivities along a solution.
#[derive(Clone, PartialEq, Debug)]
pub struct Sensitivities<const N: usize> {
    points: Vec<Sensitivity<N>>,
    transitions: Vec<TransitionSensitivity<N>>,
    /// What the point at an index starts with, where it is behind a transition.
    behind: Vec<(usize, Behind<N>)>,
}

impl<const N: usize> Sensitivities<N> {
    /// At each of [`Solution::points`], at the time of the point.
    pub fn points(&self) -> &[Sensitivity<N>] {
        &self.points
    }

    /// At the end; nothing for a solution without a point.
    pub fn last(&self) -> Option<&Sensitivity<N>> {
        self.points.last()
    }

    /// Of each of [`Solution::transitions`].
    pub fn transitions(&self) -> &[TransitionSensitivity<N>] {
        &self.transitions
    }
}

impl<Sys: System<N>, Met: Method, const N: usize> Solution<Sys, Met, N> {
    /// The derivatives of the solution by its initial state and by all parameters.
    ///
    /// They are those of the discrete steps, found by the same formulas over dual numbers: of a step
    /// that is solved for by its equation, of a transition by g(t̂*, x̂*) = 0, which gives
    ///
    /// dt̂* = −(∇g dx + dg)/ġ, dx(t⁺) = dx(t⁻) + (f⁻ − f⁺) dt̂*,
    ///
    /// with dg by the parameters alone (the saltation matrix; Nurkanović, Sperl, Albrecht & Diehl,
    /// Numer. Math. 156, 2024, eq. 24), where an event has its derivatives in between and a sliding
    /// motion is a field like any other. What is added to a state to keep the level of ψ is not
    /// derived: it is of the order of rounding errors, or of the tolerance.
    ///
    /// # Errors
    /// [`ErrorKind::NoDerivative`] where there is none: at a transition where ġ = 0, at one where
    /// several interfaces are met, or at the end time itself; and for a solution that does not keep
    /// every step.
    ///
    /// ```
    /// use dmm_runtime::{Best, Integrator, pws};
    ///
    /// pws! {
    ///     /// A ball that falls, and loses speed in the air below y = 0.
    ///     pub system Ball {
    ///         state y, v;
    ///         param k = 0.5;
    ///         interface surface = y;
    ///         der(y) = v;
    ///         region above where surface > 0 { der(v) = -1; }
    ///         region below where surface < 0 { der(v) = -1 - k * v; }
    ///     }
    /// }
    ///
    /// let solution = Integrator::new(&Ball::default(), Best::tolerance(1e-12))
    ///     .initial(0.0, [2.0, 0.0])
    ///     .run_until(3.0)?;
    /// let sensitivities = solution.sensitivities()?;
    /// // from y = h the ball is at the surface at t = √(2h)
    /// let surface = &sensitivities.transitions()[0];
    /// assert!((surface.time_by_initial[0] - 0.5).abs() < 1e-14);
    /// // v = −1/k + (1/k − 2) e^{−k}, one unit of time after it
    /// let end = sensitivities.last().ok_or("no point")?;
    /// let k: f64 = 0.5;
    /// let expected = 1.0 / (k * k) - ((1.0 / k - 2.0) + 1.0 / (k * k)) * (-k).exp();
    /// assert!((end.by_parameters[(1, 0)] - expected).abs() < 1e-13);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sensitivities(&self) -> Result<Sensitivities<N>, Error> {
        let points = self.points();
        let moves = points
            .windows(2)
            .filter(|pair| pair[0].time != pair[1].time);
        if points.is_empty() || moves.count() as u64 != self.statistics().steps {
            return Err(ErrorKind::NoDerivative {
                reason: "not every step of the solution is kept: run it without `every` and \
                         `output_times`",
            }
            .into());
        }
        let directions = Directions::new(self.system());
        let mut along = Sensitivities {
            points: Vec::with_capacity(points.len()),
            transitions: Vec::new(),
            behind: Vec::new(),
        };
        let mut transitions = self.transitions().iter().peekable();
        let mut present = Behind::start(directions.initial());
        along.points.push(split(&present.at_time));
        for (index, pair) in points.windows(2).enumerate() {
            let [from, to] = [&pair[0], &pair[1]];
            let met = transitions.next_if(|next| from.time == to.time && next.time == from.time);
            if let Some(met) = met {
                if self.last().is_some_and(|last| last.time == met.time) {
                    return Err(no_derivative(self, from, "a transition is at the end time"));
                }
                let last = index.checked_sub(1).map(|before| &points[before]);
                let earlier = last.filter(|last| last.time != from.time);
                let (behind, sensitivity) = directions.across(self, earlier, met, &present)?;
                along.transitions.push(sensitivity);
                along.behind.push((index + 1, behind.clone()));
                present = behind;
            } else if from.time != to.time {
                let matrix = directions.step(self, from, to.time, &present)?;
                present = Behind::start(matrix);
            }
            along.points.push(split(&present.at_time));
        }
        Ok(along)
    }

    /// The derivatives at any time of the solution, by a step from the point before it.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] if `t` was not integrated, [`ErrorKind::NoDerivative`] if a step has
    /// none.
    pub fn sensitivity_at(
        &self,
        t: f64,
        along: &Sensitivities<N>,
    ) -> Result<Sensitivity<N>, Error> {
        let points = self.points();
        let index = points.partition_point(|point| point.t <= t);
        let (Some(last), Some(index)) = (points.last(), index.checked_sub(1)) else {
            return Err(self.at(t).err().unwrap_or(ErrorKind::LeftDomain.into()));
        };
        if t > last.t {
            self.at(t)?;
        }
        let known = &along.points[index];
        if points[index].t == t {
            return Ok(known.clone());
        }
        let mut behind = along.behind.iter();
        let present = match behind.find(|(place, _)| *place == index) {
            Some((_, behind)) => behind.clone(),
            None => Behind::start(join(known)),
        };
        let directions = Directions::new(self.system());
        let time = crate::arithmetic::Time::new(t);
        let matrix = directions.step(self, &points[index], time, &present)?;
        Ok(split(&matrix))
    }
}

/// The error at a point.
#[cold]
fn no_derivative<Sys: System<N>, Met: Method, const N: usize>(
    solution: &Solution<Sys, Met, N>,
    point: &Point<Sys::Region, N>,
    reason: &'static str,
) -> Error {
    let region = solution.system().of_region(point.region).name;
    ErrorKind::NoDerivative { reason }.at(point.t, point.x.as_slice(), region)
}

/// The columns of all directions: first those of the initial state.
fn split<const N: usize>(all: &DMatrix<f64>) -> Sensitivity<N> {
    let parameters = all.ncols() - N;
    Sensitivity {
        by_initial: all.fixed_view::<N, N>(0, 0).into_owned(),
        by_parameters: OMatrix::<f64, Const<N>, Dyn>::from_fn(parameters, |i, j| all[(i, N + j)]),
    }
}

/// What [`split`] was given.
fn join<const N: usize>(parts: &Sensitivity<N>) -> DMatrix<f64> {
    let parameters = parts.by_parameters.ncols();
    DMatrix::from_fn(N, N + parameters, |i, j| match j.checked_sub(N) {
        None => parts.by_initial[(i, j)],
        Some(parameter) => parts.by_parameters[(i, parameter)],
    })
}
