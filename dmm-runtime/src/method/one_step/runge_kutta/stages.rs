//! The stages of a step.

use super::super::map::Step;
use super::tableau::{MOST_STAGES, Tableau};
use crate::contract::{Dynamics, Vector};

/// zᵢ = xᵢ − x₀; as many as the method has stages.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stages<const N: usize>(pub(super) [Vector<f64, N>; MOST_STAGES]);

impl<const N: usize> Stages<N> {
    /// `stage(i)` of each stage of a method.
    pub(super) fn each(tableau: &Tableau, mut stage: impl FnMut(usize) -> Vector<f64, N>) -> Self {
        let mut stages = [Vector::zeros(); MOST_STAGES];
        for (i, place) in stages.iter_mut().take(tableau.stages()).enumerate() {
            *place = stage(i);
        }
        Self(stages)
    }

    /// Of the solution's tangent at the start of the step.
    pub(super) fn on_tangent<F, const M: usize>(tableau: &Tableau, step: &Step<'_, F, N>) -> Self
    where
        F: Dynamics<f64, N, M>,
    {
        let tangent = step.dynamics.vector_field(step.t0, step.x0) * step.tau;
        Self::each(tableau, |i| tangent * tableau.c[i])
    }

    /// Those of a step `ratio` times as long after this one, on the polynomial through its start and
    /// its stages.
    pub(super) fn continued(&self, tableau: &Tableau, ratio: f64) -> Self {
        let end = self.at(tableau, 1.0);
        Self::each(tableau, |i| {
            self.at(tableau, 1.0 + tableau.c[i] * ratio) - end
        })
    }

    /// The polynomial at a part of the step.
    fn at(&self, tableau: &Tableau, part: f64) -> Vector<f64, N> {
        let nodes = tableau.c;
        let mut sum = Vector::zeros();
        for (i, &own) in nodes.iter().enumerate().filter(|(_, node)| **node != 0.0) {
            let others = nodes
                .iter()
                .enumerate()
                .filter(|&(j, node)| j != i && *node != 0.0);
            let others = others.map(|(_, node)| (part - node) / (own - node));
            sum += self.0[i] * (others.product::<f64>() * part / own);
        }
        sum
    }

    /// f at each stage.
    pub(super) fn fields<F, const M: usize>(&self, tableau: &Tableau, step: &Step<'_, F, N>) -> Self
    where
        F: Dynamics<f64, N, M>,
    {
        Self::each(tableau, |i| {
            let t = step.t0 + tableau.c[i] * step.tau;
            step.dynamics.vector_field(t, &(step.x0 + self.0[i]))
        })
    }

    /// τ Σⱼ aᵢⱼ f(xⱼ) − zᵢ, which are zero for the stages of the step.
    pub(super) fn residual<F, const M: usize>(
        &self,
        tableau: &Tableau,
        step: &Step<'_, F, N>,
    ) -> Self
    where
        F: Dynamics<f64, N, M>,
    {
        let fields = self.fields(tableau, step);
        Self::each(tableau, |i| {
            let terms = tableau.a[i].iter().zip(&fields.0);
            let sum = terms.fold(Vector::zeros(), |sum, (&a, field)| sum + field * a);
            sum * step.tau - self.0[i]
        })
    }

    /// x₁ − x₀
    pub(super) fn increment<F, const M: usize>(
        &self,
        tableau: &Tableau,
        step: &Step<'_, F, N>,
    ) -> Vector<f64, N>
    where
        F: Dynamics<f64, N, M>,
    {
        if tableau.ends_in_stage() {
            return self.0[tableau.stages() - 1];
        }
        let fields = self.fields(tableau, step);
        let terms = tableau.b.iter().zip(&fields.0);
        terms.fold(Vector::zeros(), |sum, (&b, field)| sum + field * b) * step.tau
    }

    /// The largest component over all stages, each relative to `scale`.
    pub(super) fn relative(&self, scale: &Vector<f64, N>) -> f64 {
        let mut largest = 0.0f64;
        for stage in &self.0 {
            for (entry, scale) in stage.iter().zip(scale) {
                let part = if *entry == 0.0 {
                    0.0
                } else {
                    entry.abs() / scale
                };
                // a NaN must not be lost
                if part > largest || part.is_nan() {
                    largest = part;
                }
            }
        }
        largest
    }

    /// The largest size of each component over all stages.
    pub(super) fn sizes(&self) -> Vector<f64, N> {
        let largest = |sizes: Vector<f64, N>, stage: &Vector<f64, N>| sizes.sup(&stage.abs());
        self.0.iter().fold(Vector::zeros(), largest)
    }

    /// Adds others.
    pub(super) fn add(&mut self, others: &Self) {
        for (stage, other) in self.0.iter_mut().zip(&others.0) {
            *stage += other;
        }
    }
}
