//! What lies around a point of interfaces: the modes that meet there, and the one that the solution
//! goes on in.
//!
//! Away from the interfaces the signs of the switching functions tell the region. On some of them
//! every choice of sides is a region that meets the point, and so is every sliding motion on some of
//! them. The solution goes on in the mode whose own field fits to its choice at each of these
//! interfaces: dg/dt > 0 where it lies on the side g > 0, dg/dt < 0 where it lies on the side g < 0,
//! and where it slides the fields of both sides lead to the interface, which the ends of the motion
//! tell. These are the solutions of the complementarity problem (17) of Nurkanović, Sperl, Albrecht &
//! Diehl (2024) of each independent group of interfaces. None is a motion that is not declared,
//! several are several solutions, and where one of them neither enters nor leaves (dg/dt = 0) it is
//! not determined. Nothing depends on the order in which interfaces and regions are declared.

use super::reading::Reading;
use crate::contract::{Side, System, Vector};
use crate::error::{Error, ErrorKind};
use crate::method::Active;

/// On so many interfaces all choices are looked at; on more of them one group of those that depend on
/// one another after the other.
const MOST_AT_ONCE: usize = 5;
/// A group of interfaces that depend on one another at a point has so many at most.
const MOST: usize = 8;

/// A choice: the side of an interface, or nothing where it is slid on.
type Choice = Option<Side>;

/// A point with the signs of the switching functions.
pub(super) struct Around<'a, Sys: System<N>, const N: usize> {
    system: &'a Sys,
    t: f64,
    x: &'a Vector<f64, N>,
    /// A mode with the discrete states of the point.
    like: Sys::Region,
    /// The sides of all interfaces; of no meaning for those that the point is on.
    sides: Vec<Choice>,
    /// The interfaces that the point is on.
    on: Vec<usize>,
    /// The interface that a sliding motion leaves at the point, on a side.
    left: Option<(usize, Side)>,
    /// The other interfaces that it slid on. While the solution slides on all of them, dg/dt of the
    /// interface that is left is zero at the point and grows.
    kept: Vec<usize>,
}

