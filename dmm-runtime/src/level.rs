//! Conservation for ever: the level ψ_ref of a segment, and the correction towards it.
//!
//! A step conserves ψ up to its truncation and rounding errors, which add up over a long run.
//! The level is therefore kept from the entry into a region, where it is taken as a pair of
//! doubles of the state with its remainder, and the residual r = ψ(t, x) − ψ_ref is taken off
//! the state: the smallest δx with Λ δx = −r, each component measured by its [`Weights`], so that
//! neither its unit nor its zeros matter. With W = diag(wᵢ²), δx = −WΛᵀ(ΛWΛᵀ)⁻¹ r.
//!
//! Where ψ has little slope the rounding error of ψ, and not r, would be what moves the state.
//! There r is evaluated in pairs of doubles. Where ψ has no slope to speak of even r must not be
//! amplified: there, for one quantity δx = −WΛᵀ r/(ΛWΛᵀ + D) with D = (σ·|terms of ψ|/|x|)². Of
//! several quantities each is damped in the direction that it adds to those before it, and the rows
//! that count are those that [`MinimalNorm`] keeps in the discrete vector field.

use std::ops::Range;

use crate::arithmetic::MinimalNorm;
use crate::arithmetic::Scalar;
use crate::arithmetic::State;
use crate::arithmetic::Time;
use crate::arithmetic::linear::dot;
use crate::contract::{Dynamics, Guards, Matrix, Vector};
use crate::special::double::Double;

/// The level of the conserved quantities in a segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Level<const N: usize, const M: usize> {
    reference: Vector<f64, M>,
    /// What the reference lacks as doubles.
    remainder: Vector<f64, M>,
    /// (|terms of ψ|/|x|)²: the squares of slopes count relative to these.
    scale: Vector<f64, M>,
}

/// The sizes of components next to a point: wᵢ² = xᵢ² + dᵢ² of the state and the step that led to
/// it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weights<const N: usize> {
    squares: Vector<f64, N>,
    /// The largest of them.
    largest: f64,
    /// What they are multiples of: 1 unless they are so small or so large that the products they
    /// enter could leave the range of doubles.
    unit: f64,
}

impl<const N: usize> Weights<N> {
    /// Those at the end `x` of a step over `displacement`.
    #[inline(always)]
    pub(crate) fn new(x: &Vector<f64, N>, displacement: &Vector<f64, N>) -> Self {
        let squares = x.zip_map(displacement, |x, d| d.fused(d, x * x));
        let largest = squares.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        // nothing waits for a division that is not made
        if USUAL.contains(&largest) {
            return Self {
                squares,
                largest,
                unit: 1.0,
            };
        }
        Self {
            squares: squares * (1.0 / largest),
            largest: 1.0,
            unit: largest,
        }
    }

    /// Σ wᵢ²
    #[inline(always)]
    pub(crate) fn sum(&self) -> f64 {
        self.unit * self.squares.sum()
    }

    /// wᵢ² Λᵢ
    #[inline(always)]
    fn times(&self, row: &Vector<f64, N>) -> Vector<f64, N> {
        row.component_mul(&self.squares)
    }

    /// Λ with column i times wᵢ, and the wᵢ.
    #[inline(always)]
    fn scaled<const M: usize>(
        &self,
        multiplier: &Matrix<f64, M, N>,
    ) -> (Matrix<f64, M, N>, Vector<f64, N>) {
        let sizes = self.squares.map(f64::sqrt);
        let scaled = Matrix::from_fn(|m, i| multiplier[(m, i)] * sizes[i]);
        (scaled, sizes)
    }

    /// Whether the error of second order of a displacement is more than a rounding error.
    #[inline(always)]
    fn are_left_by(&self, displacement: &Vector<f64, N>) -> bool {
        let far = |i: usize| {
            let bound = COARSE * COARSE * self.unit * self.squares[i];
            displacement[i] * displacement[i] > bound
        };
        (0..N).fold(false, |any, i| any | far(i))
    }
}

