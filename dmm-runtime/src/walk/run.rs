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

/// Transitions that are seen together.
const TOGETHER: u64 = 1000;

/// Whether transitions accumulate: so many within so short a time that doubles do not tell it from
/// none, as a part of the time since the start of the run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Accumulation {
    start: Time,
    /// The time of the first of those that are seen together.
    first: Time,
    count: u64,
}

impl Accumulation {
    /// At the start of a run.
    pub(crate) fn new(start: Time) -> Self {
        Self {
            start,
            first: start,
            count: 0,
        }
    }

    /// Counts a transition.
    pub(crate) fn count<Sys: System<N>, const N: usize>(
        &mut self,
        interface: usize,
        time: Time,
        x: &Vector<f64, N>,
    ) -> Result<(), Error> {
        self.count += 1;
        if !self.count.is_multiple_of(TOGETHER) {
            return Ok(());
        }
        let within = time.since(self.first);
        if within <= f64::EPSILON * time.since(self.start) {
            return Err(Error::Zeno {
                t: time.value,
                x: x.iter().copied().collect(),
                interface: Sys::boundary_name(interface),
                transitions: TOGETHER,
                within,
            });
        }
        self.first = time;
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
    let mut accumulation = Accumulation::new(walk.time);
    while run_segment(walk, &mut accumulation)?.is_continue() {}
    Ok(())
}

/// A segment, and the transition at its end if there is one; breaks at the end time or by the
/// observer's wish.
#[inline(always)]
pub(crate) fn run_segment<Sys, Sch, Loc, Obs, const N: usize>(
    walk: &mut Walk<'_, Sys, Sch, Loc, Obs, N>,
    accumulation: &mut Accumulation,
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
    accumulation.count::<Sys, N>(interface, walk.time, &walk.state.x)?;
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
    if rate_to * inwards < 0.0 && rate_from * inwards > 0.0 {
        return Err(meeting.sliding());
    }
    if rate_to * inwards <= 0.0 || rate_to.is_nan() {
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
