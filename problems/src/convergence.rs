//! Errors against the step size, before and after given numbers of transitions.
//!
//! After k transitions two errors are measured: that of the k-th crossing time, |t̂ₖ − t*ₖ|,
//! and that of every component of the state at a fixed time between the k-th crossing and the
//! next, at 3/10 of the way (not half way: there, by symmetry, an error of time may not show
//! in a component). For k = 0 the crossing is the first.

use dmm_runtime::ErrorKind;
use std::ops::ControlFlow;

use thiserror::Error;

use crate::method::MethodName;
use crate::problem::{AnyObserver, Crossed, OutputTimes, Problem, Record, Run};
use crate::truth::{Origin, Truth, TruthError};

/// Where in a segment the state is compared.
const SHARE_OF_SEGMENT: f64 = 0.3;

/// What to measure.
#[derive(Clone, PartialEq, Debug)]
pub struct Plan {
    /// The scheme.
    pub method: MethodName,
    /// x(0)
    pub initial: Vec<f64>,
    /// Numbers of transitions.
    pub after: Vec<usize>,
    /// Step sizes.
    pub step_sizes: Vec<f64>,
    /// For a problem without transitions, the time at which states are compared.
    pub t_end: f64,
}

/// What was measured.
#[derive(Clone, PartialEq, Debug)]
pub struct Study {
    /// Step sizes.
    pub step_sizes: Vec<f64>,
    /// What the errors are measured against.
    pub origin: Origin,
    /// A row for each number of transitions.
    pub rows: Vec<Row>,
    /// Integrations that stopped; what they did not reach is NaN in the rows.
    pub stopped: Vec<Stopped>,
}

/// An integration that stopped before its end.
#[derive(Clone, PartialEq, Debug, Error)]
#[error("with step size {step_size:?}: {error}")]
pub struct Stopped {
    /// τ
    pub step_size: f64,
    /// Why.
    pub error: Box<dmm_runtime::Error>,
}

/// Errors after a number of transitions.
#[derive(Clone, PartialEq, Debug)]
pub struct Row {
    /// The number of transitions.
    pub transitions: usize,
    /// The crossing that is measured, if there is one.
    pub crossing: Option<CrossingErrors>,
    /// The time at which the state is measured.
    pub t: f64,
    /// Errors of the components: `components[i][j]` for state i and step size j.
    pub components: Vec<Vec<f64>>,
}

/// Errors of a crossing time.
#[derive(Clone, PartialEq, Debug)]
pub struct CrossingErrors {
    /// Which crossing, counted from 1.
    pub number: usize,
    /// t*
    pub t: f64,
    /// |t̂ − t*| for each step size.
    pub errors: Vec<f64>,
}

