//! Phase portraits: trajectories in the plane of two states.

use std::collections::BTreeSet;

use dmm_problems::picture::{Axis, GREY, Look, Panel, Scale, Stroke};
use dmm_problems::problem::Problem;

/// A point of the trajectory, kept for the pictures.
#[derive(Clone, Debug)]
pub(crate) struct Kept {
    pub(crate) t: f64,
    pub(crate) x: Vec<f64>,
    pub(crate) region: usize,
}

/// What a phase portrait shows of a run.
pub(crate) struct Trajectory<'a> {
    pub(crate) points: &'a [Kept],
    pub(crate) crossings: &'a [Kept],
    /// Whether the last point is where the run ended.
    pub(crate) ends_there: bool,
}

/// The trajectory in the plane of two states, each region in its colour, with the interfaces that
/// are curves in that plane, and with start, end and crossings.
pub(crate) fn phase(
    problem: &Problem,
    trajectory: &Trajectory<'_>,
    plane: (usize, usize),
    title: &str,
) -> Panel {
    let mut panel = phases(problem, &[trajectory.points], plane, title);
    panel.equal_aspect = true;
    marks(&mut panel, trajectory, plane);
    panel
}

/// Several trajectories in one panel.
pub(crate) fn phases(
    problem: &Problem,
    trajectories: &[impl AsRef<[Kept]>],
    plane: (usize, usize),
    title: &str,
) -> Panel {
    let (horizontal, vertical) = plane;
    let states = problem.states();
    let axis = |state: usize| Axis::new(*states.get(state).unwrap_or(&""), Scale::Linear);
    let mut panel = Panel::new(title, axis(horizontal), axis(vertical));
    let points = || trajectories.iter().map(AsRef::as_ref);
    let stays: Vec<&[Kept]> = points().flat_map(split_by_region).collect();
    let names = problem.regions();
    for (region, name) in names.iter().enumerate() {
        let mut label = (names.len() > 1).then(|| (*name).to_owned());
        for stay in stays.iter().filter(|stay| stay[0].region == region) {
            let curve = stay
                .iter()
                .map(|point| (point.x[horizontal], point.x[vertical]));
            let curve = curve.collect();
            panel.curve(label.take(), curve, Stroke::Solid, Look::nth(region));
        }
    }
    let samples: Vec<&Kept> = points().flat_map(sampled).collect();
    interfaces(problem, &mut panel, &samples, plane);
    panel
}

/// Marks in a picture of this many times this many places; no place is marked twice.
const PLACES: f64 = 120.0;

/// Adds start, end and crossings.
fn marks(panel: &mut Panel, trajectory: &Trajectory<'_>, (horizontal, vertical): (usize, usize)) {
    let place = |point: &Kept| (point.x[horizontal], point.x[vertical]);
    let Some(((x_low, x_high), (y_low, y_high))) = bounds(panel) else {
        return;
    };
    let mut marked = BTreeSet::new();
    let crossings = trajectory.crossings.iter().map(place);
    let crossings = crossings.filter(|(x, y)| {
        let cell = |value: f64, low: f64, high: f64| (PLACES * (value - low) / (high - low)) as i64;
        marked.insert((cell(*x, x_low, x_high), cell(*y, y_low, y_high)))
    });
    let crossings: Vec<(f64, f64)> = crossings.collect();
    if !crossings.is_empty() {
        let label = Some("crossing".to_owned());
        panel.curve(label, crossings, Stroke::Crosses, BLACK);
    }
    let mut mark = |name: &str, point: Option<&Kept>, stroke| {
        let point = point.map(place);
        panel.curve(
            Some(name.to_owned()),
            point.into_iter().collect(),
            stroke,
            BLACK,
        );
    };
    mark("start", trajectory.points.first(), Stroke::Circles);
    if trajectory.ends_there {
        mark("end", trajectory.points.last(), Stroke::Squares);
    }
}

/// Of marks.
const BLACK: &str = "#222222";

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

/// Points of a trajectory at which functions are compared.
const SAMPLES: usize = 12;

/// A few points all over a trajectory.
fn sampled(points: &[Kept]) -> impl Iterator<Item = &Kept> {
    points.iter().step_by(points.len().div_ceil(SAMPLES).max(1))
}

