//! Fig. 9, left: the objective (56) as a function of the initial state,
//!
//! V(x₀) = ∫₀² x² dt + (x(2) − 5/3)², ẋ = 2 − sgn x,
//!
//! whose integral is a second state.

use dmm_picture::{Axis, GREY, Look, Panel, Picture, Scale, Stroke};
use dmm_problems::method::MethodName;

use super::runs::{self, Case, Form};
use crate::failure::Failure;
use crate::output;
use crate::paper::report::Report;

const DECLARATION: &str = "
system Objective {
    state x, cost;
    interface switch = x;
    der(cost) = x^2;
    region below where switch < 0 { der(x) = 3; }
    region above where switch > 0 { der(x) = 1; }
}";
const T_END: f64 = 2.0;
/// As in the paper.
const STEPS: u32 = 25;
/// Of initial states, all of which meet the switch.
const RANGE: (f64, f64) = (-2.0, -0.8);
/// The solution of 8x² − 18x − 42 = 0 at which V′ vanishes.
const MINIMUM: f64 = -1.427_572_232_082_767;

/// V, from the solution 3 (t − tₛ) before and t − tₛ after the switch at tₛ = −x₀/3.
fn exact(x0: f64) -> f64 {
    let end = T_END + x0 / 3.0;
    -x0.powi(3) / 9.0 + end.powi(3) / 3.0 + (end - 5.0 / 3.0).powi(2)
}

/// The same of a computed end.
fn value(end: &[f64]) -> f64 {
    end[1] + (end[0] - 5.0 / 3.0).powi(2)
}

/// Both forms beside the exact curve.
pub(super) fn figure(report: &mut Report, points: u32) -> Result<(), Failure> {
    let problem = runs::declared(DECLARATION)?;
    let header = ["x0", "exact", "standard", "switch_detecting"];
    let mut csv = report.out.csv("fig9_objective.csv", header)?;
    let mut curves = [Vec::new(), Vec::new(), Vec::new()];
    for k in 0..=points {
        let x0 = RANGE.0 + (RANGE.1 - RANGE.0) * f64::from(k) / f64::from(points);
        let case = Case {
            problem: &problem,
            method: MethodName::GaussLegendre2,
            initial: &[x0, 0.0],
            t_end: T_END,
        };
        let mut values = vec![exact(x0)];
        for form in Form::ALL {
            values.push(value(&case.end(form, STEPS)?));
        }
        for (curve, value) in curves.iter_mut().zip(&values) {
            curve.push((x0, *value));
        }
        csv.row(
            [&[x0][..], &values]
                .concat()
                .into_iter()
                .map(output::number),
        )?;
    }
    report.out.add(csv.finish()?);
    let [exact, computed @ ..] = &curves;
    for (form, curve) in Form::ALL.into_iter().zip(computed) {
        compare(report, form, curve, exact);
    }
    let axis = |label: &str| Axis::new(label, Scale::Linear);
    let mut panel = Panel::new(
        "Gauss–Legendre of order 4, 25 steps",
        axis("x₀"),
        axis("V(x₀)"),
    );
    let [exact, standard, detecting] = curves;
    panel.curve(Some("exact".to_owned()), exact, Stroke::Solid, GREY);
    panel.curve(
        Some(Form::Standard.name().to_owned()),
        standard,
        Stroke::Thin,
        Look::nth(0),
    );
    let some = detecting.into_iter().step_by((points / 30).max(1) as usize);
    let label = Some(Form::Detecting.name().to_owned());
    panel.curve(label, some.collect(), Stroke::Circles, Look::nth(1));
    let picture = Picture {
        panel_size: (640.0, 440.0),
        ..Picture::row(
            "Fig. 9: objective as a function of the initial state",
            vec![panel],
        )
    };
    report
        .out
        .picture("fig9_objective", &picture, report.format)
}

/// Adds a curve to the comparison.
fn compare(report: &mut Report, form: Form, curve: &[(f64, f64)], exact: &[(f64, f64)]) {
    let paper = match form {
        Form::Standard => ["O(τ)", "does not converge", "many"],
        Form::Detecting => ["on the analytic curve", "converges", "one"],
    };
    let difference = largest_distance(curve, exact);
    let difference_of_slopes = largest_distance(&slopes(curve), &slopes(exact));
    let rows = [
        ("|V − exact|", format!("at most {difference:.1e}")),
        (
            "|V′ − exact|, by differences",
            format!("at most {difference_of_slopes:.1e}"),
        ),
        ("local minima", minima(curve)),
    ];
    for ((what, ours), paper) in rows.into_iter().zip(paper) {
        report.line(
            "Fig. 9",
            format!("objective, {}: {what}", form.name()),
            paper,
            ours,
        );
    }
}

fn largest_distance(curve: &[(f64, f64)], other: &[(f64, f64)]) -> f64 {
    let distances = curve.iter().zip(other).map(|(p, q)| (p.1 - q.1).abs());
    distances.fold(0.0, f64::max)
}

/// Difference quotients between neighbours.
fn slopes(curve: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let pairs = curve.windows(2);
    let slope = |p: &[(f64, f64)]| (p[0].0, (p[1].1 - p[0].1) / (p[1].0 - p[0].0));
    pairs.map(slope).collect()
}

/// How many local minima there are within the range, and where a single one is.
fn minima(curve: &[(f64, f64)]) -> String {
    let triples = curve.windows(3);
    let lowest: Vec<f64> = triples
        .filter(|p| p[1].1 < p[0].1 && p[1].1 < p[2].1)
        .map(|p| p[1].0)
        .collect();
    match lowest.as_slice() {
        [x0] => format!("one, at x₀ = {x0:.3} (exact {MINIMUM:.3})"),
        many => many.len().to_string(),
    }
}
