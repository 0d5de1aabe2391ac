//! The derivatives of Runge–Kutta steps.

use super::super::map::Step;
use super::implicit::Prepared;
use super::stages::Stages;
use super::tableau::{MOST_STAGES, Tableau};
use crate::arithmetic::factors::Factors;
use crate::arithmetic::{Scalar, Vector};
use crate::contract::Dynamics;
use crate::method::Statistics;
use crate::method::variation::Variation;

/// Stages, or fields at them, over dual numbers.
type Each<S, const N: usize> = [Vector<S, N>; MOST_STAGES];

impl<D, S: Scalar, const N: usize> Variation<'_, D, S, N> {
    /// x₁ − x₀
    pub(super) fn runge_kutta<const M: usize>(&self, tableau: &Tableau) -> Option<Vector<S, N>>
    where
        D: Dynamics<S, N, M>,
    {
        let mut stages = zeros();
        let fields = if tableau.is_explicit() {
            let mut fields = zeros();
            for i in 0..tableau.stages() {
                stages[i] = self.weighted(tableau.a[i], &fields);
                fields[i] = self.field(tableau.c[i], &stages[i]);
            }
            fields
        } else {
            let (solved, factors) = self.solved(tableau)?;
            for (stage, solved) in stages.iter_mut().zip(&solved.0) {
                *stage = solved.map(S::from_f64);
            }
            for _ in 0..S::DERIVATIVES {
                let fields = self.fields(tableau, &stages);
                let stages = &mut stages[..tableau.stages()];
                let mut residual = Vec::with_capacity(tableau.stages() * N);
                for (row, stage) in tableau.a.iter().zip(&*stages) {
                    let right = self.weighted(row, &fields);
                    residual.extend((0..N).map(|i| right[i] - stage[i]));
                }
                factors.solve_over(&mut residual, S::from_f64);
                let entries = stages.iter_mut().flat_map(|stage| stage.iter_mut());
                for (entry, correction) in entries.zip(residual) {
                    *entry += correction;
                }
            }
            self.fields(tableau, &stages)
        };
        Some(self.weighted(tableau.b, &fields))
    }

    /// The stages over doubles, and the factors of I − τ aᵢⱼ Jⱼ.
    fn solved<const M: usize>(&self, tableau: &Tableau) -> Option<(Stages<N>, Factors<f64>)>
    where
        D: Dynamics<S, N, M>,
    {
        let dynamics = self.dynamics.over::<f64>();
        let (t0, x0, tau) = self.values();
        let step = Step {
            dynamics: &dynamics,
            t0,
            x0: &x0,
            tau,
        };
        let (mut prepared, mut statistics) = (Prepared::default(), Statistics::default());
        let predicted = Stages::on_tangent(tableau, &step);
        let stages = step.stages(tableau, predicted, &mut prepared, &mut statistics);
        let stages = stages.ok()?;
        let factors = step.factors_of_all(tableau, &stages)?;
        Some((stages, factors))
    }

    /// f at a stage.
    fn field<const M: usize>(&self, c: f64, stage: &Vector<S, N>) -> Vector<S, N>
    where
        D: Dynamics<S, N, M>,
    {
        let t = self.t0 + self.tau * S::from_f64(c);
        self.dynamics.vector_field(t, &self.end(stage))
    }

    /// f at every stage.
    fn fields<const M: usize>(&self, tableau: &Tableau, stages: &Each<S, N>) -> Each<S, N>
    where
        D: Dynamics<S, N, M>,
    {
        std::array::from_fn(|i| match tableau.c.get(i) {
            Some(&c) => self.field(c, &stages[i]),
            None => zero(),
        })
    }

    /// τ Σ wⱼ fⱼ
    fn weighted(&self, weights: &[f64], fields: &Each<S, N>) -> Vector<S, N> {
        let terms = weights.iter().zip(fields);
        terms.fold(zero(), |sum: Vector<S, N>, (&weight, field)| {
            let factor = self.tau * S::from_f64(weight);
            Vector::from_fn(|i, _| sum[i] + factor * field[i])
        })
    }
}

fn zero<S: Scalar, const N: usize>() -> Vector<S, N> {
    Vector::from_element(S::from_f64(0.0))
}

fn zeros<S: Scalar, const N: usize>() -> Each<S, N> {
    std::array::from_fn(|_| zero())
}
