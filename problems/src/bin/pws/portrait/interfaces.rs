//! Interfaces in a plane: zero sets of switching functions.

use dmm_picture::{GREY, Panel, Stroke};
use dmm_problems::problem::Problem;

use super::{Coordinate, Kept, Plane, bounds, place};

/// How far beyond the trajectory an interface is drawn.
const MARGIN: f64 = 0.1;
/// More interfaces are not named one by one.
const MOST_NAMED: usize = 4;

/// Adds the zero set of each switching function that depends on the two coordinates alone.
pub(super) fn add(problem: &Problem, panel: &mut Panel, samples: &[&Kept], plane: Plane) {
    let (Some((xs, ys)), Some(first)) = (bounds(panel), samples.first()) else {
        return;
    };
    let wider = |(low, high): (f64, f64)| {
        let margin = MARGIN * (high - low);
        (low - margin, high + margin)
    };
    let mut found = Vec::new();
    for (interface, name) in problem.interfaces().iter().enumerate() {
        // g with the other states and the time of a sample
        let g = |sample: &Kept, x: f64, y: f64| {
            let (mut t, mut state) = (sample.t, sample.x.clone());
            for (coordinate, value) in [(plane.0, x), (plane.1, y)] {
                match coordinate {
                    Coordinate::Time => t = value,
                    Coordinate::State(index) => state[index] = value,
                }
            }
            problem.switching_function(interface, t, &state)
        };
        if !lies_in_plane(&g, samples, plane) {
            continue;
        }
        let zeros = zero_set(|x, y| g(first, x, y), wider(xs), wider(ys));
        if !zeros.is_empty() {
            found.push((format!("interface {name}"), zeros));
        }
    }
    let is_named = found.len() <= MOST_NAMED;
    for (index, (name, zeros)) in found.into_iter().enumerate() {
        let label = match index {
            _ if is_named => Some(name),
            0 => Some("interfaces".to_owned()),
            _ => None,
        };
        panel.curve(label, zeros, Stroke::Fine, GREY);
    }
}

/// Whether g has the same value at the places of the samples whatever the rest of the state and the
/// time are.
fn lies_in_plane(g: &impl Fn(&Kept, f64, f64) -> f64, samples: &[&Kept], plane: Plane) -> bool {
    samples.iter().all(|sample| {
        let (x, y) = place(plane, sample.t, &sample.x);
        let own = g(sample, x, y);
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
    fn an_interface_lies_in_the_plane_of_the_coordinates_that_it_depends_on() {
        let kept = |t: f64, x: [f64; 3]| Kept {
            t,
            x: x.to_vec(),
            discrete: Vec::new(),
            mode: 0,
        };
        let points = [kept(0.0, [0.1, 0.2, 0.3]), kept(1.0, [1.1, -0.4, 2.0])];
        let samples: Vec<&Kept> = points.iter().collect();
        let plane = (Coordinate::State(0), Coordinate::State(1));
        let sum = |at: &Kept, x: f64, y: f64| x + 2.0 * y + 0.0 * at.x[2];
        let third = |at: &Kept, x: f64, _: f64| x - at.x[2];
        let moving = |at: &Kept, x: f64, _: f64| x - at.t.sin();
        assert!(lies_in_plane(&sum, &samples, plane));
        assert!(!lies_in_plane(&third, &samples, plane));
        assert!(!lies_in_plane(&moving, &samples, plane));
        let plane = (Coordinate::Time, Coordinate::State(0));
        let moving = |_: &Kept, t: f64, x: f64| x - t.sin();
        assert!(lies_in_plane(&moving, &samples, plane));
    }

    #[test]
    fn the_zero_set_of_a_circle_lies_on_it() {
        let zeros = zero_set(|x, y| x * x + y * y - 1.0, (-1.3, 1.2), (-1.1, 1.4));
        assert!(zeros.len() > 300);
        assert!(zeros.iter().all(|(x, y)| (x.hypot(*y) - 1.0).abs() < 1e-3));
    }
}
