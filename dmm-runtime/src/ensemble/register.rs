//! The trajectories in the lanes of a register.

use crate::arithmetic::lanes::{LaneMask, Lanes};
use crate::arithmetic::masked::{Mask, Masked};
use crate::arithmetic::{Scalar, State, Time};
use crate::contract::Vector;

/// Trajectories that are stepped together: two vectors, of which one is computed with while the other waits.
/// Vectors have eight doubles in a build for a processor that has such, and four otherwise.
pub(super) const WIDTH: usize = if cfg!(target_feature = "avx512f") {
    16
} else {
    8
};

/// A truth value of each trajectory.
pub(super) type WideMask = LaneMask<WIDTH>;

/// A scalar of each trajectory.
pub(super) type Wide = Lanes<WIDTH>;

/// Why the trajectory in a lane needs attention.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Leave {
    /// It does not.
    Not,
    /// It is at the end time.
    Finished,
    /// It crosses an interface in this step.
    Crosses(usize),
    /// It is on the interface.
    Crossed(usize),
    /// Its step needs a closer look, or cannot be made.
    Hard,
}

/// An interface that lanes have moved to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reached {
    pub(super) interface: usize,
    /// Whether all lanes in use are on it.
    pub(super) by_all: bool,
}

impl Leave {
    const FINISHED: f64 = 1.0;
    const CROSSED: f64 = 2.0;
    const CROSSES: f64 = 3.0;
    const HARD: f64 = -1.0;
}

/// The lanes: (t, x) of each with its remainders, and the level of its region.
#[derive(Clone, Debug)]
#[repr(C)]
pub(super) struct Register<const N: usize> {
    pub(super) time: Time<Wide>,
    pub(super) state: State<N, Wide>,
    /// The size of the step before.
    pub(super) before: Wide,
    /// A [`Level`](crate::level::Level), its parts.
    pub(super) level: [Vector<Wide, N>; 3],
    /// So long after the start of its step g begins to fall.
    pub(super) from: Wide,
    /// About how long after the start of its step a lane meets an interface.
    pub(super) elapsed: Wide,
    /// The size of that step.
    pub(super) tau: Wide,
    /// dg/dt on the interface.
    pub(super) rate: Wide,
    /// Steps made.
    pub(super) steps: Wide,
    /// Steps made since the scale of the level was taken.
    pub(super) since: Wide,
    /// How many steps are still made without a correction of the level.
    pub(super) free: Wide,
    /// 1 in a lane that is not used, else 0.
    idle: Wide,
    /// A [`Leave`] as a number.
    leave: Wide,
    /// The interface that is crossed.
    interface: Wide,
    /// The interface that lanes have just moved to.
    reached: Option<Reached>,
    /// The trajectories.
    pub(super) slots: [usize; WIDTH],
}

impl<const N: usize> Register<N> {
    pub(super) fn new() -> Self {
        let zero = Wide::from_f64(0.0);
        let vector = Vector::from_element(zero);
        Self {
            time: Time::new(zero),
            state: State::new(vector),
            before: zero,
            level: [vector; 3],
            from: zero,
            elapsed: zero,
            tau: zero,
            rate: zero,
            steps: zero,
            since: zero,
            free: zero,
            idle: zero,
            leave: zero,
            interface: zero,
            reached: None,
            slots: [0; WIDTH],
        }
    }

    /// Puts a lane to use, or out of it.
    pub(super) fn set_idle(&mut self, lane: usize, idle: bool) {
        self.idle.0[lane] = f64::from(u8::from(idle));
        self.leave.0[lane] = 0.0;
    }

    pub(super) fn is_idle(&self, lane: usize) -> bool {
        self.idle.0[lane] != 0.0
    }

    /// The lanes in use.
    #[inline(always)]
    pub(super) fn used(&self) -> WideMask {
        self.idle.equals(Wide::from_f64(0.0))
    }

    /// The first of them.
    #[inline]
    fn first_used(&self) -> Option<usize> {
        (0..WIDTH).find(|&lane| !self.is_idle(lane))
    }

    /// Notes which lanes need attention, the first mask that applies, and tells whether there
    /// are any in use.
    #[inline(always)]
    pub(super) fn note(
        &mut self,
        hard: WideMask,
        (crosses, interface): (WideMask, Wide),
        finished: WideMask,
    ) -> bool {
        let mark = Wide::from_f64;
        let not = self.idle * mark(0.0);
        let leave = finished.select(mark(Leave::FINISHED), not);
        let leave = crosses.select(mark(Leave::CROSSES), leave);
        let leave = hard.select(mark(Leave::HARD), leave);
        self.leave = leave;
        self.interface = interface;
        self.reached = None;
        let used = mark(1.0) - self.idle;
        let marked = (leave * leave * used).0;
        marked.iter().sum::<f64>() != 0.0
    }

    /// The interface that all lanes in use cross in their next step.
    #[inline(always)]
    pub(super) fn crossed_by_all(&self) -> Option<usize> {
        let first = self.first_used()?;
        let crosses = self.leave.equals(Wide::from_f64(Leave::CROSSES));
        let same = self
            .interface
            .equals(Wide::from_f64(self.interface.0[first]));
        let all = crosses.and(same).all_of(self.used());
        all.then_some(self.interface.0[first] as usize)
    }

    /// Notes which lanes have reached the interface; the others need a closer look.
    #[inline(always)]
    pub(super) fn note_crossed(&mut self, crossed: WideMask, interface: usize) {
        let mark = Wide::from_f64;
        self.interface = mark(interface as f64);
        self.leave = crossed.select(mark(Leave::CROSSED), mark(Leave::HARD));
        self.reached = Some(Reached {
            interface,
            by_all: crossed.all_of(self.used()),
        });
    }

    /// The interface that lanes have just moved to.
    pub(super) fn reached(&self) -> Option<Reached> {
        self.reached
    }

    /// Why a lane in use needs attention.
    pub(super) fn leave(&self, lane: usize) -> Leave {
        match self.leave.0[lane] {
            0.0 => Leave::Not,
            Leave::FINISHED => Leave::Finished,
            Leave::CROSSED => Leave::Crossed(self.interface.0[lane] as usize),
            Leave::CROSSES => Leave::Crosses(self.interface.0[lane] as usize),
            _ => Leave::Hard,
        }
    }
}
