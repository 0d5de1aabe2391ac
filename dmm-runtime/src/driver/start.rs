//! Which region an integration starts in.
//!
//! Away from the interfaces the signs of the switching functions decide. On one of them the
//! rates dg/dt = ∂ₜg + ∇g·f of both sides do: both up or both down is the region that they
//! lead into; both inwards would slide; both outwards has two solutions, and the caller has
//! to name the region. On several of them see the module `around`.

use super::around::Around;
use super::events::with_clocks;
use super::reading::Reading;
use crate::contract::{System, Vector};
use crate::error::{Error, ErrorKind};
use crate::method::Active;

/// Where an integration starts.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Start<R> {
    pub(crate) region: R,
    /// The interfaces that it starts on.
    pub(crate) on: Active,
}

/// Determines the region of a start at (t, x) that names none; discrete states are those of `like`,
/// or the initial ones.
pub(crate) fn find_region<Sys: System<N>, const N: usize>(
    system: &Sys,
    like: Option<Sys::Region>,
    t: f64,
    x: &Vector<f64, N>,
) -> Result<Start<Sys::Region>, Error> {
    let no_region = || ErrorKind::NoRegion.at(t, x.as_slice(), "");
    let like = like.or_else(|| system.region(0)).ok_or_else(no_region)?;
    let like = with_clocks(system, like, t, x)?;
    let (region, on) = Around::new(system, like, t, x, |_, _| false)?.entered()?;
    Ok(Start { region, on })
}

/// Checks a region that the caller named against the signs at (t, x).
pub(crate) fn check_region<Sys: System<N>, const N: usize>(
    system: &Sys,
    region: Sys::Region,
    t: f64,
    x: &Vector<f64, N>,
) -> Result<Start<Sys::Region>, Error> {
    let region = with_clocks(system, region, t, x)?;
    let mut on = Active::default();
    for interface in 0..system.metadata().interfaces.len() {
        let Some(side) = system.side(region, interface) else {
            continue;
        };
        let reading = Reading::new(system, region, interface, t, x);
        if reading.is_zero() {
            if side.sign() * reading.rate <= 0.0 {
                return Err(ErrorKind::InvalidInput {
                    what: "region",
                    value: system.of_region(region).name.to_owned(),
                    requirement: "its vector field does not lead into it from the start, which is on \
                                  its interface",
                }.into());
            }
            on.insert(interface);
        } else if side.sign() * reading.value < 0.0 || reading.value.is_nan() {
            return Err(ErrorKind::InvalidInput {
                what: "region",
                value: system.of_region(region).name.to_owned(),
                requirement: "the start does not lie in it",
            }
            .into());
        }
    }
    Ok(Start { region, on })
}
