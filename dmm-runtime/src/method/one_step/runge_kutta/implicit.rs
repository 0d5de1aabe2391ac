//! The stages of an implicit method: zᵢ = τ Σⱼ aᵢⱼ f(t₀ + cⱼτ, x₀ + zⱼ).
//!
//! Newton's method with one Jacobian J for all stages, (I − τA⊗J) Δz = r with the residual r, falls
//! on the eigenvectors of A⁻¹ into systems of the size of the state, (I − τ/λₖ J) Δwₖ = (T⁻¹r)ₖ
//! (Hairer & Wanner, Solving Ordinary Differential Equations II, eq. IV.8.4). The factors are kept
//! as long as the step size is the same and the iteration is fast, the Jacobian where the step size
//! changes as well. Where it does not converge, all stages are solved for together with their own
//! Jacobians and damping.

use nalgebra::Complex;

use super::super::map::Step;
use super::stages::Stages;
use super::tableau::Tableau;
use crate::arithmetic::factors::Factors;
use crate::arithmetic::linear::is_finite;
use crate::contract::{Dynamics, Vector};
use crate::method::{Statistics, StepFailure};

/// Iterations before an iteration is given up.
const MOST_ITERATIONS: u64 = 60;
/// Halvings of a damped correction before it is given up.
const MOST_HALVINGS: u32 = 12;
/// A correction that leaves less than this part of the stages is the last: half a rounding error.
const CONVERGED: f64 = 0.5 * f64::EPSILON;
/// Where a component of the stages passes through zero, its correction is measured against this
/// part of the state.
const SHARE_OF_STATE: f64 = 2.441_406_25e-4; // 2⁻¹²
/// Corrections that fall off more slowly than this ask for another Jacobian.
const SLOW: f64 = 0.25;
/// Those that fall off faster keep it for the next step.
const FAST: f64 = 0.03;
/// Corrections by a Jacobian at the solution that do not fall off, and are below this part of the
/// state, are rounding errors.
const ROUNDING: f64 = 1e-10;
/// Corrections that do not fall off, and are below this part of the sizes that errors are measured
/// against, are rounding errors.
const NOISE: f64 = 64.0 * f64::EPSILON;
/// Iterations before a step that may be made shorter is given up.
const FEW_ITERATIONS: u64 = 20;
/// Step sizes that differ by less than this part have the same matrices.
const SAME: f64 = 1e-9;

/// What the corrections of an iteration are measured against.
#[derive(Clone, Copy, Debug)]
pub(super) enum Against<'a, const N: usize> {
    /// The stages: to the rounding errors of the increment.
    Stages,
    /// These sizes of the components, or the stages where they are larger: to this part of them, in a
    /// step that may be made shorter instead.
    Sizes(&'a Vector<f64, N>, f64),
}

/// The matrices I − τ/λₖ J of a step size, factored.
#[derive(Clone, Debug, Default)]
pub(super) struct Prepared {
    tau: f64,
    /// J, by columns.
    jacobian: Vec<f64>,
    /// Whether the next step is to have another Jacobian.
    is_stale: bool,
    by_eigenvalue: Vec<Factors<Complex<f64>>>,
    work: Vec<Complex<f64>>,
}

impl Prepared {
    /// With the Jacobian in the middle of `stages`; nothing if a matrix is singular.
    fn renew<F, const N: usize, const M: usize>(
        &mut self,
        tableau: &Tableau,
        step: &Step<'_, F, N>,
        stages: &Stages<N>,
    ) -> Option<()>
    where
        F: Dynamics<f64, N, M>,
    {
        let share = 1.0 / tableau.stages() as f64;
        let middle = stages
            .0
            .iter()
            .fold(Vector::zeros(), |sum, z| sum + z * share);
        let time = tableau.c.iter().sum::<f64>() * share * step.tau + step.t0;
        let jacobian = step.dynamics.jacobian(time, &(step.x0 + middle));
        self.jacobian.clear();
        self.jacobian.extend(jacobian.iter());
        self.is_stale = false;
        self.factor::<N>(tableau, step.tau)
    }

    /// With the Jacobian that there is, for steps over `tau`.
    fn factor<const N: usize>(&mut self, tableau: &Tableau, tau: f64) -> Option<()> {
        let jacobian = &self.jacobian;
        let eigen = &tableau.transform().eigen;
        // of no step, if a matrix is singular
        self.tau = 0.0;
        self.work.resize(N, Complex::default());
        self.by_eigenvalue
            .resize_with(eigen.len(), Factors::default);
        for (eigen, factors) in eigen.iter().zip(&mut self.by_eigenvalue) {
            let factor = -tau / eigen.value;
            let entry = |i, j| factor * jacobian[i + N * j] + f64::from(u8::from(i == j));
            factors.renew(N, (0..N).flat_map(|j| (0..N).map(move |i| entry(i, j))))?;
        }
        self.tau = tau;
        Some(())
    }

