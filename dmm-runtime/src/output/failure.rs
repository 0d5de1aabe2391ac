//! What stopped a method, with the names of the system.

use crate::arithmetic::traced::{Fault, Traced};
use crate::arithmetic::{Scalar, Vector};
use crate::contract::{Dynamics, DynamicsVisitor, System};
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
        let (t, x) = (cursor.time.value, &cursor.state.x);
        let kind = match self.kind {
            FailureKind::Step(StepFailure::NotFinite) => {
                let tau = self.step_size;
                match system.visit(region, Diagnose { t, x, tau }) {
                    Some(Fault::Overflow) => ErrorKind::Overflow,
                    Some(Fault::Undefined(function, argument)) => {
                        let kind = ErrorKind::Undefined { function, argument };
                        return kind.at(t, x.as_slice(), system.of_region(region).name);
                    }
                    None => ErrorKind::LeftDomain,
                }
            }
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
        kind.at(t, x.as_slice(), system.of_region(region).name)
            .in_step(self.step_size)
    }
}

/// Why a step over τ from (t, x) has no finite values: what f(t, x) and ψ(t, x) lack, or a solution
/// whose squares overflow within the step if it goes on growing as it does at its start.
struct Diagnose<'a, const N: usize> {
    t: f64,
    x: &'a Vector<f64, N>,
    tau: f64,
}

impl<const N: usize> DynamicsVisitor<N> for Diagnose<'_, N> {
    type Output = Option<Fault>;

    fn visit<const M: usize, F: Dynamics<f64, N, M>>(self, dynamics: &F) -> Option<Fault> {
        /// ln of the largest number whose square is a double: methods take squares of states.
        const LARGEST: f64 = 354.8;
        let dynamics = dynamics.over::<Traced>();
        let (t, x) = (Traced::from_f64(self.t), self.x.map(Traced::from_f64));
        let field = dynamics.vector_field(t, &x);
        if let Some(fault) = field.iter().find_map(|u| u.fault) {
            return Some(fault);
        }
        let psi = dynamics.conserved(t, &x);
        let mut faults = psi.iter().filter_map(|u| u.fault);
        if faults.any(|fault| fault == Fault::Overflow) {
            return Some(Fault::Overflow);
        }
        // x_i exp(τ f_i/x_i)
        let mut growths = x.iter().zip(&field).map(|(x, f)| {
            let (x, f) = (x.value.abs(), f.value);
            x.ln() + f.abs() / x * self.tau
        });
        growths
            .any(|growth| growth > LARGEST)
            .then_some(Fault::Overflow)
    }
}
