//! Runge–Kutta methods, explicit and implicit.

mod controlled;
mod embedded;
mod implicit;
mod stages;
mod tableau;
mod tableaux;
mod transform;
mod variation;

use super::map::{Correction, OneStep, Step};
use super::uniform::Uniform;
use crate::arithmetic::Scalar;
use crate::arithmetic::linear::is_finite;
use crate::contract::{Dynamics, Vector};
use crate::method::{Statistics, StepFailure, Variation};
pub use controlled::ErrorEstimate;
pub use embedded::EmbeddedRungeKutta;
use implicit::Prepared;
use stages::Stages;
use tableau::Tableau;

/// A Runge–Kutta method of s stages,
///
/// xᵢ = x₀ + τ Σⱼ aᵢⱼ f(t₀ + cⱼτ, xⱼ), x₁ = x₀ + τ Σᵢ bᵢ f(t₀ + cᵢτ, xᵢ),
///
/// in uniform steps; [`EmbeddedRungeKutta`] makes steps by a tolerance (Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I, eq.
/// II.1.8).
///
/// | family | stages | order |
/// |---|---|---|
/// | [`explicit`](Self::explicit) | 1 to 4 | 1 to 4 |
/// | [`dormand_prince`](Self::dormand_prince) | 6 | 5 |
/// | [`gauss_legendre`](Self::gauss_legendre) | s = 1 to 4 | 2s |
/// | [`radau_iia`](Self::radau_iia) | s = 1 to 5 | 2s − 1 |
/// | [`lobatto_iiic`](Self::lobatto_iiic) | s = 2 to 4 | 2s − 2 |
///
/// A step that meets an interface ends on it: its size is solved for together with the state, so
/// that the order of the method survives every switch (Nurkanović, Sperl, Albrecht & Diehl, Numer.
/// Math. 156, 2024, theorem 17). On sliding arcs the field is the mean that keeps the solution on
/// the interface, whose conserved quantities are the switching functions; the order there is that of
/// the method for every family, because nothing algebraic is left to be solved for.
///
/// The objects of that paper are found here as follows:
///
/// | there | here |
/// |---|---|
/// | regions Rᵢ of sign patterns of c (eq. 12), g = −S c (eq. 13) | [`Metadata::regions`](crate::Metadata::regions) and their sides; g is not needed |
/// | θ | 1 for the region; on a sliding arc the weights that the compiler solves for |
/// | λ = g − μ, μ = min g | 0 for the region, positive for the others |
/// | the sliding motion (eq. 14), of index 2 | the mean field, with the switching functions among ψ |
/// | the next active set (eqs 17–18) | every side of each interface, or a slide on it, tried against the fields there: none or several is an error |
/// | cross complementarity (eq. 28) | a step has one region, and ends where it is left |
/// | step equilibration (eq. 31) | steps of one size, but for those to and from a switch |
///
/// None of them conserves ψ but for affine quantities, and `gauss_legendre` quadratic ones. The
/// correction of the level that [`Uniform`] makes after each step (default: yes) does: with it ψ is
/// kept as by any other scheme.
///
/// The stages of an implicit method are solved for to rounding, by Newton's method with one
/// Jacobian ∂f/∂x for all of them, on the eigenvectors of A⁻¹ (Hairer & Wanner, Solving Ordinary
/// Differential Equations II, section IV.8). Radau IIA and Lobatto IIIC are L-stable: they are the
/// ones for stiff regions.
///
/// ```
/// use dmm_runtime::{Integrator, RungeKutta, pws};
///
/// pws! {
///     /// A relay that turns a spring's end.
///     pub system Relay {
///         state x, v;
///         interface middle = x;
///         der(x) = v;
///         region right where middle > 0 { der(v) = -1 - x; }
///         region left where middle < 0 { der(v) = 1 - x; }
///     }
/// }
///
/// let until = |step_size| {
///     Integrator::new(&Relay {}, RungeKutta::radau_iia::<3>().step_size(step_size))
///         .initial(0.0, [0.0, 1.0])
///         .run_until(10.0)
/// };
/// let (coarse, fine) = (until(0.1)?, until(0.05)?);
/// assert_eq!(coarse.transitions().len(), fine.transitions().len());
/// assert!((coarse.at(10.0)? - fine.at(10.0)?).norm() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// There are no others:
///
/// ```compile_fail
/// let method = dmm_runtime::RungeKutta::lobatto_iiic::<1>();
/// ```
#[derive(Clone, Copy, Debug)]
pub struct RungeKutta {
    tableau: &'static Tableau,
}

