//! Several interfaces, events and switches: modes that are more than the two sides of an interface.

mod jumps;
mod several;
mod switches;

use dmm_problems::method::{MethodName, Run};
use dmm_problems::problem::Problem;
use dmm_runtime::dynamic::Finish;
use dmm_runtime::{Best, Error, Integrator, Method, Model, Solution, System};

type Failure = Box<dyn std::error::Error>;

/// A trajectory from t = 0.
fn run<Sys: System<N>, Met: Method, const N: usize>(
    system: &Sys,
    method: Met,
    x0: [f64; N],
    t_end: f64,
) -> Result<Solution<Sys, Met, N>, Error> {
    let run = Integrator::new(system, method).initial(0.0, x0);
    Ok(run.run_until(t_end)?)
}

/// The times of its transitions.
fn times<Sys: System<N>, Met: Method, const N: usize>(run: Solution<Sys, Met, N>) -> Vec<f64> {
    run.transitions().iter().map(|one| one.t).collect()
}

/// A system compiled at run time from (0, x₀) by `Best`: where it ends.
fn best(declaration: &str, tolerance: f64, x0: &[f64], t_end: f64) -> Result<Finish, Failure> {
    let problem = Problem::own(Model::compile(declaration)?)?;
    let run = Run {
        method: MethodName::Best,
        tolerance,
        initial: x0.to_vec(),
        t_end,
        ..problem.default_run()
    };
    Ok(problem.integrate_silently(&run)?)
}

/// Compares generated code with the same declaration compiled at run time.
fn same_at_run_time<Sys: System<N>, const N: usize>(
    system: &Sys,
    x0: [f64; N],
    t_end: f64,
) -> Result<(), Failure> {
    let end = best(system.declaration(), 1e-12, &x0, t_end)?;
    let expected = Integrator::new(system, Best::tolerance(1e-12)).initial(0.0, x0);
    let expected = expected.observe_until(t_end, &mut ())?;
    let name = system.metadata().name;
    let transitions = expected.statistics.transitions;
    assert_eq!(end.statistics.transitions, transitions, "{name}");
    for (one, other) in end.x.iter().zip(expected.point.x.iter()) {
        assert!((one - other).abs() < 1e-11, "{name}: {one} {other}");
    }
    Ok(())
}
