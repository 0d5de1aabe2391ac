//! Fig. 8: the error at T = π/2 of eq. (47) against the step size, of the families of Table 1. Orders in
//! the paper are those of its theorem 17: with detection of switches the order of the method.

use std::f64::consts::PI;

use dmm_picture::{Axis, Look, Panel, Picture, Scale, Stroke};
use dmm_problems::fit::fitted_order;
use dmm_problems::method::{Control, MethodName};
use dmm_problems::problem::Problem;

use super::runs::{Case, Form};
use crate::failure::Failure;
use crate::input;
use crate::output::{self, Csv};
use crate::paper::report::Report;

/// The families of Table 1.
const FAMILIES: [(&str, &[MethodName]); 4] = [
    (
        "explicit",
        &[
            MethodName::Euler,
            MethodName::ExplicitMidpoint,
            MethodName::Heun3,
            MethodName::Classical4,
        ],
    ),
    (
        "Gauss–Legendre",
        &[
            MethodName::GaussLegendre1,
            MethodName::GaussLegendre2,
            MethodName::GaussLegendre3,
            MethodName::GaussLegendre4,
        ],
    ),
    (
        "Radau IIA",
        &[
            MethodName::RadauIia1,
            MethodName::RadauIia2,
            MethodName::RadauIia3,
            MethodName::RadauIia4,
            MethodName::RadauIia5,
        ],
    ),
    (
        "Lobatto IIIC",
        &[
            MethodName::LobattoIiic2,
            MethodName::LobattoIiic3,
            MethodName::LobattoIiic4,
        ],
    ),
];
const T_END: f64 = PI / 2.0;
/// The fewest steps.
const FEWEST: f64 = 8.0;
/// Errors below this have rounding errors in them: with them a curve ends.
const ROUNDING: f64 = 1e-12;
/// An order is fitted to errors below this: with detection of switches to those of the last halving;
/// without, to the largest of each halving, because errors go up and down with the place of the
/// switch in its step.
const LARGEST: f64 = 0.1;

/// The step sizes.
#[derive(Clone, Copy)]
pub(super) struct Sizes {
    /// Halvings from the largest to the smallest.
    pub(super) octaves: u32,
    /// How many there are before the size is half.
    pub(super) of_octave: u32,
}

impl Sizes {
    /// The numbers of steps.
    fn counts(self, order: i32) -> Vec<u32> {
        // whose errors fall off so slowly that they are not small before
        let octaves = self.octaves + if order == 1 { 4 } else { 0 };
        let count = |k| {
            let octaves = f64::from(k) / f64::from(self.of_octave);
            (FEWEST * octaves.exp2()).round() as u32
        };
        let mut counts: Vec<u32> = (0..=octaves * self.of_octave).map(count).collect();
        counts.dedup();
        counts
    }
}

/// x(T). (In the solution that the paper prints, x₂ has the other sign.)
fn exact() -> [f64; 2] {
    let (size, angle) = ((T_END - 1.0).exp(), 2.0 * PI * (T_END - 1.0));
    [size * angle.cos(), size * angle.sin()]
}

/// The errors of a method.
struct Curve {
    method: MethodName,
    form: Form,
    /// Step sizes with errors, the largest first.
    errors: Vec<(f64, f64)>,
    /// Those that stand for the others, the smallest first: with detection of switches all; without,
    /// the largest of each halving.
    shown: Vec<(f64, f64)>,
    /// As fitted.
    order: f64,
}

impl Curve {
    fn measure(
        problem: &Problem,
        method: MethodName,
        form: Form,
        sizes: Sizes,
    ) -> Result<Self, Failure> {
        let case = Case {
            problem,
            method,
            initial: problem.description().initial,
            t_end: T_END,
        };
        let exact = exact();
        let mut errors = Vec::new();
        for count in sizes.counts(theory(method)) {
            let x = case.end(form, count)?;
            let error = (x[0] - exact[0]).hypot(x[1] - exact[1]);
            errors.push((T_END / f64::from(count), error));
            if error < ROUNDING {
                break;
            }
        }
        let halving = sizes.of_octave as usize;
        let (shown, fitted) = match form {
            Form::Standard => (largest(&errors, halving), usize::MAX),
            Form::Detecting => (errors.iter().rev().copied().collect(), halving),
        };
        let is_used = |error: &&(f64, f64)| (ROUNDING..LARGEST).contains(&error.1);
        let used = shown.iter().filter(is_used).take(fitted);
        let (used_sizes, used): (Vec<f64>, Vec<f64>) = used.copied().unzip();
        Ok(Self {
            method,
            form,
            errors,
            shown,
            order: fitted_order(&used_sizes, &used),
        })
    }

