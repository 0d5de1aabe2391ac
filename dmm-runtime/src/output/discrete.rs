//! The discrete states of a mode, as they are declared.

use crate::contract::System;

/// The values of [`Metadata::declared_discrete`](crate::Metadata::declared_discrete) in a mode.
pub(super) fn discrete<Sys: System<N>, const N: usize>(
    system: &Sys,
    mode: Sys::Region,
) -> Vec<f64> {
    let metadata = system.metadata();
    if metadata.discrete.is_empty() {
        return Vec::new();
    }
    metadata.declared_values(&Sys::constants(mode))
}
