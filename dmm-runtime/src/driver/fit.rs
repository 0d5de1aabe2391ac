//! How the field of a mode fits to the choice of a side, or of sliding, at an interface.

use super::around::{Around, Choice};
use super::reading::Reading;
use crate::contract::{Side, System};

/// How the field of a mode fits to a choice at one interface.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Fit {
    /// It does.
    Fits,
    /// It does not.
    Fails,
    /// The rate that decides is zero.
    Open,
}

impl Fit {
    /// By a rate that has to be positive.
    fn of(rate: f64) -> Self {
        if rate > 0.0 {
            Self::Fits
        } else if rate == 0.0 {
            Self::Open
        } else {
            // a rate that is not a number leads nowhere
            Self::Fails
        }
    }

    pub(super) fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Fails, _) | (_, Self::Fails) => Self::Fails,
            (Self::Open, _) | (_, Self::Open) => Self::Open,
            _ => Self::Fits,
        }
    }
}

impl<Sys: System<N>, const N: usize> Around<'_, Sys, N> {
    /// How the field of a mode fits to a choice at an interface: it leads to that side, or along the
    /// interface.
    pub(super) fn fit(&self, mode: Sys::Region, interface: usize, choices: &[Choice]) -> Fit {
        match choices[interface] {
            Some(side) if self.leaves(mode, interface, side) => Fit::Fits,
            Some(side) if self.system.side(mode, interface).is_some() => {
                if let Some(rate) = self.rate_of_end(interface, side, choices) {
                    return Fit::of(-rate);
                }
                let rate = self.rate(mode, interface);
                if rate == 0.0 && self.rests_on(mode, interface) {
                    let known = self.system.side(self.like, interface);
                    return if known == Some(side) {
                        Fit::Fits
                    } else {
                        Fit::Fails
                    };
                }
                Fit::of(rate * side.sign())
            }
            Some(_) => Fit::Fits,
            None => self.stays_on(mode, interface),
        }
    }

    /// Whether a mode leaves an interface as the end of a sliding motion tells: it goes on sliding on
    /// the others, so that its field is that of the motion.
    fn leaves(&self, mode: Sys::Region, interface: usize, side: Side) -> bool {
        let mut kept = self.kept.iter();
        self.left == Some((interface, side)) && kept.all(|&one| self.system.slides_on(mode, one))
    }

    /// Whether a mode stays on one of the interfaces.
    pub(super) fn rests(&self, mode: Sys::Region) -> bool {
        let mut on = self.on.iter();
        on.any(|&one| self.rate(mode, one) == 0.0 && self.rests_on(mode, one))
    }

    /// Whether a mode stays on an interface that has to do with events alone, because nothing moves its
    /// switching function there: then it keeps the side that it had.
    fn rests_on(&self, mode: Sys::Region, interface: usize) -> bool {
        /// How far ahead along the field that is tried, in units of time.
        const AHEAD: [f64; 3] = [1e-6, 1e-3, 1.0];
        let metadata = self.system.metadata();
        let bounds = self.system.of_region(mode).side(interface);
        if bounds.is_some() || metadata.switches.contains(&interface) {
            return false;
        }
        let field = self.system.vector_field(mode, self.t, self.x);
        AHEAD.iter().all(|&ahead| {
            let x = self.x + field * ahead;
            Reading::new(self.system, mode, interface, self.t + ahead, &x).rate == 0.0
        })
    }

    /// At the end of sliding on an interface, where the field of a side is tangential to it: how fast
    /// that field turns to the interface, which says whether the solution slides on or leaves.
    fn rate_of_end(&self, interface: usize, side: Side, choices: &[Choice]) -> Option<f64> {
        let metadata = self.system.metadata();
        if !metadata.sliding.contains(&interface) {
            return None;
        }
        let mut choices = choices.to_vec();
        choices[interface] = None;
        let mode = self.settled(choices)?;
        let mut ends = self.ends_of(mode, interface);
        let (_, reading) = ends.find(|(of, _)| *of == side)?;
        reading.is_zero().then_some(reading.rate)
    }

    /// Whether the ends of a sliding motion that belong to an interface are ahead of it.
    fn stays_on(&self, mode: Sys::Region, interface: usize) -> Fit {
        let fits = self.ends_of(mode, interface).map(|(_, reading)| {
            if reading.is_zero() {
                Fit::of(reading.rate)
            } else {
                Fit::of(reading.value)
            }
        });
        fits.fold(Fit::Fits, Fit::and)
    }

    /// The ends of a sliding motion at which it leaves an interface: the side, and what is positive
    /// until then.
    fn ends_of(
        &self,
        mode: Sys::Region,
        interface: usize,
    ) -> impl Iterator<Item = (Side, Reading)> {
        let metadata = self.system.metadata();
        let region = self.system.of_region(mode);
        let guards = metadata.interfaces.len()..;
        let own = guards.zip(metadata.ends).filter_map(move |(guard, end)| {
            // the others tell of crossings during the motion
            let side = end.side.filter(|_| end.interface == interface)?;
            region.side(guard).map(|_| (guard, side))
        });
        own.map(move |(guard, side)| {
            let reading = Reading::new(self.system, mode, guard, self.t, self.x);
            (side, reading)
        })
    }

    pub(super) fn rate(&self, mode: Sys::Region, interface: usize) -> f64 {
        Reading::new(self.system, mode, interface, self.t, self.x).rate
    }
}
