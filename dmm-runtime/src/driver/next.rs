//! The next mode: decided at a point of an interface by the rates dg/dt of the fields around it.

use super::around::Around;
use super::conditions::check_conditions;
use super::reading::Reading;
use crate::arithmetic::{State, Time};
use crate::contract::{Side, System, Vector};
use crate::error::{Error, ErrorKind};
use crate::method::Active;
use crate::output::Transition;

/// The transition at a point of an interface, from a region that is left at a rate, into the region
/// whose field leads into it; and the interfaces that bound it there.
pub(crate) fn enter<Sys: System<N>, const N: usize>(
    system: &Sys,
    (from, rate_from): (Sys::Region, f64),
    interface: usize,
    time: Time,
    state: &State<N>,
) -> Result<(Transition<Sys::Region, N>, Active), Error> {
    let (t, x) = (time.value, &state.x);
    let (to, active) = if let [_] = system.metadata().interfaces {
        let to = across(system, (from, rate_from), interface, t, x)?;
        (to, Active::new(Some(interface)))
    } else {
        let around = Around::new(system, Some(interface), t, x)?;
        let entered = around.entered();
        let (to, active) = entered.map_err(|error| error.in_region(system.of_region(from).name))?;
        let rate = Reading::new(system, to, interface, t, x).rate;
        ((to, rate), active)
    };
    let (to, rate_to) = to;
    check_conditions(system, to, t, x)?;
    let transition = Transition {
        t,
        time,
        x: state.x,
        remainder: state.remainder,
        interface,
        from,
        to,
        rate_from,
        rate_to,
    };
    Ok((transition, active))
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
        return Err(no_region(system, from, t, x));
    };
    let rate_to = Reading::new(system, to, interface, t, x).rate;
    let inwards = system.side(to, interface).map_or(0.0, Side::sign);
    let enters = rate_to * inwards > 0.0;
    if enters {
        return Ok((to, rate_to));
    }
    Err(BothSides::new(system, (from, rate_from), interface, t, x)?.stays())
}

/// There is no region on the other side.
#[cold]
fn no_region<Sys: System<N>, const N: usize>(
    system: &Sys,
    from: Sys::Region,
    t: f64,
    x: &Vector<f64, N>,
) -> Error {
    ErrorKind::NoRegion.at(t, x.as_slice(), system.of_region(from).name)
}

/// A point of an interface with the rates dg/dt = ∂ₜg + ∇g·f of both sides.
pub(super) struct BothSides<'a, Sys: System<N>, const N: usize> {
    system: &'a Sys,
    t: f64,
    x: &'a Vector<f64, N>,
    interface: usize,
    /// A region.
    from: Sys::Region,
    rate_from: f64,
    /// The region on the other side.
    to: Sys::Region,
    rate_to: f64,
}

impl<'a, Sys: System<N>, const N: usize> BothSides<'a, Sys, N> {
    /// Those of a region, whose rate is known, and its neighbour.
    #[cold]
    pub(super) fn new(
        system: &'a Sys,
        (from, rate_from): (Sys::Region, f64),
        interface: usize,
        t: f64,
        x: &'a Vector<f64, N>,
    ) -> Result<Self, Error> {
        let to = system.neighbour(from, interface);
        let to = to.ok_or_else(|| no_region(system, from, t, x))?;
        Ok(Self {
            system,
            t,
            x,
            interface,
            from,
            rate_from,
            to,
            rate_to: Reading::new(system, to, interface, t, x).rate,
        })
    }

    /// The error of a solution that neither of the fields leads away: both point at the interface,
    /// or one is tangential to it.
    #[cold]
    pub(super) fn stays(&self) -> Error {
        let inwards = self.system.side(self.to, self.interface);
        let inwards = inwards.map_or(0.0, Side::sign);
        let interface = self.system.metadata().guard_name(self.interface);
        let [from, to] = [self.from, self.to].map(|region| self.system.of_region(region).name);
        let (rate_from, rate_to) = (self.rate_from, self.rate_to);
        let slides = rate_to * inwards < 0.0 && rate_from * inwards > 0.0;
        let kind = if slides {
            ErrorKind::Sliding {
                interface,
                from,
                to,
                rate_from,
                rate_to,
            }
        } else {
            ErrorKind::Tangential {
                interface,
                from,
                to,
                rate_from,
                rate_to,
            }
        };
        kind.at(self.t, self.x.as_slice(), from)
    }
}
