//! A test for every system: crossings and states against the exact solution, at two step sizes,
//! so that the order of both is seen, and by Taylor's method and the best one at several tolerances.

use std::ops::ControlFlow;

use dmm_problems::accurate;
use dmm_problems::method::MethodName;
use dmm_problems::problem::{AnyObserver, Crossed, OutputTimes, Problem, Run};
use dmm_problems::reference::Reference;
use dmm_problems::registry;

/// Up to this time the errors at the step sizes used are in their asymptotic regime.
const T_END: f64 = 100.0;
/// The ratio of errors at τ and τ/2 is 4 + O(τ); a scheme of order 1 has 2, of order 3 has 8.
const RATIO: std::ops::Range<f64> = 3.8..4.2;
/// Below this an error is rounding, and so is its ratio.
const ROUNDING: f64 = 1e-11;

/// Of Taylor's method and the best one.
const TOLERANCES: [f64; 4] = [1e-4, 1e-8, 1e-12, 1e-15];
/// The errors of a few hundred steps, and what the flows make of them until the end.
const GROWTH: f64 = 1e3;
/// What rounding errors grow to.
const GROWN: f64 = 5e-12;

#[derive(Default)]
struct Collector {
    crossings: Vec<(f64, usize)>,
    states: Vec<Vec<f64>>,
}

impl AnyObserver for Collector {
    fn transition(&mut self, crossed: &Crossed) -> ControlFlow<()> {
        self.crossings.push((crossed.t, crossed.to.region));
        ControlFlow::Continue(())
    }

    fn output(&mut self, _t: f64, x: &[f64]) {
        self.states.push(x.to_vec());
    }

    fn record_every(&self) -> u64 {
        0
    }
}

