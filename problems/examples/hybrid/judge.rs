//! What became of a run, beside the reference.

use dmm_runtime::{Error, Model};

use crate::decide::Stop;
use crate::motion::Systems;
use crate::plant::State;
use crate::reference::{Setting, Solution, solve};
use crate::run::{Run, Scheme, Told};
use dmm_problems::random::Random;

/// The step of the reference.
const STEP: f64 = 0.05;
/// Solutions are followed through so many transitions.
const MOST: usize = 40;
/// A run goes on for so long behind the point where the reference ends.
const BEYOND: f64 = 0.05;
/// The refusal of a run and the end of the reference are the same point within this time.
const TOGETHER: f64 = 1e-4;
/// Tolerances are so many times the difference that a change of the initial state makes which is as
/// large as the error of the scheme.
const FACTOR: f64 = 10.0;

/// What became of a run.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Outcome {
    /// The same itinerary, times and states.
    Same,
    /// Refused where the reference ends too: there is no solution, or several.
    Confirmed(String),
    /// Refused where the reference is not decided.
    Degenerate(String),
    /// The same until the reference is not decided, for this reason.
    Undecided(&'static str),
    /// Refused where the reference goes on.
    Refused(String, String),
    /// Something else, and nothing was said.
    Silent(String),
}

/// A system with an initial state.
pub(crate) struct Case<'a> {
    pub(crate) systems: Systems<'a>,
    pub(crate) model: &'a Model,
    pub(crate) x0: State,
    pub(crate) t_end: f64,
}

impl Case<'_> {
    fn reference(&self, x0: &State, step: f64, t_end: f64) -> Solution {
        let setting = Setting {
            step,
            t_end,
            most: MOST,
        };
        solve(&self.systems, x0, setting)
    }

    /// The reference; the end time is put where the solution is not far away yet.
    pub(crate) fn solution(&mut self) -> Solution {
        loop {
            let solution = self.reference(&self.x0, STEP, self.t_end);
            if solution.stop != Some(Stop::Far) {
                return solution;
            }
            self.t_end = 0.97 * solution.t;
        }
    }

    /// A run to where the reference ends, or a bit farther.
    fn told(&self, solution: &Solution, scheme: Scheme) -> Result<Told, Error> {
        let is_over = solution.stop.is_some() || solution.passed.len() == MOST;
        let t_end = if matches!(solution.stop, Some(Stop::Undecided(_))) {
            solution.t
        } else if is_over {
            (solution.t + BEYOND).min(self.t_end)
        } else {
            self.t_end
        };
        let run = Run {
            systems: self.systems,
            scheme,
            x0: self.x0,
            t_end,
            most: MOST,
        };
        run.of(self.model)
    }

    /// What becomes of a run by a scheme, beside the reference.
    pub(crate) fn judge(&self, solution: &Solution, scheme: Scheme) -> Outcome {
        let told = match self.told(solution, scheme) {
            Ok(told) => told,
            Err(error) => return Outcome::Silent(format!("{error}")),
        };
        let outcome = compare(solution, &told, scheme.error());
        if !matches!(outcome, Outcome::Silent(_) | Outcome::Refused(..)) {
            return outcome;
        }
        // again with shorter steps, and with what a change of the initial state makes
        let finer = self.reference(&self.x0, STEP / 8.0, self.t_end);
        if finer.stop == Some(Stop::Far) {
            return Outcome::Undecided("far away");
        }
        let Ok(told) = self.told(&finer, scheme) else {
            return outcome;
        };
        let tolerance = match self.difference(&finer, scheme) {
            Ok(difference) => scheme.error() + FACTOR * difference,
            Err(reason) => return Outcome::Undecided(reason),
        };
        match compare(&finer, &told, tolerance) {
            Outcome::Silent(text) => Outcome::Silent(format!("{text}\n{}", both(&finer, &told))),
            Outcome::Refused(kind, text) => {
                Outcome::Refused(kind, format!("{text}\n{}", both(&finer, &told)))
            }
            outcome => outcome,
        }
    }

    /// The largest difference that a change of the initial state makes.
    fn difference(&self, solution: &Solution, scheme: Scheme) -> Result<f64, &'static str> {
        let mut random = Random::new("changes", 0, 0);
        let mut largest = 0.0_f64;
        for _ in 0..4 {
            let mut x0 = self.x0;
            let states = x0.iter_mut().take(self.systems.plant.states);
            let size = scheme.error() / 10.0;
            states.for_each(|entry| *entry += random.between(-size, size));
            if on_interface(&self.systems, &self.x0) {
                x0 = self.x0;
            }
            let other = self.reference(&x0, STEP / 2.0, self.t_end);
            let is_same =
                other.stop == solution.stop
                    && other.passed.len() == solution.passed.len()
                    && other.passed.iter().zip(&solution.passed).all(|(a, b)| {
                        (a.interface, a.kind, &a.slid) == (b.interface, b.kind, &b.slid)
                    });
            if !is_same {
                return Err("another itinerary after a small change");
            }
            let passed = other.passed.iter().zip(&solution.passed);
            let parts = passed.map(|(a, b)| (a.t - b.t).abs().max(distance(&a.after, &b.after)));
            largest = parts.fold(largest, f64::max);
            largest = largest.max(distance(&other.x, &solution.x));
        }
        Ok(largest)
    }
}

