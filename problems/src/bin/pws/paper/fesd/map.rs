//! Fig. 5: what the steps do as functions of the initial state, ẋ = 2 − sgn x + x² (Example 5).
//!
//! In the paper all steps of an arc are of one size, so that the first one jumps where the last one
//! starts to meet the switch; ours are those of the grid until one meets it.

use dmm_picture::{Axis, Look, Panel, Picture, Scale, Stroke};
use dmm_problems::method::MethodName;

use super::runs::{self, Case, Form};
use crate::failure::Failure;
use crate::output;
use crate::paper::report::Report;

const DECLARATION: &str = "
system Example5 {
    state x;
    interface switch = x;
    region below where switch < 0 { der(x) = 3 + x^2; }
    region above where switch > 0 { der(x) = 1 + x^2; }
}";
/// As in the paper.
const T_END: f64 = 0.2;
const STEPS: u32 = 2;
const RANGE: (f64, f64) = (-0.7, 0.1);
/// Steps of a run that meets the switch.
const MOST_STEPS: usize = 3;

/// The time of the switch, of the tangent that the solution is below it.
fn switch(x0: f64) -> f64 {
    -(x0 / 3f64.sqrt()).atan() / 3f64.sqrt()
}

/// x(T), by the tangents of both sides.
fn exact(x0: f64) -> f64 {
    let root = 3f64.sqrt();
    match switch(x0) {
        ..=0.0 => (T_END + x0.atan()).tan(),
        T_END.. => root * (root * (T_END - switch(x0))).tan(),
        switch => (T_END - switch).tan(),
    }
}

/// The first step size, and where it jumps.
fn first_size(sizes: &[(f64, f64)]) -> String {
    let whole = T_END / f64::from(STEPS);
    let expected = |x0: f64| match switch(x0) {
        t if (0.0..whole).contains(&t) && x0 < 0.0 => t,
        _ => whole,
    };
    let errors = sizes.iter().map(|&(x0, size)| (size - expected(x0)).abs());
    let error = errors.fold(0.0, f64::max);
    let pairs = sizes.windows(2);
    let jumps = pairs.filter(|pair| (pair[1].1 - pair[0].1).abs() > 0.5 * whole);
    let jumps: Vec<String> = jumps
        .map(|pair| output::short((1e3 * pair[1].0).round() / 1e3 + 0.0))
        .collect();
    let jumps = jumps.join(", ");
    format!("the time to the switch, at most T/2, to {error:.1e}; jumps at x₀ = {jumps}")
}

/// Curves over the initial state.
struct Curves {
    /// The size of each step.
    sizes: [Vec<(f64, f64)>; MOST_STEPS],
    /// x(T), with detection of switches.
    ends: Vec<(f64, f64)>,
    /// The error of x(T) of each form.
    errors: [Vec<(f64, f64)>; 2],
}

/// The sizes of the steps, the end, and its error.
pub(super) fn figure(report: &mut Report, points: u32) -> Result<(), Failure> {
    let curves = measure(report, points)?;
    report.line(
        "Fig. 5",
        "first step size h₀(x₀)",
        "jumps to the time of the switch where that is T",
        first_size(&curves.sizes[0]),
    );
    for (form, curve) in Form::ALL.into_iter().zip(&curves.errors) {
        let largest = curve.iter().fold(0.0, |worst: f64, p| worst.max(p.1));
        let what = format!("x(0.2), {}: error", form.name());
        report.line(
            "Fig. 5",
            what,
            "not given",
            format!("at most {largest:.1e}"),
        );
    }
    let title = "Fig. 5: two steps of Radau IIA of order 3 as functions of the initial state";
    let picture = Picture::row(title, curves.panels());
    report.out.picture("fig5_step_map", &picture, report.format)
}

fn measure(report: &mut Report, points: u32) -> Result<Curves, Failure> {
    let problem = runs::declared(DECLARATION)?;
    let header = [
        "x0",
        "exact",
        "standard",
        "switch_detecting",
        "step1",
        "step2",
        "step3",
    ];
    let mut csv = report.out.csv("fig5_step_map.csv", header)?;
    let mut curves = Curves {
        sizes: Default::default(),
        ends: Vec::new(),
        errors: Default::default(),
    };
    for k in 0..=points {
        let x0 = RANGE.0 + (RANGE.1 - RANGE.0) * f64::from(k) / f64::from(points);
        let case = Case {
            problem: &problem,
            method: MethodName::RadauIia2,
            initial: &[x0],
            t_end: T_END,
        };
        let standard = case.end(Form::Standard, STEPS)?[0];
        let seen = case.detecting(STEPS)?;
        let (detecting, exact) = (seen.last[0], exact(x0));
        let mut row = vec![x0, exact, standard, detecting];
        for (curve, size) in curves.sizes.iter_mut().zip(&seen.sizes) {
            curve.push((x0, *size));
            row.push(*size);
        }
        row.resize(header.len(), 0.0);
        csv.row(row.into_iter().map(output::number))?;
        curves.ends.push((x0, detecting));
        for (curve, x) in curves.errors.iter_mut().zip([standard, detecting]) {
            curve.push((x0, (x - exact).abs()));
        }
    }
    report.out.add(csv.finish()?);
    Ok(curves)
}

impl Curves {
    fn panels(self) -> Vec<Panel> {
        let panel = |label: &str, scale| {
            let x = Axis::new("x₀", Scale::Linear);
            Panel::new("", x, Axis::new(label, scale))
        };
        let mut steps = panel("step size", Scale::Linear);
        let names = ["first", "second", "third"];
        for (k, (curve, name)) in self.sizes.into_iter().zip(names).enumerate() {
            steps.curve(Some(name.to_owned()), curve, Stroke::Fine, Look::nth(k));
        }
        let mut end = panel("x(0.2)", Scale::Linear);
        let label = Some(Form::Detecting.name().to_owned());
        end.curve(label, self.ends, Stroke::Solid, Look::nth(1));
        let mut error = panel("|x(0.2) − exact|", Scale::Decades);
        for (k, (curve, form)) in self.errors.into_iter().zip(Form::ALL).enumerate() {
            let label = Some(form.name().to_owned());
            error.curve(label, curve, Stroke::Fine, Look::nth(k));
        }
        vec![steps, end, error]
    }
}
