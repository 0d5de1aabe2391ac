//! Systems that are compiled at run time give what those compiled with a program give, to rounding.

use dmm_problems::method::MethodName;
use dmm_problems::problem::{Description, Problem, Run};
use dmm_problems::registry::{self, SystemVisitor, visit_systems};
use dmm_runtime::dynamic::{AnyObserver, Crossed, Finish, Parallelism, Start};
use dmm_runtime::{Best, End, Error, Integrator, Method, Model, Symmetric, System, Taylor, Vector};
use std::ops::ControlFlow;

/// The methods that are compared: one-step, Taylor, and exact flows.
const METHODS: [MethodName; 3] = [MethodName::Symmetric, MethodName::Taylor, MethodName::Best];

const TOLERANCE: f64 = 1e-12;

/// The time of a comparison: rounding errors of chaotic solutions have not grown far.
const LONGEST: f64 = 5.0;
/// Rounding errors, which grow along a solution.
const ROUNDING: f64 = 1e-11;

/// Compares the two ways to compile each system.
struct Compare {
    runs: usize,
    transitions: u64,
    /// The runs whose results are the same to the last bit.
    equal: usize,
}

fn compiled_at_run_time(declaration: &str) -> Problem {
    let model = Model::compile(declaration).unwrap_or_else(|error| panic!("{error}"));
    Problem::own(model).unwrap()
}

/// A run of a problem from elsewhere.
fn run(problem: &Problem, method: MethodName, initial: &[f64], t_end: f64) -> Run {
    Run {
        method,
        tolerance: TOLERANCE,
        initial: initial.to_vec(),
        t_end,
        ..problem.default_run()
    }
}

/// A run of a system that is compiled with this test.
fn compiled<Sys: System<N>, Met: Method, const N: usize>(
    system: &Sys,
    method: Met,
    initial: &[f64],
    t_end: f64,
) -> End<Sys::Region, N> {
    let initial = Vector::<f64, N>::from_column_slice(initial);
    let problem = Integrator::new(system, method).initial(0.0, initial);
    problem.observe_until(t_end, &mut ()).unwrap()
}

impl SystemVisitor for Compare {
    fn visit<Sys: System<N> + Default, const N: usize>(
        &mut self,
        description: &'static Description,
    ) {
        let system = Sys::default();
        let model = compiled_at_run_time(system.declaration());
        let parameters = model.parameters().into_iter().map(|(_, value)| value);
        assert_eq!(model.metadata(), system.metadata());
        assert_eq!(parameters.collect::<Vec<_>>(), system.parameters());
        assert!(model.has_default_parameters());
        assert_eq!(model.listing(), system.listing());
        let x0 = description.initial;
        let t_end = description.t_end.min(LONGEST);
        let step_size = description.step_size.max(1e-3);
        for method in METHODS {
            let name = format!("{} {}", description.name, method.name());
            let expected = match method {
                MethodName::Symmetric => {
                    compiled(&system, Symmetric::step_size(step_size), x0, t_end)
                }
                MethodName::Taylor => compiled(&system, Taylor::tolerance(TOLERANCE), x0, t_end),
                _ => compiled(&system, Best::tolerance(TOLERANCE), x0, t_end),
            };
            let run = Run {
                step_size,
                ..run(&model, method, x0, t_end)
            };
            let end = model.integrate_silently(&run).unwrap();
            assert_eq!(
                (end.statistics.steps, end.statistics.transitions),
                (expected.statistics.steps, expected.statistics.transitions),
                "{name}"
            );
            self.runs += 1;
            self.transitions += end.statistics.transitions;
            let x = expected.point.x;
            self.equal += usize::from(end.x == x.as_slice());
            let size = x.amax().max(1.0);
            for (a, b) in end.x.iter().zip(&x) {
                let error = (a - b).abs() / size;
                assert!(error <= ROUNDING, "{name}: {error:e}");
            }
        }
        for (index, region) in system.regions().enumerate() {
            assert_eq!(
                model.vector_field(index, 0.3, x0).len(),
                model.states().len()
            );
            let x = Vector::<f64, N>::from_column_slice(x0);
            let expected = system.conserved(region, 0.3, &x);
            let psi = model.conserved(index, 0.3, x0);
            assert_eq!(psi.len(), model.conserved_names(index).len());
            assert_eq!(psi.len(), expected.len());
            for (a, b) in psi.iter().zip(&expected) {
                assert!((a - b).abs() <= 1e-14 * (1.0 + a.abs()), "{a} {b}");
            }
        }
    }
}

#[test]
fn all_problems_agree() {
    let mut compare = Compare {
        runs: 0,
        transitions: 0,
        equal: 0,
    };
    visit_systems(&mut compare);
    assert_eq!(compare.runs, 63);
    assert!(compare.transitions > 20, "{}", compare.transitions);
    // the operations are the same; what is fused may differ
    assert!(3 * compare.equal > 2 * compare.runs, "{}", compare.equal);
}

