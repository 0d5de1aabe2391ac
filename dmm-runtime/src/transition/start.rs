//! Which region an integration starts in.
//!
//! Away from the interfaces the signs of the switching functions decide. On one of them the
//! rates dg/dt = ∂ₜg + ∇g·f of both sides do: both up or both down is the region that they
//! lead into; both inwards would slide; both outwards has two solutions, and the caller has
//! to name the region.

use crate::error::Error;
use crate::scalar::Scalar;
use crate::system::{Boundary, Flow, FlowVisitor, Side, System, Vector};
use crate::transition::rate;

/// g this many rounding errors of its terms away from zero is on the interface.
const NOISE: f64 = 8.0;

/// Where an integration starts.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Start<R> {
    pub(crate) region: R,
    /// The interface that it starts on.
    pub(crate) interface: Option<usize>,
}

/// The value of g, the size of its terms and dg/dt under the flow of a region.
struct Reading {
    value: f64,
    size: f64,
    rate: f64,
}

impl Reading {
    fn is_zero(&self) -> bool {
        self.value.abs() <= NOISE * f64::ROUNDING * self.size
    }
}

/// Reads one interface.
struct Read<'a, const N: usize> {
    interface: usize,
    t: f64,
    x: &'a Vector<f64, N>,
}

impl<const N: usize> FlowVisitor<N> for Read<'_, N> {
    type Output = Reading;

    fn visit<const M: usize, F: Flow<f64, N, M>>(self, flow: &F) -> Reading {
        let boundary = flow.boundary();
        Reading {
            value: boundary.switching_function(self.interface, self.t, self.x),
            size: boundary.switching_size(self.interface, self.t, self.x),
            rate: rate(flow, self.interface, self.t, self.x),
        }
    }
}

/// dg/dt under the flow of `region`.
pub(crate) fn rate_in<Sys: System<N>, const N: usize>(
    system: &Sys,
    region: Sys::Region,
    interface: usize,
    t: f64,
    x: &Vector<f64, N>,
) -> f64 {
    system.visit(region, Read { interface, t, x }).rate
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

/// Determines the region of a start at (t, x) that names none.
pub(crate) fn find_region<Sys: System<N>, const N: usize>(
    system: &Sys,
    t: f64,
    x: &Vector<f64, N>,
) -> Result<Start<Sys::Region>, Error> {
    let no_region = || Error::NoRegion {
        t,
        x: x.iter().copied().collect(),
    };
    let mut sides = Vec::with_capacity(Sys::INTERFACES.len());
    let mut on = None;
    let first = *Sys::REGIONS.first().ok_or_else(no_region)?;
    for interface in 0..Sys::INTERFACES.len() {
        let reading = system.visit(first, Read { interface, t, x });
        if reading.is_zero() {
            on = Some(interface);
            sides.push(Side::Positive);
        } else if reading.value.is_nan() {
            return Err(no_region());
        } else if reading.value > 0.0 {
            sides.push(Side::Positive);
        } else {
            sides.push(Side::Negative);
        }
    }
    let region = Sys::REGIONS
        .iter()
        .copied()
        .find(|&region| Sys::sides(region) == sides)
        .ok_or_else(no_region)?;
    match on {
        None => Ok(Start {
            region,
            interface: None,
        }),
        Some(interface) => decide_by_rates(system, region, interface, t, x),
    }
}

/// Decides between `above` (g > 0) and its neighbour at a point on `interface`.
fn decide_by_rates<Sys: System<N>, const N: usize>(
    system: &Sys,
    above: Sys::Region,
    interface: usize,
    t: f64,
    x: &Vector<f64, N>,
) -> Result<Start<Sys::Region>, Error> {
    let point = || x.iter().copied().collect::<Vec<f64>>();
    let below =
        neighbour::<Sys, N>(above, interface).ok_or_else(|| Error::NoRegion { t, x: point() })?;
    let (up, down) = (
        rate_in(system, above, interface, t, x),
        rate_in(system, below, interface, t, x),
    );
    let name = Sys::INTERFACES[interface];
    let start = |region| {
        Ok(Start {
            region,
            interface: Some(interface),
        })
    };
    match (up > 0.0, up < 0.0, down > 0.0, down < 0.0) {
        (true, _, true, _) => start(above),
        (_, true, _, true) => start(below),
        (_, true, true, _) => Err(Error::Sliding {
            t,
            x: point(),
            interface: name,
            from: Sys::region_name(above),
            to: Sys::region_name(below),
            rate_from: up,
            rate_to: down,
        }),
        (true, _, _, true) => Err(Error::AmbiguousStart {
            t,
            x: point(),
            interface: name,
        }),
        _ => Err(Error::Tangential {
            t,
            x: point(),
            interface: name,
            from: Sys::region_name(above),
            to: Sys::region_name(below),
            rate_from: up,
            rate_to: down,
        }),
    }
}

/// Checks a region that the caller named against the signs at (t, x).
pub(crate) fn check_region<Sys: System<N>, const N: usize>(
    system: &Sys,
    region: Sys::Region,
    t: f64,
    x: &Vector<f64, N>,
) -> Result<Start<Sys::Region>, Error> {
    let mut on = None;
    for (interface, side) in Sys::sides(region).iter().enumerate() {
        let reading = system.visit(region, Read { interface, t, x });
        if reading.is_zero() {
            if side.sign() * reading.rate <= 0.0 {
                return Err(Error::InvalidInput {
                    what: "region",
                    value: Sys::region_name(region).to_owned(),
                    requirement: "its vector field does not lead into it from the start, which is on \
                                  its interface",
                });
            }
            on = Some(interface);
        } else if side.sign() * reading.value < 0.0 || reading.value.is_nan() {
            return Err(Error::InvalidInput {
                what: "region",
                value: Sys::region_name(region).to_owned(),
                requirement: "the start does not lie in it",
            });
        }
    }
    Ok(Start {
        region,
        interface: on,
    })
}
