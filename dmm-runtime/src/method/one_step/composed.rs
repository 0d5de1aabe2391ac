//! Symmetric compositions of [`Symmetric`](super::Symmetric), of order 4, 6 and 8.

use super::adaptive::Adaptive;
use super::compositions::Composition;
use super::history::History;
use super::map::{Correction, OneStep, Step};
use super::propagator::{Propagator, propagate};
use super::uniform::Uniform;
use crate::arithmetic::Scalar;
use crate::contract::{Dynamics, Solvability, Vector};
use crate::method::Statistics;
use crate::method::{StepFailure, Variation};

/// The symmetric scheme of order 2 composed with itself to the order 4, 6 or 8: sub-steps
///
/// xᵢ = xᵢ₋₁ + τᵢ f^τ(tᵢ₋₁, xᵢ₋₁, tᵢ, xᵢ), τᵢ = γᵢτ, i = 1 … s,
///
/// some of them backwards in time. Each conserves every declared ψ exactly, and so does the
/// step. With s = 5 (Suzuki 1990) for order 4, 9 and 17 (Kahan & Li 1997) for 6 and 8.
///
/// Sub-steps keep the vector field of their region beyond its interfaces, where it has to have
/// a value. A transition is located on the composed map, so that its order survives.
///
/// ```
/// use dmm_runtime::{Composed, Integrator, pws};
///
/// pws! {
///     /// A pendulum.
///     pub system Pendulum {
///         state q, p;
///         der(q) = p;
///         der(p) = -sin(q);
///         conserved energy = p^2 / 2 - cos(q);
///     }
/// }
///
/// let solution = |step_size| {
///     Integrator::new(&Pendulum {}, Composed::<6>::step_size(step_size))
///         .initial(0.0, [0.5, 1.0])
///         .run_until(10.0)
/// };
/// let (coarse, fine) = (solution(0.1)?, solution(0.01)?);
/// assert!((coarse.at(10.0)? - fine.at(10.0)?).norm() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// There is no other order:
///
/// ```compile_fail
/// let scheme = dmm_runtime::Composed::<5>::step_size(0.1);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Composed<const ORDER: usize>;

impl<const ORDER: usize> Composed<ORDER>
where
    Self: Composition,
{
    /// Uniform steps of `step_size` (in the unit of time), which must be positive and finite;
    /// the integrator refuses others.
    pub fn step_size(step_size: f64) -> Uniform<SubSteps> {
        Uniform::new(Self::SUB_STEPS, step_size)
    }

    /// Steps by a tolerance: each leaves an error of about `tolerance` relative to the size of
    /// the state. Between 2.2·10⁻¹⁶ and 0.1; the integrator refuses others.
    pub fn tolerance(tolerance: f64) -> Adaptive<SubSteps> {
        Adaptive::new(Self::SUB_STEPS, tolerance)
    }

    /// The one-step map.
    pub const SUB_STEPS: SubSteps = SubSteps {
        order: ORDER,
        weights: Self::WEIGHTS,
    };
}

/// The one-step map of [`Composed`]. It is one type for every order, so that steps by it are
/// compiled once for a system.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SubSteps {
    order: usize,
    /// γ₁ … γₛ
    weights: &'static [f64],
}

/// What [`Composed`] remembers within a segment.
#[derive(Clone, Debug)]
pub struct Memory<const N: usize> {
    /// Of each sub-step, d/τ.
    velocities: Vec<History<N>>,
    /// Of a linear field, all sub-steps in one.
    propagator: Option<Propagator<N>>,
}

/// A sub-step, as a part of the whole.
struct Stage<'a, F, const N: usize> {
    step: Step<'a, F, N>,
    weight: f64,
    /// The sums of the weights at its ends.
    from: f64,
    to: f64,
}

impl<F, const N: usize> Step<'_, F, N> {
    /// The increment of a composition, from those of its sub-steps.
    fn compose<const M: usize>(
        &self,
        weights: &[f64],
        mut increment_of: impl FnMut(usize, &Stage<'_, F, N>) -> Result<Vector<f64, N>, StepFailure>,
    ) -> Result<Vector<f64, N>, StepFailure>
    where
        F: Dynamics<f64, N, M>,
    {
        let mut increment = Vector::zeros();
        let (mut from, mut t0) = (0.0, self.t0);
        for (i, &weight) in weights.iter().enumerate() {
            let is_last = i + 1 == weights.len();
            let to = if is_last { 1.0 } else { from + weight };
            let tau = if self.dynamics.is_autonomous() {
                weight * self.tau
            } else {
                // telescoping sums need the very times that ψ(t, x) is evaluated at
                (self.t0 + to * self.tau) - t0
            };
            let x0 = self.x0 + increment;
            let step = Step {
                dynamics: self.dynamics,
                t0,
                x0: &x0,
                tau,
            };
            let stage = Stage {
                step,
                weight,
                from,
                to,
            };
            increment += increment_of(i, &stage)?;
            (from, t0) = (to, t0 + tau);
        }
        Ok(increment)
    }
}

/// Velocities in a step, each with the share of the step at which it is: what sub-steps
/// without a history are predicted from.
struct Guess<const N: usize> {
    at: [f64; 3],
    velocity: [Vector<f64, N>; 3],
    known: usize,
}

