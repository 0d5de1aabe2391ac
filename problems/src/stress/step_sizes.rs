//! Step sizes from the limit of stability to 10⁻⁹: as long as a step has a solution, ψ keeps
//! its level; when it has none any more, that is said.

use super::report::{Extent, Observe, Row, Verdict, kind_of};
use super::setting::{SETTINGS, Setting};
use crate::conservation::{Conservation, measure};
use crate::picture::{Axis, COLOURS, Panel, Scale, Stroke};
use crate::problem::Run;
use crate::registry::find;
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
            observer.begins(&format!("{name}, {}", setting.name));
            let results: Vec<_> = step_sizes()
                .map(|tau| (tau, run(name, &setting, tau, steps)))
                .collect();
            let kept = |(tau, result): &(f64, Option<Result<Conservation, Error>>)| match result {
                Some(Ok(kept)) => Some((*tau, kept.ulps)),
                _ => None,
            };
            panel.curve(
                Some(name.to_owned()),
                results.iter().filter_map(kept).collect(),
                Stroke::Marked,
                COLOURS[k % COLOURS.len()],
            );
            observer.ended(summary(name, setting.name, &results));
        }
        panels.push(panel);
    }
    panels
}

/// From far beyond what a step can do.
fn step_sizes() -> impl Iterator<Item = f64> {
    (-2..=18).map(|k| 10f64.powf(-0.5 * f64::from(k)))
}

fn run(name: &str, setting: &Setting, tau: f64, steps: f64) -> Option<Result<Conservation, Error>> {
    let problem = find(name).ok()?;
    let run = Run {
        step_size: tau,
        t_end: tau * steps,
        ..setting.run(&problem)
    };
    Some(measure(&problem, &run, &mut |_| {}))
}

/// One row for all step sizes of a problem.
fn summary(
    problem: &str,
    scheme: &str,
    results: &[(f64, Option<Result<Conservation, Error>>)],
) -> Row {
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
