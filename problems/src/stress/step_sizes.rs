//! Step sizes from the limit of stability to 10⁻⁹: as long as a step has a solution, ψ keeps
//! its level; when it has none any more, that is said.

use std::ops::ControlFlow;

use super::report::{Extent, Observe, Row, Verdict, kind_of};
use super::setting::{SETTINGS, Setting};
use crate::conservation::{Conservation, measure};
use crate::problem::Run;
use crate::registry::find;
use dmm_picture::{Axis, Look, Panel, Scale, Stroke};
use dmm_runtime::Error;

/// Evaluating ψ costs two or three roundings of its terms, the state's own one each; at the limit
/// of stability the state moves by its own size in a step.
const BOUND: f64 = 16.0;
const PROBLEMS: [&str; 4] = ["harmonic", "elliptic", "pendulum", "henon_heiles"];

pub(super) fn study(extent: Extent, observer: &mut dyn Observe) -> Vec<Panel> {
    let steps = extent.of(1_000_000.0, 2_000.0);
    let mut panels = Vec::new();
    for setting in SETTINGS {
        if !setting.has_uniform_steps() {
            continue;
        }
        let mut panel = Panel::new(
            setting.name,
            Axis::new("step size τ", Scale::Decades),
            Axis::new("largest |ψ − ψ_ref| (ulp of ψ's terms)", Scale::Decades),
        );
        for (k, name) in PROBLEMS.into_iter().enumerate() {
            let begins = observer.begins(&format!("{name}, {}", setting.name));
            let measured = || measured(name, &setting, steps, observer);
            let Some(results) = begins.is_continue().then(measured).flatten() else {
                panels.push(panel);
                return panels;
            };
            let kept = |(tau, result): &Measured| match result {
                Some(Ok(kept)) => Some((*tau, kept.ulps)),
                _ => None,
            };
            panel.curve(
                Some(name.to_owned()),
                results.iter().filter_map(kept).collect(),
                Stroke::Marked,
                Look::nth(k),
            );
            observer.ended(summary(name, setting.name, &results));
        }
        panels.push(panel);
    }
    panels
}

/// A step size, and what a run with it did.
type Measured = (f64, Option<Result<Conservation, Error>>);

/// All step sizes of a problem; nothing if the case was stopped.
fn measured(
    name: &str,
    setting: &Setting,
    steps: f64,
    observer: &mut dyn Observe,
) -> Option<Vec<Measured>> {
    let count = step_sizes().count() as f64;
    let mut results = Vec::new();
    for (k, tau) in step_sizes().enumerate() {
        let mut is_stopped = false;
        let mut progress = |share: f64| {
            let flow = observer.at((k as f64 + share.min(1.0)) / count);
            is_stopped = flow.is_break();
            flow
        };
        let result = run(name, setting, tau, steps, &mut progress);
        if is_stopped {
            return None;
        }
        results.push((tau, result));
    }
    Some(results)
}

/// From far beyond what a step can do.
fn step_sizes() -> impl Iterator<Item = f64> {
    (-2..=18).map(|k| 10f64.powf(-0.5 * f64::from(k)))
}

fn run(
    name: &str,
    setting: &Setting,
    tau: f64,
    steps: f64,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Option<Result<Conservation, Error>> {
    let problem = find(name).ok()?;
    let run = Run {
        step_size: tau,
        t_end: tau * steps,
        ..setting.run(&problem)
    };
    let share = |t: f64| t / run.t_end;
    Some(measure(&problem, &run, &mut |t| progress(share(t))))
}

/// One row for all step sizes of a problem.
fn summary(problem: &str, scheme: &str, results: &[Measured]) -> Row {
    let mut worst: f64 = 0.0;
    let (mut largest, mut smallest): (f64, f64) = (0.0, f64::INFINITY);
    let mut refused = Vec::new();
    for (tau, result) in results {
        match result {
            Some(Ok(kept)) => {
                worst = if kept.ulps.is_nan() {
                    f64::NAN
                } else {
                    worst.max(kept.ulps)
                };
                (largest, smallest) = (largest.max(*tau), smallest.min(*tau));
            }
            Some(Err(error)) => refused.push(format!("{tau:.0e}: {}", kind_of(error))),
            None => {}
        }
    }
    let mut finding = format!("τ from {largest:.0e} to {smallest:.0e}: at most {worst:.2} ulp");
    if !refused.is_empty() {
        finding.push_str(&format!("; refused: {}", refused.join(", ")));
    }
    Row::new(problem, scheme, Verdict::within(worst <= BOUND), finding)
}
