//! Fig. 2: trajectories of both systems.

use std::ops::ControlFlow;

use dmm_picture::Picture;
use dmm_problems::method::MethodName;
use dmm_problems::problem::{AnyObserver, Problem, Record, Run};

use super::report::{Report, SYSTEMS};
use crate::failure::Failure;
use crate::input;
use crate::mode::Modes;
use crate::output;
use crate::portrait::{self, Coordinate, Kept};

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
        let mut modes = Modes::new(&problem);
        let mut all = Vec::new();
        for (number, start) in STARTS[system].iter().enumerate() {
            let near = trajectory(&problem, &mut modes, start, T_END[system])?;
            for (region, point) in near.regions.iter().zip(&near.points) {
                csv.row([
                    (*name).to_owned(),
                    (number + 1).to_string(),
                    output::number(point.t),
                    output::number(point.x[0]),
                    output::number(point.x[1]),
                    regions[*region].to_owned(),
                ])?;
            }
            all.push(near.points);
        }
        let plane = (Coordinate::State(0), Coordinate::State(1));
        let title = problem.description().title;
        let mut panel = portrait::phases(&problem, &all, &modes, plane, title);
        panel.equal_aspect = true;
        panels.push(panel);
    }
    report.out.add(csv.finish()?);
    let picture = Picture::row("Fig. 2: trajectories", panels);
    report
        .out
        .picture("fig2_trajectories", &picture, report.format)
}

fn trajectory<'a, 'b>(
    problem: &'b Problem,
    modes: &'b mut Modes<'a>,
    start: &[f64; 2],
    t_end: f64,
) -> Result<Near<'a, 'b>, Failure> {
    let run = Run {
        method: MethodName::Symmetric,
        step_size: STEP_SIZE,
        initial: start.to_vec(),
        t_end,
        ..problem.default_run()
    };
    let mut near = Near {
        problem,
        modes,
        points: Vec::new(),
        regions: Vec::new(),
        records: 0,
    };
    problem.integrate(&run, &mut near)?;
    Ok(near)
}

/// Keeps every fifth point and both sides of transitions, until the orbit is far away.
struct Near<'a, 'b> {
    problem: &'b Problem,
    modes: &'b mut Modes<'a>,
    points: Vec<Kept>,
    /// The region of each point.
    regions: Vec<usize>,
    records: u64,
}

impl AnyObserver for Near<'_, '_> {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        if record.x.iter().any(|x| x.abs() > NEAR) {
            return ControlFlow::Break(());
        }
        let region = record.mode.region;
        let before = self.regions.last().copied().zip(self.points.last());
        let before = before.filter(|(before, _)| *before != region);
        let enters = before.is_some();
        let kept = Kept::new(self.problem, self.modes, record);
        if let Some((before, last)) = before {
            let mode = last.mode;
            let near = Kept {
                mode,
                ..kept.clone()
            };
            self.regions.push(before);
            self.points.push(near);
        }
        if enters || self.records.is_multiple_of(5) {
            self.regions.push(region);
            self.points.push(kept);
        }
        self.records += 1;
        ControlFlow::Continue(())
    }
}