    fn write(&self, csv: &mut Csv) -> Result<(), Failure> {
        for (tau, error) in &self.errors {
            csv.row([
                self.form.name().to_owned(),
                self.method.name().to_owned(),
                theory(self.method).to_string(),
                output::number(*tau),
                output::number(*error),
            ])?;
        }
        Ok(())
    }

    /// Adds it to the comparison.
    fn compare(&self, report: &mut Report) {
        let paper = match self.form {
            Form::Standard => 1,
            Form::Detecting => theory(self.method),
        };
        let (method, form) = (self.method.name(), self.form.name());
        report.line(
            "Fig. 8",
            format!("{method}, {form}: error at T = π/2"),
            format!("order {paper}"),
            format!("order {:.2}", self.order),
        );
    }

    /// Draws it as the k-th of a panel.
    fn draw(self, panel: &mut Panel, k: usize) {
        let label = format!("{} ({:.2})", self.method.name(), self.order);
        let stroke = match self.form {
            Form::Standard => {
                panel.curve(None, self.errors, Stroke::Fine, Look::nth(k));
                Stroke::Marked
            }
            Form::Detecting => Stroke::Solid,
        };
        panel.curve(Some(label), self.shown, stroke, Look::nth(k));
    }
}

/// The largest error of each halving, the one of the smallest step first.
fn largest(errors: &[(f64, f64)], halving: usize) -> Vec<(f64, f64)> {
    let largest = |errors: &[(f64, f64)]| {
        let errors = errors.iter().copied();
        errors.max_by(|p, q| p.1.total_cmp(&q.1))
    };
    errors.rchunks_exact(halving).filter_map(largest).collect()
}

/// Both columns of the figure, a row a family.
pub(super) fn figure(report: &mut Report, sizes: Sizes) -> Result<(), Failure> {
    let problem = input::problem("spiral", &[])?;
    let header = ["form", "method", "order", "step_size", "error"];
    let mut csv = report.out.csv("fig8_orders.csv", header)?;
    let mut panels = Vec::new();
    let methods = FAMILIES.iter().map(|(_, methods)| methods.len());
    let all = (Form::ALL.len() * methods.sum::<usize>()) as f64;
    let mut done = 0.0;
    for (family, methods) in FAMILIES {
        for form in Form::ALL {
            let mut panel = panel(family, form);
            for (k, &method) in methods.iter().enumerate() {
                if report.at(done / all).is_break() {
                    // what was made so far is not a figure
                    return Ok(());
                }
                done += 1.0;
                let curve = Curve::measure(&problem, method, form, sizes)?;
                curve.write(&mut csv)?;
                curve.compare(report);
                curve.draw(&mut panel, k);
            }
            panels.push(panel);
        }
    }
    report.out.add(csv.finish()?);
    let title = "Fig. 8: error against step size (fitted orders), without and with detection of \
                 switches";
    let picture = Picture {
        columns: Form::ALL.len(),
        panel_size: (520.0, 360.0),
        ..Picture::row(title, panels)
    };
    report.out.picture("fig8_orders", &picture, report.format)
}

/// A panel without curves.
fn panel(family: &str, form: Form) -> Panel {
    let remark = match form {
        Form::Standard => " (lines: largest of each halving)",
        Form::Detecting => "",
    };
    let x = Axis::new("step size", Scale::Decades);
    let y = Axis::new("‖x̂(T) − x(T)‖", Scale::Decades);
    Panel::new(format!("{family}, {}{remark}", form.name()), x, y)
}

/// The order of a method on smooth problems.
fn theory(method: MethodName) -> i32 {
    match method.control() {
        Control::StepSize { order } => order,
        Control::Tolerance => 0,
    }
}
