//! The conditions under which the quantities of a region were proved to be conserved.

use super::reading::Reading;
use crate::contract::{Condition, System, Vector};
use crate::error::{Error, ErrorKind};

/// Checks the conditions of a region that is entered at (t, x).
///
/// # Errors
/// A condition that does not hold, or only just.
pub(crate) fn check_conditions<Sys: System<N>, const N: usize>(
    system: &Sys,
    region: Sys::Region,
    t: f64,
    x: &Vector<f64, N>,
) -> Result<(), Error> {
    let metadata = system.metadata();
    for (number, condition) in metadata.conditions.iter().enumerate() {
        if condition.region != Sys::index(region) {
            continue;
        }
        let index = metadata.first_condition() + number;
        let reading = Reading::new(system, region, index, t, x);
        let holds = !reading.is_zero() && (reading.value > 0.0 || condition.keeps_sign);
        if !holds || reading.value.is_nan() {
            let name = system.of_region(region).name;
            return Err(condition_error(condition, name, t, x));
        }
    }
    Ok(())
}

/// The error of a solution that leaves a condition.
#[cold]
pub(crate) fn condition_error<const N: usize>(
    condition: &Condition,
    region: &'static str,
    t: f64,
    x: &Vector<f64, N>,
) -> Error {
    let kind = ErrorKind::ConditionFails {
        condition: condition.condition,
        quantity: condition.quantities,
    };
    kind.at(t, x.as_slice(), region)
}
