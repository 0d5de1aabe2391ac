//! Marks in a portrait: start, end, crossings, and jumps from where they begin to where they end.

use std::collections::BTreeSet;

use dmm_picture::{BREAK, GREY, Line, Look, Panel, Stroke};
use dmm_problems::problem::Crossed;
use dmm_runtime::TransitionKind;

use super::{Kept, Plane, Trajectory, bounds, place};

/// A transition, kept for the pictures.
#[derive(Clone, Debug)]
pub(crate) struct Mark {
    t: f64,
    before: Vec<f64>,
    after: Vec<f64>,
    kind: TransitionKind,
}

impl Mark {
    pub(crate) fn new(crossed: &Crossed) -> Self {
        Self {
            t: crossed.t,
            before: crossed.x.clone(),
            after: crossed.after.clone(),
            kind: crossed.kind,
        }
    }
}

/// What the marks of a kind of transition are called, and how they are drawn.
fn look(kind: TransitionKind) -> (&'static str, Stroke) {
    match kind {
        TransitionKind::Crossed => ("crossing", Stroke::Crosses),
        TransitionKind::Jumped => ("jump", Stroke::Triangles),
        _ => ("sliding begins or ends", Stroke::Diamonds),
    }
}

/// Marks in a picture of this many times this many places; no place is marked twice.
const PLACES: f64 = 120.0;
/// Of marks.
const BLACK: &str = "#222222";

/// Adds start, end and transitions.
pub(super) fn add(panel: &mut Panel, trajectory: &Trajectory<'_>, plane: Plane) {
    let Some(((x_low, x_high), (y_low, y_high))) = bounds(panel) else {
        return;
    };
    let cell = |value: f64, low: f64, high: f64| (PLACES * (value - low) / (high - low)) as i64;
    let cell = |(x, y): (f64, f64)| (cell(x, x_low, x_high), cell(y, y_low, y_high));
    let mut marked = BTreeSet::new();
    let mut kinds: Vec<(TransitionKind, Vec<(f64, f64)>)> = Vec::new();
    let mut jumps = Vec::new();
    for mark in trajectory.marks {
        let [before, after] = [&mark.before, &mark.after].map(|x| place(plane, mark.t, x));
        if !marked.insert((look(mark.kind).0, cell(before), cell(after))) {
            continue;
        }
        if before != after {
            jumps.extend([before, after, BREAK]);
        }
        match kinds
            .iter_mut()
            .find(|(kind, _)| look(*kind) == look(mark.kind))
        {
            Some((_, places)) => places.push(before),
            None => kinds.push((mark.kind, vec![before])),
        }
    }
    if !jumps.is_empty() {
        let dotted = Look {
            line: Line::Dotted,
            ..GREY.into()
        };
        panel.curve(None, jumps, Stroke::Thin, dotted);
    }
    for (kind, places) in kinds {
        let (name, stroke) = look(kind);
        panel.curve(Some(name.to_owned()), places, stroke, BLACK);
    }
    let mut mark = |name: &str, point: Option<&Kept>, stroke| {
        let point = point.map(|point| place(plane, point.t, &point.x));
        let point = point.into_iter().collect();
        panel.curve(Some(name.to_owned()), point, stroke, BLACK);
    };
    mark("start", trajectory.points.first(), Stroke::Circles);
    if trajectory.ends_there {
        mark("end", trajectory.points.last(), Stroke::Squares);
    }
}
