//! A solution on an interface, with the vector fields of both sides, and why it may not go on.

use crate::error::Error;
use crate::system::{System, Vector};
use crate::transition::reading::Reading;

/// A point of an interface with the rates dg/dt = ∂ₜg + ∇g·f of both sides.
pub(crate) struct Meeting<'a, Sys: System<N>, const N: usize> {
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

impl<'a, Sys: System<N>, const N: usize> Meeting<'a, Sys, N> {
    /// The meeting of a region, whose rate is known, with its neighbour.
    pub(crate) fn new(
        system: &Sys,
        (from, rate_from): (Sys::Region, f64),
        interface: usize,
        t: f64,
        x: &'a Vector<f64, N>,
    ) -> Result<Self, Error> {
        let to = neighbour::<Sys, N>(from, interface).ok_or_else(|| Error::NoRegion {
            t,
            x: x.iter().copied().collect(),
        })?;
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
    pub(crate) fn sliding(&self) -> Error {
        Error::Sliding {
            t: self.t,
            x: self.point(),
            interface: Sys::INTERFACES[self.interface],
            from: Sys::region_name(self.from),
            to: Sys::region_name(self.to),
            rate_from: self.rate_from,
            rate_to: self.rate_to,
        }
    }

    /// A field is tangential to the interface.
    pub(crate) fn tangential(&self) -> Error {
        Error::Tangential {
            t: self.t,
            x: self.point(),
            interface: Sys::INTERFACES[self.interface],
            from: Sys::region_name(self.from),
            to: Sys::region_name(self.to),
            rate_from: self.rate_from,
            rate_to: self.rate_to,
        }
    }

    /// Both fields lead away from the interface.
    pub(crate) fn ambiguous(&self) -> Error {
        Error::AmbiguousStart {
            t: self.t,
            x: self.point(),
            interface: Sys::INTERFACES[self.interface],
        }
    }

    fn point(&self) -> Vec<f64> {
        self.x.iter().copied().collect()
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
