//! The symmetric scheme of order 2.

use super::adaptive::Adaptive;
use super::history::History;
use super::map::{Correction, OneStep, Step};
use super::propagator::{Propagator, propagate};
use super::sweep::{MOST, Sweeps};
use super::uniform::Uniform;
use crate::arithmetic::Scalar;
use crate::arithmetic::linear::solve;
use crate::contract::{Dynamics, Solvability, Vector};
use crate::method::Statistics;
use crate::method::{StepFailure, Variation};

/// The discrete multiplier scheme
///
/// x₁ = x₀ + τ f^τ(t₀, x₀, t₁, x₁)
///
/// in uniform steps or in steps by a tolerance: symmetric under the exchange of its ends, hence of even order (2), and
/// conserving every declared ψ exactly (Wan, Bihlo & Nave 2017; Hirani, Wan & Wojtalewicz,
/// eq. 2.3).
///
/// Where f^τ is affine in x₁ the solution is in closed form; elsewhere it is found by
/// Newton's method in the increment with the generated Jacobian, from an explicit predictor
/// (the polynomial through the last six increments), down to rounding.
///
/// ```
/// use dmm_runtime::Symmetric;
///
/// let scheme = Symmetric::step_size(1e-3);            // levels are kept
/// let bare = Symmetric::step_size(1e-3).level_correction(false);
/// # let _ = (scheme, bare);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Symmetric;

impl Symmetric {
    /// Uniform steps of `step_size` (in the unit of time), which must be positive and finite;
    /// the integrator refuses others.
    pub fn step_size(step_size: f64) -> Uniform<Self> {
        Uniform::new(Self, step_size)
    }

    /// Steps by a tolerance: each leaves an error of about `tolerance` relative to the size of
    /// the state. Between 2.2·10⁻¹⁶ and 0.1; the integrator refuses others.
    ///
    /// ```
    /// use dmm_runtime::{Integrator, Symmetric, pws};
    ///
    /// pws! {
    ///     /// A planet.
    ///     pub system Kepler {
    ///         state x, y, u, v;
    ///         der(x) = u;
    ///         der(y) = v;
    ///         der(u) = -x / (x^2 + y^2)^1.5;
    ///         der(v) = -y / (x^2 + y^2)^1.5;
    ///         conserved energy = (u^2 + v^2) / 2 - 1 / sqrt(x^2 + y^2);
    ///         conserved angular_momentum = x * v - y * u;
    ///     }
    /// }
    ///
    /// // eccentricity 0.9: 19 times nearer, and 19 times faster, at one end than at the other
    /// let solution = Integrator::new(&Kepler {}, Symmetric::tolerance(1e-5))
    ///     .initial(0.0, [1.9, 0.0, 0.0, (0.1f64 / 1.9).sqrt()])
    ///     .run_until(100.0)?;
    /// let steps: Vec<f64> = solution.points().windows(2).map(|w| w[1].t - w[0].t).collect();
    /// let longest = steps.iter().copied().fold(0.0, f64::max);
    /// let shortest = steps.iter().copied().fold(1.0, f64::min);
    /// assert!(longest > 30.0 * shortest);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn tolerance(tolerance: f64) -> Adaptive<Self> {
        Adaptive::new(Self, tolerance)
    }
}

/// What [`Symmetric`] remembers within a segment.
#[derive(Clone, Debug)]
pub struct Memory<const N: usize> {
    /// Increments of full steps.
    increments: History<N>,
    sweeps: Sweeps<N>,
    /// Of a linear field.
    propagator: Option<Propagator<N>>,
    /// Whether steps are so long that their rounding errors soon are above that of evaluating ψ.
    long: bool,
}

impl<const N: usize> Memory<N> {
    /// The increment of a full step of a nonlinear field: by sweeps, where they are enough.
    ///
    /// Nothing that sweeps work with is lent to a function that is not inlined, so that it stays
    /// in registers.
    #[inline(always)]
    fn advance<const M: usize, F: Dynamics<f64, N, M>>(
        &mut self,
        step: &Step<'_, F, N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        let predicted = self.increments.predict();
        let mut increment = predicted.unwrap_or_else(|| step.euler());
        let looks = self.sweeps.is_due(self.increments.is_full());
        if !looks && self.sweeps.enough {
            for _ in 0..MOST {
                let before = increment;
                increment = step.sweep(&before);
                statistics.sweeps += 1;
                if self.sweeps.is_last(&(increment - before)) {
                    return Ok(increment);
                }
            }
        }
        let Step {
            dynamics,
            t0,
            x0,
            tau,
        } = *step;
        let start = (t0, *x0, tau);
        let mut solved = increment;
        let failure = if looks {
            let mut sweeps = Sweeps::new();
            let failure = newton_and_look(dynamics, start, &mut solved, &mut sweeps, statistics);
            // until predictions are as good as they become, the next step looks again
            if self.increments.is_full() {
                self.sweeps = sweeps;
            }
            failure
        } else {
            newton(dynamics, start, &mut solved, statistics)
        };
        match failure {
            None => Ok(solved),
            Some(failure) => Err(failure),
        }
    }
}

