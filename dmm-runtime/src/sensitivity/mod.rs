//! Sensitivities: the derivatives of a solution by its initial state and by the parameters.

mod adjoint;
mod forward;
mod replay;

use nalgebra::{Const, DMatrix, DVector, Dyn, OMatrix};

pub use adjoint::{Functional, Gradient};

use crate::arithmetic::{Matrix, Time, Vector};
use crate::contract::System;
use crate::error::{Error, ErrorKind};
use crate::method::Method;
use crate::output::Solution;
use forward::{Carried, Collector, Derivatives, First, Forward, Second};
use replay::Replay;

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
    behind: Vec<(usize, Derivatives)>,
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

/// Second derivatives of a state: of each component a symmetric matrix, whose rows and columns are the
/// components of the initial state, then the parameters.
pub type Hessians<const N: usize> = [DMatrix<f64>; N];

/// The second derivatives of a transition; see [`TransitionSensitivity`] and [`Hessians`].
#[derive(Clone, PartialEq, Debug)]
pub struct TransitionHessians<const N: usize> {
    /// t̂*
    pub t: f64,
    /// Of t̂*.
    pub time: DMatrix<f64>,
    /// Of the state in front of the transition.
    pub before: Hessians<N>,
    /// Of the state behind it.
    pub after: Hessians<N>,
}

/// The first and second derivatives along a solution.
#[derive(Clone, PartialEq, Debug)]
pub struct SecondSensitivities<const N: usize> {
    first: Sensitivities<N>,
    points: Vec<Hessians<N>>,
    transitions: Vec<TransitionHessians<N>>,
}

impl<const N: usize> SecondSensitivities<N> {
    /// The first derivatives.
    pub fn first(&self) -> &Sensitivities<N> {
        &self.first
    }

    /// At each of [`Solution::points`], at the time of the point.
    pub fn points(&self) -> &[Hessians<N>] {
        &self.points
    }

    /// At the end; nothing for a solution without a point.
    pub fn last(&self) -> Option<&Hessians<N>> {
        self.points.last()
    }

    /// Of each of [`Solution::transitions`].
    pub fn transitions(&self) -> &[TransitionHessians<N>] {
        &self.transitions
    }
}

impl<Sys: System<N>, Met: Method, const N: usize> Solution<Sys, Met, N> {
    /// The derivatives of the solution by its initial state and by all parameters.
    ///
    /// They are those of the discrete steps, found by the same formulas over dual numbers: of a step
    /// that is solved for by its equation, of a transition by g(t̂*, x̂*) = 0, to which a step is that
    /// has t̂* for its end. At a fixed time behind it that is, of exact steps,
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
        let mut along = Sensitivities::default();
        self.forward::<First>(&mut along)?;
        Ok(along)
    }

    /// The first and second derivatives of the solution by its initial state and by all parameters,
    /// of the discrete steps like [`Solution::sensitivities`]. A transition ends a part of a step, whose
    /// size changes with the initial state: behind it the second derivatives of a scheme of order p
    /// with uniform steps are of order p − 1.
    ///
    /// # Errors
    /// Those of [`Solution::sensitivities`].
    ///
    /// ```
    /// use dmm_runtime::{Best, Integrator, pws};
    ///
    /// pws! {
    ///     /// Growth until a threshold, and decay beyond it.
    ///     pub system Growth {
    ///         state x;
    ///         param k = 0.5;
    ///         interface threshold = x - 2;
    ///         region growing where threshold < 0 { der(x) = k * x; }
    ///         region beyond where threshold > 0 { der(x) = x; }
    ///     }
    /// }
    ///
    /// let solution = Integrator::new(&Growth::default(), Best::tolerance(1e-14))
    ///     .initial(0.0, [1.0])
    ///     .run_until(2.0)?;
    /// let second = solution.second_sensitivities()?;
    /// // t̂* = ln(2/x₀)/k and x(t) = 2 e^{t − t̂*}
    /// let ln2 = 2.0_f64.ln();
    /// let (time, k) = (&second.transitions()[0].time, 0.5);
    /// assert!((time[(0, 0)] - 1.0 / k).abs() < 1e-13);
    /// assert!((time[(0, 1)] - 1.0 / (k * k)).abs() < 1e-13);
    /// assert!((time[(1, 1)] - 2.0 * ln2 / (k * k * k)).abs() < 1e-12);
    /// let end = second.last().ok_or("no point")?;
    /// let x = 2.0 * (2.0 - ln2 / k).exp();
    /// assert!((end[0][(0, 0)] - x * (1.0 / (k * k) - 1.0 / k)).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn second_sensitivities(&self) -> Result<SecondSensitivities<N>, Error> {
        let mut along = SecondSensitivities {
            first: Sensitivities::default(),
            points: Vec::new(),
            transitions: Vec::new(),
        };
        self.forward::<Second>(&mut along)?;
        Ok(along)
    }

    fn forward<C: Carried>(&self, collector: &mut impl Collector) -> Result<(), Error> {
        Forward::<Sys, Met, N, C>::new(&Replay::new(self)?).run(collector)
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
        let index = self.point_before(t)?;
        let point = &self.points()[index];
        let known = &along.points[index];
        if point.t == t {
            return Ok(known.clone());
        }
        let mut behind = along.behind.iter();
        let present = match behind.find(|(place, _)| *place == index) {
            Some((_, behind)) => behind.clone(),
            None => join(known),
        };
        let replay = Replay::new(self)?;
        let forward = Forward::<Sys, Met, N, First>::new(&replay);
        Ok(split(&forward.at(point, &present, Time::new(t))?))
    }

    /// The gradients of numbers that the solution has, by its initial state and by all parameters:
    /// the derivatives of [`Solution::sensitivities`], at a cost that hardly depends on the number of
    /// parameters. The steps are made again from the points of the solution, the last first.
    ///
    /// For the integral of a function l along the solution, declare a state with `der(q) = l;`.
    ///
    /// # Errors
    /// Those of [`Solution::sensitivities`], [`ErrorKind::OutOfRange`] for a time that was not
    /// integrated, and [`ErrorKind::InvalidInput`] for a transition that there is not.
    ///
    /// ```
    /// use dmm_runtime::{Functional, Integrator, Taylor, Vector, pws};
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
    /// let solution = Integrator::new(&Ball::default(), Taylor::tolerance(1e-14))
    ///     .initial(0.0, [2.0, 0.0])
    ///     .run_until(3.0)?;
    /// let speed = Functional::State { t: 3.0, weights: Vector::from([0.0, 1.0]) };
    /// let surface = Functional::TransitionTime { transition: 0 };
    /// let gradients = solution.gradients(&[speed, surface])?;
    /// // v = −1/k + (1/k − 2) e^{−k}, one unit of time after t = √(2h)
    /// let k: f64 = 0.5;
    /// let expected = 1.0 / (k * k) - ((1.0 / k - 2.0) + 1.0 / (k * k)) * (-k).exp();
    /// assert!((gradients[0].by_parameters[0] - expected).abs() < 1e-13);
    /// assert!((gradients[1].by_initial[0] - 0.5).abs() < 1e-13);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn gradients(&self, functionals: &[Functional<N>]) -> Result<Vec<Gradient<N>>, Error> {
        adjoint::gradients(self, functionals)
    }

    /// The index of the last point that is not after a time.
    fn point_before(&self, t: f64) -> Result<usize, Error> {
        let points = self.points();
        let index = points.partition_point(|point| point.t <= t);
        let last = points.last().map_or(f64::NAN, |last| last.t);
        match index.checked_sub(1) {
            Some(index) if t <= last => Ok(index),
            _ => Err(ErrorKind::OutOfRange {
                t,
                from: points.first().map_or(f64::NAN, |first| first.t),
                to: last,
            }
            .into()),
        }
    }
}

