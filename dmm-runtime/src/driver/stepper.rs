//! The driver, a step at a time.

use std::ops::ControlFlow;

use super::integrator::{InitialValueProblem, check_times};
use super::run::Run;
use super::start::Start;
use crate::arithmetic::State;
use crate::contract::{InitialState, System, Vector};
use crate::error::{Error, invalid, number};
use crate::method::{Cursor, Ended, Method, Statistics};
use crate::output::{Observer, Point, Transition};

/// What a [`Stepper`] has done.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Stepped<R, const N: usize> {
    /// A step, to this point; if it is on an interface, the next one is a transition.
    Step(Point<R, N>),
    /// A transition.
    Transition(Transition<R, N>),
}

/// An integration that is pulled: one step or one transition at a time, to look at, to stop or to
/// change before it goes on.
///
/// The steps are those of [`InitialValueProblem::run_until`], to the last bit. A clone is a
/// checkpoint.
///
/// ```
/// use dmm_runtime::{Best, Integrator, Stepped, pws};
///
/// pws! {
///     /// A ball between two springs.
///     pub system Ball {
///         state x, v;
///         param k = 4;
///         interface spring = x;
///         region free where spring > 0 {
///             der(x) = v; der(v) = -1;
///             conserved energy = v^2/2 + x;
///         }
///         region pressed where spring < 0 {
///             der(x) = v; der(v) = -1 - k*x;
///             conserved energy = v^2/2 + x + k*x^2/2;
///         }
///     }
/// }
///
/// let ball = Ball::default();
/// let mut stepper = Integrator::new(&ball, Best::tolerance(1e-12))
///     .initial(0.0, [1.0, 0.0])
///     .stepper(100.0)?;
/// let mut bounces = 0;
/// while let Some(event) = stepper.step()? {
///     let Stepped::Transition(transition) = event else { continue };
///     if transition.to == BallRegion::Pressed {
///         bounces += 1;
///         // the spring hardens
///         stepper.change(|ball, _| ball.k *= 2.0)?;
///     }
/// }
/// assert!(bounces > 30 && stepper.system().k == 4.0 * 2f64.powi(bounces));
/// let [x, v] = stepper.point().x.into();
/// assert!((v * v / 2.0 + x - 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Stepper<Sys: System<N>, Met: Method, const N: usize> {
    system: Sys,
    method: Met,
    run: Run<Sys, N>,
    memory: Met::Memory<N>,
    t_end: f64,
    /// The guard that the last step has led to, and its rate.
    met: Option<(usize, f64)>,
}

/// Stops after each point.
struct Once;

impl<R, const N: usize> Observer<R, N> for Once {
    fn point(&mut self, _: &Point<R, N>) -> ControlFlow<()> {
        ControlFlow::Break(())
    }
}

impl<Sys: System<N>, Met: Method, const N: usize> InitialValueProblem<'_, Sys, Met, N> {
    /// A stepper from the initial value to `t_end`.
    ///
    /// # Errors
    /// Bad input.
    pub fn stepper(self, t_end: f64) -> Result<Stepper<Sys, Met, N>, Error> {
        let (x0, start) = self.start(t_end)?;
        let (system, method) = (
            self.integrator.system.clone(),
            self.integrator.method.clone(),
        );
        Ok(Stepper {
            run: Run::new(&system, (self.t0, x0), start),
            memory: self.memory(t_end),
            system,
            method,
            t_end,
            met: None,
        })
    }
}

impl<Sys: System<N>, Met: Method, const N: usize> Stepper<Sys, Met, N> {
    /// The next step or transition; nothing at the end time.
    ///
    /// # Errors
    /// Whatever stops the integration; the stepper is still at the point before.
    pub fn step(&mut self) -> Result<Option<Stepped<Sys::Region, N>>, Error> {
        let (system, moving) = (&self.system, (&self.method, &mut self.memory));
        if let Some(met) = self.met {
            let mut transition = None;
            let told = |one: &_| {
                transition = Some(*one);
                ControlFlow::Continue(())
            };
            self.run.next_mode(system, met, told).map(drop)?;
            self.met = None;
            if let Some(transition) = transition {
                return Ok(Some(Stepped::Transition(transition)));
            }
        }
        match self.run.segment(system, moving, self.t_end, &mut Once)? {
            Ended::Finished => return Ok(None),
            Ended::Stopped => {}
            Ended::AtGuard { guard, rate } => self.met = Some((guard, rate)),
        }
        Ok(Some(Stepped::Step(self.run.point())))
    }

    /// Where it is.
    pub fn point(&self) -> Point<Sys::Region, N> {
        self.run.point()
    }

    /// What was done.
    pub fn statistics(&self) -> &Statistics {
        &self.run.statistics
    }

    /// The system, with its present parameters.
    pub fn system(&self) -> &Sys {
        &self.system
    }

    /// Changes parameters or the state; what follows is a new initial value problem from here, with
    /// levels of its own. On an interface the vector fields decide on the region, as at a start.
    ///
    /// # Errors
    /// A start that is not possible; the stepper is as it was.
    pub fn change(
        &mut self,
        change: impl FnOnce(&mut Sys, &mut Vector<f64, N>),
    ) -> Result<(), Error> {
        self.start_again(None, change)
    }

    /// Sets the state; see [`Stepper::change`].
    ///
    /// # Errors
    /// A start that is not possible, or a slice of the wrong length; the stepper is as it was.
    pub fn set_state(&mut self, x: impl InitialState<Sys, N>) -> Result<(), Error> {
        let x = x.into_state(&self.system)?;
        self.start_again(None, |_, state| *state = x)
    }

    /// Sets the state and names its region, as [`InitialValueProblem::region`] does.
    ///
    /// # Errors
    /// As of [`Stepper::set_state`], and a state that does not lie in the region.
    pub fn set_state_in(
        &mut self,
        region: Sys::Region,
        x: impl InitialState<Sys, N>,
    ) -> Result<(), Error> {
        let x = x.into_state(&self.system)?;
        self.start_again(Some(region), |_, state| *state = x)
    }

    /// A new start from here, after a change.
    fn start_again(
        &mut self,
        region: Option<Sys::Region>,
        change: impl FnOnce(&mut Sys, &mut Vector<f64, N>),
    ) -> Result<(), Error> {
        let mut system = self.system.clone();
        let Cursor {
            time, mut state, ..
        } = self.run.cursor;
        let mut x = state.rounded();
        let before = x;
        change(&mut system, &mut x);
        if x != before {
            state = State::new(x);
        }
        let t = time.value;
        let regions = (region, Some(self.run.region));
        let start = Start::checked(&system, regions, (t, self.t_end), &x)?;
        let cursor = Cursor::new(time, state, 0, start.on);
        let (statistics, accumulation) = (self.run.statistics, self.run.accumulation);
        self.run = Run {
            statistics,
            accumulation,
            ..Run::at(&system, cursor, start.region)
        };
        self.memory = self.method.memory(t, self.t_end);
        self.system = system;
        self.met = None;
        Ok(())
    }

    /// Moves the end time, which must not be before the present time.
    ///
    /// # Errors
    /// An end time that is not finite, or too early.
    pub fn extend(&mut self, t_end: f64) -> Result<(), Error> {
        let t = self.run.cursor.time.value;
        if t_end < t {
            return invalid(
                "end time",
                number(t_end),
                "must not be before the present time",
            );
        }
        check_times(t, t_end)?;
        self.method.check(t, t_end)?;
        self.t_end = t_end;
        Ok(())
    }
}