/// Takes the increment of a step from (t₀, x₀) over τ from a prediction to the solution, by
/// Newton's method.
#[inline(never)]
fn newton<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
    dynamics: &F,
    (t0, x0, tau): (f64, Vector<f64, N>, f64),
    increment: &mut Vector<f64, N>,
    statistics: &mut Statistics,
) -> Option<StepFailure> {
    let step = Step {
        dynamics,
        t0,
        x0: &x0,
        tau,
    };
    match step.solve::<M>(*increment, statistics) {
        Ok(solved) => {
            *increment = solved;
            None
        }
        Err(failure) => Some(failure),
    }
}

/// The same, with a decision on the sweeps of the steps that follow.
#[inline(never)]
fn newton_and_look<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
    dynamics: &F,
    (t0, x0, tau): (f64, Vector<f64, N>, f64),
    increment: &mut Vector<f64, N>,
    sweeps: &mut Sweeps<N>,
    statistics: &mut Statistics,
) -> Option<StepFailure> {
    let step = Step {
        dynamics,
        t0,
        x0: &x0,
        tau,
    };
    let (ref residual, ref matrix) = step.residual::<M>(increment);
    let correction = solve(matrix, residual);
    statistics.newton_iterations += 1;
    *sweeps = Sweeps::new();
    if let Some(correction) = correction {
        *increment -= correction;
        *sweeps = Sweeps::decide(matrix, &correction, increment, &x0);
        if step.is_converged(increment, &correction) {
            return None;
        }
    }
    newton(dynamics, (t0, x0, tau), increment, statistics)
}

impl OneStep for Symmetric {
    type Memory<const N: usize> = Memory<N>;

    fn order(&self) -> usize {
        2
    }

    fn begin<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        dynamics: &F,
        step_size: Option<f64>,
    ) -> Memory<N> {
        let propagator = match (dynamics.solvability(), step_size) {
            (Solvability::Linear, Some(tau)) => Propagator::new(dynamics, tau),
            _ => None,
        };
        Memory {
            increments: History::new(),
            sweeps: Sweeps::new(),
            long: propagator.as_ref().is_none_or(Propagator::is_long),
            propagator,
        }
    }

    #[inline(always)]
    fn correction_interval<const N: usize>(memory: &Memory<N>) -> u64 {
        if memory.long && !memory.sweeps.enough {
            8
        } else {
            32
        }
    }

    // there is one call of it, in the loop over full steps; inlined there, a step in two variables
    // takes a third of the instructions less
    #[inline(always)]
    fn full_step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        memory: &mut Memory<N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        match step.dynamics.solvability() {
            Solvability::Linear => propagate(memory.propagator.as_ref(), step.x0),
            Solvability::Affine => self.step(step, statistics),
            Solvability::Nonlinear => {
                let increment = memory.advance::<M, F>(step, statistics)?;
                memory.increments.remember(increment);
                Ok(increment)
            }
        }
    }

    fn varied_step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        memory: &mut Memory<N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        // steps vary, velocities less so
        let predicted = memory.increments.predict().map(|v| v * step.tau);
        let predicted = predicted.unwrap_or_else(|| step.euler());
        let increment = step.increment::<M>(predicted, statistics)?;
        memory.increments.remember(increment / step.tau);
        Ok(increment)
    }

    fn step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        step.increment::<M>(step.euler(), statistics)
    }

    fn correction<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        increment: &Vector<f64, N>,
    ) -> Option<Correction<N>> {
        step.correction::<M>(increment)
    }

    fn differentiate<D, S, const N: usize, const M: usize>(
        &self,
        step: &Variation<'_, D, S, N>,
    ) -> Option<Vector<S, N>>
    where
        D: Dynamics<S, N, M>,
        S: Scalar,
    {
        step.symmetric::<M>()
    }
}
