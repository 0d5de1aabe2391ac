//! Time against final error: every scheme over many step sizes or tolerances, until a
//! fixed time at which the exact state is known.
//!
//! The runs of all settings are made in turn, round after round, so that what disturbs the
//! machine for a while disturbs all alike, and what is measured is the thread's processor time.
//! Nothing listens to them, and nothing is kept from
//! one to the next.

use std::ops::ControlFlow;
use std::time::Duration;

use cpu_time::ThreadTime;
use dmm_runtime::{Error, Statistics};
use thiserror::Error as ThisError;

use crate::accurate;
use crate::method::{Control, MethodName};
use crate::problem::{Finish, Problem, Run};
use crate::reference::Reference;
use crate::truth::{Origin, TruthError, is_known};

/// Without a sample of the reference at it, the time of comparison: before chaos has enlarged
/// the errors of the exact solution's integrator.
const WITHOUT_REFERENCE: f64 = 10.0;
/// Longer references are compared at this time, or the last sample before it.
const LONGEST: f64 = 100.0;
/// The coarsest step size; the others are halves of it, a quarter, ….
const LARGEST_STEP: f64 = 1.0 / 16.0;
/// The loosest tolerance; the others are a tenth of it, a hundredth, ….
const LOOSEST: f64 = 1e-2;
/// A smaller final error is the rounding of the exact state.
const ROUNDING: f64 = 1e-14;
/// Shorter runs are repeated within a turn, and their mean counts.
const SHORTEST_TURN: Duration = Duration::from_micros(300);

/// The exact state at the time of comparison.
#[derive(Clone, PartialEq, Debug)]
pub struct Goal {
    /// The time.
    pub t: f64,
    /// The state.
    pub x: Vec<f64>,
    /// Where it is from.
    pub origin: Origin,
}

/// A scheme with a step size or a tolerance, measured.
#[derive(Clone, PartialEq, Debug)]
pub struct Setting {
    /// The scheme.
    pub method: MethodName,
    /// Its step size or tolerance.
    pub control: f64,
    /// ‖x̂ − x‖ at the time of comparison.
    pub error: f64,
    /// Counters of a run.
    pub statistics: Statistics,
    /// Seconds of a run, of each round, in ascending order.
    pub seconds: Vec<f64>,
    /// About the seconds that a turn takes.
    turn: f64,
}

impl Setting {
    /// Minimum, median and maximum of the seconds.
    pub fn spread(&self) -> [f64; 3] {
        let at = |place: usize| self.seconds.get(place).copied().unwrap_or(f64::NAN);
        let count = self.seconds.len();
        [at(0), at(count / 2), at(count.saturating_sub(1))]
    }
}

/// Why nothing can be measured.
#[derive(Debug, ThisError)]
pub enum GoalError {
    /// There is no exact state.
    #[error(transparent)]
    Truth(#[from] TruthError),
    /// The time makes no sense.
    #[error("end time: {0} (must be positive and finite)")]
    Time(f64),
}

impl Goal {
    /// The exact state at `t`, or at the time that suits the problem.
    ///
    /// # Errors
    /// [`GoalError`] if it cannot be computed.
    pub fn of(problem: &Problem, t: Option<f64>) -> Result<Self, GoalError> {
        let reference = Reference::of(problem).map_err(TruthError::from)?;
        let samples = reference.map_or_else(Vec::new, |reference| reference.samples);
        let wanted = samples.into_iter().rev().find(|sample| match t {
            Some(t) => sample.t == t,
            None => sample.t <= LONGEST,
        });
        if let Some(sample) = wanted.filter(|_| problem.has_default_parameters()) {
            return Ok(Self {
                t: sample.t,
                x: sample.x,
                origin: Origin::Reference,
            });
        }
        let t = t.unwrap_or(WITHOUT_REFERENCE);
        if !(t.is_finite() && t > 0.0) {
            return Err(GoalError::Time(t));
        }
        is_known(problem)?;
        let nodes = accurate::crossings(problem, problem.description().initial, t, usize::MAX)
            .map_err(TruthError::from)?;
        let last = nodes
            .last()
            .ok_or(TruthError::from(accurate::Stuck { t }))?;
        Ok(Self {
            t,
            x: accurate::state_at(problem, last, t).map_err(TruthError::from)?,
            origin: Origin::Accurate,
        })
    }

