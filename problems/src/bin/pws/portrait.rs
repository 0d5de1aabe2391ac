//! Pictures of a run: phase portrait, time series, conservation error.

use dmm_problems::picture::{Axis, COLOURS, GREY, Legend, Panel, Scale, Stroke, superscript};
use dmm_problems::problem::Problem;

/// A point of the trajectory, kept for the pictures.
#[derive(Clone, Debug)]
pub(crate) struct Kept {
    pub(crate) t: f64,
    pub(crate) x: Vec<f64>,
    pub(crate) region: usize,
}

/// The trajectory in the plane of two states, each region in its colour, with the interface
/// where it is a curve in that plane.
pub(crate) fn phase(
    problem: &Problem,
    points: &[Kept],
    plane: (usize, usize),
    title: &str,
) -> Panel {
    phases(problem, &[points], plane, title)
}

/// Several trajectories in one panel.
pub(crate) fn phases(
    problem: &Problem,
    trajectories: &[impl AsRef<[Kept]>],
    (horizontal, vertical): (usize, usize),
    title: &str,
) -> Panel {
    let states = problem.states();
    let axis = |state: usize| Axis::new(*states.get(state).unwrap_or(&""), Scale::Linear);
    let mut panel = Panel::new(title, axis(horizontal), axis(vertical));
    let points = trajectories.iter().map(AsRef::as_ref);
    let stays: Vec<&[Kept]> = points.flat_map(split_by_region).collect();
    let names = problem.regions();
    for (region, name) in names.iter().enumerate() {
        let mut label = (names.len() > 1).then(|| (*name).to_owned());
        for stay in stays.iter().filter(|stay| stay[0].region == region) {
            let curve = stay
                .iter()
                .map(|point| (point.x[horizontal], point.x[vertical]));
            let colour = COLOURS[region % COLOURS.len()];
            panel.curve(label.take(), curve.collect(), Stroke::Solid, colour);
        }
    }
    if states.len() == 2 {
        interfaces(problem, &mut panel, horizontal == 0);
    }
    panel
}

/// A stay in a region begins with the far side of a transition, whose point it shares with
/// the stay before.
fn split_by_region(points: &[Kept]) -> impl Iterator<Item = &[Kept]> {
    points.chunk_by(|a, b| a.region == b.region)
}

/// How far beyond the trajectory an interface is drawn.
const MARGIN: f64 = 0.1;

/// Adds the zero set of each switching function at t = 0, for a system of two states.
fn interfaces(problem: &Problem, panel: &mut Panel, in_order: bool) {
    let all = || panel.curves.iter().flat_map(|curve| &curve.points);
    let bounds = |value: fn(&(f64, f64)) -> f64| {
        let low = all().map(value).fold(f64::INFINITY, f64::min);
        let high = all().map(value).fold(f64::NEG_INFINITY, f64::max);
        let margin = MARGIN * (high - low);
        (low - margin, high + margin)
    };
    let (xs, ys) = (bounds(|p| p.0), bounds(|p| p.1));
    if !(xs.0 < xs.1 && ys.0 < ys.1) {
        return;
    }
    for (interface, name) in problem.interfaces().iter().enumerate() {
        let g = |x: f64, y: f64| {
            let state = if in_order { [x, y] } else { [y, x] };
            problem.switching_function(interface, 0.0, &state)
        };
        let zeros = zero_set(g, xs, ys);
        // the entry of a line rather than of a dot
        let first = zeros.first().copied().into_iter().collect();
        panel.curve(Some(format!("interface {name}")), first, Stroke::Thin, GREY);
        panel.curve(None, zeros, Stroke::Fine, GREY);
    }
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

/// A longer legend would hide the curves.
const MOST_LABELS: usize = 12;

/// Every state against time.
pub(crate) fn time_series(problem: &Problem, points: &[Kept], title: &str) -> Panel {
    let label = match problem.states() {
        [one] => (*one).to_owned(),
        _ => "states".to_owned(),
    };
    let mut panel = Panel::new(
        title,
        Axis::new("t", Scale::Linear),
        Axis::new(label, Scale::Linear),
    );
    let labelled = problem.states().len() <= MOST_LABELS;
    if !labelled {
        panel.legend = Legend::None;
    }
    for (state, name) in problem.states().iter().enumerate() {
        let curve = points
            .iter()
            .map(|point| (point.t, point.x[state]))
            .collect();
        let colour = COLOURS[state % COLOURS.len()];
        let label = labelled.then(|| (*name).to_owned());
        panel.curve(label, curve, Stroke::Solid, colour);
    }
    panel
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
        panel.curve(label, scaled, Stroke::Thin, COLOURS[k % COLOURS.len()]);
    }
    if series.iter().all(|(name, _)| name.is_empty()) {
        panel.legend = Legend::None;
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
    fn the_zero_set_of_a_circle_lies_on_it() {
        let zeros = zero_set(|x, y| x * x + y * y - 1.0, (-1.3, 1.2), (-1.1, 1.4));
        assert!(zeros.len() > 300);
        assert!(zeros.iter().all(|(x, y)| (x.hypot(*y) - 1.0).abs() < 1e-3));
    }
}