fn on_interface(systems: &Systems<'_>, x0: &State) -> bool {
    let mut all = 0..systems.plant.interfaces.len();
    all.any(|k| systems.g(k, 0.0, x0).abs() < 1e-11)
}

/// Compares what a run has told with the reference.
fn compare(solution: &Solution, told: &Told, tolerance: f64) -> Outcome {
    let count = solution.passed.len().min(told.passed.len());
    for (number, (own, other)) in solution.passed.iter().zip(&told.passed).enumerate() {
        let time = (own.t - other.t).abs();
        let state = distance(&own.after, &other.after);
        let what = if own.interface != other.interface && own.interface.is_some() {
            "another interface".to_owned()
        } else if own.kind != other.kind || own.slid != other.slid {
            "another thing happens".to_owned()
        } else if time > tolerance {
            format!("another time, by {time:e}")
        } else if state > tolerance * 10.0 {
            format!("another state, by {state:e}")
        } else {
            continue;
        };
        return Outcome::Silent(format!("transition {}: {what}", number + 1));
    }
    if let Some(error) = &told.error {
        return refused(solution, told, error);
    }
    if told.passed.len() > count {
        let extra = told.passed[count].t;
        return match solution.stop {
            Some(Stop::Undecided(reason)) if extra >= solution.t - TOGETHER => {
                Outcome::Undecided(reason)
            }
            Some(stop) => Outcome::Silent(format!("goes on where the reference ends: {stop:?}")),
            None if extra > solution.t => Outcome::Same,
            None => Outcome::Silent(format!("a transition more, at {extra}")),
        };
    }
    if solution.passed.len() > count {
        let t = solution.passed[count].t;
        if let Some(Stop::Undecided(reason)) = solution.stop
            && t > solution.t - TOGETHER
        {
            return Outcome::Undecided(reason);
        }
        return Outcome::Silent(format!("a transition less, that at {t}"));
    }
    match solution.stop {
        Some(Stop::Undecided(reason)) => return Outcome::Undecided(reason),
        Some(stop) if told.t > solution.t + TOGETHER => {
            return Outcome::Silent(format!("goes on where the reference ends: {stop:?}"));
        }
        Some(_) => return Outcome::Silent("ends before the reference".to_owned()),
        None => {}
    }
    let difference = distance(&solution.x, &told.x);
    if solution.passed.len() < MOST && difference > 10.0 * tolerance {
        return Outcome::Silent(format!("another end, by {difference:e}"));
    }
    Outcome::Same
}

/// What an error is.
fn refused(solution: &Solution, told: &Told, error: &Error) -> Outcome {
    let kind = format!("{:?}", error.kind);
    let kind = kind.split([' ', '(']).next().unwrap_or_default().to_owned();
    let is_there =
        (solution.t - told.t).abs() < TOGETHER && told.passed.len() == solution.passed.len();
    let mut forks = solution.forks.iter();
    if kind == "Ambiguous" && forks.any(|t| (t - told.t).abs() < TOGETHER) {
        return Outcome::Confirmed("Ambiguous beside a repelling slide".to_owned());
    }
    match solution.stop {
        Some(Stop::Undecided(_)) if is_there => Outcome::Degenerate(kind),
        Some(_) if is_there => Outcome::Confirmed(kind),
        Some(Stop::Undecided(reason)) if told.t > solution.t => Outcome::Undecided(reason),
        _ => Outcome::Refused(kind, error.to_string()),
    }
}

/// Both itineraries.
fn both(solution: &Solution, told: &Told) -> String {
    let line = |(number, one): (usize, &crate::reference::Passed)| {
        format!(
            "    {:>2}. t = {:.12}, {:?} at {:?}, slides on {:?}, x = {:.10?}\n",
            number + 1,
            one.t,
            one.kind,
            one.interface,
            one.slid,
            one.after
        )
    };
    let list =
        |all: &[crate::reference::Passed]| all.iter().enumerate().map(line).collect::<String>();
    format!(
        "  reference:\n{}    t = {:.12}, x = {:.10?}, {:?}\n  run:\n{}    t = {:.12}, x = {:.10?}\n",
        list(&solution.passed),
        solution.t,
        solution.x,
        solution.stop,
        list(&told.passed),
        told.t,
        told.x
    )
}

/// The largest difference of two states, as a part of 1 + |x|.
fn distance(a: &State, b: &State) -> f64 {
    let parts = a.iter().zip(b);
    parts
        .map(|(a, b)| (a - b).abs() / (1.0 + a.abs()))
        .fold(0.0, |most, part| {
            if part.is_nan() {
                f64::INFINITY
            } else {
                most.max(part)
            }
        })
}
