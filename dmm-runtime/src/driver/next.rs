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
use crate::output::{Transition, TransitionKind};

/// What is behind a point of an interface.
pub(crate) struct Next<R, const N: usize> {
    /// The transition into the next mode; nothing where an interface was crossed that has to do
    /// with events alone and none happened.
    pub(crate) transition: Option<Transition<R, N>>,
    /// The mode.
    pub(crate) mode: R,
    /// The state, if it has changed.
    pub(crate) state: Option<State<N>>,
    /// The interfaces that bound the mode there.
    pub(crate) active: Active,
}

/// What is behind a point of a guard, from a mode that is left at a rate: the mode whose field leads
/// into it.
pub(crate) fn enter<Sys: System<N>, const N: usize>(
    system: &Sys,
    (from, rate_from): (Sys::Region, f64),
    guard: usize,
    time: Time,
    state: &State<N>,
) -> Result<Next<Sys::Region, N>, Error> {
    let (t, x) = (time.value, &state.x);
    let metadata = system.metadata();
    let end = metadata.end(guard);
    let interface = end.map_or(guard, |end| end.interface);
    let parts = (metadata.interfaces, metadata.free, metadata.sliding);
    let ((to, rate_to), active, happened) = if let ([_], [], []) = parts {
        let to = across(system, (from, rate_from), interface, t, x)?;
        (to, Active::new(Some(interface)), None)
    } else {
        let left = end.and_then(|end| Some((interface, end.side?)));
        let met = Met {
            interface,
            rate: rate_from,
            left,
        };
        let (to, active, happened) = around(system, from, &met, t, state)?;
        let after = happened.as_ref().map_or(x, |happened| &happened.state.x);
        let rate = Reading::new(system, to, interface, t, after).rate;
        ((to, rate), active, happened)
    };
    let after = happened.as_ref().map_or(*x, |happened| happened.state.x);
    check_conditions(system, to, t, &after)?;
    let is_silent = happened.is_none()
        && Sys::index(from) == Sys::index(to)
        && metadata.free.contains(&interface)
        && !metadata.switches.contains(&interface);
    let transition = Transition {
        t,
        time,
        x: state.x,
        remainder: state.remainder,
        after,
        kind: match happened {
            Some(_) => TransitionKind::Jumped,
            None => kind(system, from, to),
        },
        interface,
        guard,
        from,
        to,
        rate_from,
        rate_to,
    };
    Ok(Next {
        transition: (!is_silent).then_some(transition),
        mode: to,
        state: happened.map(|happened| happened.state),
        active,
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
