//! Why a solution cannot go on from a point of interfaces: no mode fits there, or several do.

use super::around::Around;
use crate::contract::{Side, System, Vector};
use crate::error::{Error, ErrorKind};

impl<Sys: System<N>, const N: usize> Around<'_, Sys, N> {
    /// No field leads into its region.
    #[cold]
    pub(super) fn none(&self, modes: &[Sys::Region]) -> Error {
        let is_open = |mode: &&Sys::Region| {
            let mut on = self.on.iter();
            !on.any(|&one| self.system.slides_on(**mode, one))
        };
        let open: Vec<Sys::Region> = modes.iter().filter(is_open).copied().collect();
        let [from, to] = open[..] else {
            return self.intersection();
        };
        let differs = |&&one: &&usize| self.system.side(from, one) != self.system.side(to, one);
        let interface = self.on.iter().find(differs).copied().unwrap_or_default();
        let [from, to] = [from, to].map(|mode| (mode, self.rate(mode, interface)));
        stays(self.system, (from, to), interface, self.t, self.x)
    }

    /// The fields of several modes fit.
    #[cold]
    pub(super) fn several(&self, modes: impl Iterator<Item = Sys::Region>) -> Error {
        let names = modes.map(|mode| format!("`{}`", mode_name(self.system, mode)));
        self.error(ErrorKind::Ambiguous {
            interfaces: self.interfaces(),
            regions: names.collect::<Vec<String>>().join(", "),
        })
    }

    #[cold]
    pub(super) fn intersection(&self) -> Error {
        self.error(ErrorKind::Intersection {
            interfaces: self.interfaces(),
        })
    }

    /// The interfaces that the point is on, by their names.
    fn interfaces(&self) -> String {
        let names = self.on.iter();
        let names = names.map(|&one| format!("`{}`", self.system.metadata().guard_name(one)));
        names.collect::<Vec<String>>().join(", ")
    }

    pub(super) fn error(&self, kind: ErrorKind) -> Error {
        kind.at(self.t, self.x.as_slice(), "")
    }
}

/// A region with the sides of switches, as in `everywhere (v > 0)`.
fn mode_name<Sys: System<N>, const N: usize>(system: &Sys, mode: Sys::Region) -> String {
    let metadata = system.metadata();
    let side = |&interface: &usize| {
        let sign = match system.side(mode, interface)? {
            Side::Positive => ">",
            Side::Negative => "<",
        };
        Some(format!("{} {sign} 0", metadata.interfaces.get(interface)?))
    };
    let sides: Vec<String> = metadata.switches.iter().filter_map(side).collect();
    let name = system.of_region(mode).name;
    if sides.is_empty() {
        name.to_owned()
    } else {
        format!("{name} ({})", sides.join(", "))
    }
}

/// A mode with dg/dt under its field.
type Rated<R> = (R, f64);

/// The error of a solution that the field of neither side leads away from an interface: both point
/// at it, or one is tangential to it.
#[cold]
pub(super) fn stays<Sys: System<N>, const N: usize>(
    system: &Sys,
    ((from, rate_from), (to, rate_to)): (Rated<Sys::Region>, Rated<Sys::Region>),
    interface: usize,
    t: f64,
    x: &Vector<f64, N>,
) -> Error {
    let inwards = system.side(to, interface).map_or(0.0, Side::sign);
    let interface = system.metadata().guard_name(interface);
    let [from, to] = [from, to].map(|region| system.of_region(region).name);
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
    kind.at(t, x.as_slice(), from)
}
