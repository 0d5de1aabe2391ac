//! The derivatives over a step.

use nalgebra::DMatrix;

use super::directions::{Directions, Number, number, state, store};
use super::no_derivative;
use super::transition::Behind;
use crate::arithmetic::{Time, Vector};
use crate::contract::{Dynamics, DynamicsVisitor, System};
use crate::error::Error;
use crate::method::{Method, Variation};
use crate::output::{Point, Solution};

impl<Sys: System<N>, const N: usize> Directions<'_, Sys, N> {
    /// ∂x at the fixed end of a step from a point.
    pub(super) fn step<Met: Method>(
        &self,
        solution: &Solution<Sys, Met, N>,
        from: &Point<Sys::Region, N>,
        end: Time,
        present: &Behind<N>,
    ) -> Result<DMatrix<f64>, Error> {
        let mut derivatives = DMatrix::zeros(N, self.count());
        for first in self.firsts() {
            let t0 = number(from.t, &present.time, first);
            let step = Step {
                method: solution.method(),
                t0,
                x0: state(&from.x, &present.state, first),
                tau: number(end.since(from.time), &[], 0) - t0 + number(from.t, &[], 0),
            };
            let x1 = self.visit(from.region, first, step);
            let x1 = x1.filter(|x| {
                x.iter()
                    .all(|x| x.parts.iter().all(|part| part.is_finite()))
            });
            match x1 {
                Some(x1) => store(&mut derivatives, first, &x1),
                None => return Err(no_derivative(solution, from, "the step has none")),
            }
        }
        Ok(derivatives)
    }

    /// ∂d/∂τ at the end of a step from a point: the velocity of the method's map.
    pub(super) fn velocity<Met: Method>(
        &self,
        solution: &Solution<Sys, Met, N>,
        from: &Point<Sys::Region, N>,
        end: Time,
    ) -> Option<Vector<f64, N>> {
        let step = Step {
            method: solution.method(),
            t0: number(from.t, &[], 0),
            x0: from.x.map(|x| number(x, &[], 0)),
            tau: number(end.since(from.time), &[1.0], 0),
        };
        // beyond all directions: parameters are constant
        let x1 = self.visit(from.region, self.count(), step)?;
        Some(x1.map(|x| x.parts[0]))
    }
}

/// A step over dual numbers.
struct Step<'a, Met, const N: usize> {
    method: &'a Met,
    t0: Number,
    x0: Vector<Number, N>,
    tau: Number,
}

impl<Met: Method, const N: usize> DynamicsVisitor<N, Number> for Step<'_, Met, N> {
    type Output = Option<Vector<Number, N>>;

    fn visit<const M: usize, D: Dynamics<Number, N, M>>(self, dynamics: &D) -> Self::Output {
        let variation = Variation {
            dynamics,
            t0: self.t0,
            x0: self.x0,
            tau: self.tau,
        };
        let increment = self.method.differentiate::<D, Number, N, M>(&variation)?;
        Some(variation.end(&increment))
    }
}