impl<const N: usize, const M: usize> Level<N, M> {
    /// Where the slope is smaller than this, rounding errors of ψ would move the state by more
    /// than some units in its last place.
    const LITTLE: f64 = 1.0 / 16.0;
    /// Rounding errors of ψ are below this part of its terms.
    const ROUNDING: f64 = 4.0 * f64::EPSILON;
    /// σ: where the slope is smaller than this, the second order of r is more than a rounding
    /// error of ψ.
    const NONE: f64 = 1e-6;

    /// The level at the entry into a mode, or the one that was `kept` of a segment that goes on.
    #[inline]
    pub(crate) fn enter<F: Dynamics<f64, N, M>>(
        dynamics: &F,
        time: Time,
        state: &State<N>,
        kept: Option<&[[f64; 2]]>,
    ) -> Self {
        let psi = match kept {
            Some(kept) => from_kept(kept),
            None => in_pairs(dynamics, time, state),
        };
        let mut level = Self {
            reference: psi.map(|psi| psi.high),
            remainder: psi.map(|psi| psi.low),
            scale: Vector::zeros(),
        };
        level.rescale(dynamics, time.value, state);
        level
    }

    /// What goes on with the next segment.
    #[cold]
    pub(crate) fn kept(&self) -> Vec<[f64; 2]> {
        let pairs = self.reference.iter().zip(&self.remainder);
        pairs.map(|(&high, &low)| [high, low]).collect()
    }

