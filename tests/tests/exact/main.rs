//! The exact flow of affine regions, which `Best` takes, against closed forms: every crossing is
//! found and in its place, whatever the spectrum of A.

mod crossings;
mod mixed;
mod spectra;
mod stiff;

use dmm_runtime::{Best, InitialValueProblem, Integrator, Solution, System};

/// The problem from `x` at t = 0.
fn start<Sys: System<N>, const N: usize>(
    system: &Sys,
    x: [f64; N],
) -> InitialValueProblem<'_, Sys, Best, N> {
    Integrator::new(system, Best::tolerance(1e-12)).initial(0.0, x)
}

/// The solution until `t_end`.
fn solve<Sys: System<N>, const N: usize>(
    system: &Sys,
    x: [f64; N],
    t_end: f64,
) -> Solution<Sys, Best, N> {
    start(system, x).run_until(t_end).unwrap()
}

/// The times of the transitions until `t_end`.
fn times<Sys: System<N>, const N: usize>(system: &Sys, x: [f64; N], t_end: f64) -> Vec<f64> {
    let solution = solve(system, x, t_end);
    solution.transitions().iter().map(|t| t.t).collect()
}

/// Within `error` of each other, and as many.
#[track_caller]
fn assert_near(found: &[f64], exact: &[f64], error: f64) {
    assert_eq!(found.len(), exact.len(), "{found:?} {exact:?}");
    for (found, exact) in found.iter().zip(exact) {
        assert!((found - exact).abs() <= error, "{found} {exact}");
    }
}
