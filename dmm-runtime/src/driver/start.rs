//! Which region an integration starts in.
//!
//! Away from the interfaces the signs of the switching functions decide. On one of them the
//! rates dg/dt = ∂ₜg + ∇g·f of both sides do: both up or both down is the region that they
//! lead into; both inwards would slide; both outwards has two solutions, and the caller has
//! to name the region.
//!
//! A region that is named is taken at its word also next to an interface: where g has the sign of the
//! other side, but the field of the region named brings the solution to the interface within a time
//! that rounding takes from the times of the run, |g/ġ| ≤ ε max(|t₀|, |t_end|), the start is on the
//! interface. So a run starts again at a transition point, on whichever side of the interface rounding
//! has left it.

use super::next::BothSides;
use super::reading::Reading;
use crate::contract::{Side, System, Vector};
use crate::error::{Error, ErrorKind};

/// Where an integration starts.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Start<R> {
    pub(crate) region: R,
    /// The interface that it starts on.
    pub(crate) interface: Option<usize>,
}

/// Determines the region of a start at (t, x) that names none.
pub(crate) fn find_region<Sys: System<N>, const N: usize>(
    system: &Sys,
    t: f64,
    x: &Vector<f64, N>,
) -> Result<Start<Sys::Region>, Error> {
    let no_region = || ErrorKind::NoRegion.at(t, x.as_slice(), "");
    let interfaces = system.metadata().interfaces.len();
    let mut sides = Vec::with_capacity(interfaces);
    let mut on = None;
    let first = system.region(0).ok_or_else(no_region)?;
    for interface in 0..interfaces {
        let reading = Reading::new(system, first, interface, t, x);
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
    let region = system.region_on(&sides).ok_or_else(no_region)?;
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
    let up = Reading::new(system, above, interface, t, x).rate;
    let both = BothSides::new(system, (above, up), interface, t, x)?;
    let (below, down) = (both.to, both.rate_to);
    let start = |region| {
        Ok(Start {
            region,
            interface: Some(interface),
        })
    };
    match (up > 0.0, up < 0.0, down > 0.0, down < 0.0) {
        (true, _, true, _) => start(above),
        (_, true, _, true) => start(below),
        (_, true, true, _) => Err(both.sliding()),
        (true, _, _, true) => Err(both.ambiguous()),
        _ => Err(both.tangential()),
    }
}

/// Checks a region that the caller named against the signs at (t, x), in a run until `t_end`.
pub(crate) fn check_region<Sys: System<N>, const N: usize>(
    system: &Sys,
    region: Sys::Region,
    (t, t_end): (f64, f64),
    x: &Vector<f64, N>,
) -> Result<Start<Sys::Region>, Error> {
    let moment = f64::EPSILON * t.abs().max(t_end.abs());
    let mut on = None;
    for (interface, side) in system.of_region(region).sides.iter().enumerate() {
        let reading = Reading::new(system, region, interface, t, x);
        let (value, rate) = (side.sign() * reading.value, side.sign() * reading.rate);
        if reading.is_zero() || value < 0.0 && -value <= moment * rate {
            if rate <= 0.0 {
                return Err(ErrorKind::InvalidInput {
                    what: "region",
                    value: system.of_region(region).name.to_owned(),
                    requirement: "its vector field does not lead into it from the start, which is on \
                                  its interface",
                }.into());
            }
            on = Some(interface);
        } else if value < 0.0 || value.is_nan() {
            return Err(ErrorKind::InvalidInput {
                what: "region",
                value: system.of_region(region).name.to_owned(),
                requirement: "the start does not lie in it",
            }
            .into());
        }
    }
    Ok(Start {
        region,
        interface: on,
    })
}
