//! How what is false is shown: the residual, a point, and the value there.

use crate::algebra::{Counterexample, Dag, Name, to_text};
use crate::model::Region;

/// Residuals are shown up to this many characters.
const LONGEST_RESIDUAL: usize = 240;
/// Coordinates that are zero are summed up if there are more than this.
const MOST_ZEROS: usize = 4;

/// ` in the region …`, nothing where there is just one.
pub(super) fn in_region(region: &Region) -> String {
    if region.sides.is_empty() {
        String::new()
    } else {
        format!(" in the region `{}`", region.ident)
    }
}

/// `x*y, which is 0.25 at x = 0.5, y = 0.5`
pub(super) fn refutation(dag: &Dag, counterexample: &Counterexample) -> String {
    let residual = shortened(&to_text(dag, counterexample.residual));
    if dag.as_constant(counterexample.residual).is_some() {
        return residual;
    }
    let value = rounded(counterexample.value);
    let depends: Vec<Name> = dag.variables([counterexample.residual]);
    let point: Vec<(Name, f64)> = counterexample
        .point
        .iter()
        .filter(|(name, _)| depends.contains(name))
        .cloned()
        .collect();
    if point.is_empty() {
        format!("{residual}, which is {value}")
    } else {
        format!("{residual}, which is {value} at {}", coordinates(&point))
    }
}

/// `x = 1, y = 2`
pub(super) fn coordinates(point: &[(Name, f64)]) -> String {
    let zeros = point.iter().filter(|(_, value)| *value == 0.0).count();
    let sums_up = zeros > MOST_ZEROS;
    let mut parts: Vec<String> = point
        .iter()
        .filter(|(_, value)| !sums_up || *value != 0.0)
        .map(|(name, value)| format!("{name} = {}", rounded(*value)))
        .collect();
    if sums_up {
        parts.push("everything else 0".into());
    }
    parts.join(", ")
}

/// `text`, cut off where it is too long to be read.
pub(super) fn shortened(text: &str) -> String {
    if text.chars().count() <= LONGEST_RESIDUAL {
        return text.to_owned();
    }
    let beginning: String = text.chars().take(LONGEST_RESIDUAL).collect();
    format!("{beginning}…")
}

/// Four significant digits.
pub(super) fn rounded(value: f64) -> String {
    let scientific = format!("{value:.3e}");
    let shorter: f64 = scientific.parse().unwrap_or(value);
    if shorter == 0.0 || (1e-3..1e5).contains(&shorter.abs()) {
        format!("{shorter}")
    } else {
        format!("{shorter:e}")
    }
}