    /// Takes the scale of slopes from the present state, which may have grown or shrunk since
    /// the entry.
    pub(crate) fn rescale<F: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &F,
        t: f64,
        state: &State<N>,
    ) {
        let squares = state.x.iter().map(|x| x * x);
        let square = squares.fold(f64::MIN_POSITIVE, f64::max);
        let size = dynamics.conserved_size(t, &state.x);
        self.scale = size.map(|size| size * (size / square) + f64::MIN_POSITIVE);
    }

    /// The displacement δx towards the level.
    #[inline(always)]
    pub(crate) fn correction<F: Dynamics<f64, N, M>>(
        &self,
        dynamics: &F,
        time: Time,
        state: &State<N>,
        weights: &Weights<N>,
    ) -> Vector<f64, N> {
        let at = dynamics.multiplier(time.value, &state.x);
        self.correction_by(dynamics, time, state, weights, &at)
    }

    /// The same by ψ and Λ at (t, x).
    #[inline(always)]
    pub(crate) fn correction_by<F: Dynamics<f64, N, M>>(
        &self,
        dynamics: &F,
        time: Time,
        state: &State<N>,
        weights: &Weights<N>,
        (psi, multiplier): &(Vector<f64, M>, Matrix<f64, M, N>),
    ) -> Vector<f64, N> {
        if M == 0 || dynamics.quantities() == 0 {
            return Vector::zeros();
        }
        let little = self.scale * (Self::LITTLE * Self::LITTLE * weights.largest);
        if M == 1 {
            let row = Vector::from_fn(|i, _| multiplier[(0, i)]);
            let weighted = weights.times(&row);
            let square = dot(&row, &weighted);
            let inverse = 1.0 / square;
            let drift = dot(&row, &remainder(dynamics, time, state)) - self.remainder[0];
            if square > little[0] {
                return weighted * -(((psi[0] - self.reference[0]) + drift) * inverse);
            }
            return self.gentle(dynamics, time, state, multiplier, weights);
        }
        let (scaled, sizes) = weights.scaled(multiplier);
        let projection = MinimalNorm::new(&scaled, &scaled);
        if projection.is_steep(&little) {
            let drift = multiplier * remainder(dynamics, time, state) - self.remainder;
            let residual = (psi - self.reference) + drift;
            return -projection.smallest(&residual).component_mul(&sizes);
        }
        self.gentle(dynamics, time, state, multiplier, weights)
    }

    /// The displacement where ψ has little slope, with the residual in pairs of doubles.
    #[cold]
    #[inline(never)]
    fn gentle<F: Dynamics<f64, N, M>>(
        &self,
        dynamics: &F,
        time: Time,
        state: &State<N>,
        multiplier: &Matrix<f64, M, N>,
        weights: &Weights<N>,
    ) -> Vector<f64, N> {
        let residual = self.residual(dynamics, time, state);
        self.towards(multiplier, &residual, weights)
    }

    /// ψ(t, x) − ψ_ref in pairs of doubles, rounded.
    #[inline(always)]
    pub(crate) fn residual<F: Dynamics<f64, N, M>>(
        &self,
        dynamics: &F,
        time: Time,
        state: &State<N>,
    ) -> Vector<f64, M> {
        let psi = in_pairs(dynamics, time, state);
        Vector::from_fn(|i, _| (psi[i] - Double::new(self.reference[i], self.remainder[i])).high)
    }

    /// The displacement that takes a residual off.
    #[inline(always)]
    pub(crate) fn towards(
        &self,
        multiplier: &Matrix<f64, M, N>,
        residual: &Vector<f64, M>,
        weights: &Weights<N>,
    ) -> Vector<f64, N> {
        let damping = self.scale * (Self::NONE * Self::NONE * weights.largest);
        if M == 1 {
            let row = Vector::from_fn(|i, _| multiplier[(0, i)]);
            let weighted = weights.times(&row);
            let square = dot(&row, &weighted);
            let damping = if square > damping[0] { 0.0 } else { damping[0] };
            return weighted * -(residual[0] / (square + damping));
        }
        let (scaled, sizes) = weights.scaled(multiplier);
        let projection = MinimalNorm::new(&scaled, &scaled);
        let displacement = match projection.is_steep(&damping) {
            true => projection.smallest(residual),
            false => projection.damped(residual, &damping),
        };
        -displacement.component_mul(&sizes)
    }

    /// Whether ψ is further from its level than the rounding errors of evaluating it: a state that
    /// is better than them is not to be moved by them.
    pub(crate) fn strays<F: Dynamics<f64, N, M>>(
        &self,
        dynamics: &F,
        time: Time,
        state: &State<N>,
    ) -> bool {
        let (psi, multiplier) = dynamics.multiplier(time.value, &state.x);
        let drift = multiplier * remainder(dynamics, time, state) - self.remainder;
        let residual = (psi - self.reference) + drift;
        let size = dynamics.conserved_size(time.value, &state.x);
        let mut errors = residual.iter().zip(&size);
        errors.any(|(residual, size)| residual.abs() > Self::ROUNDING * size)
    }

    /// The state that a step over `displacement` has come to, put back on the level if it
    /// `corrects`.
    #[inline(always)]
    pub(crate) fn reached<F: Dynamics<f64, N, M>>(
        &self,
        dynamics: &F,
        time: Time,
        state: State<N>,
        displacement: &Vector<f64, N>,
        corrects: bool,
    ) -> State<N> {
        if M == 0 || dynamics.quantities() == 0 || !corrects {
            return state.normalised();
        }
        let weights = Weights::new(&state.x, displacement);
        if M == 1
            && let Some(reached) = self.reached_at_once(dynamics, time, &state, &weights)
        {
            return reached;
        }
        self.reached_by_steps(dynamics, time, state, &weights)
    }

    /// The same for one quantity that has some slope. What a large correction leaves, the square
    /// of it, is taken off with the same slope.
    #[inline(always)]
    fn reached_at_once<F: Dynamics<f64, N, M>>(
        &self,
        dynamics: &F,
        time: Time,
        state: &State<N>,
        weights: &Weights<N>,
    ) -> Option<State<N>> {
        let (psi, multiplier) = dynamics.multiplier(time.value, &state.x);
        let row = Vector::from_fn(|i, _| multiplier[(0, i)]);
        let weighted = weights.times(&row);
        let square = dot(&row, &weighted);
        if square <= self.scale[0] * (Self::LITTLE * Self::LITTLE * weights.largest) {
            return None;
        }
        let gain = weighted * (1.0 / square);
        let residual = |psi: Vector<f64, M>, state: &State<N>| {
            let drift = dot(&row, &remainder(dynamics, time, state)) - self.remainder[0];
            (psi[0] - self.reference[0]) + drift
        };
        let without = |mut state: State<N>, residual: f64| {
            state.remainder -= gain * residual;
            state.normalised()
        };
        let first = residual(psi, state);
        let mut reached = without(*state, first);
        let coarse = square * (weights.unit * (COARSE * COARSE));
        if first * first > coarse {
            let second = residual(dynamics.conserved(time.value, &reached.x), &reached);
            reached = without(reached, second);
            // the same slope again leaves the product of the two
            if (first * second).abs() > coarse {
                reached = self.reached_by_steps(dynamics, time, reached, weights);
            }
        }
        Some(reached)
    }

    /// The same by one correction after the other, while the square of the last one is no rounding
    /// error.
    #[inline(never)]
    fn reached_by_steps<F: Dynamics<f64, N, M>>(
        &self,
        dynamics: &F,
        time: Time,
        mut state: State<N>,
        weights: &Weights<N>,
    ) -> State<N> {
        /// The error falls to its square each time, and then to the part that damping leaves.
        const MOST: u32 = 9;
        for _ in 0..MOST {
            let displacement = self.correction(dynamics, time, &state, weights);
            state.remainder += displacement;
            state = state.normalised();
            if !weights.are_left_by(&displacement) {
                break;
            }
        }
        state
    }
}

