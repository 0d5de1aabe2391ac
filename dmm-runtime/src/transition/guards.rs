//! Guards: the conditions under which the quantities of a region were proved to be conserved.

use crate::error::Error;
use crate::system::{Guard, System, Vector};
use crate::transition::reading::Reading;

/// The guard that an index behind those of the interfaces stands for.
#[inline]
pub(crate) fn guard<Sys: System<N>, const N: usize>(index: usize) -> Option<&'static Guard> {
    if const { Sys::GUARDS.is_empty() } {
        return None;
    }
    index
        .checked_sub(Sys::INTERFACES.len())
        .and_then(|number| Sys::GUARDS.get(number))
}

/// Checks the guards of a region that is entered at (t, x).
///
/// # Errors
/// A condition that does not hold, or only just.
pub(crate) fn check_guards<Sys: System<N>, const N: usize>(
    system: &Sys,
    region: Sys::Region,
    t: f64,
    x: &Vector<f64, N>,
) -> Result<(), Error> {
    for (number, guard) in Sys::GUARDS.iter().enumerate() {
        if Sys::REGIONS.get(guard.region) != Some(&region) {
            continue;
        }
        let index = Sys::INTERFACES.len() + number;
        let reading = Reading::new(system, region, index, t, x);
        let holds = !reading.is_zero() && (reading.value > 0.0 || guard.keeps_sign);
        if !holds || reading.value.is_nan() {
            return Err(guard_error::<Sys, N>(guard, region, t, x));
        }
    }
    Ok(())
}

/// The error of a solution that comes to a guard.
#[cold]
pub(crate) fn guard_error<Sys: System<N>, const N: usize>(
    guard: &Guard,
    region: Sys::Region,
    t: f64,
    x: &Vector<f64, N>,
) -> Error {
    Error::ConditionFails {
        t,
        x: x.iter().copied().collect(),
        condition: guard.condition,
        quantity: guard.quantities,
        region: Sys::region_name(region),
    }
}
