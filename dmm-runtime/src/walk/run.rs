//! Segment after segment: Algorithm 2.1 of Hirani, Wan & Wojtalewicz (Mannshardt's transition
//! scheme) with the region as explicit state. It is never inferred again from the sign of g
//! after a transition, so that x̂* belongs to the region entered whatever rounding did, and the
//! located point never fires again.

use crate::error::Error;
use crate::observer::{Observer, Transition};
use crate::scheme::Scheme;
use crate::system::System;
use crate::transition::{Locator, Meeting};
use crate::walk::{SegmentEnd, Walk};

/// Transitions that one step may have.
const LARGEST_TRANSITIONS_A_STEP: u64 = 1000;

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
    let mut transitions_in_step = 0;
    let mut step = 0;
    loop {
        let system = walk.system;
        let (interface, rate_from) = match system.visit(walk.region, &mut *walk)? {
            SegmentEnd::Finished | SegmentEnd::Stopped => return Ok(()),
            SegmentEnd::Crossed { interface, rate } => (interface, rate),
        };
        let number = Sch::step_number(&walk.progress);
        transitions_in_step = if number == step {
            transitions_in_step + 1
        } else {
            1
        };
        step = number;
        if transitions_in_step > LARGEST_TRANSITIONS_A_STEP {
            return Err(Error::Zeno {
                t: walk.time.value,
                x: walk.state.x.iter().copied().collect(),
                interface: Sys::INTERFACES[interface],
                limit: LARGEST_TRANSITIONS_A_STEP,
            });
        }
        let transition = enter(walk, interface, rate_from)?;
        walk.statistics.transitions += 1;
        walk.region = transition.to;
        walk.fresh = Some(interface);
        if walk.observer.transition(&transition).is_break() || walk.tell_point().is_break() {
            return Ok(());
        }
    }
}

/// The transition at the walk's point, if the field of the region entered leads into it.
fn enter<Sys, Sch, Loc, Obs, const N: usize>(
    walk: &Walk<'_, Sys, Sch, Loc, Obs, N>,
    interface: usize,
    rate_from: f64,
) -> Result<Transition<Sys::Region, N>, Error>
where
    Sys: System<N>,
    Sch: Scheme,
    Loc: Locator,
    Obs: Observer<Sys::Region, N>,
{
    let (t, x) = (walk.time.value, walk.state.x);
    let from = walk.region;
    let meeting = Meeting::new(walk.system, (from, rate_from), interface, t, &x)?;
    let Meeting { to, rate_to, .. } = meeting;
    let inwards = Sys::sides(to)[interface].sign();
    if rate_to * inwards < 0.0 {
        return Err(meeting.sliding());
    }
    if rate_to * inwards == 0.0 || rate_to.is_nan() {
        return Err(meeting.tangential());
    }
    Ok(Transition {
        t,
        time: walk.time,
        x,
        remainder: walk.state.remainder,
        interface,
        from,
        to,
        rate_from,
        rate_to,
    })
}
