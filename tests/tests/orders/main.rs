//! Fitted orders of accuracy before the first event, after 10 and after 30 events of each kind:
//! crossings, jumps, beginnings and ends of sliding, changes of a discrete state, events in time.
//!
//! Every system has a solution in closed form between events; where an event happens is the zero of
//! a closed form, in closed form as well or by bisection. `Taylor` and `Best` have to meet the
//! times of the events to 10⁻¹², and the errors of the others have to fall by their orders: those of
//! the times of events, and those of the state between two events.
//!
//! `cargo test -p dmm-tests --test orders -- --nocapture` prints the fitted orders.

mod clocks;
mod crossings;
mod discrete;
mod jumps;
mod sliding;
mod solution;

use std::ops::{ControlFlow, RangeInclusive};

use dmm_problems::fit::fitted_order;
use dmm_problems::method::{MethodName, Run};
use dmm_problems::problem::Problem;
use dmm_runtime::dynamic::{AnyObserver, Crossed, OutputTimes};
use dmm_runtime::{Error, Model, TransitionKind};

use solution::Solution;

type Failure = Box<dyn std::error::Error>;

/// Errors of `Taylor` and `Best`: at times up to 200 the doubles themselves are 3e-14 apart, and a
/// time is a sum of up to 60 times between events.
const EXACT: f64 = 1e-12;

/// What a fitted order may be off by.
const TOLERANCE: f64 = 0.3;

/// Errors below this are near those of rounding, and not fitted.
const ROUNDING: f64 = 1e-13;
/// Errors that a fit takes, of the shortest steps.
const FITTED: usize = 4;
const FEWEST: usize = 3;

/// Where between two events states are compared: not half way, where by symmetry an error of time
/// may not show.
const SHARE: f64 = 0.3;

/// The schemes of uniform steps, with the exponents of their errors and of their step sizes 2⁻ᵏ.
const SCHEMES: [(MethodName, f64, RangeInclusive<i32>); 3] = [
    (MethodName::Symmetric, 2.0, 4..=7),
    (MethodName::Composed4, 4.0, 3..=6),
    (MethodName::Composed6, 6.0, 2..=5),
];

/// A system and what is measured of it.
struct Case {
    declaration: &'static str,
    initial: &'static [f64],
    solution: Solution,
    /// Numbers of the events, from 1, that are measured, and behind which the state is.
    events: &'static [usize],
    /// Whether the times of the events depend on the solution.
    is_located: bool,
    /// How many of the schemes have errors above rounding.
    schemes: usize,
}

/// What came out of a run: the events, and the state at the times of output.
#[derive(Default)]
struct Outcome {
    events: Vec<(f64, TransitionKind)>,
    states: Vec<Vec<f64>>,
}

impl AnyObserver for Outcome {
    fn transition(&mut self, crossed: &Crossed) -> ControlFlow<()> {
        self.events.push((crossed.t, crossed.kind));
        ControlFlow::Continue(())
    }

    fn output(&mut self, _t: f64, x: &[f64]) {
        self.states.push(x.to_vec());
    }
}

impl Case {
    /// Times at which the state is compared: before the first event, and behind those measured.
    fn sample_times(&self) -> Vec<f64> {
        let after = [0].into_iter().chain(self.events.iter().copied());
        after.map(|k| self.solution.between(k, SHARE)).collect()
    }

    fn run(&self, problem: &Problem, method: MethodName, step: f64) -> Result<Outcome, Error> {
        let times = self.sample_times();
        let run = Run {
            method,
            step_size: step,
            tolerance: 1e-15,
            initial: self.initial.to_vec(),
            t_end: times[times.len() - 1],
            output_times: OutputTimes::At(times),
            ..problem.default_run()
        };
        let mut outcome = Outcome::default();
        problem.integrate(&run, &mut outcome)?;
        Ok(outcome)
    }

