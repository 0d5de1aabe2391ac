//! The discrete states of a mode, as they are declared.

use crate::contract::System;

/// The values of [`Metadata::declared_discrete`](crate::Metadata::declared_discrete) in a mode.
pub(super) fn discrete<Sys: System<N>, const N: usize>(
    system: &Sys,
    mode: Sys::Region,
) -> Vec<f64> {
    let mut declared = system.metadata().declared_discrete().peekable();
    if declared.peek().is_none() {
        return Vec::new();
    }
    let constants = Sys::constants(mode);
    let values = declared.map(|(index, _)| constants.get(index).copied());
    values.map(|value| value.unwrap_or(f64::NAN)).collect()
}