/// A falling ball on a spring.
const BALL: &str = "system Ball {
    state x, v;
    param k = 4, m = 1;
    interface spring = x;
    region free where spring > 0 {
        der(x) = v; der(v) = -1; conserved energy = m*(v^2/2 + x);
    }
    region pressed where spring < 0 {
        der(x) = v; der(v) = -1 - k*x/m; conserved energy = m*(v^2/2 + x) + k*x^2/2;
    }
}";

fn fall(k: f64, t_end: f64) -> Result<Finish, Error> {
    let mut model = Model::compile(BALL).unwrap();
    model.set("k", k)?;
    let ball = Problem::own(model)?;
    ball.integrate_silently(&run(&ball, MethodName::Best, &[1.0, 0.0], t_end))
}

#[test]
fn parameters_are_set_by_name() {
    // free fall for √2, then half a period about −m/k
    let time = |k: f64| {
        let omega: f64 = k.sqrt();
        let half = std::f64::consts::PI + 2.0 * (1.0 / (omega * 2f64.sqrt())).atan();
        2.0 * 2f64.sqrt() + half / omega
    };
    for k in [1.0, 4.0, 30.0] {
        let end = fall(k, time(k)).unwrap();
        assert!(
            (end.x[0] - 1.0).abs() < 1e-13 && end.x[1].abs() < 1e-13,
            "{k} {end:?}"
        );
        assert_eq!(end.statistics.transitions, 2);
    }
    let mut model = Model::compile(BALL).unwrap();
    let error = model.set("stiffness", 1.0).unwrap_err().to_string();
    assert!(error.contains("stiffness"), "{error}");
    let error = fall(f64::NAN, 1.0).unwrap_err().to_string();
    assert!(error.contains("k = NaN"), "{error}");
}

#[test]
fn mistakes_are_told_by_line_and_column() {
    let errors = |text: &str| Model::compile(text).unwrap_err().to_string();
    let text = "system Ball {\n    state x, v;\n    der(x) = v;\n    der(v) = -w;\n}";
    assert!(
        errors(text).starts_with("4:15: `w` is not declared"),
        "{}",
        errors(text)
    );
    assert!(errors("fn main() {}").starts_with("1:1: this declares no system"));
    let unclosed = errors("system A { state x; der(x) = 1; } \"");
    assert!(unclosed.starts_with("1:35: "), "{unclosed}");
    let two =
        "pws! { system A { state x; der(x) = 1; } } pws! { system B { state x; der(x) = 1; } }";
    assert!(errors(two).contains("more than one system"));
    let false_claim = "system A { state x, y; der(x) = y; der(y) = -x; conserved e = x^2 - y^2; }";
    assert!(
        errors(false_claim).contains("PWS300"),
        "{}",
        errors(false_claim)
    );
    let large = "system A { state x[200]; for i in 0..200 { der(x[i]) = 1; } }";
    assert!(errors(large).contains("PWS241"), "{}", errors(large));
    // each x[i] is conserved
    let rests = "system A { state x[10], y; for i in 0..10 { der(x[i]) = 0; } der(y) = 1;
        conserved c0 = x[0]; conserved c1 = x[1]; conserved c2 = x[2]; conserved c3 = x[3];
        conserved c4 = x[4]; conserved c5 = x[5]; conserved c6 = x[6]; conserved c7 = x[7];
        conserved c8 = x[8]; }";
    let error = Model::compile(rests).map(|model| Problem::own(model).map(drop));
    assert!(
        format!("{error:?}").contains("8 conserved quantities"),
        "{error:?}"
    );
}

#[test]
fn a_start_has_as_many_entries_as_there_are_states() {
    let ball = compiled_at_run_time(BALL);
    for initial in [&[][..], &[1.0], &[1.0, 0.0, 0.0]] {
        let from = run(&ball, MethodName::Best, initial, 1.0);
        let error = ball.integrate_silently(&from).unwrap_err();
        assert!(error.to_string().contains("as many entries"), "{error}");
    }
}

