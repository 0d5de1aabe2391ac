//! The conditions under which the quantities of a region were proved to be conserved.

use super::reading::Reading;
use crate::contract::{Condition, System, Vector};
use crate::error::{Error, ErrorKind};

/// The condition that the index of a guard behind those of the interfaces stands for.
#[inline]
pub(crate) fn condition<Sys: System<N>, const N: usize>(
    index: usize,
) -> Option<&'static Condition> {
    if const { Sys::CONDITIONS.is_empty() } {
        return None;
    }
    index
        .checked_sub(Sys::INTERFACES.len())
        .and_then(|number| Sys::CONDITIONS.get(number))
}

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
    for (number, condition) in Sys::CONDITIONS.iter().enumerate() {
        if Sys::REGIONS.get(condition.region) != Some(&region) {
            continue;
        }
        let index = Sys::INTERFACES.len() + number;
        let reading = Reading::new(system, region, index, t, x);
        let holds = !reading.is_zero() && (reading.value > 0.0 || condition.keeps_sign);
        if !holds || reading.value.is_nan() {
            return Err(condition_error::<Sys, N>(condition, region, t, x));
        }
    }
    Ok(())
}

/// The error of a solution that leaves a condition.
#[cold]
pub(crate) fn condition_error<Sys: System<N>, const N: usize>(
    condition: &Condition,
    region: Sys::Region,
    t: f64,
    x: &Vector<f64, N>,
) -> Error {
    let kind = ErrorKind::ConditionFails {
        condition: condition.condition,
        quantity: condition.quantities,
    };
    kind.at(t, x.as_slice(), Sys::region_name(region))
}