impl RungeKutta {
    /// Euler's method, the explicit midpoint rule, Heun's method of order 3, and the classical
    /// method of order 4.
    pub const fn explicit<const ORDER: usize>() -> Self {
        const {
            assert!(
                1 <= ORDER && ORDER <= 4,
                "explicit methods have order 1 to 4"
            );
        }
        Self {
            tableau: match ORDER {
                1 => &tableaux::EULER,
                2 => &tableaux::MIDPOINT,
                3 => &tableaux::HEUN,
                _ => &tableaux::CLASSICAL,
            },
        }
    }

    /// The method of order 5 of Dormand & Prince (J. Comput. Appl. Math. 6, 1980).
    pub const fn dormand_prince() -> Self {
        Self {
            tableau: &tableaux::DORMAND_PRINCE,
        }
    }

    /// Gauss–Legendre collocation, of order 2s: symmetric and A-stable.
    pub const fn gauss_legendre<const STAGES: usize>() -> Self {
        const {
            assert!(
                1 <= STAGES && STAGES <= 4,
                "Gauss-Legendre methods have 1 to 4 stages"
            );
        }
        Self {
            tableau: match STAGES {
                1 => &tableaux::GAUSS_LEGENDRE_1,
                2 => &tableaux::GAUSS_LEGENDRE_2,
                3 => &tableaux::GAUSS_LEGENDRE_3,
                _ => &tableaux::GAUSS_LEGENDRE_4,
            },
        }
    }

    /// Radau IIA collocation, of order 2s − 1: L-stable.
    pub const fn radau_iia<const STAGES: usize>() -> Self {
        const {
            assert!(
                1 <= STAGES && STAGES <= 5,
                "Radau IIA methods have 1 to 5 stages"
            );
        }
        Self {
            tableau: match STAGES {
                1 => &tableaux::RADAU_IIA_1,
                2 => &tableaux::RADAU_IIA_2,
                3 => &tableaux::RADAU_IIA_3,
                4 => &tableaux::RADAU_IIA_4,
                _ => &tableaux::RADAU_IIA_5,
            },
        }
    }

    /// Lobatto IIIC methods, of order 2s − 2: L-stable.
    pub const fn lobatto_iiic<const STAGES: usize>() -> Self {
        const {
            assert!(
                2 <= STAGES && STAGES <= 4,
                "Lobatto IIIC methods have 2 to 4 stages"
            );
        }
        Self {
            tableau: match STAGES {
                2 => &tableaux::LOBATTO_IIIC_2,
                3 => &tableaux::LOBATTO_IIIC_3,
                _ => &tableaux::LOBATTO_IIIC_4,
            },
        }
    }

    /// The coefficients aᵢⱼ (by rows of length s, zero where a stage does not depend on another), bᵢ
    /// and cᵢ.
    ///
    /// ```
    /// use dmm_runtime::RungeKutta;
    ///
    /// let (a, b, c) = RungeKutta::explicit::<2>().coefficients();
    /// assert_eq!(a, [[0.0, 0.0], [0.5, 0.0]]);
    /// assert_eq!((b, c), (&[0.0, 1.0][..], &[0.0, 0.5][..]));
    /// ```
    pub fn coefficients(&self) -> (Vec<Vec<f64>>, &'static [f64], &'static [f64]) {
        let Tableau { a, b, c, .. } = self.tableau;
        let entry = |row: &[f64], j| row.get(j).copied().unwrap_or_default();
        let row = |row: &&[f64]| (0..b.len()).map(|j| entry(row, j)).collect();
        (a.iter().map(row).collect(), b, c)
    }

