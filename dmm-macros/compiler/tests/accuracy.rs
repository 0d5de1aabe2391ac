//! Optimised code rounds no worse than what it was made from.

#[path = "accuracy/mod.rs"]
mod accuracy;
#[path = "../benches/declarations/mod.rs"]
mod declarations;

use accuracy::{measure, scheme};

/// Points a step size; the example `accuracy` takes more.
const POINTS: usize = 2;

/// Larger systems repeat what smaller ones have.
const MOST_STATES: usize = 16;

/// The mean error against that of the operations as they are written: another order of sums
/// and shared reciprocals round otherwise, here less and there more.
const MEAN: f64 = 1.5;

/// The greatest error against that of the operations as they are written, one of which may be
/// lucky: a reciprocal shared by two quotients has three roundings where each had one.
const GREATEST: f64 = 3.0;

#[test]
fn optimised_operations_are_as_accurate_as_written_ones() {
    let found = declarations::declarations(&declarations::problems()).expect("the problems");
    let mut measured = 0;
    for (file, declaration) in found {
        let scheme =
            scheme(declaration).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        if scheme.model.states.len() > MOST_STATES {
            continue;
        }
        for row in measure(&scheme, POINTS) {
            let what = row.function.join(" ");
            let (mean, greatest) = row.optimised.parts();
            let (mean_before, greatest_before) = row.written.parts();
            assert!(
                mean <= MEAN * mean_before + 0.02,
                "{what}: mean {mean}, as written {mean_before}"
            );
            assert!(
                greatest <= GREATEST * greatest_before.max(0.1),
                "{what}: greatest {greatest}, as written {greatest_before}"
            );
            // and within the bound of what was written
            assert!(greatest <= 1.0, "{what}: {greatest} of the bound");
            measured += row.optimised.count();
        }
    }
    assert!(measured > 10_000, "only {measured} values were compared");
}