/// A stay in a region begins with the far side of a transition, whose point it shares with
/// the stay before.
fn split_by_region(points: &[Kept]) -> impl Iterator<Item = &[Kept]> {
    points.chunk_by(|a, b| a.region == b.region)
}

/// How far beyond the trajectory an interface is drawn.
const MARGIN: f64 = 0.1;

/// Adds the zero set of each switching function that depends on the two states of the plane alone.
fn interfaces(problem: &Problem, panel: &mut Panel, samples: &[&Kept], plane: (usize, usize)) {
    let Some((xs, ys)) = bounds(panel) else {
        return;
    };
    let wider = |(low, high): (f64, f64)| {
        let margin = MARGIN * (high - low);
        (low - margin, high + margin)
    };
    for (interface, name) in problem.interfaces().iter().enumerate() {
        // g with the other states and the time of a sample
        let g = |sample: &Kept, x: f64, y: f64| {
            let mut state = sample.x.clone();
            state[plane.0] = x;
            state[plane.1] = y;
            problem.switching_function(interface, sample.t, &state)
        };
        let (Some(first), true) = (samples.first(), lies_in_plane(&g, samples, plane)) else {
            continue;
        };
        let zeros = zero_set(|x, y| g(first, x, y), wider(xs), wider(ys));
        if !zeros.is_empty() {
            let label = Some(format!("interface {name}"));
            panel.curve(label, zeros, Stroke::Fine, GREY);
        }
    }
}

/// Whether g has the same value at the places of the samples whatever the rest of the state and the
/// time are.
fn lies_in_plane(
    g: &impl Fn(&Kept, f64, f64) -> f64,
    samples: &[&Kept],
    (horizontal, vertical): (usize, usize),
) -> bool {
    samples.iter().all(|place| {
        let (x, y) = (place.x[horizontal], place.x[vertical]);
        let own = g(place, x, y);
        let mut others = samples.iter().map(|sample| g(sample, x, y));
        others.all(|other| (other - own).abs() <= 1e-12 * own.abs().max(f64::MIN_POSITIVE))
    })
}

/// Points of g = 0 on the edges of a fine grid.
fn zero_set(g: impl Fn(f64, f64) -> f64, xs: (f64, f64), ys: (f64, f64)) -> Vec<(f64, f64)> {
    const CELLS: usize = 160;
    let at = |(low, high): (f64, f64), k: usize| low + (high - low) * k as f64 / CELLS as f64;
    let mut zeros = Vec::new();
    let mut edge = |a: (f64, f64), b: (f64, f64)| {
        let (ga, gb) = (g(a.0, a.1), g(b.0, b.1));
        if (ga < 0.0) != (gb < 0.0) {
            let share = ga / (ga - gb);
            zeros.push((a.0 + share * (b.0 - a.0), a.1 + share * (b.1 - a.1)));
        }
    };
    for i in 0..=CELLS {
        for j in 0..=CELLS {
            let corner = (at(xs, i), at(ys, j));
            if i < CELLS {
                edge(corner, (at(xs, i + 1), corner.1));
            }
            if j < CELLS {
                edge(corner, (corner.0, at(ys, j + 1)));
            }
        }
    }
    zeros
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interface_lies_in_the_plane_of_the_states_that_it_depends_on() {
        let kept = |t: f64, x: [f64; 3]| Kept {
            t,
            x: x.to_vec(),
            region: 0,
        };
        let points = [kept(0.0, [0.1, 0.2, 0.3]), kept(1.0, [1.1, -0.4, 2.0])];
        let samples: Vec<&Kept> = points.iter().collect();
        let sum = |at: &Kept, x: f64, y: f64| x + 2.0 * y + 0.0 * at.x[2];
        let third = |at: &Kept, x: f64, _: f64| x - at.x[2];
        let moving = |at: &Kept, x: f64, _: f64| x - at.t.sin();
        assert!(lies_in_plane(&sum, &samples, (0, 1)));
        assert!(!lies_in_plane(&third, &samples, (0, 1)));
        assert!(!lies_in_plane(&moving, &samples, (0, 1)));
    }

    #[test]
    fn the_zero_set_of_a_circle_lies_on_it() {
        let zeros = zero_set(|x, y| x * x + y * y - 1.0, (-1.3, 1.2), (-1.1, 1.4));
        assert!(zeros.len() > 300);
        assert!(zeros.iter().all(|(x, y)| (x.hypot(*y) - 1.0).abs() < 1e-3));
    }
}
