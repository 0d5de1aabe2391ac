//! What lies around a point of interfaces: the regions that meet there, and the one whose own field
//! leads into it.
//!
//! Away from the interfaces the signs of the switching functions tell the region. On some of them
//! every choice of sides is a region that meets the point, and the solution goes on in the one whose
//! field enters it at each of these interfaces: dg/dt > 0 where it lies on the side g > 0, dg/dt < 0
//! where it lies on the side g < 0. None is sliding or rest, several are several solutions, and where
//! one of them neither enters nor leaves (dg/dt = 0) it is not determined. Nothing depends on the
//! order in which interfaces and regions are declared.

use super::reading::Reading;
use crate::contract::{Side, System, Vector};
use crate::error::{Error, ErrorKind};
use crate::method::Active;

/// A point that lies on so many interfaces at most: all choices of their sides are looked at.
const MOST: usize = 12;

/// A point with the signs of the switching functions.
pub(super) struct Around<'a, Sys: System<N>, const N: usize> {
    system: &'a Sys,
    t: f64,
    x: &'a Vector<f64, N>,
    /// A mode with the discrete states of the point.
    like: Sys::Region,
    /// The sides of all interfaces; of no meaning for those that the point is on.
    sides: Vec<Side>,
    /// The interfaces that the point is on.
    on: Vec<usize>,
}

impl<'a, Sys: System<N>, const N: usize> Around<'a, Sys, N> {
    /// The point (t, x), where the discrete states are those of `like`; it is on an interface where
    /// g is no more than its rounding errors, or `is_on` knows it of its value there.
    pub(super) fn new(
        system: &'a Sys,
        like: Sys::Region,
        t: f64,
        x: &'a Vector<f64, N>,
        is_on: impl Fn(usize, f64) -> bool,
    ) -> Result<Self, Error> {
        let interfaces = 0..system.metadata().interfaces.len();
        let mut on = Vec::new();
        let mut sides = Vec::with_capacity(interfaces.len());
        for interface in interfaces {
            let reading = Reading::new(system, like, interface, t, x);
            if reading.value.is_nan() {
                return Err(ErrorKind::NoRegion.at(t, x.as_slice(), ""));
            }
            if reading.is_zero() || is_on(interface, reading.value) {
                on.push(interface);
            }
            sides.push(Side::of(reading.value));
        }
        Ok(Self {
            system,
            t,
            x,
            like,
            sides,
            on,
        })
    }

    /// The interfaces that the point is on.
    pub(super) fn on(&self) -> &[usize] {
        &self.on
    }

    /// The region that the solution goes on in, and the interfaces that bound it at the point.
    ///
    /// # Errors
    /// None, or several.
    pub(super) fn entered(&self) -> Result<(Sys::Region, Active), Error> {
        let regions = self.regions();
        let inwards: Vec<f64> = regions.iter().map(|&region| self.inwards(region)).collect();
        // a field that is tangential to an interface may lead into its region as well
        if inwards.contains(&0.0) {
            return Err(self.none(&regions));
        }
        let entered = regions.iter().zip(&inwards);
        let entered = entered.filter(|(_, inwards)| **inwards > 0.0);
        let entered: Vec<Sys::Region> = entered.map(|(&region, _)| region).collect();
        match (&entered[..], &regions[..]) {
            (&[region], _) => Ok((region, self.active(region))),
            ([], []) => Err(self.error(ErrorKind::NoRegion)),
            ([], regions) => Err(self.none(regions)),
            (several, _) => Err(self.several(several)),
        }
    }

    /// The interfaces of the point that bound a region.
    fn active(&self, region: Sys::Region) -> Active {
        let bounds = |&&interface: &&usize| self.system.side(region, interface).is_some();
        let mut active = Active::default();
        let on = self.on.iter().filter(bounds);
        on.for_each(|&interface| active.insert(interface));
        active
    }

    /// The regions that meet the point.
    fn regions(&self) -> Vec<Sys::Region> {
        if self.on.len() > MOST {
            return Vec::new();
        }
        let mut sides = self.sides.clone();
        let mut regions = Vec::new();
        for choice in 0..1_usize << self.on.len() {
            for (place, &interface) in self.on.iter().enumerate() {
                sides[interface] = if choice >> place & 1 == 0 {
                    Side::Positive
                } else {
                    Side::Negative
                };
            }
            let region = self.settled(sides.clone());
            regions.extend(region.filter(|region| !regions.contains(region)));
        }
        regions
    }

    /// The region on these sides; where switching functions depend on the sides of others, the
    /// sides of those that the point is not on are the ones that they have there.
    fn settled(&self, mut sides: Vec<Side>) -> Option<Sys::Region> {
        let mut region = self.system.region_on(&sides, Some(self.like))?;
        let metadata = self.system.metadata();
        for _ in 0..metadata.switches.len() {
            let mut is_settled = true;
            for (interface, side) in sides.iter_mut().enumerate() {
                if self.on.contains(&interface) {
                    continue;
                }
                let reading = Reading::new(self.system, region, interface, self.t, self.x);
                let found = Side::of(reading.value);
                is_settled &= found == *side;
                *side = found;
            }
            if is_settled {
                break;
            }
            region = self.system.region_on(&sides, Some(self.like))?;
        }
        Some(region)
    }

    /// The least dg/dt into a region among the interfaces that bound it at the point: its field leads
    /// into it where that is positive.
    fn inwards(&self, region: Sys::Region) -> f64 {
        let rates = self.on.iter().filter_map(|&interface| {
            let side = self.system.side(region, interface)?;
            Some(self.rate(region, interface) * side.sign())
        });
        // a rate that is not a number leads nowhere
        rates.fold(f64::INFINITY, |least, rate| {
            if rate < least || rate.is_nan() {
                rate
            } else {
                least
            }
        })
    }

    fn rate(&self, region: Sys::Region, interface: usize) -> f64 {
        Reading::new(self.system, region, interface, self.t, self.x).rate
    }

    /// No field leads into its region.
    #[cold]
    fn none(&self, regions: &[Sys::Region]) -> Error {
        let [from, to] = regions else {
            return self.error(ErrorKind::Intersection {
                interfaces: self.interfaces(),
            });
        };
        let differs = |&&one: &&usize| self.system.side(*from, one) != self.system.side(*to, one);
        let interface = self.on.iter().find(differs).copied().unwrap_or_default();
        let [from, to] = [*from, *to].map(|region| (region, self.rate(region, interface)));
        stays(self.system, (from, to), interface, self.t, self.x)
    }

    /// The fields of several regions lead into them.
    #[cold]
    fn several(&self, regions: &[Sys::Region]) -> Error {
        let names = regions.iter();
        let names = names.map(|&region| format!("`{}`", self.system.of_region(region).name));
        self.error(ErrorKind::Ambiguous {
            interfaces: self.interfaces(),
            regions: names.collect::<Vec<String>>().join(", "),
        })
    }

    /// The interfaces that the point is on, by their names.
    fn interfaces(&self) -> String {
        let names = self.on.iter();
        let names = names.map(|&one| format!("`{}`", self.system.metadata().guard_name(one)));
        names.collect::<Vec<String>>().join(", ")
    }

    fn error(&self, kind: ErrorKind) -> Error {
        kind.at(self.t, self.x.as_slice(), "")
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
