//! One interface, x = 0.2, written in ten ways: the same itinerary and the same times, whatever
//! the switching function's series, scale and domain are.

use dmm_runtime::{
    Best, Composed, Ensemble, Integrator, Member, Method, Symmetric, System, Taylor,
};

macro_rules! pendulums {
    ($($name:ident: [$($g:tt)+];)+) => {
        $(mod $name {
            use dmm_runtime::pws;

            pws! {
                /// A pendulum with a stronger torque beyond x = 0.2.
                pub(super) system Pendulum {
                    state x, v;
                    interface border = $($g)+;
                    der(x) = v;
                    region near where border < 0 {
                        der(v) = -sin(x);
                        conserved energy = v^2 / 2 - cos(x);
                    }
                    region far where border > 0 {
                        der(v) = -3 * sin(x);
                        conserved energy = v^2 / 2 - 3 * cos(x);
                    }
                }
            }
        })+

        /// The crossings of each of the ten with a scheme, from each start.
        fn all(scheme: impl Method) -> Vec<(&'static str, Vec<Orbit>)> {
            vec![$((stringify!($name), orbits($name::Pendulum {}, scheme.clone()))),+]
        }

        /// Their ends in the lanes of an ensemble.
        fn all_in_lanes(scheme: impl Method) -> Vec<(&'static str, Vec<Orbit>)> {
            vec![$((stringify!($name), in_lanes($name::Pendulum {}, scheme.clone()))),+]
        }
    };
}

pendulums! {
    plain: [x - 0.2];
    exponential: [exp(x) - exp(0.2)];
    logarithm: [ln(x + 2) - ln(2.2)];
    tangent: [tanh(x - 0.2)];
    arctangent: [atan(x - 0.2)];
    cubic: [(x - 0.2)^3 + (x - 0.2)];
    rational: [(x - 0.2) / (0.01 + x^2)];
    wavy: [x - 0.2 + 0.1 * sin(x - 0.2)];
    smoothed: [(x - 0.2) / sqrt(1e-2 + (x - 0.2)^2)];
    root: [sqrt(x + 3) - sqrt(3.2)];
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
    Ended { times: Vec<f64>, x: [f64; 2] },
    /// What stopped it.
    Stopped(String),
}

fn orbits<Sys: System<2>>(system: Sys, scheme: impl Method) -> Vec<Orbit> {
    let orbit = |start: &[f64; 2]| {
        let problem = Integrator::new(&system, scheme.clone()).initial(0.0, *start);
        match problem.run_until(T_END) {
            Ok(solution) => Orbit::Ended {
                times: solution.transitions().iter().map(|found| found.t).collect(),
                x: solution
                    .last()
                    .map_or([f64::NAN; 2], |point| point.x.into()),
            },
            Err(stopped) => Orbit::Stopped(stopped.to_string()),
        }
    };
    STARTS.iter().map(orbit).collect()
}

fn in_lanes<Sys: System<2>>(system: Sys, scheme: impl Method) -> Vec<Orbit> {
    let members = STARTS.map(|start| Member::new(system.clone(), 0.0, start));
    let outcomes = Ensemble::new(scheme).collect_until(T_END, members);
    let orbit = |outcome: dmm_runtime::Outcome<Sys::Region, 2>| match outcome {
        Ok(end) => Orbit::Ended {
            // only their number is told
            times: vec![0.0; end.statistics.transitions as usize],
            x: end.point.x.into(),
        },
        Err(stopped) => Orbit::Stopped(stopped.to_string()),
    };
    outcomes.into_iter().map(orbit).collect()
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
    agree(&all(Taylor::tolerance(1e-14)), OF_ROUNDING);
}

#[test]
fn best_sees_one_interface() {
    agree(&all(Best::tolerance(1e-14)), OF_ROUNDING);
}

#[test]
fn lanes_see_one_interface() {
    agree(&all_in_lanes(Taylor::tolerance(1e-14)), OF_ROUNDING);
}

/// Uniform steps are the same for every form: what differs is the rounding of a root.
#[test]
fn uniform_steps_see_one_interface() {
    agree(&all(Symmetric::step_size(0.02)), OF_ROUNDING);
    agree(&all(Composed::<4>::step_size(0.05)), OF_ROUNDING);
    agree(&all(Composed::<8>::step_size(0.2)), OF_ROUNDING);
}

/// Steps by a tolerance may depend on the form, and so does their error: some hundred times the
/// tolerance after as many steps.
#[test]
fn steps_by_tolerance_see_one_interface() {
    agree(&all(Symmetric::tolerance(1e-5)), 1e-2);
    agree(&all(Composed::<6>::tolerance(1e-10)), 1e-7);
}
