//! Phase portraits: trajectories in the plane of two states, or of a state and the time.

mod interfaces;
mod marks;

use dmm_picture::{Axis, BREAK, Panel, Scale, Stroke};
use dmm_problems::problem::{Problem, Record};

use crate::mode::{self, Modes};
pub(crate) use marks::Mark;

/// A point of the trajectory, kept for the pictures.
#[derive(Clone, Debug)]
pub(crate) struct Kept {
    pub(crate) t: f64,
    pub(crate) x: Vec<f64>,
    /// The discrete states that are declared.
    pub(crate) discrete: Vec<f64>,
    /// The number of its mode in [`Modes`].
    pub(crate) mode: usize,
}

impl Kept {
    pub(crate) fn new(problem: &Problem, modes: &mut Modes<'_>, record: &Record<'_>) -> Self {
        Self {
            t: record.t,
            x: record.x.to_vec(),
            discrete: mode::discrete(problem, record.mode),
            mode: modes.number(record.mode),
        }
    }
}

/// What an axis of a portrait shows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Coordinate {
    Time,
    /// A state, by its index.
    State(usize),
}

impl Coordinate {
    fn of(self, t: f64, x: &[f64]) -> f64 {
        match self {
            Self::Time => t,
            Self::State(index) => x.get(index).copied().unwrap_or(f64::NAN),
        }
    }

    fn name(self, problem: &Problem) -> &'static str {
        match self {
            Self::Time => "t",
            Self::State(index) => problem.states().get(index).copied().unwrap_or(""),
        }
    }
}

/// Two coordinates, the horizontal one first.
pub(crate) type Plane = (Coordinate, Coordinate);

/// A point in a plane.
fn place((horizontal, vertical): Plane, t: f64, x: &[f64]) -> (f64, f64) {
    (horizontal.of(t, x), vertical.of(t, x))
}

/// What a phase portrait shows of a run.
pub(crate) struct Trajectory<'a> {
    pub(crate) points: &'a [Kept],
    pub(crate) modes: &'a Modes<'a>,
    pub(crate) marks: &'a [Mark],
    /// Whether the last point is where the run ended.
    pub(crate) ends_there: bool,
}

/// The trajectory in a plane, each mode in its colour, with the interfaces that are curves in that
/// plane, and with start, end, crossings and jumps.
pub(crate) fn phase(
    problem: &Problem,
    trajectory: &Trajectory<'_>,
    plane: Plane,
    title: &str,
) -> Panel {
    let points = [trajectory.points];
    let mut panel = phases(problem, &points, trajectory.modes, plane, title);
    panel.equal_aspect = ![plane.0, plane.1].contains(&Coordinate::Time) && is_square(&panel);
    marks::add(&mut panel, trajectory, plane);
    panel
}

/// Several trajectories in one panel.
pub(crate) fn phases(
    problem: &Problem,
    trajectories: &[impl AsRef<[Kept]>],
    modes: &Modes<'_>,
    plane: Plane,
    title: &str,
) -> Panel {
    let axis = |coordinate: Coordinate| Axis::new(coordinate.name(problem), Scale::Linear);
    let mut panel = Panel::new(title, axis(plane.0), axis(plane.1));
    let points = || trajectories.iter().map(AsRef::as_ref);
    let stays: Vec<&[Kept]> = points().flat_map(stays).collect();
    let shown = modes.shown();
    let own = |stay: &[Kept]| {
        let mut all = shown.iter();
        all.position(|shown| shown.numbers.contains(&stay[0].mode))
    };
    let mut curves = vec![Vec::new(); shown.len()];
    for stay in stays {
        if let Some(own) = own(stay) {
            let places = stay.iter().map(|point| place(plane, point.t, &point.x));
            curves[own].extend(places.chain([BREAK]));
        }
    }
    // each lies below those before it
    for (shown, curve) in shown.iter().zip(curves).rev() {
        panel.curve(None, curve, Stroke::Solid, shown.look.clone());
    }
    for shown in shown {
        if shown.label.is_some() {
            panel.curve(shown.label, Vec::new(), Stroke::Solid, shown.look);
        }
    }
    let samples: Vec<&Kept> = points().flat_map(sampled).collect();
    interfaces::add(problem, &mut panel, &samples, plane);
    panel
}

/// The ranges of a panel's curves.
fn bounds(panel: &Panel) -> Option<((f64, f64), (f64, f64))> {
    let all = || panel.curves.iter().flat_map(|curve| &curve.points);
    let range = |value: fn(&(f64, f64)) -> f64| {
        let low = all().map(value).fold(f64::INFINITY, f64::min);
        let high = all().map(value).fold(f64::NEG_INFINITY, f64::max);
        (low < high).then_some((low, high))
    };
    range(|point| point.0).zip(range(|point| point.1))
}

/// One range is at most so many times the other, or units are not as long on both axes.
const MOST_OBLONG: f64 = 3.0;

/// Whether a picture with the same unit on both axes shows enough of both.
fn is_square(panel: &Panel) -> bool {
    bounds(panel).is_none_or(|((left, right), (low, high))| {
        let ratio = (right - left) / (high - low);
        (1.0 / MOST_OBLONG..=MOST_OBLONG).contains(&ratio)
    })
}

/// Points of a trajectory at which functions are compared.
const SAMPLES: usize = 12;

/// A few points all over a trajectory.
fn sampled(points: &[Kept]) -> impl Iterator<Item = &Kept> {
    points.iter().step_by(points.len().div_ceil(SAMPLES).max(1))
}

/// The points between one transition and the next, both of which have two points at one time.
fn stays(points: &[Kept]) -> impl Iterator<Item = &[Kept]> {
    points.chunk_by(|before, after| before.t != after.t)
}
