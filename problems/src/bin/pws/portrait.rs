//! Pictures of a run: phase portrait, time series, conservation error.

use std::collections::BTreeSet;
use std::ops::Range;

use dmm_problems::picture::{Axis, GREY, Look, Panel, Scale, Stroke, superscript};
use dmm_problems::problem::Problem;

use crate::output;

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

/// States that are not elements of a group in a panel.
const MOST_STATES: usize = 7;
/// More curves in a panel are drawn as shades from the first to the last.
const MOST_COLOURS: usize = 7;
/// Of more than these a few are named.
const MOST_NAMED: usize = 14;
/// Pieces between the shades that are named.
const SHADES: usize = 4;

/// The k-th of `count` dense curves, on which broken lines do not show.
fn look(k: usize, count: usize) -> Look {
    if count <= MOST_COLOURS {
        Look::nth(k)
    } else {
        Look::shade(k, count)
    }
}

/// The states against time: a panel for each group of them, and for a few others together.
pub(crate) fn time_series(problem: &Problem, points: &[Kept], title: &str) -> Vec<Panel> {
    let names = problem.states();
    let panels = panels_of(names).into_iter();
    let panels = panels.enumerate().map(|(number, (label, states))| {
        let title = if number == 0 { title } else { "" };
        let axis = |text: &str| Axis::new(text, Scale::Linear);
        let mut panel = Panel::new(title, axis("t"), axis(&label));
        let count = states.len();
        for (k, state) in states.enumerate() {
            let curve = points
                .iter()
                .map(|point| (point.t, point.x[state]))
                .collect();
            let label = named(k, count).then(|| names[state].to_owned());
            panel.curve(label, curve, Stroke::Solid, look(k, count));
        }
        panel
    });
    panels.collect()
}

/// What each panel shows: the name of a group, or those of states that are in none.
fn panels_of(names: &[&str]) -> Vec<(String, Range<usize>)> {
    let mut panels: Vec<(String, Range<usize>)> = Vec::new();
    let mut is_open = false;
    for (group, places) in output::groups(names) {
        let is_single = places.len() == 1;
        match panels.last_mut() {
            Some((label, all)) if is_open && is_single && all.len() < MOST_STATES => {
                *label = format!("{label}, {}", names[places.start]);
                all.end = places.end;
            }
            _ if is_single => panels.push((names[places.start].to_owned(), places)),
            _ => panels.push((group.to_owned(), places)),
        }
        is_open = is_single;
    }
    panels
}

/// Whether the k-th curve is named: of many the first, the last and a few between.
fn named(k: usize, count: usize) -> bool {
    count <= MOST_NAMED || (0..=SHADES).any(|piece| piece * (count - 1) / SHADES == k)
}

/// Errors against time, in units of a power of ten that suits them.
pub(crate) fn errors(series: &[(String, Vec<(f64, f64)>)], what: &str, title: &str) -> Panel {
    let all = || series.iter().flat_map(|(_, points)| points);
    let largest = all()
        .map(|p| p.1.abs())
        .filter(|e| e.is_finite())
        .fold(0.0, f64::max);
    let exponent = if largest > 0.0 {
        largest.log10().floor()
    } else {
        0.0
    };
    let unit = 10f64.powf(exponent);
    let label = if exponent == 0.0 {
        what.to_owned()
    } else {
        format!("{what} (×10{})", superscript(exponent as i64))
    };
    let mut panel = Panel::new(
        title,
        Axis::new("t", Scale::Linear),
        Axis::new(label, Scale::Linear),
    );
    for (k, (name, points)) in series.iter().enumerate() {
        let scaled = points.iter().map(|&(t, e)| (t, e / unit)).collect();
        let label = (!name.is_empty()).then(|| name.clone());
        panel.curve(label, scaled, Stroke::Thin, look(k, series.len()));
    }
    panel
}

/// Points kept evenly over a run of unknown length: at most twice the capacity.
///
/// When there are too many, every second is dropped and the distance doubles; `keep` decides
/// which of two neighbours stays.
#[derive(Clone, Debug)]
pub(crate) struct Thinned {
    points: Vec<(f64, f64)>,
    stride: u64,
    offered: u64,
}

impl Thinned {
    const CAPACITY: usize = 3000;

    pub(crate) fn new() -> Self {
        Self {
            points: Vec::new(),
            stride: 1,
            offered: 0,
        }
    }

    /// Of each `stride` points the one with the largest |value| is kept.
    pub(crate) fn offer(&mut self, t: f64, value: f64) {
        let starts = self.offered.is_multiple_of(self.stride);
        self.offered += 1;
        match self.points.last_mut() {
            Some(last) if !starts => {
                if value.abs() > last.1.abs() {
                    *last = (t, value);
                }
            }
            _ => self.points.push((t, value)),
        }
        if self.points.len() >= 2 * Self::CAPACITY {
            let larger = |pair: &[(f64, f64)]| match pair {
                [a, b] if b.1.abs() > a.1.abs() => *b,
                _ => pair[0],
            };
            self.points = self.points.chunks(2).map(larger).collect();
            self.stride *= 2;
        }
    }

    pub(crate) fn points(&self) -> &[(f64, f64)] {
        &self.points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_the_extremes_and_the_order() {
        let mut thinned = Thinned::new();
        for k in 0..1_000_000 {
            thinned.offer(f64::from(k), if k == 777_777 { -5.0 } else { 1.0 });
        }
        let points = thinned.points();
        assert!(points.len() < 2 * Thinned::CAPACITY && points.len() >= Thinned::CAPACITY);
        assert!(points.is_sorted_by_key(|p| p.0));
        assert_eq!(
            points.iter().filter(|p| **p == (777_777.0, -5.0)).count(),
            1
        );
    }

    #[test]
    fn groups_have_panels_and_single_states_share_one() {
        let chain = ["q[0]", "q[1]", "p[0]", "p[1]", "s", "e"];
        let panels = [("q", 0..2), ("p", 2..4), ("s, e", 4..6)];
        assert_eq!(
            panels_of(&chain),
            panels.map(|(name, at)| (name.to_owned(), at))
        );
        let many = ["a", "b", "c", "d", "e", "f", "g", "h"];
        let counts: Vec<usize> = panels_of(&many).iter().map(|(_, at)| at.len()).collect();
        assert_eq!(counts, [7, 1]);
        let shades: Vec<usize> = (0..32).filter(|&k| named(k, 32)).collect();
        assert_eq!(shades, [0, 7, 15, 23, 31]);
    }

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
