//! ψ and g at a state and a time with their remainders, in pairs of doubles.

use super::row;
use crate::arithmetic::double::Pair;
use crate::arithmetic::linear::dot;
use crate::arithmetic::masked::{Mask, Masked, vector};
use crate::arithmetic::{State, Time};
use crate::contract::{Dynamics, Guards, Vector};

/// Of more states ψ has so many terms that their code in pairs of doubles is out of proportion:
/// there ψ is evaluated in doubles, and the remainders enter by its slope.
pub(super) const MOST_IN_PAIRS: usize = 12;

/// ψ at the state and time with their remainders.
#[inline(always)]
pub(super) fn in_pairs<S: Masked, const N: usize, const M: usize, F: Dynamics<S, N, M>>(
    dynamics: &F,
    time: Time<S>,
    state: &State<N, S>,
) -> Vector<Pair<S>, M> {
    if const { N > MOST_IN_PAIRS } {
        let (psi, multiplier) = dynamics.multiplier(time.value, &state.x);
        let remainder = remainder(dynamics, time, state);
        return vector!(|m| Pair::sum(psi[m], dot(&row(&multiplier, m), &remainder)));
    }
    // what is not inlined does not compute in lanes
    if S::LANES == 1 {
        let psi = conserved_apart(dynamics, time, state);
        return vector!(|m| psi[m].by_numbers());
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
pub(super) fn switching_in_pairs<
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
        vector!(|i| Pair::new(state.x[i], state.remainder[i])),
    )
}

/// The state's remainder, as far as ψ is concerned with that of the time: ψ(t + δ, x) is
/// ψ(t, x − fδ), because ∂ₜψ = −∇ψ·f.
#[inline(always)]
pub(super) fn remainder<S: Masked, const N: usize, const M: usize, F: Dynamics<S, N, M>>(
    dynamics: &F,
    time: Time<S>,
    state: &State<N, S>,
) -> Vector<S, N> {
    if dynamics.is_autonomous() || time.remainder.equals(S::from_f64(0.0)).all() {
        return state.remainder;
    }
    let field = dynamics.vector_field(time.value, &state.x);
    vector!(|i| state.remainder[i] - field[i] * time.remainder)
}
