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

mod guard_point;

use std::ops::Range;

use crate::arithmetic::MinimalNorm;
use crate::arithmetic::State;
use crate::arithmetic::Time;
use crate::arithmetic::double::Pair;
use crate::arithmetic::linear::dot;
use crate::arithmetic::masked::{Mask, Masked, vector};
use crate::contract::{Dynamics, Guards, Matrix, Vector};

pub(crate) use guard_point::{Found, GuardPoint};

/// The level of the conserved quantities in a segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Level<const N: usize, const M: usize, S: Masked = f64> {
    pub(crate) reference: Vector<S, M>,
    /// What the reference lacks as doubles.
    pub(crate) remainder: Vector<S, M>,
    /// (|terms of ψ|/|x|)²: the squares of slopes count relative to these.
    pub(crate) scale: Vector<S, M>,
}

/// The sizes of components next to a point: wᵢ² = xᵢ² + dᵢ² of the state and the step that led to
/// it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weights<const N: usize, S: Masked = f64> {
    squares: Vector<S, N>,
    /// The largest of them.
    largest: S,
    /// What they are multiples of: 1 unless they are so small or so large that the products they
    /// enter could leave the range of doubles.
    unit: S,
}

impl<const N: usize, S: Masked> Weights<N, S> {
    /// Those at the end `x` of a step over `displacement`.
    #[inline(always)]
    pub(crate) fn new(x: &Vector<S, N>, displacement: &Vector<S, N>) -> Self {
        let one = S::from_f64(1.0);
        let squares = vector(|i| displacement[i].fused(displacement[i], x[i] * x[i]));
        let least = S::from_f64(f64::MIN_POSITIVE);
        let largest = (0..N).fold(least, |largest, i| largest.max(squares[i]));
        let above = largest.above(S::from_f64(USUAL.start));
        let usual = above.and(S::from_f64(USUAL.end).above(largest));
        let weights = Self {
            squares,
            largest,
            unit: one,
        };
        // nothing waits for a division that is not made
        if usual.all() {
            return weights;
        }
        let inverse = one / largest;
        Self {
            squares: vector(|i| usual.select(squares[i], squares[i] * inverse)),
            largest: usual.select(largest, one),
            unit: usual.select(one, largest),
        }
    }

    /// wᵢ² Λᵢ
    #[inline(always)]
    fn times(&self, row: &Vector<S, N>) -> Vector<S, N> {
        vector(|i| row[i] * self.squares[i])
    }

    /// The displacement that takes a residual off by Λ with column i times wᵢ, as `value` has it, and
    /// where that matrix is steep beyond a `bound`. Lane by lane, because which of several
    /// quantities count differs.
    #[inline]
    fn by_lane<const M: usize>(
        &self,
        multiplier: &Matrix<S, M, N>,
        residual: &Vector<S, M>,
        bound: &Vector<S, M>,
        value: impl Fn(&MinimalNorm<f64, N, M>, &Vector<f64, M>, &Vector<f64, M>) -> Vector<f64, N>,
    ) -> (Vector<S, N>, S::Mask) {
        let mut results: Vector<S, N> = vector(|_| S::from_f64(0.0));
        let mut steep = S::from_f64(0.0);
        for lane in 0..S::LANES {
            let sizes: Vector<f64, N> = vector(|i| self.squares[i].lane(lane).sqrt());
            let scaled = Matrix::from_fn(|m, i| multiplier[(m, i)].lane(lane) * sizes[i]);
            let projection = MinimalNorm::new(&scaled, &scaled);
            let bound = vector(|m| bound[m].lane(lane));
            steep.set_lane(lane, f64::from(u8::from(projection.is_steep(&bound))));
            let result = value(&projection, &vector(|m| residual[m].lane(lane)), &bound);
            for i in 0..N {
                results[i].set_lane(lane, -(result[i] * sizes[i]));
            }
        }
        (results, steep.above(S::from_f64(0.5)))
    }

    /// Whether the error of second order of a displacement is more than a rounding error.
    #[inline(always)]
    fn are_left_by(&self, displacement: &Vector<S, N>) -> S::Mask {
        let coarse = S::from_f64(COARSE * COARSE) * self.unit;
        (0..N).fold(S::Mask::all_are(false), |any, i| {
            let square = displacement[i] * displacement[i];
            any.or(square.above(coarse * self.squares[i]))
        })
    }
}

/// Where the slope is smaller than this, rounding errors of ψ would move the state by more
/// than some units in its last place.
const LITTLE: f64 = 1.0 / 16.0;
/// Rounding errors of ψ are below this part of its terms.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// σ: where the slope is smaller than this, the second order of r is more than a rounding
/// error of ψ.
const NONE: f64 = 1e-6;