/// Where squares of sizes and the products that they enter are far from the ends of the range of
/// doubles.
const USUAL: Range<f64> = 1e-20..1e20;

/// The error of second order of a displacement by this part of the state is more than a rounding
/// error.
const COARSE: f64 = 1e-9;

/// Of more states ψ has so many terms that their code in pairs of doubles is out of proportion:
/// there ψ is evaluated in doubles, and the remainders enter by its slope.
const MOST_IN_PAIRS: usize = 12;

/// ψ_ref of a segment that was stopped; NaN where there is none.
#[cold]
fn from_kept<const M: usize>(kept: &[[f64; 2]]) -> Vector<Double, M> {
    Vector::from_fn(|i, _| {
        let [high, low] = kept.get(i).copied().unwrap_or([f64::NAN; 2]);
        Double::new(high, low)
    })
}

/// ψ at the state and time with their remainders.
#[inline]
fn in_pairs<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
    dynamics: &F,
    time: Time,
    state: &State<N>,
) -> Vector<Double, M> {
    if const { N > MOST_IN_PAIRS } {
        let (psi, multiplier) = dynamics.multiplier(time.value, &state.x);
        let drift = multiplier * remainder(dynamics, time, state);
        return Vector::from_fn(|i, _| Double::sum(psi[i], drift[i]));
    }
    let (t, x) = pairs(time, state);
    dynamics.over::<Double>().conserved(t, &x)
}

/// g at the state and time with their remainders, rounded.
#[inline(always)]
pub(crate) fn switching_in_pairs<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
    dynamics: &F,
    interface: usize,
    time: Time,
    state: &State<N>,
) -> f64 {
    let (t, x) = pairs(time, state);
    let guards = dynamics.guards().over::<Double>();
    guards.switching_function(interface, t, &x).high
}

/// A time and a state as pairs of doubles.
#[inline(always)]
fn pairs<const N: usize>(time: Time, state: &State<N>) -> (Double, Vector<Double, N>) {
    (
        Double::new(time.value, time.remainder),
        Vector::from_fn(|i, _| Double::new(state.x[i], state.remainder[i])),
    )
}

/// The state's remainder, as far as ψ is concerned with that of the time: ψ(t + δ, x) is
/// ψ(t, x − fδ), because ∂ₜψ = −∇ψ·f.
#[inline(always)]
fn remainder<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
    dynamics: &F,
    time: Time,
    state: &State<N>,
) -> Vector<f64, N> {
    if dynamics.is_autonomous() || time.remainder == 0.0 {
        return state.remainder;
    }
    state.remainder - dynamics.vector_field(time.value, &state.x) * time.remainder
}
