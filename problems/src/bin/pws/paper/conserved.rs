//! Figs 5 and 8: the error of the conserved quantity over time, beside the explicit midpoint
//! method.

use std::ops::ControlFlow;

use dmm_picture::Picture;
use dmm_problems::method::MethodName;
use dmm_problems::problem::{AnyObserver, Problem, Record, Run};
use dmm_problems::reference::Reference;

use super::report::Report;
use crate::failure::Failure;
use crate::input;
use crate::output;
use crate::series::{self, Thinned};

/// As in the paper.
const STEP_SIZE: f64 = 1e-3;
/// Transitions to go through.
const TRANSITIONS: usize = 30;
/// The paper's time span is not given; its numbers suggest one of about this length.
const EARLY: f64 = 10.0;
/// Every so many steps a row is written.
const EVERY: u64 = 10;

/// Both schemes over 30 transitions.
pub(super) fn figure(report: &mut Report, name: &str, number: u32) -> Result<(), Failure> {
    let problem = input::problem(name, &[])?;
    let (exact, t_end) = exact(&problem)?;
    let file = format!("fig{number}_{name}_conserved");
    let header = ["scheme", "t", "error"];
    let mut csv = report.out.csv(&format!("{file}.csv"), header)?;
    let mut panels = Vec::new();
    let schemes = [
        ("DMM", "discrete multiplier method", MethodName::Symmetric),
        (
            "RK2",
            "explicit midpoint method",
            MethodName::ExplicitMidpoint,
        ),
    ];
    for (short, long, method) in schemes {
        let run = Run {
            method,
            // as the paper compares them
            level_correction: method == MethodName::Symmetric,
            step_size: STEP_SIZE,
            t_end,
            ..problem.default_run()
        };
        let mut errors = Errors {
            exact: &exact,
            thinned: Thinned::new(),
            rows: Vec::new(),
            records: 0,
            worst: 0.0,
        };
        problem.integrate(&run, &mut errors)?;
        for (t, error) in &errors.rows {
            csv.row([short.to_owned(), output::number(*t), output::number(*error)])?;
        }
        let paper = match (name, short) {
            (_, "DMM") => "close to machine precision",
            ("harmonic", _) => "about 1e-8, drifting",
            _ => "about 1e-7, drifting",
        };
        let early = errors.rows.iter().filter(|(t, _)| *t <= EARLY);
        let early = early.fold(0.0, |worst: f64, (_, error)| worst.max(error.abs()));
        report.row(
            number,
            format!("{name}: |ψ − exact|, {long}"),
            paper,
            format!(
                "at most {early:.1e} until t = {EARLY}, {:.1e} until t = {t_end:.1}",
                errors.worst
            ),
        );
        let series = [(String::new(), errors.thinned.points().to_vec())];
        panels.push(series::errors(&series, "ψ − exact level", long));
    }
    report.out.add(csv.finish()?);
    let title = format!("Fig. {number}: error of the conserved quantity, τ = 0.001, {name}");
    let picture = Picture {
        columns: 1,
        panel_size: (760.0, 300.0),
        ..Picture::row(title, panels)
    };
    report.out.picture(&file, &picture, report.format)
}

/// The exact level of each region, and a time in the middle of the last segment.
fn exact(problem: &Problem) -> Result<(Vec<f64>, f64), Failure> {
    let missing = || {
        Failure::Stopped(format!(
            "{}: no reference levels",
            problem.description().name
        ))
    };
    let stopped =
        |error: dmm_problems::reference::ReferenceError| Failure::Stopped(error.to_string());
    let reference = Reference::of(problem)
        .map_err(stopped)?
        .ok_or_else(missing)?;
    let mut levels = vec![f64::NAN; problem.regions().len()];
    for side in [-1.0, 1.0] {
        let level = reference.constant_level(side).and_then(<[f64]>::first);
        let region = problem
            .region_on_side(side)
            .and_then(|region| levels.get_mut(region));
        *region.ok_or_else(missing)? = *level.ok_or_else(missing)?;
    }
    let times = reference
        .crossings
        .get(TRANSITIONS - 1)
        .zip(reference.crossings.get(TRANSITIONS));
    let (last, next) = times.ok_or_else(missing)?;
    Ok((levels, 0.5 * (last.t + next.t)))
}

/// ψ − the exact level of the region.
struct Errors<'a> {
    exact: &'a [f64],
    thinned: Thinned,
    rows: Vec<(f64, f64)>,
    records: u64,
    worst: f64,
}

impl AnyObserver for Errors<'_> {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        let error = record.psi[0] - self.exact[record.mode.region];
        self.thinned.offer(record.t, error);
        self.worst = self.worst.max(error.abs());
        if self.records.is_multiple_of(EVERY) {
            self.rows.push((record.t, error));
        }
        self.records += 1;
        ControlFlow::Continue(())
    }
}
