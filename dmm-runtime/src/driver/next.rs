//! The next mode: decided at a point of an interface by the rates dg/dt of both sides.

use super::conditions::check_conditions;
use super::reading::Reading;
use crate::arithmetic::{State, Time};
use crate::contract::{Side, System, Vector};
use crate::error::{Error, ErrorKind};
use crate::output::Transition;

/// The transition at a point of an interface, from a region that is left at a rate, if the field
/// of the region entered leads into it.
pub(crate) fn enter<Sys: System<N>, const N: usize>(
    system: &Sys,
    (from, rate_from): (Sys::Region, f64),
    interface: usize,
    time: Time,
    state: &State<N>,
) -> Result<Transition<Sys::Region, N>, Error> {
    let (t, x) = (time.value, &state.x);
    let Some(to) = system.neighbour(from, interface) else {
        return Err(no_region(system, from, t, x));
    };
    let rate_to = Reading::new(system, to, interface, t, x).rate;
    let inwards = system.side(to, interface).map_or(0.0, Side::sign);
    let enters = rate_to * inwards > 0.0;
    if !enters {
        let sides = BothSides::new(system, (from, rate_from), interface, t, x)?;
        let slides = rate_to * inwards < 0.0 && rate_from * inwards > 0.0;
        return Err(if slides {
            sides.sliding()
        } else {
            sides.tangential()
        });
    }
    check_conditions(system, to, t, x)?;
    Ok(Transition {
        t,
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
pub(crate) struct BothSides<'a, Sys: System<N>, const N: usize> {
    system: &'a Sys,
    t: f64,
    x: &'a Vector<f64, N>,
    interface: usize,
    /// The region that the solution comes from.
    from: Sys::Region,
    rate_from: f64,
    /// The region on the other side.
    pub(crate) to: Sys::Region,
    pub(crate) rate_to: f64,
}

impl<'a, Sys: System<N>, const N: usize> BothSides<'a, Sys, N> {
    /// Those of a region, whose rate is known, and its neighbour.
    #[cold]
    pub(crate) fn new(
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

    /// Both fields point at the interface.
    #[cold]
    pub(crate) fn sliding(&self) -> Error {
        self.error(ErrorKind::Sliding {
            interface: self.interface_name(),
            from: self.name(self.from),
            to: self.name(self.to),
            rate_from: self.rate_from,
            rate_to: self.rate_to,
        })
    }

    /// A field is tangential to the interface.
    #[cold]
    pub(crate) fn tangential(&self) -> Error {
        self.error(ErrorKind::Tangential {
            interface: self.interface_name(),
            from: self.name(self.from),
            to: self.name(self.to),
            rate_from: self.rate_from,
            rate_to: self.rate_to,
        })
    }

    /// Both fields lead away from the interface.
    #[cold]
    pub(crate) fn ambiguous(&self) -> Error {
        self.error(ErrorKind::AmbiguousStart {
            interface: self.interface_name(),
        })
    }

    fn interface_name(&self) -> &'static str {
        self.system.metadata().guard_name(self.interface)
    }

    fn name(&self, region: Sys::Region) -> &'static str {
        self.system.of_region(region).name
    }

    fn error(&self, kind: ErrorKind) -> Error {
        kind.at(self.t, self.x.as_slice(), self.name(self.from))
    }
}
