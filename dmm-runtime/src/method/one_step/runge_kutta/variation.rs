//! The derivatives of Runge–Kutta steps.

use nalgebra::DMatrix;

use super::super::map::Step;
use super::implicit::Prepared;
use super::stages::Stages;
use super::tableau::{MOST_STAGES, Tableau};
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
            let (solved, inverse) = self.solved(tableau)?;
            for (stage, solved) in stages.iter_mut().zip(&solved.0) {
                *stage = solved.map(S::from_f64);
            }
            for _ in 0..S::DERIVATIVES {
                let fields = self.fields(tableau, &stages);
                let residual: Each<S, N> = std::array::from_fn(|i| match tableau.a.get(i) {
                    Some(row) => difference(&self.weighted(row, &fields), &stages[i]),
                    None => zero(),
                });
                for k in 0..inverse.nrows() {
                    for j in 0..inverse.ncols() {
                        let entry = S::from_f64(inverse[(k, j)]) * residual[j / N][j % N];
                        stages[k / N][k % N] += entry;
                    }
                }
            }
            self.fields(tableau, &stages)
        };
        Some(self.weighted(tableau.b, &fields))
    }

    /// The stages over doubles, and (I − τ aᵢⱼ Jⱼ)⁻¹.
    fn solved<const M: usize>(&self, tableau: &Tableau) -> Option<(Stages<N>, DMatrix<f64>)>
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
        let inverse = step.matrix_of_all(tableau, &stages).try_inverse()?;
        Some((stages, inverse))
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

fn difference<S: Scalar, const N: usize>(a: &Vector<S, N>, b: &Vector<S, N>) -> Vector<S, N> {
    Vector::from_fn(|i, _| a[i] - b[i])
}
