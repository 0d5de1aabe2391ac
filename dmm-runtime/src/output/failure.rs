//! What stopped a method, with the names of the system.

use crate::contract::System;
use crate::error::{Error, ErrorKind};
use crate::method::{Cursor, Failure, FailureKind, StepFailure};

impl Failure {
    /// The error at a cursor, with the names of the system.
    #[cold]
    pub(crate) fn named<Sys: System<N>, const N: usize>(
        self,
        system: &Sys,
        cursor: &Cursor<N>,
        region: Sys::Region,
    ) -> Error {
        let names = system.metadata();
        let kind = match self.kind {
            FailureKind::Step(StepFailure::NotFinite) => ErrorKind::LeftDomain,
            FailureKind::Step(StepFailure::NoConvergence {
                residual,
                iterations,
            }) => ErrorKind::NewtonFailed {
                residual,
                iterations,
            },
            FailureKind::NotLocated { guard } => ErrorKind::LocationFailed {
                interface: names.guard_name(guard),
            },
            FailureKind::Undecided { guard } => ErrorKind::Undecided {
                interface: names.guard_name(guard),
            },
        };
        let (t, x) = (cursor.time.value, cursor.state.x.as_slice());
        kind.at(t, x, system.of_region(region).name)
            .in_step(self.step_size)
    }
}
