//! States and errors against time.

use std::ops::Range;

use dmm_picture::{Axis, BREAK, Look, Panel, Scale, Stroke, superscript};
use dmm_problems::problem::Problem;

use crate::mode;
use crate::output;
use crate::portrait::Kept;

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

/// The states against time: a panel for each group of them, and for a few others together. Then the
/// discrete states in the same way.
pub(crate) fn time_series(problem: &Problem, points: &[Kept], title: &str) -> Vec<Panel> {
    let mut panels = panels(problem.states(), points, |point| &point.x);
    let discrete = mode::discrete_names(problem);
    panels.extend(self::panels(&discrete, points, |point| &point.discrete));
    if let Some(first) = panels.first_mut() {
        title.clone_into(&mut first.title);
    }
    panels
}

/// Panels of values with names.
fn panels(names: &[&str], points: &[Kept], values: impl Fn(&Kept) -> &[f64]) -> Vec<Panel> {
    let panels = panels_of(names).into_iter().map(|(label, places)| {
        let axis = |text: &str| Axis::new(text, Scale::Linear);
        let mut panel = Panel::new("", axis("t"), axis(&label));
        let count = places.len();
        for (k, place) in places.enumerate() {
            let curve = against_time(points, |point| values(point)[place]);
            let label = named(k, count).then(|| names[place].to_owned());
            panel.curve(label, curve, Stroke::Solid, look(k, count));
        }
        panel
    });
    panels.collect()
}

/// A value against time, interrupted where it jumps.
fn against_time(points: &[Kept], value: impl Fn(&Kept) -> f64) -> Vec<(f64, f64)> {
    let mut curve: Vec<(f64, f64)> = Vec::with_capacity(points.len());
    for point in points {
        let (t, value) = (point.t, value(point));
        let jumps = |last: &(f64, f64)| last.0 == t && last.1 != value;
        if curve.last().is_some_and(jumps) {
            curve.push(BREAK);
        }
        curve.push((t, value));
    }
    curve
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
    fn a_jump_interrupts_a_curve() {
        let kept = |t: f64, x: f64| Kept {
            t,
            x: vec![x],
            discrete: Vec::new(),
            mode: 0,
        };
        let points = [(0.0, 1.0), (1.0, 0.5), (1.0, -0.5), (2.0, 0.0), (2.0, 0.0)];
        let points = points.map(|(t, x)| kept(t, x));
        let curve = against_time(&points, |point| point.x[0]);
        let pieces: Vec<&[(f64, f64)]> = curve.split(|point| point.0.is_nan()).collect();
        assert_eq!(pieces[0], [(0.0, 1.0), (1.0, 0.5)]);
        assert_eq!(pieces[1].len(), 3);
    }

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
}