impl<const N: usize> Guess<N> {
    /// From the velocity at the start.
    fn new(velocity: Vector<f64, N>) -> Self {
        Self {
            at: [0.0; 3],
            velocity: [velocity, Vector::zeros(), Vector::zeros()],
            known: 1,
        }
    }

    /// The velocity of a sub-step: on the polynomial through the latest ones.
    fn predict(&self, at: f64) -> Vector<f64, N> {
        let ([a, b, c], [u, v, w]) = (self.at, &self.velocity);
        if self.known == 1 {
            return *u;
        }
        let first = (u - v) / (a - b);
        if self.known == 2 {
            return u + first * (at - a);
        }
        let second = (first - (v - w) / (b - c)) / (a - c);
        u + (first + second * (at - b)) * (at - a)
    }

    /// Appends that of the sub-step around `at`.
    fn remember(&mut self, at: f64, velocity: Vector<f64, N>) {
        self.at = [at, self.at[0], self.at[1]];
        self.velocity = [velocity, self.velocity[0], self.velocity[1]];
        self.known = (self.known + 1).min(3);
    }
}

impl<F, const N: usize> Stage<'_, F, N> {
    /// The increment from a `guess`, which is told of it.
    fn increment<const M: usize>(
        &self,
        guess: &mut Guess<N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure>
    where
        F: Dynamics<f64, N, M>,
    {
        let middle = self.from + 0.5 * self.weight;
        let predicted = guess.predict(middle) * self.step.tau;
        let increment = self.step.increment::<M>(predicted, statistics)?;
        guess.remember(middle, increment / self.step.tau);
        Ok(increment)
    }
}

impl OneStep for SubSteps {
    type Memory<const N: usize> = Memory<N>;

    fn order(&self) -> usize {
        self.order
    }

    /// The rounding errors of all sub-steps of a few long steps are above that of evaluating ψ.
    #[inline(always)]
    fn correction_interval<const N: usize>(_memory: &Self::Memory<N>) -> u64 {
        1
    }

    fn begin<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        dynamics: &F,
        step_size: Option<f64>,
    ) -> Self::Memory<N> {
        let whole = |tau: f64| {
            let of = |&weight: &f64| Propagator::new(dynamics, weight * tau);
            let mut each = self.weights.iter().map(of);
            let first = each.next()??;
            each.try_fold(first, |before, next| Some(before.then(&next?)))
        };
        Memory {
            velocities: vec![History::new(); self.weights.len()],
            propagator: match dynamics.solvability() {
                Solvability::Linear => step_size.and_then(whole),
                Solvability::Affine | Solvability::Nonlinear => None,
            },
        }
    }

    fn full_step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        memory: &mut Self::Memory<N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        match step.dynamics.solvability() {
            Solvability::Linear => propagate(memory.propagator.as_ref(), step.x0),
            Solvability::Affine | Solvability::Nonlinear => {
                self.varied_step(step, memory, statistics)
            }
        }
    }

    fn varied_step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        memory: &mut Self::Memory<N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        if step.dynamics.solvability() != Solvability::Nonlinear {
            return self.step(step, statistics);
        }
        let histories = &mut memory.velocities;
        let mut guess = match histories.first().and_then(History::predict) {
            Some(_) => None,
            None => Some(Guess::new(step.dynamics.vector_field(step.t0, step.x0))),
        };
        let scale = 1.0 / step.tau;
        step.compose(self.weights, |i, stage| {
            let increment = match (histories[i].predict(), &mut guess) {
                (Some(velocity), _) => stage.step.increment(velocity * step.tau, statistics)?,
                (None, Some(guess)) => stage.increment(guess, statistics)?,
                (None, None) => stage.step.increment(stage.step.euler(), statistics)?,
            };
            histories[i].remember(increment * scale);
            Ok(increment)
        })
    }

    fn step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        let mut guess = Guess::new(step.dynamics.vector_field(step.t0, step.x0));
        step.compose(self.weights, |_, stage| {
            stage.increment(&mut guess, statistics)
        })
    }

    /// The whole way to the composed map: of its sub-steps an increment tells nothing.
    fn correction<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        increment: &Vector<f64, N>,
    ) -> Option<Correction<N>> {
        let mut guess = Guess::new(step.dynamics.vector_field(step.t0, step.x0));
        // ∂xᵢ/∂τ, from sub-step to sub-step
        let mut velocity = Vector::zeros();
        let solved = step.compose(self.weights, |_, stage| {
            let increment = stage.increment(&mut guess, &mut Statistics::default())?;
            let rates = (velocity, stage.from, stage.to);
            velocity = stage
                .step
                .tangent(&increment, rates)
                .ok_or(StepFailure::NotFinite)?;
            Ok(increment)
        });
        Some(Correction {
            delta: solved.ok()? - increment,
            velocity,
        })
    }

    fn differentiate<D, S, const N: usize, const M: usize>(
        &self,
        step: &Variation<'_, D, S, N>,
    ) -> Option<Vector<S, N>>
    where
        D: Dynamics<S, N, M>,
        S: Scalar,
    {
        step.composed::<M>(self.weights)
    }
}
