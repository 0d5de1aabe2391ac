//! Families of systems: what `pws!` makes of a declaration, and the same once more in the
//! formulas of the reference solution.
//!
//! The states are a position x and a velocity v (three numbers in one family), l times a number
//! u and w of the order of 1, and change s times as fast as in the unit of time.

use dmm_runtime::System;

use crate::formula::{Formula, Formulas, Writer};
use crate::reference::Problem;
use dmm_problems::random::Random;

mod affine;
mod algebraic;
mod transcendental;

pub(super) use affine::{Plane, Space};
pub(super) use algebraic::{Bell, Bent, Flat, Polynomial, Rational, Root};
pub(super) use transcendental::{Clock, Exponential, Hyperbolic, Logarithm, Sheets, Wave};

/// The scales of length and of rates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales {
    pub(super) l: f64,
    pub(super) s: f64,
}

/// A family of systems with N states.
pub(super) trait Family<const N: usize>: System<N> + Default {
    /// What its switching function is.
    const TITLE: &'static str;

    /// A member, and where it starts.
    fn draw(random: &mut Random, scales: Scales) -> (Self, [f64; N]);

    /// The member in formulas.
    fn problem(&self, initial: [f64; N]) -> Problem;
}

/// The formulas of a system, with its scales.
fn problem<const N: usize>(
    Scales { l, s }: Scales,
    initial: [f64; N],
    fields: Vec<Formulas>,
    switching: Formulas,
) -> Problem {
    Problem {
        fields,
        switching,
        initial: initial.to_vec(),
        size: l,
        rate: s,
    }
}

/// F(u, w, s t)
type Force = Box<dyn for<'w> Fn([Formula<'w>; 3]) -> Formula<'w>>;

/// ẋ = s v, v̇ = s l F(u, w, s t) for each F.
fn moving(Scales { l, s }: Scales, forces: Vec<Force>) -> Vec<Formulas> {
    let field = |force: Force| {
        Formulas::of(|w: &Writer| {
            let [x, v] = w.state();
            let force = force([x / l, v / l, w.time() * s]);
            vec![v * s, force * (s * l)]
        })
    };
    forces.into_iter().map(field).collect()
}

/// g(u, w, s t)
fn switching(
    Scales { l, s }: Scales,
    g: impl for<'w> Fn([Formula<'w>; 3]) -> Formula<'w>,
) -> Formulas {
    Formulas::of(|w: &Writer| {
        let [x, v] = w.state();
        vec![g([x / l, v / l, w.time() * s])]
    })
}

/// A start in the plane.
fn start(random: &mut Random, l: f64) -> [f64; 2] {
    let angle = random.between(0.0, std::f64::consts::TAU);
    let radius = random.between(0.3, 1.6);
    [l * radius * angle.cos(), l * radius * angle.sin()]
}
