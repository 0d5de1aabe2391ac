//! The next mode: decided at a point of an interface by the rates dg/dt of the fields around it,
//! behind the events that happen there.

use super::around::Around;
use super::conditions::check_conditions;
use super::events::{Happened, happens};
use super::reading::Reading;
use super::refusal::stays;
use crate::arithmetic::{State, Time};
use crate::contract::{Side, System, Vector};
use crate::error::{Error, ErrorKind};
use crate::method::Active;
use crate::output::TransitionKind;

/// What is behind a point of an interface.
pub(crate) struct Next<R, const N: usize> {
    /// The mode.
    pub(crate) mode: R,
    /// dg/dt in it.
    pub(crate) rate: f64,
    /// The state, if it has changed.
    pub(crate) state: Option<State<N>>,
    /// The interfaces that bound the mode there.
    pub(crate) active: Active,
    /// The kind of the transition; nothing where an interface was crossed that has to do with events
    /// alone and none happened.
    pub(crate) kind: Option<TransitionKind>,
}

/// What is behind a point of a guard, from a mode that is left at a rate: the mode whose field leads
/// into it.
#[inline(always)]
pub(crate) fn enter<Sys: System<N>, const N: usize>(
    system: &Sys,
    from: (Sys::Region, f64),
    guard: usize,
    time: Time,
    state: &State<N>,
) -> Result<Next<Sys::Region, N>, Error> {
    let metadata = system.metadata();
    let ([_], [], []) = (metadata.interfaces, metadata.free, metadata.sliding) else {
        // what is returned in memory is kept apart from what is in registers
        let next = enter_among(system, from, guard, time, state)?;
        return Ok(next);
    };
    let (t, x) = (time.value, &state.x);
    let (mode, rate) = across(system, from, guard, t, x)?;
    check_conditions(system, mode, t, x)?;
    Ok(Next {
        mode,
        rate,
        state: None,
        active: Active::new(Some(guard)),
        kind: Some(TransitionKind::Crossed),
    })
}

/// The same where there are several interfaces, events or sliding motions.
#[inline(never)]
fn enter_among<Sys: System<N>, const N: usize>(
    system: &Sys,
    (from, rate_from): (Sys::Region, f64),
    guard: usize,
    time: Time,
    state: &State<N>,
) -> Result<Next<Sys::Region, N>, Error> {
    let t = time.value;
    let metadata = system.metadata();
    let end = metadata.end(guard);
    let interface = metadata.interface(guard);
    let met = Met {
        interface,
        rate: rate_from,
        left: end.and_then(|end| Some((interface, end.side?))),
    };
    let (mode, active, happened) = around(system, from, &met, t, state)?;
    let after = happened
        .as_ref()
        .map_or(&state.x, |happened| &happened.state.x);
    let rate = Reading::new(system, mode, interface, t, after).rate;
    check_conditions(system, mode, t, after)?;
    let is_silent = happened.is_none()
        && Sys::index(from) == Sys::index(mode)
        && metadata.free.contains(&interface)
        && !metadata.switches.contains(&interface);
    let kind = match happened {
        Some(_) => TransitionKind::Jumped,
        None => kind(system, from, mode),
    };
    Ok(Next {
        mode,
        rate,
        state: happened.map(|happened| happened.state),
        active,
        kind: (!is_silent).then_some(kind),
    })
}

/// What a change of the mode is that no event has made.
fn kind<Sys: System<N>, const N: usize>(
    system: &Sys,
    from: Sys::Region,
    to: Sys::Region,
) -> TransitionKind {
    let mut sliding = system.metadata().sliding.iter();
    let begins = |&&one: &&usize| system.slides_on(to, one) && !system.slides_on(from, one);
    let ends = |&&one: &&usize| system.slides_on(from, one) && !system.slides_on(to, one);
    if sliding.clone().any(|one| begins(&one)) {
        TransitionKind::BeganToSlide
    } else if sliding.any(|one| ends(&one)) {
        TransitionKind::LeftSlide
    } else {
        TransitionKind::Crossed
    }
}

/// What has been met.
struct Met {
    interface: usize,
    /// The rate of its function, or of the end of a sliding motion.
    rate: f64,
    /// The interface that a sliding motion leaves, and the side.
    left: Option<(usize, Side)>,
}

/// A mode, the interfaces that bound it at a point, and what has happened there.
type Behind<R, const N: usize> = (R, Active, Option<Happened<R, N>>);

/// The mode that the solution goes on in where several interfaces may be met or events happen, and
/// the interfaces that bound it.
#[inline(never)]
fn around<Sys: System<N>, const N: usize>(
    system: &Sys,
    from: Sys::Region,
    met: &Met,
    t: f64,
    state: &State<N>,
) -> Result<Behind<Sys::Region, N>, Error> {
    let x = &state.x;
    let Met {
        interface,
        rate,
        left,
    } = *met;
    let in_region = |error: Error| error.in_region(system.of_region(from).name);
    // what is on the wrong side of an interface by rounding is on it
    let is_on = |one: usize, value: f64| {
        let side = system.side(from, one);
        one == interface
            || side.is_some_and(|side| side != Side::of(value))
            || system.slides_on(from, one)
    };
    let mut before = Around::new(system, from, t, x, is_on).map_err(in_region)?;
    if let Some((interface, side)) = left {
        before = before.leaving(from, interface, side);
    }
    let met = (interface, rate);
    let Some(mut happened) = happens(system, from, met, before.on(), t, state)? else {
        let (to, active) = before.entered().map_err(in_region)?;
        return Ok((to, active, None));
    };
    let is_on = |one: usize, value: f64| {
        let was_on = before.on().contains(&one);
        was_on && value.abs() <= Reading::new(system, from, one, t, x).value.abs()
    };
    let after = Around::new(system, happened.mode, t, &happened.state.x, is_on);
    let after = after.map_err(in_region)?;
    let (to, active) = after.entered().map_err(in_region)?;
    if after.rests(to) {
        // so that it is on the interface for ever
        happened.state = State::new(happened.state.x);
    }
    Ok((to, active, Some(happened)))
}

/// The region on the other side of the only interface, if its field leads into it, and dg/dt there.
#[inline]
fn across<Sys: System<N>, const N: usize>(
    system: &Sys,
    (from, rate_from): (Sys::Region, f64),
    interface: usize,
    t: f64,
    x: &Vector<f64, N>,
) -> Result<(Sys::Region, f64), Error> {
    let Some(to) = system.neighbour(from, interface) else {
        let region = system.of_region(from).name;
        return Err(ErrorKind::NoRegion.at(t, x.as_slice(), region));
    };
    let rate_to = Reading::new(system, to, interface, t, x).rate;
    let inwards = system.side(to, interface).map_or(0.0, Side::sign);
    let enters = rate_to * inwards > 0.0;
    if enters {
        return Ok((to, rate_to));
    }
    let both = ((from, rate_from), (to, rate_to));
    Err(stays(system, both, interface, t, x))
}