    /// (I − τA⊗J)⁻¹ r
    fn solve<const N: usize>(&mut self, tableau: &Tableau, residual: &Stages<N>) -> Stages<N> {
        let mut solution = Stages::each(tableau, |_| Vector::zeros());
        for (eigen, factors) in tableau.transform().eigen.iter().zip(&self.by_eigenvalue) {
            self.work.fill(Complex::default());
            for (&weight, stage) in eigen.row.iter().zip(&residual.0) {
                for (entry, &value) in self.work.iter_mut().zip(stage) {
                    *entry += weight * value;
                }
            }
            factors.solve(&mut self.work);
            for (&weight, stage) in eigen.vector.iter().zip(&mut solution.0) {
                let part = |k: usize| (weight * self.work[k]).re;
                *stage += Vector::from_fn(|k, _| part(k));
            }
        }
        solution
    }

    /// (I − τ/λ J)⁻¹ v for the eigenvalue of this number, which is real; nothing if there are no
    /// matrices.
    pub(super) fn filter<const N: usize>(
        &mut self,
        eigenvalue: usize,
        vector: &Vector<f64, N>,
    ) -> Option<Vector<f64, N>> {
        let factors = self.by_eigenvalue.get(eigenvalue)?;
        for (entry, &value) in self.work.iter_mut().zip(vector) {
            *entry = Complex::from(value);
        }
        factors.solve(&mut self.work);
        Some(Vector::from_fn(|k, _| self.work[k].re))
    }

    /// Asks for another Jacobian in the next step.
    pub(super) fn forget(&mut self) {
        self.is_stale = true;
    }

    /// Whether the Jacobian is good for another step.
    pub(super) fn is_good(&self) -> bool {
        !self.is_stale && !self.jacobian.is_empty()
    }

    /// Makes the matrices of a step, if they are not there: whether the Jacobian is of this step;
    /// nothing if a matrix is singular.
    #[inline]
    fn fit<F, const N: usize, const M: usize>(
        &mut self,
        tableau: &Tableau,
        step: &Step<'_, F, N>,
        stages: &Stages<N>,
    ) -> Option<bool>
    where
        F: Dynamics<f64, N, M>,
    {
        if !self.is_good() {
            self.renew(tableau, step, stages)?;
            return Some(true);
        }
        if (self.tau - step.tau).abs() > SAME * step.tau {
            self.factor::<N>(tableau, step.tau)?;
        }
        Some(false)
    }
}

