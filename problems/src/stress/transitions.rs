//! Levels over many transitions: an error in the location of a crossing is one of the level
//! that follows, and must not add up.
//!
//! The orbit of `elliptic` is closed; that of the star is chaotic, with the same energy on both
//! sides of the axis.

use std::ops::ControlFlow;

use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::report::{Extent, Observe, Row, Verdict};
use super::setting::{SETTINGS, Setting};
use super::systems::warped;
use crate::growth::Growth;
use crate::method::MethodName;
use crate::problem::{AnyObserver, Crossed, Finish, Problem, Record, Run};
use crate::reference::Reference;
use crate::registry::find;
use dmm_picture::{Axis, Look, Panel, Scale, Stroke};

/// Levels are of the order of 1: a few units in the last place, and what a random walk of
/// roundings makes of them.
fn bound(transitions: f64) -> f64 {
    16.0 * f64::EPSILON * transitions.sqrt()
}
/// Where the state at a transition is pinned with its remainder.
const PINNED: f64 = 1e-28;

pub(super) fn study(extent: Extent, observer: &mut dyn Observe) -> Vec<Panel> {
    let transitions = extent.of(1_000_000, 500);
    let mut panels = Vec::new();
    let Ok(elliptic) = find("elliptic") else {
        return panels;
    };
    for (kind, problem) in [("closed orbit", &elliptic), ("open orbit", &warped())] {
        let mut panel = Panel::new(
            format!("{}: {kind}", problem.description().name),
            Axis::new("transitions", Scale::Decades),
            Axis::new("largest |ψ_ref − exact level| so far", Scale::Decades),
        );
        for (k, setting) in SETTINGS.into_iter().enumerate() {
            let case = format!("{}, {}", problem.description().name, setting.name);
            if observer.begins(&case).is_break() {
                break;
            }
            let Some((row, growth)) = measure(problem, &setting, transitions, observer) else {
                break;
            };
            observer.ended(row);
            let label = Some(setting.name.to_owned());
            panel.curve(label, growth.points(), Stroke::Marked, Look::nth(k));
        }
        panels.push(panel);
    }
    if observer.begins("elliptic, with the remainder").is_break() {
        return panels;
    }
    for tolerance in [1e-3, 1e-12] {
        match pinned(&elliptic, tolerance, transitions, observer) {
            Some(row) => observer.ended(row),
            None => break,
        }
    }
    panels
}

/// Levels at entries into regions.
struct Levels<'a> {
    /// The exact level of each region.
    exact: Vec<f64>,
    growth: Growth,
    transitions: u64,
    wanted: u64,
    entered: bool,
    is_stopped: bool,
    observer: &'a mut dyn Observe,
}

impl AnyObserver for Levels<'_> {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        if let (true, Some(exact)) = (self.entered, self.exact.get(record.mode.region)) {
            let error = (record.level[0] - exact).abs();
            self.growth.offer(self.transitions as f64, error);
            self.entered = false;
        }
        if self.transitions >= self.wanted {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    fn transition(&mut self, _crossed: &Crossed) -> ControlFlow<()> {
        self.transitions += 1;
        self.entered = true;
        let share = self.transitions as f64 / self.wanted as f64;
        let flow = self.observer.at(share.min(1.0));
        self.is_stopped = flow.is_break();
        flow
    }
}

/// Nothing if the run was stopped.
fn measure(
    problem: &Problem,
    setting: &Setting,
    transitions: u64,
    observer: &mut dyn Observe,
) -> Option<(Row, Growth)> {
    let mut levels = Levels {
        exact: exact(problem),
        growth: Growth::default(),
        transitions: 0,
        wanted: transitions,
        entered: false,
        is_stopped: false,
        observer,
    };
    let run = Run {
        // more than there can be between transitions; the levels stop the run
        t_end: 100.0 * transitions as f64,
        ..setting.run(problem)
    };
    let what = format!("{}, {transitions} transitions", problem.description().name);
    let result = problem.integrate(&run, &mut levels);
    if levels.is_stopped {
        return None;
    }
    let row = match result {
        Ok(_) => {
            let (error, exponent) = (levels.growth.largest(), levels.growth.exponent());
            let holds = error <= bound(transitions as f64) && levels.transitions == transitions;
            let finding = format!("level off by {error:.1e}, growing with the power {exponent:.2}");
            Row::new(what, setting.name, Verdict::within(holds), finding)
        }
        // nothing stands in the way of these runs
        Err(error) => Row::new(what, setting.name, Verdict::Wrong, error.to_string()),
    };
    Some((row, levels.growth))
}