impl<const N: usize, const M: usize, S: Masked> Level<N, M, S> {
    /// The level at the entry into a mode, or the one that was `kept` of a segment that goes on.
    #[inline(always)]
    pub(crate) fn enter<F: Dynamics<S, N, M>>(
        dynamics: &F,
        time: Time<S>,
        state: &State<N, S>,
        kept: Option<&[[f64; 2]]>,
    ) -> Self {
        let psi = match kept {
            Some(kept) => from_kept(kept),
            None => in_pairs(dynamics, time, state),
        };
        let mut level = Self {
            reference: vector(|m| psi[m].high),
            remainder: vector(|m| psi[m].low),
            scale: vector(|_| S::from_f64(0.0)),
        };
        level.rescale(dynamics, time.value, state);
        level
    }

    /// Takes the scale of slopes from the present state, which may have grown or shrunk since
    /// the entry.
    #[inline]
    pub(crate) fn rescale<F: Dynamics<S, N, M>>(
        &mut self,
        dynamics: &F,
        t: S,
        state: &State<N, S>,
    ) {
        let least = S::from_f64(f64::MIN_POSITIVE);
        let square = (0..N).fold(least, |largest, i| largest.max(state.x[i] * state.x[i]));
        let size = dynamics.conserved_size(t, &state.x);
        self.scale = vector(|m| size[m] * (size[m] / square) + least);
    }

    /// The squares of slopes below which a part of the scale is.
    #[inline(always)]
    fn bound(&self, part: f64, weights: &Weights<N, S>) -> Vector<S, M> {
        let factor = S::from_f64(part * part) * weights.largest;
        vector(|m| self.scale[m] * factor)
    }

    /// ψ(t, x) − ψ_ref, from ψ of the rounded state.
    #[inline(always)]
    fn rounded_residual(
        &self,
        psi: &Vector<S, M>,
        multiplier: &Matrix<S, M, N>,
        remainder: &Vector<S, N>,
    ) -> Vector<S, M> {
        vector(|m| {
            let drift = dot(&row(multiplier, m), remainder) - self.remainder[m];
            (psi[m] - self.reference[m]) + drift
        })
    }

