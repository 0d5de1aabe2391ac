//! Tests across the workspace; see `tests/`. What several of them do is here.

pub mod systems;

use dmm_runtime::{End, Error, Halted, Integrator, Method, System};

/// The end of a run from `initial` at t = 0.
///
/// # Errors
///
/// What stops it before `t_end`.
pub fn run<Sys: System<N>, const N: usize>(
    system: &Sys,
    scheme: impl Method,
    initial: [f64; N],
    t_end: f64,
) -> Result<End<Sys::Region, N>, Halted<Sys::Region, N>> {
    Integrator::new(system, scheme)
        .initial(0.0, initial)
        .observe_until(t_end, &mut ())
}

/// Times of the transitions of a run from `initial` at t = 0.
///
/// # Errors
///
/// What stops it before `t_end`.
pub fn transition_times<Sys: System<N>, const N: usize>(
    system: &Sys,
    scheme: impl Method,
    initial: [f64; N],
    t_end: f64,
) -> Result<Vec<f64>, Error> {
    let solution = Integrator::new(system, scheme)
        .initial(0.0, initial)
        .run_until(t_end)?;
    let times = solution.transitions().iter().map(|transition| transition.t);
    Ok(times.collect())
}