    /// Errors of the times of the events measured, and of the states.
    fn errors(&self, outcome: &Outcome, what: &str) -> (Vec<f64>, Vec<f64>) {
        let expected = self.solution.kinds();
        let last = self.events[self.events.len() - 1];
        let kinds: Vec<_> = outcome.events.iter().map(|event| event.1).collect();
        assert!(kinds.len() >= last, "{what}: {} events", kinds.len());
        assert_eq!(kinds[..last], expected[..last], "{what}");
        let times = self.events.iter();
        let times = times.map(|&k| (outcome.events[k - 1].0 - self.solution.event(k)).abs());
        let samples = self.sample_times();
        assert_eq!(outcome.states.len(), samples.len(), "{what}");
        let states = outcome.states.iter().zip(samples);
        let states = states.map(|(x, t)| {
            let exact = self.solution.at(t);
            assert_eq!(x.len(), exact.len(), "{what}");
            let square = |(x, exact): (&f64, &f64)| (x - exact) * (x - exact);
            x.iter().zip(&exact).map(square).sum::<f64>().sqrt()
        });
        (times.collect(), states.collect())
    }

    /// Compares with the exact solution, and prints the fitted orders.
    fn check(&self) -> Result<(), Failure> {
        let problem = Problem::own(Model::compile(self.declaration)?)?;
        let name = problem.system_name();
        self.check_exact(&problem, name)?;
        for (method, order, halvings) in SCHEMES.into_iter().take(self.schemes) {
            let steps: Vec<f64> = halvings.map(|k| 0.5f64.powi(k)).collect();
            let mut runs = Vec::new();
            for &step in &steps {
                let what = format!("{name}, {}, {step}", method.name());
                let outcome = self.run(&problem, method, step)?;
                runs.push(self.errors(&outcome, &what));
            }
            let mut line = format!("{name:<18}{:<12}", method.name());
            let mut wrong = Vec::new();
            let mut fit = |what: String, errors: Vec<f64>| {
                if errors.iter().all(|error| *error <= ROUNDING) {
                    // where a motion sticks, and for how long, may not depend on steps
                    line += &format!("{what} exact  ");
                    return;
                }
                let above = errors.iter().take_while(|error| **error > ROUNDING);
                let end = above.count();
                let fitted = end.saturating_sub(FITTED)..end;
                let slope = fitted_order(&steps[fitted.clone()], &errors[fitted]);
                line += &format!("{what} {slope:.2}  ");
                if end < FEWEST || (slope - order).abs() > TOLERANCE {
                    wrong.push(format!("{what}: order {slope}, {errors:?}"));
                }
            };
            let after = [0].into_iter().chain(self.events.iter().copied());
            for (i, k) in after.enumerate() {
                if i > 0 && self.is_located {
                    fit(
                        format!("t{k}"),
                        runs.iter().map(|run| run.0[i - 1]).collect(),
                    );
                }
                fit(format!("x{k}"), runs.iter().map(|run| run.1[i]).collect());
            }
            println!("{line}");
            assert!(wrong.is_empty(), "{name}, {}: {wrong:#?}", method.name());
        }
        Ok(())
    }

    /// `Taylor` and `Best` have the times of all events and the states.
    fn check_exact(&self, problem: &Problem, name: &str) -> Result<(), Failure> {
        for method in [MethodName::Taylor, MethodName::Best] {
            let what = format!("{name}, {}", method.name());
            let outcome = self.run(problem, method, 0.0)?;
            let mut largest = 0.0_f64;
            for (k, (t, _)) in (1..).zip(&outcome.events) {
                let error = (t - self.solution.event(k)).abs();
                assert!(
                    error <= EXACT,
                    "{what}: event {k} at {t}, an error of {error:e}"
                );
                largest = largest.max(error);
            }
            let (_, states) = self.errors(&outcome, &what);
            let state = states.iter().copied().fold(0.0, f64::max);
            assert!(state <= EXACT, "{what}: errors of the state {states:?}");
            println!(
                "{name:<18}{:<12}times {largest:.1e}  states {state:.1e}",
                method.name()
            );
        }
        Ok(())
    }
}