    /// Uniform steps of `step_size` (in the unit of time), which must be positive and finite;
    /// the integrator refuses others.
    pub fn step_size(self, step_size: f64) -> Uniform<Self> {
        Uniform::new(self, step_size)
    }
}

impl PartialEq for RungeKutta {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.tableau, other.tableau)
    }
}

/// What [`RungeKutta`] remembers within a segment.
#[derive(Clone, Debug)]
pub struct Memory<const N: usize> {
    prepared: Prepared,
    /// The stages of the step before, and its size.
    before: Option<(Stages<N>, f64)>,
}

impl OneStep for RungeKutta {
    type Memory<const N: usize> = Memory<N>;

    #[inline(always)]
    fn conserves(&self) -> bool {
        false
    }

    #[inline(always)]
    fn has_exact_velocity(&self) -> bool {
        false
    }

    fn order(&self) -> usize {
        self.tableau.order
    }

    fn begin<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        _dynamics: &F,
        _step_size: Option<f64>,
    ) -> Memory<N> {
        Memory {
            prepared: Prepared::default(),
            before: None,
        }
    }

    #[inline(always)]
    fn correction_interval<const N: usize>(_memory: &Memory<N>) -> u64 {
        1
    }

    fn full_step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        memory: &mut Memory<N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        if self.tableau.is_explicit() {
            return self.step(step, statistics);
        }
        let predicted = match &memory.before {
            Some((stages, tau)) => stages.continued(self.tableau, step.tau / tau),
            None => Stages::on_tangent(self.tableau, step),
        };
        let stages = step.stages(self.tableau, predicted, &mut memory.prepared, statistics)?;
        let increment = stages.increment(self.tableau, step);
        memory.before = Some((stages, step.tau));
        finite(increment)
    }

    fn varied_step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        memory: &mut Memory<N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        self.full_step(step, memory, statistics)
    }

    fn step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        if self.tableau.is_explicit() {
            return finite(step.explicit(self.tableau).0);
        }
        let predicted = Stages::on_tangent(self.tableau, step);
        let stages = step.stages(
            self.tableau,
            predicted,
            &mut Prepared::default(),
            statistics,
        )?;
        finite(stages.increment(self.tableau, step))
    }

    /// The velocity is that of the field at the end, off by O(τᵖ): the locator's iteration converges
    /// linearly with that factor, to the same point.
    fn correction<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        increment: &Vector<f64, N>,
    ) -> Option<Correction<N>> {
        let solved = self.step(step, &mut Statistics::default()).ok()?;
        Some(Correction {
            delta: solved - increment,
            velocity: (step.dynamics).vector_field(step.t0 + step.tau, &(step.x0 + solved)),
        })
    }

    fn differentiate<D, S, const N: usize, const M: usize>(
        &self,
        step: &Variation<'_, D, S, N>,
    ) -> Option<Vector<S, N>>
    where
        D: Dynamics<S, N, M>,
        S: Scalar,
    {
        step.runge_kutta::<M>(self.tableau)
    }
}

impl<F, const N: usize> Step<'_, F, N> {
    /// The increment of an explicit method, and the fields at its stages.
    fn explicit<const M: usize>(
        &self,
        tableau: &Tableau,
    ) -> (Vector<f64, N>, [Vector<f64, N>; tableau::MOST_STAGES])
    where
        F: Dynamics<f64, N, M>,
    {
        let mut fields = [Vector::zeros(); tableau::MOST_STAGES];
        let mut increment = Vector::zeros();
        for (i, (row, (&b, &c))) in tableau
            .a
            .iter()
            .zip(tableau.b.iter().zip(tableau.c))
            .enumerate()
        {
            let mut stage = *self.x0;
            for (&a, field) in row.iter().zip(&fields) {
                stage += field * (a * self.tau);
            }
            fields[i] = self.dynamics.vector_field(self.t0 + c * self.tau, &stage);
            increment += fields[i] * (b * self.tau);
        }
        (increment, fields)
    }
}

fn finite<const N: usize>(increment: Vector<f64, N>) -> Result<Vector<f64, N>, StepFailure> {
    if is_finite(&increment) {
        Ok(increment)
    } else {
        Err(StepFailure::NotFinite)
    }
}
