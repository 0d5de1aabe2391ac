//! Radau5 of the crate differential-equations: Radau IIA of three stages with the exact Jacobian.
//! Roots are found on its dense output, and a phase is a problem of its own.

use differential_equations::linalg::Matrix;
use differential_equations::ode::{ODE, solve_ode};
use differential_equations::prelude::{
    ControlFlag, ImplicitRungeKutta, Interpolation, Solout, Solution,
};

use crate::Outcome;
use crate::phases::{End, Part, Tolerances, integrate};
use crate::plain::Plain;

/// Halvings of a step that a root is looked for in.
const MOST_HALVINGS: usize = 60;

struct Phase<P: Plain<N>, const N: usize>(P::Phase);

impl<P: Plain<N>, const N: usize> ODE<f64, [f64; N]> for Phase<P, N> {
    fn diff(&self, _: f64, x: &[f64; N], dx: &mut [f64; N]) {
        *dx = P::field(self.0, x);
    }

    fn jacobian(&self, _: f64, x: &[f64; N], matrix: &mut Matrix<f64>) {
        for (i, row) in P::jacobian(self.0, x).into_iter().enumerate() {
            for (k, entry) in row.into_iter().enumerate() {
                matrix[(i, k)] = entry;
            }
        }
    }
}

/// Ends a phase at its first root.
struct Roots<'a, P: Plain<N>, const N: usize> {
    phase: &'a Phase<P, N>,
    part: Part<N>,
}

impl<P: Plain<N>, const N: usize> Roots<'_, P, N> {
    fn is_met(&self, before: &[f64; N], x: &[f64; N]) -> bool {
        let values = |x| P::roots(self.phase.0, x);
        let pairs = values(before).into_iter().zip(values(x));
        P::ROOTS > 0
            && pairs
                .into_iter()
                .any(|(before, after)| before * after < 0.0)
    }
}

impl<P: Plain<N>, const N: usize> Solout<f64, [f64; N]> for Roots<'_, P, N> {
    fn solout<I>(
        &mut self,
        t: f64,
        t_before: f64,
        x: &[f64; N],
        x_before: &[f64; N],
        interpolation: &mut I,
        _: &mut Solution<f64, [f64; N]>,
    ) -> ControlFlag<f64, [f64; N]>
    where
        I: Interpolation<f64, [f64; N]> + ?Sized,
    {
        (self.part.t, self.part.x) = (t, *x);
        if t <= t_before || !self.is_met(x_before, x) {
            return ControlFlag::Continue;
        }
        let mut low = t_before;
        for _ in 0..MOST_HALVINGS {
            let middle = 0.5 * (low + self.part.t);
            let Ok(x) = interpolation.interpolate(middle) else {
                break;
            };
            if middle <= low || middle >= self.part.t {
                break;
            }
            if self.is_met(x_before, &x) {
                (self.part.t, self.part.x) = (middle, x);
            } else {
                low = middle;
            }
        }
        self.part.root = true;
        ControlFlag::Terminate
    }
}

pub fn run<P: Plain<N>, const N: usize>(tolerances: Tolerances) -> Outcome<End<N>> {
    integrate::<P, N>(|phase, initial, left| {
        let phase = Phase::<P, N>(phase);
        let mut roots = Roots {
            phase: &phase,
            part: Part {
                t: 0.0,
                x: initial,
                steps: 0,
                root: false,
            },
        };
        let mut method = ImplicitRungeKutta::radau5()
            .rtol(tolerances.relative)
            .atol(tolerances.of_components::<P, N>());
        let solution = solve_ode(&mut method, &phase, 0.0, left, &initial, &mut roots)
            .map_err(|error| format!("{error:?}"))?;
        roots.part.steps = solution.steps.accepted as u64;
        Ok(roots.part)
    })
}