impl<F, const N: usize> Step<'_, F, N> {
    /// The stages of an implicit method, from predicted ones.
    pub(super) fn stages<const M: usize>(
        &self,
        tableau: &Tableau,
        predicted: Stages<N>,
        prepared: &mut Prepared,
        statistics: &mut Statistics,
    ) -> Result<Stages<N>, StepFailure>
    where
        F: Dynamics<f64, N, M>,
    {
        match self.iterate(tableau, predicted, prepared, Against::Stages, statistics) {
            Some(stages) => Ok(stages),
            None => {
                prepared.forget();
                self.damped(tableau, statistics)
            }
        }
    }

    /// Newton's method with one Jacobian for all stages; nothing if it does not converge.
    pub(super) fn iterate<const M: usize>(
        &self,
        tableau: &Tableau,
        mut stages: Stages<N>,
        prepared: &mut Prepared,
        against: Against<'_, N>,
        statistics: &mut Statistics,
    ) -> Option<Stages<N>>
    where
        F: Dynamics<f64, N, M>,
    {
        let mut is_new = prepared.fit(tableau, self, &stages)?;
        let mut before = f64::INFINITY;
        let (most, converged) = match against {
            Against::Stages => (MOST_ITERATIONS, CONVERGED),
            Against::Sizes(_, part) => (FEW_ITERATIONS, part.max(CONVERGED)),
        };
        for _ in 0..most {
            let residual = stages.residual(tableau, self);
            statistics.newton_iterations += 1;
            let correction = prepared.solve(tableau, &residual);
            stages.add(&correction);
            let scale = match against {
                Against::Stages => stages.sizes() + self.x0.abs() * SHARE_OF_STATE,
                Against::Sizes(sizes, _) => stages.sizes().sup(sizes),
            };
            let size = correction.relative(&scale);
            let rate = size / before;
            // the corrections that follow add up to size·rate/(1 − rate)
            let is_known = before < f64::INFINITY;
            if size <= converged || is_known && size * rate <= converged * (1.0 - rate) {
                if is_known && rate > FAST {
                    prepared.forget();
                }
                return Some(stages);
            }
            if !size.is_finite() {
                return None;
            }
            if rate > SLOW {
                if size <= NOISE && matches!(against, Against::Sizes(..)) {
                    return Some(stages);
                }
                let state = stages.sizes() + self.x0.abs();
                if is_new && correction.relative(&state) <= ROUNDING {
                    return Some(stages);
                }
                if is_new && rate > 1.0 {
                    return None;
                }
                prepared.renew(tableau, self, &stages)?;
                is_new = true;
                before = f64::INFINITY;
                continue;
            }
            before = size;
        }
        None
    }

    /// Newton's method for all stages together, with halved corrections until the residual falls,
    /// from the start of the step.
    #[cold]
    fn damped<const M: usize>(
        &self,
        tableau: &Tableau,
        statistics: &mut Statistics,
    ) -> Result<Stages<N>, StepFailure>
    where
        F: Dynamics<f64, N, M>,
    {
        let mut stages = Stages::on_tangent(tableau, self);
        let mut residual = stages.residual(tableau, self);
        let mut iterations = 0;
        while iterations < MOST_ITERATIONS {
            iterations += 1;
            statistics.newton_iterations += 1;
            if !residual.0.iter().all(is_finite) {
                return Err(StepFailure::NotFinite);
            }
            let Some(correction) = self.correction_of_all(tableau, &stages, &residual) else {
                break;
            };
            let state = stages.sizes() + self.x0.abs();
            let size = correction.relative(&(stages.sizes() + self.x0.abs() * SHARE_OF_STATE));
            let norm = residual.relative(&state);
            let mut share = 1.0;
            let accepted = (0..MOST_HALVINGS).find_map(|_| {
                let mut trial = stages;
                trial.add(&Stages::each(tableau, |i| correction.0[i] * share));
                share *= 0.5;
                let residual = trial.residual(tableau, self);
                (residual.relative(&state) < norm).then_some((trial, residual))
            });
            match accepted {
                // the next one would be of the order of its square
                Some((trial, _)) if size * size <= CONVERGED && share == 0.5 => return Ok(trial),
                Some((trial, next)) => (stages, residual) = (trial, next),
                None if correction.relative(&state) <= ROUNDING => return Ok(stages),
                None => break,
            }
        }
        let sizes = residual.sizes();
        Err(StepFailure::NoConvergence {
            residual: sizes.amax(),
            iterations,
        })
    }

    /// (I − τ aᵢⱼ Jⱼ)⁻¹ r
    fn correction_of_all<const M: usize>(
        &self,
        tableau: &Tableau,
        stages: &Stages<N>,
        residual: &Stages<N>,
    ) -> Option<Stages<N>>
    where
        F: Dynamics<f64, N, M>,
    {
        let factors = self.factors_of_all(tableau, stages)?;
        let mut solution: Vec<f64> = residual.0[..tableau.stages()]
            .iter()
            .flat_map(|stage| stage.iter().copied())
            .collect();
        factors.solve(&mut solution);
        Some(Stages::each(tableau, |i| {
            Vector::from_fn(|k, _| solution[i * N + k])
        }))
    }

    /// Those of I − τ aᵢⱼ Jⱼ, with the Jacobian of each stage.
    pub(super) fn factors_of_all<const M: usize>(
        &self,
        tableau: &Tableau,
        stages: &Stages<N>,
    ) -> Option<Factors<f64>>
    where
        F: Dynamics<f64, N, M>,
    {
        let size = tableau.stages() * N;
        let mut matrix = Vec::with_capacity(size * size);
        for (j, &c) in tableau.c.iter().enumerate() {
            let t = self.t0 + c * self.tau;
            let jacobian = self.dynamics.jacobian(t, &(self.x0 + stages.0[j]));
            for part in jacobian.column_iter() {
                for row in tableau.a {
                    let factor = -self.tau * row[j];
                    matrix.extend(part.iter().map(|entry| factor * entry));
                }
                let column = matrix.len() / size - 1;
                matrix[column * size + column] += 1.0;
            }
        }
        Factors::new(size, matrix)
    }
}