    /// The displacement δx towards the level.
    #[inline(always)]
    pub(crate) fn correction<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        time: Time<S>,
        state: &State<N, S>,
        weights: &Weights<N, S>,
    ) -> Vector<S, N> {
        if M == 0 || dynamics.quantities() == 0 {
            return vector(|_| S::from_f64(0.0));
        }
        let (psi, multiplier) = dynamics.multiplier(time.value, &state.x);
        let little = self.bound(LITTLE, weights);
        let (displacement, steep) = if M == 1 {
            let row = row(&multiplier, 0);
            let weighted = weights.times(&row);
            let square = dot(&row, &weighted);
            let inverse = S::from_f64(1.0) / square;
            let remainder = remainder(dynamics, time, state);
            let residual = self.rounded_residual(&psi, &multiplier, &remainder);
            let factor = -(residual[0] * inverse);
            (vector(|i| weighted[i] * factor), square.above(little[0]))
        } else {
            let remainder = remainder(dynamics, time, state);
            let residual = self.rounded_residual(&psi, &multiplier, &remainder);
            weights.by_lane(
                &multiplier,
                &residual,
                &little,
                |projection, residual, _| projection.smallest(residual),
            )
        };
        if steep.all() {
            return displacement;
        }
        let gentle = self.gentle(dynamics, time, state, &multiplier, weights);
        steep.select_vector(&displacement, &gentle)
    }

    /// The displacement where ψ has little slope, with the residual in pairs of doubles.
    #[cold]
    #[inline(never)]
    fn gentle<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        time: Time<S>,
        state: &State<N, S>,
        multiplier: &Matrix<S, M, N>,
        weights: &Weights<N, S>,
    ) -> Vector<S, N> {
        let residual = self.residual(dynamics, time, state);
        self.towards(multiplier, &residual, weights)
    }

    /// ψ(t, x) − ψ_ref in pairs of doubles, rounded.
    #[inline(always)]
    pub(crate) fn residual<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        time: Time<S>,
        state: &State<N, S>,
    ) -> Vector<S, M> {
        let psi = in_pairs(dynamics, time, state);
        vector(|m| (psi[m] - Pair::new(self.reference[m], self.remainder[m])).high)
    }

    /// The displacement that takes a residual off.
    #[inline(always)]
    pub(crate) fn towards(
        &self,
        multiplier: &Matrix<S, M, N>,
        residual: &Vector<S, M>,
        weights: &Weights<N, S>,
    ) -> Vector<S, N> {
        let damping = self.bound(NONE, weights);
        if M == 1 {
            let row = row(multiplier, 0);
            let weighted = weights.times(&row);
            let square = dot(&row, &weighted);
            let steep = square.above(damping[0]);
            let damping = steep.select(S::from_f64(0.0), damping[0]);
            let factor = -(residual[0] / (square + damping));
            return vector(|i| weighted[i] * factor);
        }
        let gentle =
            |projection: &MinimalNorm<f64, N, M>, residual: &_, damping: &_| match projection
                .is_steep(damping)
            {
                true => projection.smallest(residual),
                false => projection.damped(residual, damping),
            };
        weights.by_lane(multiplier, residual, &damping, gentle).0
    }

    /// The state that a step over `displacement` has come to, put back on the level if it
    /// `corrects`, in the lanes that are `used`.
    #[inline(always)]
    pub(crate) fn reached<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        time: Time<S>,
        state: State<N, S>,
        displacement: &Vector<S, N>,
        (corrects, used): (bool, S::Mask),
    ) -> State<N, S> {
        if M == 0 || dynamics.quantities() == 0 || !corrects {
            return state.normalised();
        }
        let weights = Weights::new(&state.x, displacement);
        if M == 1 {
            return self.reached_at_once(dynamics, time, state, (&weights, used));
        }
        self.step_by_step(dynamics, time, state, (&weights, used))
    }

    /// The same for one quantity, where it has some slope. What a large correction leaves, the
    /// square of it, is taken off with the same slope.
    #[inline(always)]
    fn reached_at_once<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        time: Time<S>,
        state: State<N, S>,
        (weights, used): (&Weights<N, S>, S::Mask),
    ) -> State<N, S> {
        let (psi, multiplier) = dynamics.multiplier(time.value, &state.x);
        let row = row(&multiplier, 0);
        let weighted = weights.times(&row);
        let square = dot(&row, &weighted);
        let steep = square.above(self.bound(LITTLE, weights)[0]);
        let flat = steep.not().and(used);
        if !steep.and(used).any() {
            return self.reached_by_steps(dynamics, time, state, (weights, flat));
        }
        let inverse = S::from_f64(1.0) / square;
        let gain: Vector<S, N> = vector(|i| weighted[i] * inverse);
        let off = remainder(dynamics, time, &state);
        let first = self.rounded_residual(&psi, &multiplier, &off)[0];
        let mut reached = less(state, &gain, first);
        let coarse = square * (weights.unit * S::from_f64(COARSE * COARSE));
        let mut rest = flat;
        let again = (first * first).above(coarse).and(steep).and(used);
        if again.any() {
            let psi = dynamics.conserved(time.value, &reached.x);
            let off = remainder(dynamics, time, &reached);
            let second = self.rounded_residual(&psi, &multiplier, &off)[0];
            reached = select(again, &less(reached, &gain, second), &reached);
            // the same slope again leaves the product of the two
            rest = rest.or(again.and((first * second).abs().above(coarse)));
        }
        if rest.any() {
            reached = select(flat, &state, &reached);
            reached = self.reached_by_steps(dynamics, time, reached, (weights, rest));
        }
        reached
    }

    /// The same by one correction after the other, while the square of the last one is no rounding
    /// error; in the lanes that are `used`.
    #[inline(always)]
    fn reached_by_steps<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        time: Time<S>,
        state: State<N, S>,
        how: (&Weights<N, S>, S::Mask),
    ) -> State<N, S> {
        // what is not inlined does not compute in lanes
        if S::LANES == 1 {
            self.step_by_step_apart(dynamics, time, state, how)
        } else {
            self.step_by_step(dynamics, time, state, how)
        }
    }

    #[inline(never)]
    fn step_by_step_apart<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        time: Time<S>,
        state: State<N, S>,
        how: (&Weights<N, S>, S::Mask),
    ) -> State<N, S> {
        self.step_by_step(dynamics, time, state, how)
    }

    #[inline(always)]
    fn step_by_step<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        time: Time<S>,
        mut state: State<N, S>,
        (weights, mut used): (&Weights<N, S>, S::Mask),
    ) -> State<N, S> {
        /// The error falls to its square each time, and then to the part that damping leaves.
        const MOST: u32 = 9;
        for _ in 0..MOST {
            let displacement = self.correction(dynamics, time, &state, weights);
            let mut moved = state;
            for i in 0..N {
                moved.remainder[i] += displacement[i];
            }
            state = select(used, &moved.normalised(), &state);
            used = used.and(weights.are_left_by(&displacement));
            if !used.any() {
                break;
            }
        }
        state
    }
}

