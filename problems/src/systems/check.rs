//! What every system's test checks: crossings and samples against the exact solution, at two
//! step sizes, so that the order of both is seen.

use std::ops::ControlFlow;

use crate::accurate;
use crate::problem::{Crossed, Problem, Run, Sink};
use crate::reference::Reference;
use crate::registry;

/// Up to this time the errors at the step sizes used are in their asymptotic regime.
const T_END: f64 = 100.0;
/// The ratio of errors at τ and τ/2 is 4 + O(τ); a scheme of order 1 has 2, of order 3 has 8.
const RATIO: std::ops::Range<f64> = 3.8..4.2;
/// Below this an error is rounding, and so is its ratio.
const ROUNDING: f64 = 1e-11;

#[derive(Default)]
struct Collector {
    crossings: Vec<(f64, usize)>,
    states: Vec<Vec<f64>>,
}

impl Sink for Collector {
    fn transition(&mut self, crossed: &Crossed) -> ControlFlow<()> {
        self.crossings.push((crossed.t, crossed.to));
        ControlFlow::Continue(())
    }

    fn output(&mut self, _t: f64, x: &[f64]) {
        self.states.push(x.to_vec());
    }

    fn wants_records(&self) -> bool {
        false
    }
}

fn solve(problem: &dyn Problem, step_size: f64, times: &[f64]) -> Collector {
    let run = Run {
        step_size,
        t_end: *times.last().unwrap(),
        output_times: times.to_vec(),
        ..problem.default_run()
    };
    let mut collector = Collector::default();
    problem.integrate(&run, &mut collector).unwrap();
    assert_eq!(collector.states.len(), times.len());
    collector
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).powi(2))
        .sum::<f64>()
        .sqrt()
}

fn assert_order_two(coarse: f64, fine: f64, what: &str) {
    assert!(
        fine < ROUNDING || RATIO.contains(&(coarse / fine)),
        "{what}: {coarse:e} at τ, {fine:e} at τ/2"
    );
}

/// A piecewise-smooth system against its reference data: as many crossings, to the same
/// sides, their times and the samples with errors of second order.
pub(super) fn against_reference(name: &str, step_size: f64) {
    let problem = registry::find(name).unwrap();
    let reference = Reference::of(&*problem).unwrap().unwrap();
    let samples: Vec<_> = reference
        .samples
        .iter()
        .filter(|sample| sample.t <= T_END)
        .collect();
    let times: Vec<f64> = samples.iter().map(|sample| sample.t).collect();
    let coarse = solve(&*problem, step_size, &times);
    let fine = solve(&*problem, 0.5 * step_size, &times);
    let count = samples.last().unwrap().crossings_before;
    assert_eq!(coarse.crossings.len() as u64, count);
    assert_eq!(fine.crossings.len() as u64, count);
    let numerical = coarse.crossings.iter().zip(&fine.crossings);
    for (exact, (coarse, fine)) in reference.crossings.iter().zip(numerical) {
        assert_eq!(Some(coarse.1), problem.region_on_side(exact.to));
        let (coarse, fine) = ((coarse.0 - exact.t).abs(), (fine.0 - exact.t).abs());
        assert_order_two(coarse, fine, &format!("{name}: crossing at {}", exact.t));
    }
    for (k, exact) in samples.iter().enumerate() {
        let (coarse, fine) = (
            distance(&coarse.states[k], &exact.x),
            distance(&fine.states[k], &exact.x),
        );
        assert_order_two(coarse, fine, &format!("{name}: state at {}", exact.t));
    }
}

/// A system against an independent method of high order, at a tenth, a fifth, a half and the
/// whole of `t_end`, and at every crossing until then.
pub(super) fn against_accurate(name: &str, step_size: f64, t_end: f64) {
    let problem = registry::find(name).unwrap();
    let times = [0.1, 0.2, 0.5, 1.0].map(|part| part * t_end);
    let initial = problem.card().initial;
    let nodes = accurate::crossings(&*problem, initial, t_end, usize::MAX).unwrap();
    let coarse = solve(&*problem, step_size, &times);
    let fine = solve(&*problem, 0.5 * step_size, &times);
    assert_eq!(coarse.crossings.len(), nodes.len() - 1, "{name}");
    assert_eq!(fine.crossings.len(), nodes.len() - 1, "{name}");
    // a piecewise-smooth system that never crosses would test nothing of it
    assert_eq!(nodes.len() > 1, !problem.interfaces().is_empty(), "{name}");
    let numerical = coarse.crossings.iter().zip(&fine.crossings);
    for (exact, (coarse, fine)) in nodes.iter().skip(1).zip(numerical) {
        assert_eq!((coarse.1, fine.1), (exact.region, exact.region), "{name}");
        let (coarse, fine) = ((coarse.0 - exact.t).abs(), (fine.0 - exact.t).abs());
        assert_order_two(coarse, fine, &format!("{name}: crossing at {}", exact.t));
    }
    for (k, &t) in times.iter().enumerate() {
        let before = nodes.partition_point(|node| node.t <= t);
        let exact = accurate::state_at(&*problem, &nodes[before - 1], t).unwrap();
        let (coarse, fine) = (
            distance(&coarse.states[k], &exact),
            distance(&fine.states[k], &exact),
        );
        assert_order_two(coarse, fine, &format!("{name}: state at {t}"));
    }
}
