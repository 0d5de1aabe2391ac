//! The point where all lanes of a register meet an interface, in their next step.

use super::kernel::Run;
use super::register::Wide;
use crate::arithmetic::Scalar;
use crate::arithmetic::masked::{Mask, vector};
use crate::contract::Dynamics;
use crate::level::{Found, GuardPoint};

impl<F: Dynamics<Wide, N, M>, const N: usize, const M: usize> Run<'_, F, N, M> {
    /// Moves every lane to the interface: t̂* and x̂* such that g = 0 and ψ keeps its level.
    #[inline(always)]
    pub(super) fn cross(&mut self, interface: usize) {
        let n = Wide::from_f64;
        let (used, tau) = (self.register.used(), self.register.tau);
        let c = self.first_switching().as_ref()[interface];
        let found = Found {
            guard: interface,
            sign: self.sign(interface),
            elapsed: self.register.elapsed,
            bracket: (self.register.from, tau),
            start: Some((c[0], c[1])),
        };
        let start = self.register.time;
        let along = |elapsed| self.after(elapsed);
        let ((time, state), located) =
            GuardPoint::near(self.dynamics, &found, start, tau, along, used);
        let increment = vector!(|i| state.x[i] - self.register.state.x[i]);
        let how = (self.settings.corrects, located);
        let level = self.register.level();
        let near = (time, &state);
        let (there, crossed) =
            GuardPoint::settled(near, self.dynamics, &level, interface, &increment, how);
        self.register.move_to(crossed, &(there.time, there.state));
        self.register.rate = there.rate;
        self.register.before = crossed.select(tau, self.register.before);
        self.register.steps += crossed.select(n(1.0), n(0.0));
        self.register.note_crossed(crossed, interface);
    }
}