impl<const N: usize, const M: usize> Level<N, M> {
    /// What goes on with the next segment.
    #[cold]
    pub(crate) fn kept(&self) -> Vec<[f64; 2]> {
        let pairs = self.reference.iter().zip(&self.remainder);
        pairs.map(|(&high, &low)| [high, low]).collect()
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
        let remainder = remainder(dynamics, time, state);
        let residual = self.rounded_residual(&psi, &multiplier, &remainder);
        let size = dynamics.conserved_size(time.value, &state.x);
        let mut errors = residual.iter().zip(&size);
        errors.any(|(residual, size)| residual.abs() > ROUNDING * size)
    }
}

/// The state without `gain` times a residual.
#[inline(always)]
fn less<const N: usize, S: Masked>(
    mut state: State<N, S>,
    gain: &Vector<S, N>,
    residual: S,
) -> State<N, S> {
    for i in 0..N {
        state.remainder[i] -= gain[i] * residual;
    }
    state.normalised()
}

/// The one state where a mask is true, the other elsewhere.
#[inline(always)]
fn select<const N: usize, S: Masked>(
    mask: S::Mask,
    one: &State<N, S>,
    other: &State<N, S>,
) -> State<N, S> {
    State {
        x: mask.select_vector(&one.x, &other.x),
        remainder: mask.select_vector(&one.remainder, &other.remainder),
    }
}

/// Row m of Λ.
#[inline(always)]
fn row<S: Masked, const N: usize, const M: usize>(
    multiplier: &Matrix<S, M, N>,
    m: usize,
) -> Vector<S, N> {
    vector(|i| multiplier[(m, i)])
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
fn from_kept<S: Masked, const M: usize>(kept: &[[f64; 2]]) -> Vector<Pair<S>, M> {
    vector(|i| {
        let [high, low] = kept.get(i).copied().unwrap_or([f64::NAN; 2]);
        Pair::new(S::from_f64(high), S::from_f64(low))
    })
}

/// ψ at the state and time with their remainders.
#[inline(always)]
fn in_pairs<S: Masked, const N: usize, const M: usize, F: Dynamics<S, N, M>>(
    dynamics: &F,
    time: Time<S>,
    state: &State<N, S>,
) -> Vector<Pair<S>, M> {
    if const { N > MOST_IN_PAIRS } {
        let (psi, multiplier) = dynamics.multiplier(time.value, &state.x);
        let remainder = remainder(dynamics, time, state);
        return vector(|m| Pair::sum(psi[m], dot(&row(&multiplier, m), &remainder)));
    }
    // what is not inlined does not compute in lanes
    if S::LANES == 1 {
        return conserved_apart(dynamics, time, state);
    }
    let (t, x) = pairs(time, state);
    dynamics.over::<Pair<S>>().conserved(t, &x)
}

/// ψ in pairs, by code that is there once.
#[inline(never)]
fn conserved_apart<S: Masked, const N: usize, const M: usize, F: Dynamics<S, N, M>>(
    dynamics: &F,
    time: Time<S>,
    state: &State<N, S>,
) -> Vector<Pair<S>, M> {
    let (t, x) = pairs(time, state);
    dynamics.over::<Pair<S>>().conserved(t, &x)
}

/// g at the state and time with their remainders, rounded.
#[inline(always)]
pub(crate) fn switching_in_pairs<
    S: Masked,
    const N: usize,
    const M: usize,
    F: Dynamics<S, N, M>,
>(
    dynamics: &F,
    interface: usize,
    time: Time<S>,
    state: &State<N, S>,
) -> S {
    let (t, x) = pairs(time, state);
    let guards = dynamics.guards().over::<Pair<S>>();
    guards.switching_function(interface, t, &x).high
}

/// A time and a state as pairs of doubles.
#[inline(always)]
fn pairs<S: Masked, const N: usize>(
    time: Time<S>,
    state: &State<N, S>,
) -> (Pair<S>, Vector<Pair<S>, N>) {
    (
        Pair::new(time.value, time.remainder),
        vector(|i| Pair::new(state.x[i], state.remainder[i])),
    )
}

/// The state's remainder, as far as ψ is concerned with that of the time: ψ(t + δ, x) is
/// ψ(t, x − fδ), because ∂ₜψ = −∇ψ·f.
#[inline(always)]
fn remainder<S: Masked, const N: usize, const M: usize, F: Dynamics<S, N, M>>(
    dynamics: &F,
    time: Time<S>,
    state: &State<N, S>,
) -> Vector<S, N> {
    if dynamics.is_autonomous() || time.remainder.equals(S::from_f64(0.0)).all() {
        return state.remainder;
    }
    let field = dynamics.vector_field(time.value, &state.x);
    vector(|i| state.remainder[i] - field[i] * time.remainder)
}
