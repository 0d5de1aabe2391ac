//! One interface, x = 0.2, written in ten ways: the same itinerary and the same times, whatever
//! the switching function's series, scale and domain are.

use std::ops::ControlFlow;

use dmm_problems::method::MethodName;
use dmm_problems::problem::{Problem, Run};
use dmm_runtime::Model;
use dmm_runtime::dynamic::{AnyObserver, Crossed, Parallelism, Start};

/// The forms of the switching function.
const FORMS: [(&str, &str); 10] = [
    ("plain", "x - 0.2"),
    ("exponential", "exp(x) - exp(0.2)"),
    ("logarithm", "ln(x + 2) - ln(2.2)"),
    ("tangent", "tanh(x - 0.2)"),
    ("arctangent", "atan(x - 0.2)"),
    ("cubic", "(x - 0.2)^3 + (x - 0.2)"),
    ("rational", "(x - 0.2) / (0.01 + x^2)"),
    ("wavy", "x - 0.2 + 0.1 * sin(x - 0.2)"),
    ("smoothed", "(x - 0.2) / sqrt(1e-2 + (x - 0.2)^2)"),
    ("root", "sqrt(x + 3) - sqrt(3.2)"),
];

/// A pendulum with a stronger torque beyond x = 0.2.
fn pendulum(form: &str) -> Problem {
    let model = Model::compile(&format!(
        "system Pendulum {{
            state x, v;
            interface border = {form};
            der(x) = v;
            region near where border < 0 {{
                der(v) = -sin(x);
                conserved energy = v^2 / 2 - cos(x);
            }}
            region far where border > 0 {{
                der(v) = -3 * sin(x);
                conserved energy = v^2 / 2 - 3 * cos(x);
            }}
        }}"
    ));
    Problem::own(model.unwrap()).unwrap()
}

const T_END: f64 = 20.0;
/// From small swings, of which some do not reach the interface, to x = −1.7.
const STARTS: [[f64; 2]; 6] = [
    [0.1, 0.05],
    [-0.1, 0.5],
    [0.5, 0.3],
    [-1.0, 0.1],
    [0.9, -0.2],
    [-1.5, 0.3],
];

/// What became of a start.
#[derive(Debug)]
enum Orbit {
    /// The times of its crossings and its end.
    Ended { times: Vec<f64>, x: Vec<f64> },
    /// What stopped it.
    Stopped(String),
}

/// A run by a method, of which the value is the step size or the tolerance.
fn run(problem: &Problem, method: MethodName, value: f64) -> Run {
    Run {
        method,
        step_size: value,
        tolerance: value,
        t_end: T_END,
        ..problem.default_run()
    }
}

/// The times of crossings.
struct Times(Vec<f64>);

impl AnyObserver for Times {
    fn transition(&mut self, crossed: &Crossed) -> ControlFlow<()> {
        self.0.push(crossed.t);
        ControlFlow::Continue(())
    }

    fn record_every(&self) -> u64 {
        0
    }
}

/// The crossings of each of the ten with a method, from each start.
fn all(method: MethodName, value: f64) -> Vec<(&'static str, Vec<Orbit>)> {
    let orbits = |form| {
        let problem = pendulum(form);
        let orbit = |start: &[f64; 2]| {
            let run = Run {
                initial: start.to_vec(),
                ..run(&problem, method, value)
            };
            let mut times = Times(Vec::new());
            match problem.integrate(&run, &mut times) {
                Ok(finish) => Orbit::Ended {
                    times: times.0,
                    x: finish.x,
                },
                Err(stopped) => Orbit::Stopped(stopped.to_string()),
            }
        };
        STARTS.iter().map(orbit).collect()
    };
    FORMS.map(|(name, form)| (name, orbits(form))).into()
}

/// Their ends in the lanes of an ensemble.
fn all_in_lanes(method: MethodName, value: f64) -> Vec<(&'static str, Vec<Orbit>)> {
    let parallelism = Parallelism {
        threads: None,
        lanes: true,
    };
    let orbits = |form| {
        let problem = pendulum(form);
        let mut starts = STARTS.iter().map(|start| Start {
            parameters: Vec::new(),
            initial: start.to_vec(),
        });
        let mut orbits = Vec::new();
        let run = run(&problem, method, value);
        problem.integrate_all(&run, parallelism, &mut starts, &mut |outcome| {
            orbits.push(match (outcome.error, outcome.arrival) {
                (None, Some(end)) => Orbit::Ended {
                    // only their number is told
                    times: vec![0.0; end.statistics.transitions as usize],
                    x: end.x,
                },
                (error, _) => Orbit::Stopped(format!("{error:?}")),
            });
            ControlFlow::Continue(())
        });
        assert_eq!(orbits.len(), STARTS.len());
        orbits
    };
    FORMS.map(|(name, form)| (name, orbits(form))).into()
}

/// Every form has the itinerary, the times and the ends of the first, to a bound.
#[track_caller]
fn agree(found: &[(&'static str, Vec<Orbit>)], bound: f64) {
    let mut differences = Vec::new();
    let (_, plain) = &found[0];
    for (form, orbits) in found {
        for ((orbit, expected), start) in orbits.iter().zip(plain).zip(STARTS) {
            match (orbit, expected) {
                (Orbit::Stopped(why), _) => {
                    differences.push(format!("{form} from {start:?}: {why}"));
                }
                (
                    Orbit::Ended { times, x },
                    Orbit::Ended {
                        times: expected,
                        x: end,
                    },
                ) => {
                    let later = times.iter().zip(expected).map(|(a, b)| (a - b).abs());
                    let moved = x.iter().zip(end).map(|(a, b)| (a - b).abs());
                    let distance = later.chain(moved).fold(0.0, f64::max);
                    if times.len() != expected.len() {
                        differences.push(format!(
                            "{form} from {start:?}: {} crossings, not {}",
                            times.len(),
                            expected.len()
                        ));
                    } else if distance > bound {
                        differences.push(format!("{form} from {start:?}: off by {distance:.1e}"));
                    }
                }
                (Orbit::Ended { .. }, Orbit::Stopped(_)) => {}
            }
        }
    }
    assert!(differences.is_empty(), "{}", differences.join("\n"));
}

/// Steps of these differ with the form, by errors of 10⁻¹⁴ a step that some tens of crossings
/// enlarge tenfold.
const OF_ROUNDING: f64 = 1e-12;

#[test]
fn taylor_sees_one_interface() {
    agree(&all(MethodName::Taylor, 1e-14), OF_ROUNDING);
}

#[test]
fn best_sees_one_interface() {
    agree(&all(MethodName::Best, 1e-14), OF_ROUNDING);
}

#[test]
fn lanes_see_one_interface() {
    agree(&all_in_lanes(MethodName::Taylor, 1e-14), OF_ROUNDING);
}

/// Uniform steps are the same for every form: what differs is the rounding of a root.
#[test]
fn uniform_steps_see_one_interface() {
    agree(&all(MethodName::Symmetric, 0.02), OF_ROUNDING);
    agree(&all(MethodName::Composed4, 0.05), OF_ROUNDING);
    agree(&all(MethodName::Composed8, 0.2), OF_ROUNDING);
}

/// Steps by a tolerance may depend on the form, and so does their error: some hundred times the
/// tolerance after as many steps.
#[test]
fn steps_by_tolerance_see_one_interface() {
    agree(&all(MethodName::SymmetricAdaptive, 1e-5), 1e-2);
    agree(&all(MethodName::Composed8Adaptive, 1e-10), 1e-7);
}
