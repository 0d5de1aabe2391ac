//! diffsol: an explicit Runge–Kutta method of order 5 with roots. At a root the state is moved
//! back to it and the step after begins with the other field.
//!
//! Roots are located to 100 ε of the time, so the clock begins anew at each crossing: otherwise
//! nothing of an error below 10⁻⁷ is left at t = 10⁴.

use diffsol::{NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason, Vector};
use dmm_runtime::System;

use crate::sides::Sides;
use crate::{End, Outcome};

/// So far ahead of a root g is looked at, to tell whether the root is the one just crossed.
const AHEAD: f64 = 1e-7;

pub fn tsit45<Sys: System<N>, const N: usize>(
    sides: &Sides<'_, Sys, N>,
    initial: [f64; N],
    t_end: f64,
    tolerance: f64,
) -> Outcome<End<N>> {
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(tolerance)
        .atol([tolerance])
        .rhs(|x: &[f64], _: &[f64], t, dx: &mut [f64]| {
            dx.copy_from_slice(&sides.field(t, &array(x)));
        })
        .init(|_: &[f64], _, x: &mut [f64]| x.copy_from_slice(&initial), N)
        .root(
            |x: &[f64], _: &[f64], t, g: &mut [f64]| g[0] = sides.switching(t, &array(x)),
            1,
        )
        .build()?;
    let mut solver = problem.tsit45()?;
    let mut left = t_end;
    solver.set_stop_time(left)?;
    let (mut steps, mut crossings) = (0, 0);
    loop {
        steps += 1;
        match solver.step()? {
            OdeSolverStopReason::RootFound(t, _) if t < left => {
                solver.state_mut_back(t)?;
                let x = array_of(solver.state().y);
                let f = sides.field(t, &x);
                let ahead = std::array::from_fn(|i| x[i] + AHEAD * f[i]);
                if sides.switching(t, &ahead) * sides.sign() < 0.0 {
                    sides.cross();
                    crossings += 1;
                }
                left -= t;
                let f = sides.field(0.0, &x);
                let state = solver.state_mut();
                *state.t = 0.0;
                for (i, f) in f.into_iter().enumerate() {
                    state.dy.set_index(i, f);
                }
                solver.set_stop_time(left)?;
            }
            OdeSolverStopReason::TstopReached => break,
            _ => {}
        }
    }
    Ok(End {
        x: array_of(solver.state().y),
        steps,
        crossings,
    })
}

fn array<const N: usize>(x: &[f64]) -> [f64; N] {
    std::array::from_fn(|i| x[i])
}

fn array_of<const N: usize>(x: &diffsol::NalgebraVec<f64>) -> [f64; N] {
    std::array::from_fn(|i| x.get_index(i))
}