#[test]
fn ensembles_and_observers_have_the_states_of_the_system_alone() {
    // three states, in a size for four
    let top = compiled_at_run_time(
        "system Top { state x, y, z; der(x) = y*z/2; der(y) = -z*x; der(z) = x*y/2;
            conserved size = x^2 + y^2 + z^2; conserved energy = x^2 + y^2/2; }",
    );
    struct Lengths(usize);
    impl AnyObserver for Lengths {
        fn record(&mut self, record: &dmm_runtime::dynamic::Record<'_>) -> ControlFlow<()> {
            assert_eq!((record.x.len(), record.psi.len()), (3, 2));
            self.0 += 1;
            ControlFlow::Continue(())
        }

        fn transition(&mut self, _: &Crossed) -> ControlFlow<()> {
            panic!("there is no interface")
        }
    }
    let mut lengths = Lengths(0);
    let from = run(&top, MethodName::Taylor, &[1.0, 0.2, 0.4], 20.0);
    top.integrate(&from, &mut lengths).unwrap();
    let end = top.integrate_silently(&from).unwrap();
    assert!(lengths.0 > 10, "{}", lengths.0);
    for lanes in [false, true] {
        let parallelism = Parallelism {
            threads: Some(1),
            lanes,
        };
        let mut starts = (0..20).map(|_| Start {
            parameters: Vec::new(),
            initial: vec![1.0, 0.2, 0.4],
        });
        let mut arrivals = 0;
        top.integrate_all(&from, parallelism, &mut starts, &mut |outcome| {
            let x = outcome.arrival.unwrap().x;
            assert_eq!(x.len(), 3);
            for (a, b) in x.iter().zip(&end.x) {
                assert!((a - b).abs() < 1e-7, "{x:?}");
            }
            arrivals += 1;
            ControlFlow::Continue(())
        });
        assert_eq!(arrivals, 20);
    }
}

/// The ends of runs whose parameters are up to a tenth larger, one by one or in lanes.
fn ensemble(problem: &Problem, run: &Run, members: usize, lanes: bool) -> Vec<Option<Vec<f64>>> {
    let parallelism = Parallelism {
        threads: Some(1),
        lanes,
    };
    let parameters = problem.parameters();
    let mut starts = (0..members).map(|member| {
        let more = 0.1 * member as f64 / members as f64;
        // not all by the same factor, of which some solutions do not depend
        let parameters = parameters.iter().enumerate();
        let parameters = parameters.map(|(i, (_, value))| value * (1.0 + more / (1 + i) as f64));
        Start {
            parameters: parameters.collect(),
            initial: run.initial.clone(),
        }
    });
    let mut ends = Vec::new();
    problem.integrate_all(run, parallelism, &mut starts, &mut |outcome| {
        ends.push(outcome.arrival.map(|arrival| arrival.x));
        ControlFlow::Continue(())
    });
    ends
}

#[test]
fn members_of_an_ensemble_have_their_own_parameters_in_lanes_too() {
    /// More than there are lanes.
    const MEMBERS: usize = 11;
    let problems = registry::all();
    let problems = problems.iter().filter(|one| !one.parameters().is_empty());
    let mut compared = 0;
    for problem in problems {
        let description = problem.description();
        let t_end = description.t_end.min(LONGEST);
        let run = run(problem, MethodName::Taylor, description.initial, t_end);
        let [single, lanes] = [false, true].map(|lanes| ensemble(problem, &run, MEMBERS, lanes));
        assert_eq!((single.len(), lanes.len()), (MEMBERS, MEMBERS));
        for (a, b) in single.iter().zip(&lanes) {
            let (Some(a), Some(b)) = (a, b) else {
                panic!("{}: {a:?} {b:?}", description.name);
            };
            let size = a.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
            for (a, b) in a.iter().zip(b) {
                assert!(
                    (a - b).abs() <= 1e-9 * size,
                    "{}: {a} {b}",
                    description.name
                );
            }
            compared += 1;
        }
        assert_ne!(single.first(), single.last(), "{}", description.name);
    }
    assert!(compared >= 10 * MEMBERS, "{compared}");
}

/// Counts the records of a run.
struct Records {
    every: u64,
    count: u64,
}

impl AnyObserver for Records {
    fn record(&mut self, _: &dmm_runtime::dynamic::Record<'_>) -> ControlFlow<()> {
        self.count += 1;
        ControlFlow::Continue(())
    }

    fn record_every(&self) -> u64 {
        self.every
    }
}

#[test]
fn one_point_in_so_many_is_recorded_and_the_first_of_each_region() {
    let decay = compiled_at_run_time("system Decay { state x; der(x) = -x; }");
    let harmonic = registry::find("harmonic").unwrap();
    for (problem, initial) in [(&decay, &[1.0][..]), (&harmonic, &[1.0, 1.0])] {
        let run = Run {
            step_size: 1e-2,
            ..run(problem, MethodName::Symmetric, initial, 10.0)
        };
        let records = |every| {
            let mut records = Records { every, count: 0 };
            let finish = problem.integrate(&run, &mut records).unwrap();
            (records.count, finish.statistics.transitions)
        };
        let (points, transitions) = records(1);
        assert!(points > 1000, "{points}");
        assert_eq!(records(0).0, 0);
        let (some, _) = records(100);
        let first = transitions + 1;
        assert!(
            some.abs_diff(points / 100 + first) <= first,
            "{some} of {points}"
        );
    }
}
