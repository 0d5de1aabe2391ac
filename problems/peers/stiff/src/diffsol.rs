//! diffsol: BDF and two diagonally implicit Runge–Kutta methods with dense matrices and the exact
//! Jacobian. A phase is a problem of its own.

use diffsol::{
    NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations, OdeSolverMethod,
    OdeSolverStopReason, Vector,
};

use crate::Outcome;
use crate::phases::{End, Part, Tolerances, integrate};
use crate::plain::Plain;

type Solver = NalgebraLU<f64>;

const MOST_STEPS: u64 = 1_000_000;

pub enum Method {
    Bdf,
    TrBdf2,
    Esdirk34,
}

pub fn run<P: Plain<N>, const N: usize>(
    method: &Method,
    tolerances: Tolerances,
) -> Outcome<End<N>> {
    integrate::<P, N>(|phase, initial, left| {
        let problem = OdeBuilder::<NalgebraMat<f64>>::new()
            .rtol(tolerances.relative)
            .atol(tolerances.of_components::<P, N>())
            .rhs_implicit(
                |x: &[f64], _: &[f64], _, dx: &mut [f64]| {
                    dx.copy_from_slice(&P::field(phase, array(x)));
                },
                |x: &[f64], _: &[f64], _, v: &[f64], product: &mut [f64]| {
                    for (product, row) in product.iter_mut().zip(P::jacobian(phase, array(x))) {
                        *product = row.iter().zip(v).map(|(entry, v)| entry * v).sum();
                    }
                },
            )
            .init(|_: &[f64], _, x: &mut [f64]| x.copy_from_slice(&initial), N)
            .root(
                |x: &[f64], _: &[f64], _, g: &mut [f64]| {
                    g.copy_from_slice(&P::roots(phase, array(x)));
                },
                2,
            )
            .build()?;
        match method {
            Method::Bdf => until(problem.bdf::<Solver>()?, left),
            Method::TrBdf2 => until(problem.tr_bdf2::<Solver>()?, left),
            Method::Esdirk34 => until(problem.esdirk34::<Solver>()?, left),
        }
    })
}

/// Steps until a root or until `left`.
fn until<'a, E, S, const N: usize>(mut solver: S, left: f64) -> Outcome<Part<N>>
where
    E: OdeEquations<T = f64, V = NalgebraVec<f64>> + 'a,
    S: OdeSolverMethod<'a, E>,
{
    solver.set_stop_time(left)?;
    let mut steps = 0;
    let (t, root) = loop {
        steps += 1;
        match solver.step()? {
            OdeSolverStopReason::RootFound(t, _) => {
                solver.state_mut_back(t)?;
                break (t, true);
            }
            OdeSolverStopReason::TstopReached => break (left, false),
            _ if steps > MOST_STEPS => return Err("too many steps".into()),
            _ => {}
        }
    };
    let x = solver.state().y;
    Ok(Part {
        t,
        x: std::array::from_fn(|i| x.get_index(i)),
        steps,
        root,
    })
}

fn array<const N: usize>(x: &[f64]) -> &[f64; N] {
    x.first_chunk().expect("a state has N components")
}