/// Why a study could not be made.
#[derive(Debug, Error)]
pub enum StudyError {
    /// The plan makes no sense to the integrator.
    #[error(transparent)]
    Input(Box<dmm_runtime::Error>),
    /// Nothing to compare with.
    #[error(transparent)]
    Truth(#[from] TruthError),
    /// There are not so many transitions.
    #[error("{wanted} transitions were asked for, but there are {known} until t = {t_end}")]
    TooFew {
        /// As asked for.
        wanted: usize,
        /// As there are.
        known: usize,
        /// Until then.
        t_end: f64,
    },
}

impl Row {
    /// ‖x̂ − x‖ for each step size.
    pub fn norms(&self) -> Vec<f64> {
        norms(&self.components)
    }
}

/// The norm of the errors of some components, for each step size.
pub fn norms(components: &[Vec<f64>]) -> Vec<f64> {
    let count = components.first().map_or(0, Vec::len);
    let square = |j: usize| {
        let errors = components.iter().map(|errors| errors[j] * errors[j]);
        errors.sum::<f64>()
    };
    (0..count).map(|j| square(j).sqrt()).collect()
}

/// Default numbers of transitions: 0, 10, 20, 30 where there are so many, else a few spread
/// over what there is.
pub fn default_after(crossings_total: usize) -> Vec<usize> {
    let mut after = match crossings_total {
        31.. => vec![0, 10, 20, 30],
        total => vec![0, total / 3, 2 * total / 3, total],
    };
    after.dedup();
    after
}

/// Makes the study; `progress` is told the share of the work that is done, and says whether to go
/// on: if not, the step sizes that are left are not in the study.
///
/// # Errors
/// [`StudyError`]
pub fn study(
    problem: &Problem,
    plan: &Plan,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Study, StudyError> {
    let wanted = plan.after.iter().copied().max().unwrap_or_default();
    let truth = Truth::of(problem, &plan.initial, wanted + 1, plan.t_end)?;
    let known = truth.nodes.len() - 1;
    if wanted > known {
        return Err(StudyError::TooFew {
            wanted,
            known,
            t_end: plan.t_end,
        });
    }
    let mut after = plan.after.clone();
    after.sort_unstable();
    after.dedup();
    let times: Vec<f64> = after
        .iter()
        .map(|&k| sample_time(&truth, k, plan.t_end))
        .collect();
    let mut rows = Vec::new();
    for (&transitions, &t) in after.iter().zip(&times) {
        rows.push(Row {
            transitions,
            crossing: truth
                .nodes
                .get(transitions.max(1))
                .map(|node| CrossingErrors {
                    number: transitions.max(1),
                    t: node.t,
                    errors: Vec::new(),
                }),
            t,
            components: vec![Vec::new(); problem.states().len()],
        });
    }
    let exact: Vec<Vec<f64>> = rows
        .iter()
        .map(|row| truth.state(problem, row.transitions, row.t))
        .collect::<Result<_, _>>()?;
    let t_last = rows
        .iter()
        .map(|row| {
            row.crossing
                .as_ref()
                .map_or(row.t, |crossing| crossing.t.max(row.t))
        })
        .fold(0.0, f64::max);
    let mut stopped = Vec::new();
    let mut step_sizes = Vec::new();
    let steps = |step_sizes: &[f64]| step_sizes.iter().map(|tau| 1.0 / tau).sum::<f64>();
    let total = steps(&plan.step_sizes);
    for &step_size in &plan.step_sizes {
        let run = Run {
            method: plan.method,
            step_size,
            initial: plan.initial.clone(),
            // a late crossing is still to be seen
            t_end: if known == 0 {
                t_last
            } else {
                t_last * 1.01 + 4.0 * step_size
            },
            output_times: OutputTimes::At(times.clone()),
            ..problem.default_run()
        };
        let done = steps(&step_sizes) / total;
        let share = 1.0 / step_size / total;
        let mut collector = Collector {
            crossings: Vec::new(),
            states: Vec::new(),
            is_stopped: false,
            progress: &mut |t| progress(done + share * t / run.t_end),
        };
        match problem.integrate(&run, &mut collector) {
            Ok(_) => {}
            Err(error) if matches!(error.kind, ErrorKind::InvalidInput { .. }) => {
                return Err(StudyError::Input(Box::new(error)));
            }
            Err(error) => stopped.push(Stopped {
                step_size,
                error: Box::new(error),
            }),
        }
        if collector.is_stopped {
            break;
        }
        collector.add_to(&mut rows, &exact);
        step_sizes.push(step_size);
    }
    Ok(Study {
        step_sizes,
        origin: truth.origin,
        rows,
        stopped,
    })
}

/// The time at which the state after `transitions` is compared.
fn sample_time(truth: &Truth, transitions: usize, t_end: f64) -> f64 {
    let begin = truth.nodes.get(transitions).map_or(0.0, |node| node.t);
    match truth.nodes.get(transitions + 1) {
        Some(next) => begin + SHARE_OF_SEGMENT * (next.t - begin),
        None if transitions == 0 => t_end,
        None => begin + SHARE_OF_SEGMENT * (t_end - begin).max(0.0),
    }
}

/// Crossing times and the states at the output times of a run.
struct Collector<'a> {
    crossings: Vec<f64>,
    states: Vec<Vec<f64>>,
    is_stopped: bool,
    progress: &'a mut dyn FnMut(f64) -> ControlFlow<()>,
}

/// Steps from one word of progress to the next.
const TOLD: u64 = 1 << 10;

impl AnyObserver for Collector<'_> {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        let flow = (self.progress)(record.t);
        self.is_stopped = flow.is_break();
        flow
    }

    fn record_every(&self) -> u64 {
        TOLD
    }

    fn transition(&mut self, crossed: &Crossed) -> ControlFlow<()> {
        self.crossings.push(crossed.t);
        ControlFlow::Continue(())
    }

    fn output(&mut self, _t: f64, x: &[f64]) {
        self.states.push(x.to_vec());
    }
}

impl Collector<'_> {
    /// Appends this run's errors to each row; what the run did not reach is NaN.
    fn add_to(&self, rows: &mut [Row], exact: &[Vec<f64>]) {
        for (i, (row, exact)) in rows.iter_mut().zip(exact).enumerate() {
            if let Some(crossing) = &mut row.crossing {
                let found = self.crossings.get(crossing.number - 1);
                crossing
                    .errors
                    .push(found.map_or(f64::NAN, |t| (t - crossing.t).abs()));
            }
            for (component, errors) in row.components.iter_mut().enumerate() {
                let found = self.states.get(i).and_then(|x| x.get(component));
                errors.push(found.map_or(f64::NAN, |x| (x - exact[component]).abs()));
            }
        }
    }
}