impl<const N: usize> Default for Sensitivities<N> {
    fn default() -> Self {
        Self {
            points: Vec::new(),
            transitions: Vec::new(),
            behind: Vec::new(),
        }
    }
}

impl<const N: usize> Collector for Sensitivities<N> {
    fn point(&mut self, derivatives: &Derivatives) {
        self.points.push(split(derivatives));
    }

    fn transition(&mut self, t: f64, before: &Derivatives, after: &Derivatives) {
        let behind = Derivatives {
            first: after.first.clone(),
            second: Vec::new(),
        };
        self.behind.push((self.points.len(), behind));
        let time = after.first.row(N);
        self.transitions.push(TransitionSensitivity {
            t,
            time_by_initial: time.fixed_columns::<N>(0).transpose(),
            time_by_parameters: time.columns_range(N..).transpose(),
            before: split(before),
            after: split(after),
        });
    }
}

impl<const N: usize> Collector for SecondSensitivities<N> {
    fn point(&mut self, derivatives: &Derivatives) {
        self.first.point(derivatives);
        self.points.push(hessians(derivatives));
    }

    fn transition(&mut self, t: f64, before: &Derivatives, after: &Derivatives) {
        self.first.transition(t, before, after);
        self.transitions.push(TransitionHessians {
            t,
            time: after.second[N].clone(),
            before: hessians(before),
            after: hessians(after),
        });
    }
}

/// The second derivatives of the state.
fn hessians<const N: usize>(derivatives: &Derivatives) -> Hessians<N> {
    std::array::from_fn(|i| derivatives.second[i].clone())
}

/// The columns of all directions: first those of the initial state.
fn split<const N: usize>(derivatives: &Derivatives) -> Sensitivity<N> {
    let state = derivatives.first.fixed_rows::<N>(0);
    Sensitivity {
        by_initial: state.fixed_columns::<N>(0).into_owned(),
        by_parameters: state.columns_range(N..).into_owned(),
    }
}

/// What [`split`] was given, at a fixed time.
fn join<const N: usize>(parts: &Sensitivity<N>) -> Derivatives {
    let directions = N + parts.by_parameters.ncols();
    let mut first = DMatrix::zeros(N + 1, directions);
    first.view_mut((0, 0), (N, N)).copy_from(&parts.by_initial);
    (first.view_mut((0, N), (N, directions - N))).copy_from(&parts.by_parameters);
    Derivatives {
        first,
        second: Vec::new(),
    }
}
