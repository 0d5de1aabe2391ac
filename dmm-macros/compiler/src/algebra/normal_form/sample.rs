//! Sampling: deterministic pseudo-random points at which an expression may turn out to be
//! clearly not zero. Nothing is ever proved by it.

use std::collections::BTreeMap;

use super::super::{Dag, Id, Name, evaluate_bounded};

/// Points tried before the answer is "undecided".
const POINTS: usize = 64;
/// Points tried before a normal form is computed: one of every range.
const FIRST_POINTS: usize = RANGES.len();
/// A value is clearly not zero where it exceeds the bound of its rounding error by this factor.
const CLEARLY: f64 = 1e4;
/// The ranges from which the coordinates are drawn, in turn.
const RANGES: [(f64, f64); 4] = [(0.2, 2.0), (-2.0, 2.0), (0.05, 0.55), (-0.9, 0.9)];

/// A point and the clearly non-zero value of an expression there.
pub(super) type Sample = (Vec<(Name, f64)>, f64);

/// The first of a few points at which `root` is clearly not zero.
pub(super) fn soon_non_zero(dag: &Dag, root: Id) -> Option<Sample> {
    among(dag, root, FIRST_POINTS)
}

/// The first point at which `root` is clearly not zero.
pub(super) fn non_zero(dag: &Dag, root: Id) -> Option<Sample> {
    among(dag, root, POINTS)
}

fn among(dag: &Dag, root: Id, points: usize) -> Option<Sample> {
    let names = dag.variables([root]);
    let mut generator = Generator(0x9e37_79b9_7f4a_7c15);
    (0..points)
        .zip(RANGES.iter().cycle())
        .find_map(|(_, &(low, high))| {
            let point: Vec<(Name, f64)> = names
                .iter()
                .map(|name| (name.clone(), generator.draw(low, high)))
                .collect();
            let values: BTreeMap<Name, f64> = point.iter().cloned().collect();
            let &(value, error) = evaluate_bounded(dag, &[root], &values).first()?;
            let clear = value.is_finite() && value.abs() > CLEARLY * error && value != 0.0;
            clear.then_some((point, value))
        })
}

/// A linear congruential generator (Knuth's MMIX constants).
struct Generator(u64);

impl Generator {
    /// A number in \[low, high\] with few decimals, so that a point can be read and copied.
    fn draw(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let unit = (self.0 >> 11) as f64 / (1_u64 << 53) as f64;
        ((low + unit * (high - low)) * 1e3).round() / 1e3
    }
}
