//! Which region an integration starts in.
//!
//! Away from the interfaces the signs of the switching functions decide. On one of them the
//! rates dg/dt = ∂ₜg + ∇g·f of both sides do: both up or both down is the region that they
//! lead into; both inwards would slide; both outwards has two solutions, and the caller has
//! to name the region. On several of them see the module `choice`.
//!
//! A region that is named is taken at its word also next to an interface: where g has the sign of the
//! other side, but the field of the region named brings the solution to the interface within a time
//! that rounding takes from the times of the run, |g/ġ| ≤ ε max(|t₀|, |t_end|), the start is on the
//! interface. So a run starts again at a transition point, on whichever side of the interface rounding
//! has left it.

use super::around::Around;
use super::conditions::check_conditions;
use super::events::with_clocks;
use super::reading::Reading;
use crate::contract::{System, Vector};
use crate::error::{Error, ErrorKind, invalid};
use crate::method::Active;

/// Where an integration starts.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Start<R> {
    pub(crate) region: R,
    /// The interfaces that it starts on.
    pub(crate) on: Active,
}

impl<R: Copy> Start<R> {
    /// The start at (t, x) of a run until `t_end`, after all input is checked: in a region that is
    /// named, or in the one that the solution enters, with the discrete states of one like it or the
    /// initial ones.
    pub(super) fn checked<Sys: System<N, Region = R>, const N: usize>(
        system: &Sys,
        (named, like): (Option<R>, Option<R>),
        (t, t_end): (f64, f64),
        x: &Vector<f64, N>,
    ) -> Result<Self, Error> {
        check_values(system, x)?;
        let start = match named {
            Some(region) => check_region(system, region, (t, t_end), x),
            None => find_region(system, like, t, x),
        }?;
        check_conditions(system, start.region, t, x)?;
        Ok(start)
    }
}

/// Determines the region of a start at (t, x) that names none; discrete states are those of `like`,
/// or the initial ones.
fn find_region<Sys: System<N>, const N: usize>(
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

/// Checks a region that the caller named against the signs at (t, x), in a run until `t_end`.
fn check_region<Sys: System<N>, const N: usize>(
    system: &Sys,
    region: Sys::Region,
    (t, t_end): (f64, f64),
    x: &Vector<f64, N>,
) -> Result<Start<Sys::Region>, Error> {
    let moment = f64::EPSILON * t.abs().max(t_end.abs());
    let region = with_clocks(system, region, t, x)?;
    let mut on = Active::default();
    for interface in 0..system.metadata().interfaces.len() {
        let reading = Reading::new(system, region, interface, t, x);
        let Some(side) = system.side(region, interface) else {
            if system.slides_on(region, interface) && !reading.is_zero() {
                return Err(ErrorKind::InvalidInput {
                    what: "region",
                    value: system.of_region(region).name.to_owned(),
                    requirement: "the start does not lie on the interface that it slides on",
                }
                .into());
            }
            continue;
        };
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
            on.insert(interface);
        } else if value < 0.0 || value.is_nan() {
            return Err(ErrorKind::InvalidInput {
                what: "region",
                value: system.of_region(region).name.to_owned(),
                requirement: "the start does not lie in it",
            }
            .into());
        }
    }
    let metadata = system.metadata();
    for guard in metadata.interfaces.len()..metadata.first_condition() {
        let bounds = system.of_region(region).side(guard);
        let reading = Reading::new(system, region, guard, t, x);
        if bounds.is_some() && !reading.is_zero() && reading.value < 0.0 {
            return Err(ErrorKind::InvalidInput {
                what: "region",
                value: system.of_region(region).name.to_owned(),
                requirement: "a field beside its interface leads away from it at the start",
            }
            .into());
        }
    }
    Ok(Start { region, on })
}

/// Checks the state and the parameters at a start.
fn check_values<Sys: System<N>, const N: usize>(
    system: &Sys,
    x0: &Vector<f64, N>,
) -> Result<(), Error> {
    let names = system.metadata();
    if let Some(refusal) = system.refusal() {
        return invalid("system", format!("{} backwards", names.name), refusal);
    }
    if let Some(i) = (0..N).find(|&i| !x0[i].is_finite()) {
        return invalid(
            "initial state",
            format!("{} = {}", names.states[i], x0[i]),
            "must be finite",
        );
    }
    let parameters = names.parameters.iter().zip(system.parameters());
    let mut infinite = parameters.filter(|(_, value)| !value.is_finite());
    match infinite.next() {
        Some((name, value)) => invalid("parameter", format!("{name} = {value}"), "must be finite"),
        None => Ok(()),
    }
}
