//! The study of all families: system after system, by every scheme.

use crate::families::{
    Bell, Bent, Clock, Exponential, Family, Flat, Hyperbolic, Logarithm, Plane, Polynomial,
    Rational, Root, Scales, Sheets, Space, Wave,
};
use crate::judge::Truth;
use crate::reference::{Ending, Growth, Problem, Reference, accurate};
use crate::schemes::{SETTINGS, in_turn, of_lanes};
use crate::tally::Tally;
use dmm_problems::random::Random;
use dmm_problems::stress::{Extent, Observe};
use dmm_problems::threads::side_by_side;

/// Systems that are integrated together in lanes: of the same scales.
const GROUP: usize = 4;
/// Longer itineraries are cut off.
const MOST_CROSSINGS: usize = 60;
/// Runs end where errors have grown by more.
const MOST_GROWTH: f64 = 1e4;
/// The shift of the start by which the growth is measured.
const SHIFT: f64 = 1e-7;
/// The reference goes farther than the runs, so that it knows of crossings just behind the end.
const LEAD: f64 = 0.97;

/// The runs of a family, by setting.
type Tallies = Vec<Tally>;
/// Makes the runs of so many groups of systems.
type Runs = fn(usize) -> Tallies;

/// The study: the families side by side.
pub(crate) fn study(extent: Extent, observer: &mut dyn Observe) {
    // of 14 families, of 4 systems each
    let groups = extent.of(500, 5);
    let families: [(&'static str, Runs); 14] = [
        family::<Polynomial, 2>(),
        family::<Rational, 2>(),
        family::<Root, 2>(),
        family::<Bent, 2>(),
        family::<Wave, 2>(),
        family::<Clock, 2>(),
        family::<Exponential, 2>(),
        family::<Logarithm, 2>(),
        family::<Hyperbolic, 2>(),
        family::<Flat, 2>(),
        family::<Bell, 2>(),
        family::<Sheets, 2>(),
        family::<Plane, 2>(),
        family::<Space, 3>(),
    ];
    let mut total = vec![Tally::default(); SETTINGS.len()];
    let run = |(title, runs): (&'static str, Runs)| (title, runs(groups));
    side_by_side(families, run, |(title, tallies)| {
        for ((setting, tally), total) in SETTINGS.iter().zip(&tallies).zip(&mut total) {
            total.add(tally);
            observer.ended(tally.row(title, setting.name));
        }
    });
    let mut all = Tally::default();
    for (setting, tally) in SETTINGS.iter().zip(&total) {
        all.add(tally);
        observer.ended(tally.row("all", setting.name));
    }
    observer.ended(all.row("all", "all"));
}

/// A system with what is known of its solution.
pub(crate) struct Case<Sys, const N: usize> {
    pub(crate) system: Sys,
    pub(crate) initial: [f64; N],
    pub(crate) problem: Problem,
    pub(crate) reference: Reference,
    pub(crate) growth: Growth,
    /// Where the solution is compared.
    pub(crate) t_end: f64,
}

impl<Sys: Family<N>, const N: usize> Case<Sys, N> {
    /// The next system that has a solution.
    pub(crate) fn draw(random: &mut Random, scales: Scales) -> Self {
        loop {
            let (system, initial) = Sys::draw(random, scales);
            let t_end = random.between(8.0, 20.0) / scales.s;
            if let Some(case) = Self::of(system, initial, t_end) {
                return case;
            }
        }
    }

    /// A system, unless its solution is lost.
    pub(crate) fn of(system: Sys, initial: [f64; N], t_end: f64) -> Option<Self> {
        let problem = system.problem(initial);
        let reference = accurate(&problem, t_end, MOST_CROSSINGS);
        if reference.ending == Ending::Lost {
            return None;
        }
        let growth = Growth::measure(&problem, &reference, SHIFT);
        let t_end = LEAD * growth.last_below(MOST_GROWTH);
        Some(Self {
            system,
            initial,
            problem,
            reference,
            growth,
            t_end,
        })
    }

    pub(crate) fn truth(&self, t_end: f64) -> Truth<'_> {
        Truth {
            problem: &self.problem,
            reference: &self.reference,
            growth: &self.growth,
            t_end,
        }
    }

    /// Where runs end that are made one by one: beyond the point from where the solution slides.
    pub(crate) fn own_end(&self) -> f64 {
        let slides = self.reference.ending == Ending::Sliding;
        if slides && self.t_end >= 0.99 * LEAD * self.reference.t_end {
            self.reference.t_end + 0.02 / self.problem.rate
        } else {
            self.t_end
        }
    }

    pub(crate) fn describe(&self, index: usize, t_end: f64) -> String {
        let (system, initial) = (&self.system, self.initial);
        format!("number {index}, {system:?} from {initial:?} to {t_end:?}")
    }
}

/// A family with what makes its runs.
fn family<Sys: Family<N>, const N: usize>() -> (&'static str, Runs) {
    (Sys::TITLE, tallies::<Sys, N>)
}

fn tallies<Sys: Family<N>, const N: usize>(groups: usize) -> Tallies {
    let mut tallies = vec![Tally::default(); SETTINGS.len()];
    for group in 0..groups {
        let mut random = Random::new(Sys::default().metadata().name, 0, group);
        let mut scale = |size: f64| {
            if random.once_in(3) {
                random.decades(1.0 / size, size)
            } else {
                1.0
            }
        };
        let scales = Scales {
            l: scale(1e6),
            s: scale(1e4),
        };
        let cases: Vec<Case<Sys, N>> = (0..GROUP)
            .map(|_| Case::draw(&mut random, scales))
            .collect();
        one_by_one(&cases, group * GROUP, &mut tallies);
        together(&cases, group, &mut tallies);
    }
    tallies
}

/// Runs each system with the settings whose turn it is.
fn one_by_one<Sys: Family<N>, const N: usize>(
    cases: &[Case<Sys, N>],
    first: usize,
    tallies: &mut [Tally],
) {
    for (case, index) in cases.iter().zip(first..) {
        let t_end = case.own_end();
        for k in in_turn(index) {
            let setting = &SETTINGS[k];
            let rate = case.problem.rate;
            let run = crate::schemes::run(setting, &case.system, rate, case.initial, t_end);
            let class = case.truth(t_end).judge(setting, &run);
            tallies[k].count(class, || case.describe(index, t_end));
        }
    }
}

/// Runs a group in lanes.
fn together<Sys: Family<N>, const N: usize>(
    cases: &[Case<Sys, N>],
    group: usize,
    tallies: &mut [Tally],
) {
    let k = of_lanes(group);
    let setting = &SETTINGS[k];
    let ends = cases.iter().map(|case| case.t_end);
    let t_end = ends.fold(f64::INFINITY, f64::min);
    let members = cases.iter().map(|case| (case.system.clone(), case.initial));
    let ends = crate::schemes::run_in_lanes(setting, members, t_end);
    for ((case, end), index) in cases.iter().zip(&ends).zip(group * GROUP..) {
        let class = case.truth(t_end).judge_end(setting, end);
        tallies[k].count(class, || case.describe(index, t_end));
    }
}
