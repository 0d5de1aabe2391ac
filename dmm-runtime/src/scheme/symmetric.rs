//! The symmetric scheme of order 2.

use crate::error::StepFailure;
use crate::linear::{is_finite, solve};
use crate::scheme::{Correction, OneStep, Step};
use crate::statistics::Statistics;
use crate::system::{Flow, Matrix, Solvability, Vector};

/// The discrete multiplier scheme
///
/// x₁ = x₀ + τ f^τ(t₀, x₀, t₁, x₁)
///
/// with uniform steps: symmetric under the exchange of its ends, hence of even order (2), and
/// conserving every declared ψ exactly (Wan, Bihlo & Nave 2017; Hirani, Wan & Wojtalewicz,
/// eq. 2.3).
///
/// Where f^τ is affine in x₁ the solution is in closed form; elsewhere it is found by
/// Newton's method in the increment with the generated Jacobian, from an explicit predictor
/// (the polynomial through the last four increments), down to rounding.
///
/// ```
/// use dmm_runtime::Symmetric;
///
/// let scheme = Symmetric::step_size(1e-3);            // levels are kept
/// let bare = Symmetric::step_size(1e-3).level_correction(false);
/// # let _ = (scheme, bare);
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Symmetric {
    step_size: f64,
    level_correction: bool,
}

impl Symmetric {
    /// Uniform steps of `step_size` (in the unit of time), which must be positive and finite;
    /// the integrator refuses others.
    pub fn step_size(step_size: f64) -> Self {
        Self {
            step_size,
            level_correction: true,
        }
    }

    /// Whether the rounding errors of ψ are corrected towards the level at the entry into the
    /// region (default: yes). Without it they add up: at τ = 10⁻³ to less than 10⁻¹³ of the
    /// size of ψ's terms in a million steps, at coarse steps of a linear flow, whose propagator
    /// is rounded once and for all, to some 10⁻¹¹.
    #[must_use]
    pub fn level_correction(self, level_correction: bool) -> Self {
        Self {
            level_correction,
            ..self
        }
    }
}

/// What [`Symmetric`] remembers within a segment.
#[derive(Clone, Debug)]
pub struct Memory<const N: usize> {
    /// The latest increments of full steps, the latest first.
    recent: [Vector<f64, N>; 4],
    /// How many of them there are.
    known: usize,
    /// Of a linear flow.
    propagator: Option<Propagator<N>>,
}

/// d = K x₀ + k
#[derive(Clone, Debug)]
struct Propagator<const N: usize> {
    /// K
    linear: Matrix<f64, N, N>,
    /// k, where it is not zero.
    offset: Option<Vector<f64, N>>,
}

impl<const N: usize> Memory<N> {
    /// The increment that continues the latest ones.
    #[inline]
    fn predict(&self) -> Option<Vector<f64, N>> {
        let [a, b, c, d] = &self.recent;
        match self.known {
            0 => None,
            1 => Some(*a),
            2 => Some(a * 2.0 - b),
            3 => Some((a - b) * 3.0 + c),
            _ => Some((a + c) * 4.0 - b * 6.0 - d),
        }
    }

    /// The increment of a linear flow.
    #[inline]
    fn propagate(&self, x0: &Vector<f64, N>) -> Result<Vector<f64, N>, StepFailure> {
        let propagator = self.propagator.as_ref();
        let Propagator { linear, offset } = propagator.ok_or(StepFailure::NotFinite)?;
        Ok(match offset {
            None => linear * x0,
            Some(offset) => linear * x0 + offset,
        })
    }

    #[inline]
    fn remember(&mut self, increment: Vector<f64, N>) {
        self.recent = [increment, self.recent[0], self.recent[1], self.recent[2]];
        self.known = (self.known + 1).min(4);
    }
}

/// The propagator of a linear flow: from d = τ(A(x₀ + x₁) + b), with the same A at both ends
/// because f^τ is symmetric, follows d = (I − τA)⁻¹ τ (2A x₀ + b).
fn propagator<const N: usize, const M: usize, F: Flow<f64, N, M>>(
    flow: &F,
    tau: f64,
) -> Option<Propagator<N>> {
    let zero = Vector::zeros();
    let (offset, slope) = flow.linearised(0.0, &zero, tau, &zero);
    let mut matrix = slope * -tau;
    for i in 0..N {
        matrix[(i, i)] += 1.0;
    }
    let mut linear = slope * (2.0 * tau);
    for mut column in linear.column_iter_mut() {
        let solution = solve(&matrix, &column.clone_owned())?;
        column.copy_from(&solution);
    }
    let offset = match offset == zero {
        true => None,
        false => Some(solve(&matrix, &(offset * tau))?),
    };
    Some(Propagator { linear, offset })
}

impl OneStep for Symmetric {
    type Memory<const N: usize> = Memory<N>;

    fn step_size(&self) -> f64 {
        self.step_size
    }

    fn corrects_level(&self) -> bool {
        self.level_correction
    }

    fn begin<const N: usize, const M: usize, F: Flow<f64, N, M>>(
        &self,
        flow: &F,
        _t: f64,
        _x: &Vector<f64, N>,
    ) -> Memory<N> {
        Memory {
            recent: [Vector::zeros(); 4],
            known: 0,
            propagator: match F::SOLVABILITY {
                Solvability::Linear => propagator(flow, self.step_size),
                Solvability::Affine | Solvability::Nonlinear => None,
            },
        }
    }

    // there is one call of it, in the loop over full steps; inlined there, a step in two variables
    // takes a third of the instructions less
    #[inline(always)]
    fn full_step<const N: usize, const M: usize, F: Flow<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        memory: &mut Memory<N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        match F::SOLVABILITY {
            Solvability::Linear => memory.propagate(step.x0),
            Solvability::Affine => self.step(step, statistics),
            Solvability::Nonlinear => {
                let predicted = memory.predict().unwrap_or_else(|| step.euler());
                let increment = step.solve::<M>(predicted, statistics)?;
                memory.remember(increment);
                Ok(increment)
            }
        }
    }

    fn step<const N: usize, const M: usize, F: Flow<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        match F::SOLVABILITY {
            Solvability::Nonlinear => step.solve::<M>(step.euler(), statistics),
            // the residual is affine in d: its correction from any d is the solution
            Solvability::Affine | Solvability::Linear => step
                .correction::<M>(&Vector::zeros())
                .map(|correction| correction.delta)
                .filter(is_finite)
                .ok_or(StepFailure::NotFinite),
        }
    }

    fn correction<const N: usize, const M: usize, F: Flow<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        increment: &Vector<f64, N>,
    ) -> Option<Correction<N>> {
        step.correction::<M>(increment)
    }
}