/// The exact level of each region: of the reference, or that of the start for all.
fn exact(problem: &Problem) -> Vec<f64> {
    let regions = problem.regions().len();
    let mut levels = vec![f64::NAN; regions];
    if let Ok(Some(reference)) = Reference::of(problem) {
        for side in [-1.0, 1.0] {
            let level = reference.constant_level(side).and_then(<[f64]>::first);
            let region = problem
                .region_on_side(side)
                .and_then(|region| levels.get_mut(region));
            if let (Some(level), Some(region)) = (level, region) {
                *region = *level;
            }
        }
        return levels;
    }
    let mut start = Start(f64::NAN);
    // the error, if there is one, is that of the run that follows
    let _ = problem.integrate(&problem.default_run(), &mut start);
    vec![start.0; regions]
}

/// ψ at the start.
struct Start(f64);

impl AnyObserver for Start {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        self.0 = record.psi[0];
        ControlFlow::Break(())
    }
}

/// Stops at a transition, or when it is told to.
struct Stop<'a> {
    transitions: u64,
    wanted: u64,
    is_stopped: bool,
    observer: &'a mut dyn Observe,
}

impl AnyObserver for Stop<'_> {
    fn transition(&mut self, _: &Crossed) -> ControlFlow<()> {
        self.transitions += 1;
        if self.transitions == self.wanted {
            return ControlFlow::Break(());
        }
        let flow = self
            .observer
            .at(self.transitions as f64 / self.wanted as f64);
        self.is_stopped = flow.is_break();
        flow
    }

    fn record_every(&self) -> u64 {
        0
    }
}

/// The level of `elliptic` outside of the circle after an even number of transitions, evaluated
/// exactly at the state with its remainder: it was 0 at the start. Nothing if the run was stopped.
fn pinned(
    problem: &Problem,
    tolerance: f64,
    transitions: u64,
    observer: &mut dyn Observe,
) -> Option<Row> {
    let what = format!("elliptic, state with remainder, {transitions} transitions");
    let scheme = format!("Taylor {tolerance:e}");
    let mut stop = Stop {
        transitions: 0,
        wanted: transitions,
        is_stopped: false,
        observer,
    };
    let run = Run {
        method: MethodName::Taylor,
        tolerance,
        t_end: 100.0 * transitions as f64,
        ..problem.default_run()
    };
    let result = problem.integrate(&run, &mut stop);
    if stop.is_stopped {
        return None;
    }
    Some(match result {
        Ok(finish) => {
            let level = exact_level(problem, &finish).map_or(f64::NAN, f64::abs);
            let finding = format!("level off by {level:.1e}");
            Row::new(what, scheme, Verdict::within(level <= PINNED), finding)
        }
        Err(error) => Row::new(what, scheme, Verdict::Wrong, error.to_string()),
    })
}

/// y² − x³ − a x, of the state with its remainder.
fn exact_level(problem: &Problem, finish: &Finish) -> Option<f64> {
    let rational = |value: f64| BigRational::from_float(value);
    let exactly = |i: usize| Some(rational(finish.x[i])? + rational(finish.remainder[i])?);
    let (x, y) = (exactly(0)?, exactly(1)?);
    let mut parameters = problem.parameters().into_iter();
    let (_, a) = parameters.find(|(name, _)| *name == "a_outside")?;
    (&y * &y - &x * &x * &x - rational(a)? * &x).to_f64()
}
