//! From phase to phase: an integrator of smooth fields goes on until a root, where the next phase
//! begins with its own field. The clock begins anew with each phase, because roots are located to a
//! multiple of the rounding error of the time.

use crate::Outcome;
use crate::plain::Plain;

/// The tolerances of a peer.
#[derive(Clone, Copy)]
pub struct Tolerances {
    pub relative: f64,
    /// As a multiple of the sizes of components.
    pub absolute: f64,
}

impl Tolerances {
    /// The absolute tolerance of each component.
    pub fn of_components<P: Plain<N>, const N: usize>(self) -> [f64; N] {
        P::SIZES.map(|size| self.absolute * size)
    }
}

/// What was made of a phase.
pub struct Part<const N: usize> {
    /// The time that it took.
    pub t: f64,
    pub x: [f64; N],
    pub steps: u64,
    /// Whether a root ended it.
    pub root: bool,
}

/// How a run ended.
pub struct End<const N: usize> {
    pub x: [f64; N],
    pub steps: u64,
    /// How often the phase has changed.
    pub changes: u64,
}

/// More phases than any problem has.
const MOST: usize = 1000;

/// A run, by a function that integrates from a state for a time unless a root comes before.
pub fn integrate<P: Plain<N>, const N: usize>(
    mut part: impl FnMut(P::Phase, [f64; N], f64) -> Outcome<Part<N>>,
) -> Outcome<End<N>> {
    let (mut phase, mut left) = (P::Phase::default(), P::T_END);
    let mut end = End {
        x: P::INITIAL,
        steps: 0,
        changes: 0,
    };
    for _ in 0..MOST {
        let made = part(phase, end.x, left)?;
        end.x = made.x;
        end.steps += made.steps;
        left -= made.t;
        if !made.root {
            return Ok(end);
        }
        let next = P::next(phase, &mut end.x);
        end.changes += u64::from(next != phase);
        phase = next;
    }
    Err("too many phases".into())
}
