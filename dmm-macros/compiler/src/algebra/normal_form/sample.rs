//! Sampling: deterministic pseudo-random points at which an expression may turn out to be
//! clearly not zero. Nothing is ever proved to be zero by it.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_traits::{ToPrimitive, Zero};

use super::super::evaluate::evaluate_exactly;
use super::super::{Dag, Id, Math, Name, Rational, evaluate_bounded};

/// Points tried before the answer is "undecided".
const POINTS: usize = 64;
/// Points tried before a normal form is computed: one of every range.
const FIRST_POINTS: usize = RANGES.len();
/// Points at which an expression is evaluated exactly.
const EXACT_POINTS: usize = 8;
/// A value is clearly not zero where it exceeds the bound of its rounding error by this factor.
const CLEARLY: f64 = 1e4;
/// The ranges from which the coordinates are drawn, in turn.
const RANGES: [(f64, f64); 4] = [(0.2, 2.0), (-2.0, 2.0), (0.05, 0.55), (-0.9, 0.9)];
/// Coordinates have this many decimals, written as the power of ten.
const DECIMALS: f64 = 1e3;
/// Coordinates that are read faster than random ones, the best first.
const SHORT: [f64; 4] = [1.0, 2.0, 0.5, 3.0];
/// With more coordinates than this, zeros come before all other numbers.
const FEW: usize = 6;

/// A point and the clearly non-zero value of an expression there.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub(super) coordinates: Vec<(Name, f64)>,
    pub(super) value: f64,
}

/// The first of a few points at which `roots`\[0\] is clearly not zero and every other root is
/// defined.
pub(super) fn soon_non_zero(dag: &Dag, roots: &[Id]) -> Option<Point> {
    let root = *roots.first()?;
    points(dag, roots, FIRST_POINTS).find_map(|point| clearly_non_zero(dag, root, roots, point))
}

/// The first point at which `root` is clearly not zero, and `domain` defined.
pub(super) fn non_zero(dag: &Dag, root: Id, domain: &[Id]) -> Option<Point> {
    points(dag, domain, POINTS).find_map(|point| clearly_non_zero(dag, root, domain, point))
}

/// The first point at which `root` has a rational value that is not zero, and `domain` is
/// defined.
pub(super) fn exactly_non_zero(dag: &Dag, root: Id, domain: &[Id]) -> Option<Point> {
    let is_rational = |id: &Id| !matches!(dag[*id], Math::Pi | Math::Call(..) | Math::Pair(..));
    if !dag.reachable([root]).iter().all(is_rational) {
        return None;
    }
    points(dag, domain, EXACT_POINTS).find_map(|point| {
        let values: BTreeMap<Name, Rational> = point
            .iter()
            .map(|(name, value)| (name.clone(), as_written(*value)))
            .collect();
        let value = evaluate_exactly(dag, root, &values)?;
        let found = !value.is_zero() && is_defined(dag, domain, &point);
        found.then(|| Point {
            coordinates: point,
            value: value.to_f64().unwrap_or(f64::NAN),
        })
    })
}

/// The decimal number that was rounded to `value`.
fn as_written(value: f64) -> Rational {
    let scaled = (value * DECIMALS).round() as i64;
    Rational::new(BigInt::from(scaled), BigInt::from(DECIMALS as i64))
}

/// `found` with coordinates replaced by short numbers one by one, as long as `residual` stays
/// clearly non-zero and `domain` defined.
pub(super) fn shortened(dag: &Dag, residual: Id, domain: &[Id], found: Point) -> Point {
    let depends = dag.variables([residual]);
    let mut best = found;
    let attempt = |point: Vec<(Name, f64)>| clearly_non_zero(dag, residual, domain, point);
    let Some(confirmed) = attempt(best.coordinates.clone()) else {
        return best;
    };
    best = confirmed;
    let zero = (depends.len() > FEW).then_some(0.0);
    for index in 0..best.coordinates.len() {
        let candidates = zero.into_iter().chain(SHORT);
        for candidate in candidates {
            let mut point = best.coordinates.clone();
            if let Some((_, coordinate)) = point.get_mut(index) {
                *coordinate = candidate;
            }
            if let Some(shorter) = attempt(point) {
                best = shorter;
                break;
            }
        }
    }
    best
}

fn clearly_non_zero(dag: &Dag, root: Id, domain: &[Id], point: Vec<(Name, f64)>) -> Option<Point> {
    let values: BTreeMap<Name, f64> = point.iter().cloned().collect();
    let roots: Vec<Id> = [root].into_iter().chain(domain.iter().copied()).collect();
    let evaluated = evaluate_bounded(dag, &roots, &values);
    let &(value, error) = evaluated.first()?;
    let clear = value.is_finite() && value.abs() > CLEARLY * error && value != 0.0;
    let defined = evaluated.iter().all(|(value, _)| value.is_finite());
    (clear && defined).then_some(Point {
        coordinates: point,
        value,
    })
}

fn is_defined(dag: &Dag, domain: &[Id], point: &[(Name, f64)]) -> bool {
    let values: BTreeMap<Name, f64> = point.iter().cloned().collect();
    evaluate_bounded(dag, domain, &values)
        .iter()
        .all(|(value, _)| value.is_finite())
}

/// `count` points over the variables of `roots`.
fn points(dag: &Dag, roots: &[Id], count: usize) -> impl Iterator<Item = Vec<(Name, f64)>> + use<> {
    let names = dag.variables(roots.iter().copied());
    let mut generator = Generator(0x9e37_79b9_7f4a_7c15);
    (0..count)
        .zip(RANGES.iter().cycle())
        .map(move |(_, &(low, high))| {
            names
                .iter()
                .map(|name| (name.clone(), generator.draw(low, high)))
                .collect()
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
        ((low + unit * (high - low)) * DECIMALS).round() / DECIMALS
    }
}