fn solve(problem: &Problem, method: MethodName, control: f64, times: &[f64]) -> Collector {
    let run = Run {
        method,
        step_size: control,
        tolerance: control,
        t_end: *times.last().unwrap(),
        output_times: OutputTimes::At(times.to_vec()),
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

/// The solution to compare with.
struct Exact {
    /// How many crossings there are until the last sample.
    count: usize,
    /// The first of them: times and regions entered.
    crossings: Vec<(f64, usize)>,
    /// Times and states.
    samples: Vec<(f64, Vec<f64>)>,
}

/// As many crossings, into the same regions, their times and the states with errors of second
/// order.
fn assert_follows(problem: &Problem, step_size: f64, exact: &Exact) {
    let name = problem.description().name;
    let times: Vec<f64> = exact.samples.iter().map(|(t, _)| *t).collect();
    let coarse = solve(problem, MethodName::Symmetric, step_size, &times);
    let fine = solve(problem, MethodName::Symmetric, 0.5 * step_size, &times);
    assert_eq!(coarse.crossings.len(), exact.count, "{name}");
    assert_eq!(fine.crossings.len(), exact.count, "{name}");
    let numerical = coarse.crossings.iter().zip(&fine.crossings);
    for (&(t, region), (coarse, fine)) in exact.crossings.iter().zip(numerical) {
        assert_eq!((coarse.1, fine.1), (region, region), "{name}");
        let (coarse, fine) = ((coarse.0 - t).abs(), (fine.0 - t).abs());
        assert_order_two(coarse, fine, &format!("{name}: crossing at {t}"));
    }
    let numerical = coarse.states.iter().zip(&fine.states);
    for ((t, exact), (coarse, fine)) in exact.samples.iter().zip(numerical) {
        let (coarse, fine) = (distance(coarse, exact), distance(fine, exact));
        assert_order_two(coarse, fine, &format!("{name}: state at {t}"));
    }
    for method in [MethodName::Taylor, MethodName::Best] {
        for tolerance in TOLERANCES {
            assert_reaches(problem, (method, tolerance), &times, exact);
        }
    }
}

/// As many crossings, into the same regions, their times and the states with errors of about
/// the tolerance of a method.
fn assert_reaches(
    problem: &Problem,
    (method, tolerance): (MethodName, f64),
    times: &[f64],
    exact: &Exact,
) {
    let name = format!("{}, {}", problem.description().name, method.name());
    let solution = solve(problem, method, tolerance, times);
    let largest = (GROWTH * tolerance).max(GROWN);
    assert_eq!(
        solution.crossings.len(),
        exact.count,
        "{name}, {tolerance:e}"
    );
    for (&(t, region), crossing) in exact.crossings.iter().zip(&solution.crossings) {
        let error = (crossing.0 - t).abs();
        assert_eq!(crossing.1, region, "{name}, {tolerance:e}");
        assert!(
            error < largest,
            "{name}, {tolerance:e}: crossing at {t}: {error:e}"
        );
    }
    for ((t, exact), state) in exact.samples.iter().zip(&solution.states) {
        let error = distance(state, exact);
        assert!(
            error < largest,
            "{name}, {tolerance:e}: state at {t}: {error:e}"
        );
    }
}

/// A piecewise-smooth system against its reference data.
fn against_reference(name: &str, step_size: f64) {
    let problem = registry::find(name).unwrap();
    let reference = Reference::of(&problem).unwrap().unwrap();
    let samples = reference.samples.iter();
    let samples: Vec<_> = samples.filter(|sample| sample.t <= T_END).collect();
    let crossings = reference.crossings.iter();
    let exact = Exact {
        count: samples.last().unwrap().crossings_before as usize,
        crossings: crossings
            .map(|crossing| (crossing.t, problem.region_on_side(crossing.to).unwrap()))
            .collect(),
        samples: samples
            .iter()
            .map(|sample| (sample.t, sample.x.to_vec()))
            .collect(),
    };
    assert_follows(&problem, step_size, &exact);
}

/// A system against an independent method of high order, at a tenth, a fifth, a half and the
/// whole of `t_end`, and at every crossing until then.
fn against_accurate(name: &str, step_size: f64, t_end: f64) {
    let problem = registry::find(name).unwrap();
    let initial = problem.description().initial;
    let nodes = accurate::crossings(&problem, initial, t_end, usize::MAX).unwrap();
    // a piecewise-smooth system that never crosses would test nothing of it
    assert_eq!(nodes.len() > 1, !problem.interfaces().is_empty(), "{name}");
    let state_at = |t: f64| {
        let before = nodes.partition_point(|node| node.t <= t);
        accurate::state_at(&problem, &nodes[before - 1], t).unwrap()
    };
    let exact = Exact {
        count: nodes.len() - 1,
        crossings: nodes[1..]
            .iter()
            .map(|node| (node.t, node.region))
            .collect(),
        samples: [0.1, 0.2, 0.5, 1.0]
            .map(|part| (part * t_end, state_at(part * t_end)))
            .into(),
    };
    assert_follows(&problem, step_size, &exact);
}

/// A test for each problem, named like it, and one that none is missing.
macro_rules! checks {
    ($($name:ident: $check:ident($($argument:expr),+);)+) => {
        $(#[test]
        fn $name() {
            $check(stringify!($name), $($argument),+);
        })+

        #[test]
        fn every_problem_is_checked() {
            let checked = [$(stringify!($name)),+];
            let problems: Vec<_> = registry::all().iter().map(|it| it.description().name).collect();
            assert_eq!(checked[..], problems);
        }
    };
}

// the arguments: a step size at which errors are asymptotic, and an end time before which chaos
// has not enlarged them
checks! {
    harmonic: against_reference(1.0 / 256.0);
    elliptic: against_reference(1.0 / 256.0);
    pendulum: against_reference(1.0 / 256.0);
    lotka_volterra_periodic: against_reference(1.0 / 256.0);
    damped: against_reference(1.0 / 256.0);
    spiral: against_reference(1.0 / 256.0);
    rigid_body: against_reference(1.0 / 256.0);
    kepler_refraction: against_reference(1.0 / 256.0);
    saturating_inductor: against_accurate(1.0 / 256.0, 20.0);
    food_chain: against_accurate(1.0 / 256.0, 20.0);
    fput_chain: against_accurate(1.0 / 256.0, 20.0);
    fput_chain_32: against_accurate(1.0 / 64.0, 20.0);
    toda_chain: against_accurate(1.0 / 256.0, 10.0);
    toda_chain_32: against_accurate(1.0 / 128.0, 5.0);
    toda: against_accurate(1.0 / 256.0, 10.0);
    relativistic_oscillator: against_accurate(1.0 / 256.0, 10.0);
    henon_heiles: against_accurate(1.0 / 256.0, 10.0);
    poschl_teller: against_accurate(1.0 / 256.0, 10.0);
    saturating_spring: against_accurate(1.0 / 256.0, 10.0);
    double_pendulum: against_accurate(1.0 / 256.0, 10.0);
    three_body: against_accurate(1.0 / 512.0, 10.0);
}
