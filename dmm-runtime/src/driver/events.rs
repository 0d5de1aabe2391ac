//! What happens in an instant: the jumps at a point of interfaces, and periodic events.

use super::reading::Reading;
use crate::arithmetic::State;
use crate::contract::{Event, Side, System, Vector};
use crate::error::{Error, ErrorKind, invalid, number};

/// What events have made of a state and a mode.
pub(super) struct Happened<R, const N: usize> {
    pub(super) state: State<N>,
    /// With the sides of before.
    pub(super) mode: R,
}

/// What the events make of a point on the interfaces `on`, one of which was `met` with a rate; all
/// of it from the values before. Nothing if none happens.
pub(super) fn happens<Sys: System<N>, const N: usize>(
    system: &Sys,
    from: Sys::Region,
    met: (usize, f64),
    on: &[usize],
    t: f64,
    state: &State<N>,
) -> Result<Option<Happened<Sys::Region, N>>, Error> {
    let x = &state.x;
    let mut happened: Option<Happened<Sys::Region, N>> = None;
    for index in happening(system, from, met, on, t, x) {
        let Some((after, mode)) = system.jump(from, index, t, x) else {
            continue;
        };
        let all = happened.get_or_insert(Happened {
            state: *state,
            mode: from,
        });
        for i in 0..N {
            if after[i] == x[i] {
                continue;
            }
            if is_given(all.state.x[i], x[i], after[i]) {
                return Err(conflict(system, from, system.metadata().states[i], t, x));
            }
            // what changes its sign alone keeps its last digits
            all.state.remainder[i] = if after[i] == -x[i] {
                -state.remainder[i]
            } else {
                0.0
            };
            all.state.x[i] = after[i];
        }
        let [after, before, so_far] = [mode, from, all.mode].map(Sys::constants);
        for (i, (&after, &before)) in after.iter().zip(&before).enumerate() {
            if after == before {
                continue;
            }
            if is_given(so_far[i], before, after) {
                return Err(conflict(system, from, system.metadata().discrete[i], t, x));
            }
            all.mode = Sys::with_constant(all.mode, i, after);
        }
    }
    Ok(happened)
}

/// The events at a point of the interfaces `on`, one of which was `met` with a rate, whatever their
/// conditions are.
pub(crate) fn happening<'a, Sys: System<N>, const N: usize>(
    system: &'a Sys,
    from: Sys::Region,
    met: (usize, f64),
    on: &'a [usize],
    t: f64,
    x: &'a Vector<f64, N>,
) -> impl Iterator<Item = usize> + 'a {
    let happens = move |event: &Event| {
        let is_here = event.region.is_none_or(|region| region == Sys::index(from));
        is_here && on.contains(&event.interface) && is_crossed(system, from, met, event, t, x)
    };
    let events = system.metadata().events.iter().enumerate();
    events.filter_map(move |(index, event)| happens(event).then_some(index))
}

/// Whether another event has given something a value other than `after`.
fn is_given(so_far: f64, before: f64, after: f64) -> bool {
    so_far != before && so_far != after
}

/// Two events give one state two values.
#[cold]
fn conflict<Sys: System<N>, const N: usize>(
    system: &Sys,
    from: Sys::Region,
    state: &'static str,
    t: f64,
    x: &Vector<f64, N>,
) -> Error {
    let kind = ErrorKind::Conflict { state };
    kind.at(t, x.as_slice(), system.of_region(from).name)
}

/// Whether the solution crosses the interface of an event the way that it asks for.
fn is_crossed<Sys: System<N>, const N: usize>(
    system: &Sys,
    from: Sys::Region,
    (interface, rate): (usize, f64),
    event: &Event,
    t: f64,
    x: &Vector<f64, N>,
) -> bool {
    let rate = if event.interface == interface {
        rate
    } else {
        Reading::new(system, from, event.interface, t, x).rate
    };
    match system.side(from, event.interface) {
        Some(Side::Positive) => event.falls && rate < 0.0,
        Some(Side::Negative) => event.rises && rate > 0.0,
        None => false,
    }
}

/// A mode at the start of a run: its periodic events count from the initial time.
pub(super) fn with_clocks<Sys: System<N>, const N: usize>(
    system: &Sys,
    mut mode: Sys::Region,
    t0: f64,
    x0: &Vector<f64, N>,
) -> Result<Sys::Region, Error> {
    for event in system.metadata().events {
        let Some(clock) = event.clock else { continue };
        // g = t − n T
        let g = |count: f64| {
            let mode = Sys::with_constant(mode, clock, count);
            Reading::new(system, mode, event.interface, t0, x0).value
        };
        let period = g(0.0) - g(1.0);
        let positive = period > 0.0 && period.is_finite();
        if !positive {
            invalid("time between events", number(period), "must be positive")?;
        }
        let mut count = (t0 / period).floor();
        while g(count) >= 0.0 {
            count += 1.0;
        }
        mode = Sys::with_constant(mode, clock, count);
    }
    Ok(mode)
}
