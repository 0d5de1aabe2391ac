//! Segment after segment: Algorithm 2.1 of Hirani, Wan & Wojtalewicz (Mannshardt's transition
//! scheme) with the region as explicit state. It is never inferred again from the sign of g
//! after a transition, so that x̂* belongs to the region entered whatever rounding did, and the
//! located point never fires again.

use std::ops::ControlFlow;

use crate::error::Error;
use crate::observer::{Observer, Transition};
use crate::scheme::Scheme;
use crate::state::State;
use crate::system::{System, Vector};
use crate::time::Time;
use crate::transition::{Locator, Meeting, check_guards, guard, guard_error};
use crate::walk::{SegmentEnd, Walk};

/// Transitions that one step may have.
const LARGEST_TRANSITIONS_A_STEP: u64 = 1000;

/// The transitions of one step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Crowd {
    step: u64,
    transitions: u64,
}

impl Crowd {
    /// Counts a transition in the step with a number, of which there must not be too many.
    pub(crate) fn count<Sys: System<N>, const N: usize>(
        &mut self,
        step: u64,
        interface: usize,
        t: f64,
        x: &Vector<f64, N>,
    ) -> Result<(), Error> {
        self.transitions = if step == self.step {
            self.transitions + 1
        } else {
            1
        };
        self.step = step;
        if self.transitions > LARGEST_TRANSITIONS_A_STEP {
            return Err(Error::Zeno {
                t,
                x: x.iter().copied().collect(),
                interface: Sys::boundary_name(interface),
                limit: LARGEST_TRANSITIONS_A_STEP,
            });
        }
        Ok(())
    }
}

/// Segment after segment, until the end time or the observer's wish.
pub(crate) fn run_segments<Sys, Sch, Loc, Obs, const N: usize>(
    walk: &mut Walk<'_, Sys, Sch, Loc, Obs, N>,
) -> Result<(), Error>
where
    Sys: System<N>,
    Sch: Scheme,
    Loc: Locator,
    Obs: Observer<Sys::Region, N>,
{
    let mut crowd = Crowd::default();
    while run_segment(walk, &mut crowd)?.is_continue() {}
    Ok(())
}

/// A segment, and the transition at its end if there is one; breaks at the end time or by the
/// observer's wish.
#[inline(always)]
pub(crate) fn run_segment<Sys, Sch, Loc, Obs, const N: usize>(
    walk: &mut Walk<'_, Sys, Sch, Loc, Obs, N>,
    crowd: &mut Crowd,
) -> Result<ControlFlow<()>, Error>
where
    Sys: System<N>,
    Sch: Scheme,
    Loc: Locator,
    Obs: Observer<Sys::Region, N>,
{
    let system = walk.system;
    let (interface, rate_from) = match system.visit(walk.region, &mut *walk)? {
        SegmentEnd::Finished | SegmentEnd::Stopped => return Ok(ControlFlow::Break(())),
        SegmentEnd::Crossed { interface, rate } => (interface, rate),
    };
    if let Some(guard) = guard::<Sys, N>(interface) {
        return Err(guard_error::<Sys, N>(
            guard,
            walk.region,
            walk.time.value,
            &walk.state.x,
        ));
    }
    let number = Sch::step_number(&walk.progress);
    crowd.count::<Sys, N>(number, interface, walk.time.value, &walk.state.x)?;
    let left = (walk.region, rate_from);
    let transition = enter(system, left, interface, walk.time, &walk.state)?;
    walk.statistics.transitions += 1;
    walk.region = transition.to;
    walk.fresh = Some(interface);
    let told = walk.observer.transition(&transition);
    match told.is_break() {
        true => Ok(told),
        false => Ok(walk.tell_point()),
    }
}

/// The transition at a point of an interface, from a region that is left at a rate, if the field
/// of the region entered leads into it.
pub(crate) fn enter<Sys: System<N>, const N: usize>(
    system: &Sys,
    (from, rate_from): (Sys::Region, f64),
    interface: usize,
    time: Time,
    state: &State<N>,
) -> Result<Transition<Sys::Region, N>, Error> {
    let meeting = Meeting::new(system, (from, rate_from), interface, time.value, &state.x)?;
    let Meeting { to, rate_to, .. } = meeting;
    let inwards = Sys::sides(to)[interface].sign();
    if rate_to * inwards < 0.0 {
        return Err(meeting.sliding());
    }
    if rate_to * inwards == 0.0 || rate_to.is_nan() {
        return Err(meeting.tangential());
    }
    check_guards(system, to, time.value, &state.x)?;
    Ok(Transition {
        t: time.value,
        time,
        x: state.x,
        remainder: state.remainder,
        interface,
        from,
        to,
        rate_from,
        rate_to,
    })
}
