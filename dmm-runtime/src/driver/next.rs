//! The next mode: decided at a point of an interface by the rates dg/dt of both sides.

use super::conditions::check_conditions;
use super::reading::Reading;
use crate::arithmetic::{State, Time};
use crate::contract::{System, Vector};
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
    let sides = BothSides::new(system, (from, rate_from), interface, time.value, &state.x)?;
    let BothSides { to, rate_to, .. } = sides;
    let inwards = Sys::sides(to)[interface].sign();
    if rate_to * inwards < 0.0 && rate_from * inwards > 0.0 {
        return Err(sides.sliding());
    }
    if rate_to * inwards <= 0.0 || rate_to.is_nan() {
        return Err(sides.tangential());
    }
    check_conditions(system, to, time.value, &state.x)?;
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

/// A point of an interface with the rates dg/dt = ∂ₜg + ∇g·f of both sides.
pub(crate) struct BothSides<'a, Sys: System<N>, const N: usize> {
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
    pub(crate) fn new(
        system: &Sys,
        (from, rate_from): (Sys::Region, f64),
        interface: usize,
        t: f64,
        x: &'a Vector<f64, N>,
    ) -> Result<Self, Error> {
        let to = neighbour::<Sys, N>(from, interface)
            .ok_or_else(|| ErrorKind::NoRegion.at(t, x.as_slice(), Sys::region_name(from)))?;
        Ok(Self {
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
            interface: Sys::INTERFACES[self.interface],
            from: Sys::region_name(self.from),
            to: Sys::region_name(self.to),
            rate_from: self.rate_from,
            rate_to: self.rate_to,
        })
    }

    /// A field is tangential to the interface.
    #[cold]
    pub(crate) fn tangential(&self) -> Error {
        self.error(ErrorKind::Tangential {
            interface: Sys::INTERFACES[self.interface],
            from: Sys::region_name(self.from),
            to: Sys::region_name(self.to),
            rate_from: self.rate_from,
            rate_to: self.rate_to,
        })
    }

    /// Both fields lead away from the interface.
    #[cold]
    pub(crate) fn ambiguous(&self) -> Error {
        self.error(ErrorKind::AmbiguousStart {
            interface: Sys::INTERFACES[self.interface],
        })
    }

    fn error(&self, kind: ErrorKind) -> Error {
        kind.at(self.t, self.x.as_slice(), Sys::region_name(self.from))
    }
}

/// The region on the other side of `interface`.
pub(crate) fn neighbour<Sys: System<N>, const N: usize>(
    region: Sys::Region,
    interface: usize,
) -> Option<Sys::Region> {
    let sides = Sys::sides(region);
    Sys::REGIONS.iter().copied().find(|&other| {
        Sys::sides(other)
            .iter()
            .zip(sides)
            .enumerate()
            .all(|(index, (a, b))| (a == b) == (index != interface))
    })
}