    /// Measures `methods` in `rounds` rounds; what stops before its end is left out. The first run of
    /// a method that takes more than `longest` is that of its last setting. `progress`
    /// is told the share of the work that is done, and says whether to go on: if not, what was
    /// timed until then is what was measured.
    pub fn measure(
        &self,
        problem: &Problem,
        methods: &[MethodName],
        rounds: u32,
        longest: Duration,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Vec<Setting> {
        // a round takes as long as the first runs
        let first = 1.0 / f64::from(rounds + 1);
        let mut settings = Vec::new();
        let total: f64 = methods.iter().map(|method| weight(*method)).sum();
        let mut done = 0.0;
        for &method in methods {
            if progress(first * done / total).is_break() {
                return Vec::new();
            }
            settings.extend(self.settings_of(problem, method, longest));
            done += weight(method);
        }
        self.time(problem, &mut settings, rounds, &mut |share| {
            progress(first + (1.0 - first) * share)
        });
        settings.retain(|setting| !setting.seconds.is_empty());
        for setting in &mut settings {
            setting.seconds.sort_by(f64::total_cmp);
        }
        settings
    }

    /// Times every setting in turn.
    fn time(
        &self,
        problem: &Problem,
        settings: &mut [Setting],
        rounds: u32,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) {
        let round: f64 = settings.iter().map(|setting| setting.turn).sum();
        let total = f64::from(rounds) * round;
        let mut done = 0.0;
        for _ in 0..rounds {
            for setting in &mut *settings {
                let run = self.run(problem, setting.method, setting.control);
                if let Ok(seconds) = turn(problem, &run) {
                    setting.seconds.push(seconds);
                }
                done += setting.turn;
                if progress(done / total).is_break() {
                    return;
                }
            }
        }
    }

    fn run(&self, problem: &Problem, method: MethodName, control: f64) -> Run {
        Run {
            method,
            step_size: control,
            tolerance: control,
            t_end: self.t,
            ..problem.default_run()
        }
    }

    /// The settings of a scheme, from the coarsest until the error is rounding or a run takes
    /// too long.
    fn settings_of(
        &self,
        problem: &Problem,
        method: MethodName,
        longest: Duration,
    ) -> Vec<Setting> {
        let mut settings = Vec::new();
        let (mut control, factor, least) = match method.control() {
            Control::StepSize { .. } => (LARGEST_STEP, 0.5, 0.0),
            Control::Tolerance => (LOOSEST, 0.1, f64::EPSILON),
        };
        while control > least {
            let run = self.run(problem, method, control);
            let start = ThreadTime::now();
            let result = problem.integrate_silently(&run);
            let elapsed = start.elapsed();
            if let Ok(finish) = result {
                settings.push(self.setting(method, control, &finish, elapsed));
            }
            let exact = settings.last().is_some_and(|it| it.error < ROUNDING);
            if elapsed > longest || exact {
                break;
            }
            control *= factor;
        }
        settings
    }

    fn setting(
        &self,
        method: MethodName,
        control: f64,
        finish: &Finish,
        elapsed: Duration,
    ) -> Setting {
        let squares = finish.x.iter().zip(&self.x).map(|(a, b)| (a - b).powi(2));
        Setting {
            method,
            control,
            error: squares.sum::<f64>().sqrt(),
            statistics: finish.statistics,
            seconds: Vec::new(),
            turn: elapsed.max(SHORTEST_TURN).as_secs_f64(),
        }
    }
}

/// About the time that the settings of a scheme take: until a run is too long where errors fall
/// by a low power of the cost, next to none where rounding is reached before.
fn weight(method: MethodName) -> f64 {
    match method {
        MethodName::Taylor | MethodName::Best => 0.05,
        _ => 1.0,
    }
}

/// Seconds of a run.
fn turn(problem: &Problem, run: &Run) -> Result<f64, Error> {
    let start = ThreadTime::now();
    let mut runs = 0;
    while runs == 0 || start.elapsed() < SHORTEST_TURN {
        std::hint::black_box(problem.integrate_silently(run)?);
        runs += 1;
    }
    Ok(start.elapsed().as_secs_f64() / f64::from(runs))
}

/// The fastest setting of a scheme that reaches an error, and whose next finer one does too.
pub fn fastest(settings: &[Setting], method: MethodName, error: f64) -> Option<&Setting> {
    let own: Vec<&Setting> = settings.iter().filter(|it| it.method == method).collect();
    let next = own.iter().skip(1).chain(own.last());
    own.iter()
        .zip(next)
        .filter(|(setting, finer)| setting.error <= error && finer.error <= error)
        .map(|(setting, _)| *setting)
        .min_by(|a, b| a.spread()[0].total_cmp(&b.spread()[0]))
}
