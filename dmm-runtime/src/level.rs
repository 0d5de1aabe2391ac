//! Conservation for ever: the level ψ_ref of a segment, and the correction towards it.
//!
//! A step conserves ψ up to its rounding errors, which add up over a long run. The level is
//! therefore kept from the entry into a region, and every few steps the residual
//! r = ψ(t, x) − ψ_ref, a few units in the last place, is taken off the state along the rows
//! of Λ, at once: the smallest δx with Λ δx = −r.
//!
//! Where ψ has almost no slope its rounding error must not be amplified into a large
//! displacement: for one quantity δx = −Λᵀ r/(ΛΛᵀ + D) with D = (σ·|terms of ψ|/|x|)². Of
//! several quantities each is damped in the direction that it adds to those before it, and the
//! rows that count are those that [`MinimalNorm`] keeps in the discrete vector field.

use crate::minimal_norm::MinimalNorm;
use crate::scalar::Scalar;
use crate::state::State;
use crate::system::{Flow, Vector};
use crate::time::Time;

/// The level of the conserved quantities in a segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Level<const N: usize, const M: usize> {
    reference: Vector<f64, M>,
    /// D
    damping: Vector<f64, M>,
    /// Residuals beyond these are no rounding errors, and not damped.
    noise: Vector<f64, M>,
}

impl<const N: usize, const M: usize> Level<N, M> {
    /// σ: rounding errors of ψ move the state by a few units in its last place.
    const SLOPE: f64 = 1.0 / 16.0;
    /// Rounding errors of ψ are below so many units of its terms.
    const NOISE: f64 = 16.0 * f64::EPSILON;

    /// The level at the entry into a region.
    pub(crate) fn enter<F: Flow<f64, N, M>>(flow: &F, time: Time, state: &State<N>) -> Self {
        let (psi, multiplier) = flow.multiplier(time.value, &state.x);
        let mut level = Self {
            reference: psi + multiplier * remainder(flow, time, state),
            damping: Vector::zeros(),
            noise: Vector::zeros(),
        };
        level.rescale(flow, time.value, state);
        level
    }

    /// Takes D from the present state, which may have grown or shrunk since the entry.
    pub(crate) fn rescale<F: Flow<f64, N, M>>(&mut self, flow: &F, t: f64, state: &State<N>) {
        let scale = Self::SLOPE / state.x.norm().max(f64::MIN_POSITIVE);
        let size = flow.conserved_size(t, &state.x);
        self.damping = size.map(|size| (size * scale).powi(2) + f64::MIN_POSITIVE);
        self.noise = size * Self::NOISE;
    }

    /// The displacement δx towards the level.
    #[inline(always)]
    pub(crate) fn correction<F: Flow<f64, N, M>>(
        &self,
        flow: &F,
        time: Time,
        state: &State<N>,
    ) -> Vector<f64, N> {
        if M == 0 {
            return Vector::zeros();
        }
        let (psi, multiplier) = flow.multiplier(time.value, &state.x);
        let residual = (psi - self.reference) + multiplier * remainder(flow, time, state);
        let damping = self
            .damping
            .zip_zip_map(&residual, &self.noise, |damping, r, noise| {
                if r.abs() > noise {
                    f64::MIN_POSITIVE
                } else {
                    damping
                }
            });
        if M == 1 {
            let row = multiplier.row(0);
            return row.transpose() * (-residual[0] / (row.norm_squared() + damping[0]));
        }
        -MinimalNorm::new(&multiplier, &multiplier).damped(&residual, &damping)
    }

    /// Whether ψ is further from its level than the rounding errors of evaluating it: a state that
    /// is better than them is not to be moved by them.
    pub(crate) fn strays<F: Flow<f64, N, M>>(
        &self,
        flow: &F,
        time: Time,
        state: &State<N>,
    ) -> bool {
        let (psi, multiplier) = flow.multiplier(time.value, &state.x);
        let residual = (psi - self.reference) + multiplier * remainder(flow, time, state);
        let mut errors = residual.iter().zip(&self.noise);
        errors.any(|(residual, noise)| residual.abs() > 0.25 * noise)
    }

    /// The state that a step has come to, put back on the level if it `corrects`.
    #[inline(always)]
    pub(crate) fn reached<F: Flow<f64, N, M>>(
        &self,
        flow: &F,
        time: Time,
        mut state: State<N>,
        corrects: bool,
    ) -> State<N> {
        if M == 0 || !corrects {
            return state.normalised();
        }
        let displacement = self.correction(flow, time, &state);
        state.remainder += displacement;
        state = state.normalised();
        match is_coarse(&displacement, &state) {
            true => self.corrected_again(flow, time, state),
            false => state,
        }
    }

    /// After a correction so large that its square is no rounding error.
    #[inline(never)]
    fn corrected_again<F: Flow<f64, N, M>>(
        &self,
        flow: &F,
        time: Time,
        mut state: State<N>,
    ) -> State<N> {
        /// The error falls to its square each time, and then to the part that damping leaves.
        const MOST: u32 = 8;
        for _ in 0..MOST {
            let displacement = self.correction(flow, time, &state);
            state.remainder += displacement;
            state = state.normalised();
            if !is_coarse(&displacement, &state) {
                break;
            }
        }
        state
    }
}

/// Whether the error of second order of a displacement is more than a rounding error.
#[inline(always)]
pub(crate) fn is_coarse<const N: usize>(displacement: &Vector<f64, N>, state: &State<N>) -> bool {
    const SMALL: f64 = 1e-9;
    let square = |v: &Vector<f64, N>| (0..N).fold(0.0, |sum, i| v[i].fused(v[i], sum));
    square(displacement) > SMALL * SMALL * square(&state.x)
}

/// The state's remainder, as far as ψ is concerned with that of the time: ψ(t + δ, x) is
/// ψ(t, x − fδ), because ∂ₜψ = −∇ψ·f.
#[inline]
fn remainder<const N: usize, const M: usize, F: Flow<f64, N, M>>(
    flow: &F,
    time: Time,
    state: &State<N>,
) -> Vector<f64, N> {
    if F::AUTONOMOUS || time.remainder == 0.0 {
        return state.remainder;
    }
    state.remainder - flow.vector_field(time.value, &state.x) * time.remainder
}
