//! A point of interfaces, and the modes that meet there: every choice of sides is a region, and every
//! choice of interfaces to slide on a motion.

use super::reading::Reading;
use crate::contract::{Side, System, Vector};
use crate::error::{Error, ErrorKind};

/// A choice: the side of an interface, or nothing where it is slid on.
pub(super) type Choice = Option<Side>;

/// A point with the signs of the switching functions.
pub(super) struct Around<'a, Sys: System<N>, const N: usize> {
    pub(super) system: &'a Sys,
    pub(super) t: f64,
    pub(super) x: &'a Vector<f64, N>,
    /// A mode with the discrete states of the point.
    pub(super) like: Sys::Region,
    /// The sides of all interfaces; of no meaning for those that the point is on.
    pub(super) sides: Vec<Choice>,
    /// The interfaces that the point is on.
    pub(super) on: Vec<usize>,
    /// The interface that a sliding motion leaves at the point, on a side.
    pub(super) left: Option<(usize, Side)>,
    /// The other interfaces that it slid on. While the solution slides on all of them, dg/dt of the
    /// interface that is left is zero at the point and grows.
    pub(super) kept: Vec<usize>,
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
            sides.push(Some(Side::of(reading.value)));
        }
        Ok(Self {
            system,
            t,
            x,
            like,
            sides,
            on,
            left: None,
            kept: Vec::new(),
        })
    }

    /// The same where a sliding motion leaves an interface on a side.
    pub(super) fn leaving(mut self, motion: Sys::Region, interface: usize, side: Side) -> Self {
        self.left = Some((interface, side));
        let slides = |&&one: &&usize| one != interface && self.system.slides_on(motion, one);
        self.kept = self.on.iter().filter(slides).copied().collect();
        self
    }

    /// The interfaces that the point is on.
    pub(super) fn on(&self) -> &[usize] {
        &self.on
    }

    /// The mode on these sides; where switching functions depend on the sides of others, the
    /// sides of those that the point is not on are the ones that they have there.
    pub(super) fn settled(&self, mut sides: Vec<Choice>) -> Option<Sys::Region> {
        let mut mode = self.system.region_on(&sides, Some(self.like))?;
        let metadata = self.system.metadata();
        for _ in 0..metadata.switches.len() {
            let mut is_settled = true;
            for (interface, side) in sides.iter_mut().enumerate() {
                if self.on.contains(&interface) {
                    continue;
                }
                let reading = Reading::new(self.system, mode, interface, self.t, self.x);
                let found = Some(Side::of(reading.value));
                is_settled &= found == *side;
                *side = found;
            }
            if is_settled {
                break;
            }
            mode = self.system.region_on(&sides, Some(self.like))?;
        }
        Some(mode)
    }
}
