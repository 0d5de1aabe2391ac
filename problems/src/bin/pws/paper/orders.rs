//! Figs 3, 4, 6 and 7: errors of crossing times and states against the step size.

use dmm_picture::{Look, Panel, Picture, Stroke};
use dmm_problems::convergence::{self, Plan, Study};
use dmm_problems::method::MethodName;
use dmm_problems::perturbed::Perturbed;
use dmm_problems::problem::Problem;

use super::report::Report;
use crate::converge::{self, axes, curve, halved, quantities};
use crate::failure::Failure;
use crate::input;
use crate::output;

/// Transitions after which errors are measured, as in the paper.
const AFTER: [usize; 4] = [0, 10, 20, 30];
/// Exponents p of the perturbations, as in the paper, each with the factor c, the largest step
/// size, and what it does. For p = 1 the steps are so small that the perturbation
/// outweighs the scheme's own error, and c so small that the perturbed elliptic orbits stay
/// closed for 30 transitions.
const PERTURBATIONS: [(i32, f64, f64, &str); 3] = [
    (1, 1.0 / 16.0, 1.0 / 4096.0, "crossings late by τ/16"),
    (2, 1.0, 1.0 / 64.0, "crossings late by τ²"),
    (15, 1.0, 1.0 / 64.0, "crossings late by τ¹⁵"),
];
const HALVINGS: u32 = 6;

fn plan(problem: &Problem, method: MethodName, step: f64) -> Plan {
    Plan {
        method,
        initial: problem.description().initial.to_vec(),
        after: AFTER.to_vec(),
        step_sizes: halved(step, HALVINGS),
        t_end: problem.description().t_end,
    }
}

fn order(study: &Study, errors: &[f64]) -> String {
    format!("order {}", converge::order(study, errors))
}

/// Figs 3 and 6: the error of the crossing time after 10, 20, 30 transitions.
pub(super) fn crossing_times(report: &mut Report, name: &str, number: u32) -> Result<(), Failure> {
    let problem = input::problem(name, &[])?;
    let study = convergence::study(
        &problem,
        &plan(&problem, MethodName::Symmetric, 1.0 / 64.0),
        &mut |share| report.at(share),
    )?;
    let file = format!("fig{number}_{name}_crossing_time");
    let header = ["crossing", "exact_time", "step_size", "error"];
    let mut csv = report.out.csv(&format!("{file}.csv"), header)?;
    let (x, y) = axes("|crossing time − exact|");
    let mut panel = Panel::new(problem.description().title, x, y);
    for (k, row) in study.rows.iter().enumerate() {
        let Some(crossing) = &row.crossing else {
            continue;
        };
        for (tau, error) in study.step_sizes.iter().zip(&crossing.errors) {
            csv.row([
                crossing.number.to_string(),
                output::number(crossing.t),
                output::number(*tau),
                output::number(*error),
            ])?;
        }
        let label = Some(format!("crossing {}", crossing.number));
        panel.curve(
            label,
            curve(&study, &crossing.errors),
            Stroke::Marked,
            Look::nth(k),
        );
        let what = format!("{name}: time of crossing {}", crossing.number);
        report.row(number, what, "order 2", order(&study, &crossing.errors));
    }
    panel.slope(2, 0);
    report.out.add(csv.finish()?);
    for (transitions, quantity, errors) in quantities(&problem, &study) {
        if !quantity.starts_with("time") {
            let what = format!("{name}: {quantity}, after {transitions}");
            report.row(number + 1, what, "order 2", order(&study, &errors));
        }
    }
    let picture = Picture::row(
        format!("Fig. {number}: error of the crossing time"),
        vec![panel],
    );
    report.out.picture(&file, &picture, report.format)
}

/// Figs 4 and 7: the error of the state with crossings located too late by c·τᵖ.
pub(super) fn states(report: &mut Report, name: &str, number: u32) -> Result<(), Failure> {
    let problem = input::problem(name, &[])?;
    let file = format!("fig{number}_{name}_perturbed");
    let header = [
        "p",
        "amplitude",
        "transitions",
        "t",
        "step_size",
        "error_norm",
    ];
    let mut csv = report.out.csv(&format!("{file}.csv"), header)?;
    let mut panels = Vec::new();
    let steps = |step: f64| 1.0 / step;
    let all: f64 = PERTURBATIONS.iter().map(|(.., step, _)| steps(*step)).sum();
    let weight = |step: f64| steps(step) / all;
    let mut done = 0.0;
    for (power, amplitude, step, title) in PERTURBATIONS {
        let method = MethodName::Perturbed(Perturbed { amplitude, power });
        let study = convergence::study(&problem, &plan(&problem, method, step), &mut |share| {
            report.at(done + share * weight(step))
        })?;
        done += weight(step);
        let (x, y) = axes("‖x̂ − x‖");
        let mut panel = Panel::new(title, x, y);
        for (k, row) in study.rows.iter().enumerate() {
            let norms = row.norms();
            for (tau, error) in study.step_sizes.iter().zip(&norms) {
                csv.row([
                    power.to_string(),
                    output::number(amplitude),
                    row.transitions.to_string(),
                    output::number(row.t),
                    output::number(*tau),
                    output::number(*error),
                ])?;
            }
            let (when, paper) = match row.transitions {
                0 => ("before".to_owned(), "order 2"),
                many if power == 1 => (format!("after {many}"), "order 1"),
                many => (format!("after {many}"), "order 2"),
            };
            let what = format!("{name}: p = {power}, ‖x̂ − x‖ {when} transitions");
            report.row(number, what, paper, order(&study, &norms));
            panel.curve(
                Some(when),
                curve(&study, &norms),
                Stroke::Marked,
                Look::nth(k),
            );
        }
        // with p = 1 the error before the first transition is of another order
        panel.slope(power.min(2), usize::from(power == 1));
        panels.push(panel);
    }
    report.out.add(csv.finish()?);
    let title = format!("Fig. {number}: error before and after 10, 20, 30 transitions, {name}");
    report
        .out
        .picture(&file, &Picture::row(title, panels), report.format)
}