/// How the field of a mode fits to a choice at one interface.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Fit {
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

    fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Fails, _) | (_, Self::Fails) => Self::Fails,
            (Self::Open, _) | (_, Self::Open) => Self::Open,
            _ => Self::Fits,
        }
    }
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

    /// Whether a mode leaves an interface as the end of a sliding motion tells: it goes on sliding on
    /// the others, so that its field is that of the motion.
    fn leaves(&self, mode: Sys::Region, interface: usize, side: Side) -> bool {
        let mut kept = self.kept.iter();
        self.left == Some((interface, side)) && kept.all(|&one| self.system.slides_on(mode, one))
    }

    /// The interfaces that the point is on.
    pub(super) fn on(&self) -> &[usize] {
        &self.on
    }

    /// The mode that the solution goes on in, and the interfaces that bound it at the point.
    ///
    /// # Errors
    /// None, or several.
    pub(super) fn entered(&self) -> Result<(Sys::Region, Active), Error> {
        let mut sides = self.sides.clone();
        let groups = if self.on.len() <= MOST_AT_ONCE {
            vec![self.on.clone()]
        } else {
            self.groups()
        };
        for group in &groups {
            self.choose(group, &mut sides)?;
        }
        let mode = self.settled(sides.clone());
        let mode = mode.ok_or_else(|| self.error(ErrorKind::NoRegion))?;
        let fits = self.on.iter().map(|&one| self.fit(mode, one, &sides));
        if groups.len() > 1 && fits.fold(Fit::Fits, Fit::and) != Fit::Fits {
            return Err(self.intersection());
        }
        Ok((mode, self.active(mode)))
    }

    /// Chooses for the interfaces of a group, whose choices depend on one another.
    fn choose(&self, group: &[usize], sides: &mut [Choice]) -> Result<(), Error> {
        if group.len() > MOST {
            return Err(self.intersection());
        }
        let mut around = Vec::new();
        let mut open = false;
        let mut entered: Vec<(Sys::Region, Vec<Choice>)> = Vec::new();
        for choices in self.choices(group) {
            let mut sides = sides.to_vec();
            for (&interface, &choice) in group.iter().zip(&choices) {
                sides[interface] = choice;
            }
            let Some(mode) = self.settled(sides.clone()) else {
                continue;
            };
            // where an interface does not bound a region, both choices are the same
            if around.contains(&mode) {
                continue;
            }
            around.push(mode);
            let fits = group.iter().map(|&one| self.fit(mode, one, &sides));
            match fits.fold(Fit::Fits, Fit::and) {
                Fit::Fits => entered.push((mode, choices)),
                Fit::Open => open = true,
                Fit::Fails => {}
            }
        }
        // a field that is tangential to an interface may lead into its region as well
        match (&entered[..], &around[..]) {
            ([(_, choices)], _) if !open => {
                for (&interface, &choice) in group.iter().zip(choices) {
                    sides[interface] = choice;
                }
                Ok(())
            }
            ([], []) => Err(self.error(ErrorKind::NoRegion)),
            ([], around) => Err(self.none(around)),
            (_, around) if open => Err(self.none(around)),
            (several, _) => Err(self.several(several.iter().map(|&(mode, _)| mode))),
        }
    }

    /// All choices for a group of interfaces.
    fn choices(&self, group: &[usize]) -> Vec<Vec<Choice>> {
        let mut all = vec![Vec::new()];
        for interface in group {
            let mut of_interface = vec![Some(Side::Positive), Some(Side::Negative)];
            let is_left = self.left.is_some_and(|(left, _)| left == *interface);
            if !is_left && self.system.metadata().sliding.contains(interface) {
                of_interface.push(None);
            }
            let longer = all.iter().flat_map(|begun| {
                of_interface.iter().map(move |&choice| {
                    let mut choices: Vec<Choice> = begun.clone();
                    choices.push(choice);
                    choices
                })
            });
            all = longer.collect();
        }
        all
    }

    /// The interfaces that the point is on, by groups of those whose choices change how the fields fit
    /// at one another.
    fn groups(&self) -> Vec<Vec<usize>> {
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for &one in &self.on {
            let mut group = vec![one];
            for known in std::mem::take(&mut groups) {
                if known.iter().any(|&other| self.are_coupled(one, other)) {
                    group.extend(known);
                } else {
                    groups.push(known);
                }
            }
            groups.push(group);
        }
        groups
    }

    /// Whether the choice at one of two interfaces changes how fast the field moves away from the
    /// other one.
    fn are_coupled(&self, one: usize, other: usize) -> bool {
        let changes = |interface: usize, of: usize| {
            [Side::Positive, Side::Negative].iter().any(|&own| {
                let mut rates = [Side::Positive, Side::Negative].iter().map(|&choice| {
                    let mut sides = self.sides.clone();
                    (sides[interface], sides[of]) = (Some(own), Some(choice));
                    let mode = self.settled(sides)?;
                    Some(self.rate(mode, interface))
                });
                let first = rates.next();
                rates.any(|rate| Some(rate) != first)
            })
        };
        changes(one, other) || changes(other, one)
    }

    /// The interfaces of the point that bound a mode.
    fn active(&self, mode: Sys::Region) -> Active {
        let bounds = |&&interface: &&usize| self.system.side(mode, interface).is_some();
        let mut active = Active::default();
        let on = self.on.iter().filter(bounds);
        on.for_each(|&interface| active.insert(interface));
        active
    }

    /// The mode on these sides; where switching functions depend on the sides of others, the
    /// sides of those that the point is not on are the ones that they have there.
    fn settled(&self, mut sides: Vec<Choice>) -> Option<Sys::Region> {
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

    /// How the field of a mode fits to a choice at an interface: it leads to that side, or along the
    /// interface.
    fn fit(&self, mode: Sys::Region, interface: usize, choices: &[Choice]) -> Fit {
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
        let region = self.system.of_region(mode);
        let bounds = region.sides.get(interface).copied().flatten().is_some();
        if bounds || metadata.switches.contains(&interface) {
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
        let region = self.system.of_region(mode);
        let is_own = |guard: &usize| {
            let end = metadata.end(*guard);
            let is_own =
                end.is_some_and(|end| (end.interface, end.side) == (interface, Some(side)));
            is_own && region.sides.get(*guard).copied().flatten().is_some()
        };
        let guard = (metadata.interfaces.len()..metadata.first_condition()).find(is_own)?;
        let reading = Reading::new(self.system, mode, guard, self.t, self.x);
        reading.is_zero().then_some(reading.rate)
    }

    /// Whether the ends of a sliding motion that belong to an interface are ahead of it.
    fn stays_on(&self, mode: Sys::Region, interface: usize) -> Fit {
        let metadata = self.system.metadata();
        let own = metadata.ends.iter().enumerate().filter(|(_, end)| {
            // the others tell of crossings during the motion
            end.interface == interface && end.side.is_some()
        });
        let guards = own.map(|(number, _)| metadata.interfaces.len() + number);
        let region = self.system.of_region(mode);
        let ahead = guards.filter(|&guard| region.sides.get(guard).copied().flatten().is_some());
        let readings = ahead.map(|guard| {
            let reading = Reading::new(self.system, mode, guard, self.t, self.x);
            if reading.is_zero() {
                Fit::of(reading.rate)
            } else {
                Fit::of(reading.value)
            }
        });
        readings.fold(Fit::Fits, Fit::and)
    }

    fn rate(&self, mode: Sys::Region, interface: usize) -> f64 {
        Reading::new(self.system, mode, interface, self.t, self.x).rate
    }

    /// No field leads into its region.
    #[cold]
    fn none(&self, modes: &[Sys::Region]) -> Error {
        let is_open = |mode: &&Sys::Region| {
            let on = self.on.iter();
            on.filter(|&&one| self.system.slides_on(**mode, one))
                .count()
                == 0
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
    fn several(&self, modes: impl Iterator<Item = Sys::Region>) -> Error {
        let names = modes.map(|mode| format!("`{}`", mode_name(self.system, mode)));
        self.error(ErrorKind::Ambiguous {
            interfaces: self.interfaces(),
            regions: names.collect::<Vec<String>>().join(", "),
        })
    }

    #[cold]
    fn intersection(&self) -> Error {
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

    fn error(&self, kind: ErrorKind) -> Error {
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
