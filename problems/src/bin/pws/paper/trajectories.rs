//! Fig. 2: trajectories of both systems.

use std::ops::ControlFlow;

use dmm_problems::method::MethodName;
use dmm_problems::picture::Picture;
use dmm_problems::problem::{AnyObserver, Problem, Record, Run};

use super::report::{Report, SYSTEMS};
use crate::failure::Failure;
use crate::input;
use crate::output;
use crate::portrait::{self, Kept};

/// Starting points, all on closed orbits except the last elliptic one, which comes from
/// infinity and goes back.
const STARTS: [&[[f64; 2]]; 2] = [
    &[[0.5, 0.5], [1.0, 1.0], [1.5, 1.5]],
    &[[-0.9, 0.0], [-1.0, -1.0], [-0.6, -0.8], [1.6, -1.48]],
];
const STEP_SIZE: f64 = 1e-3;
/// One revolution of the harmonic system takes π(1 + 1/√3) = 4.96; the elliptic orbits take
/// less, and the open one is followed for as long as it is near.
const T_END: [f64; 2] = [5.0, 6.0];
/// Only what is near is drawn: all but the ends of the open orbit.
const NEAR: f64 = 4.0;

/// Draws both systems.
pub(super) fn figure(report: &mut Report) -> Result<(), Failure> {
    let header = ["system", "trajectory", "t", "x", "y", "region"];
    let mut csv = report.out.csv("fig2_trajectories.csv", header)?;
    let mut panels = Vec::new();
    for (system, (name, _)) in SYSTEMS.iter().enumerate() {
        let problem = input::problem(name, &[])?;
        let regions = problem.regions();
        let mut all = Vec::new();
        for (number, start) in STARTS[system].iter().enumerate() {
            let trajectory = trajectory(&problem, start, T_END[system])?;
            for point in &trajectory {
                csv.row([
                    (*name).to_owned(),
                    (number + 1).to_string(),
                    output::number(point.t),
                    output::number(point.x[0]),
                    output::number(point.x[1]),
                    regions[point.region].to_owned(),
                ])?;
            }
            all.push(trajectory);
        }
        let mut panel = portrait::phases(&problem, &all, (0, 1), problem.description().title);
        panel.equal_aspect = true;
        panels.push(panel);
    }
    report.out.add(csv.finish()?);
    let picture = Picture::row("Fig. 2: trajectories", panels);
    report
        .out
        .picture("fig2_trajectories", &picture, report.format)
}

fn trajectory(problem: &Problem, start: &[f64; 2], t_end: f64) -> Result<Vec<Kept>, Failure> {
    let run = Run {
        method: MethodName::Symmetric,
        step_size: STEP_SIZE,
        initial: start.to_vec(),
        t_end,
        ..problem.default_run()
    };
    let mut near = Near::default();
    problem.integrate(&run, &mut near)?;
    Ok(near.points)
}

/// Keeps every fifth point and both sides of transitions, until the orbit is far away.
#[derive(Default)]
struct Near {
    points: Vec<Kept>,
    records: u64,
}

impl AnyObserver for Near {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        if record.x.iter().any(|x| x.abs() > NEAR) {
            return ControlFlow::Break(());
        }
        let kept = |region| Kept {
            t: record.t,
            x: record.x.to_vec(),
            region,
        };
        let before = self.points.last().map(|point| point.region);
        if let Some(before) = before.filter(|before| *before != record.region) {
            self.points.push(kept(before));
            self.points.push(kept(record.region));
        } else if self.records.is_multiple_of(5) {
            self.points.push(kept(record.region));
        }
        self.records += 1;
        ControlFlow::Continue(())
    }
}
