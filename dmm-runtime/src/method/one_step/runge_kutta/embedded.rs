//! Runge–Kutta methods with an estimate of the error of a step.

use std::sync::OnceLock;

use nalgebra::{DMatrix, DVector};

use super::super::map::{Correction, OneStep, Step};
use super::tableau::Tableau;
use super::{Memory, RungeKutta, tableaux};
use crate::arithmetic::Scalar;
use crate::contract::{Dynamics, Vector};
use crate::method::{Statistics, StepFailure, Variation};

/// A [`RungeKutta`] method in steps by a tolerance: with it comes the estimate of the error of a
/// step.
///
/// | method | stages | order | error of a step, estimated by |
/// |---|---|---|---|
/// | [`dormand_prince`](Self::dormand_prince) | 6 | 5 | x̂₁ − x₁ = τ Σᵢ eᵢ f(xᵢ), of order 4, with the field at the end of the step |
/// | [`radau_iia::<3>`](Self::radau_iia) | 3 | 5 | (I − τγ₀J)⁻¹ τ (γ₀ f(t₀, x₀) + Σᵢ eᵢ f(xᵢ)), of order 3 |
/// | [`radau_iia::<5>`](Self::radau_iia) | 5 | 9 | the same, of order 5 |
///
/// 1/γ₀ is the real eigenvalue of A⁻¹, and e makes x̂₁ a quadrature formula of order s (Hairer &
/// Wanner, Solving Ordinary Differential Equations II, section IV.8; Dormand & Prince, J. Comput.
/// Appl. Math. 6, 1980). A component counts relative to the largest size that it has had, as in
/// [`Adaptive`](crate::Adaptive). The estimate is held at the tolerance; that of Radau IIA, whose order is about half
/// of the method's, at 0.1 tol^((s + 1)/2s). The first step is half as long as the Taylor
/// coefficients of the solution allow, the next one follows from the last two errors (Gustafsson,
/// ACM Trans. Math. Softw. 20, 1994). A step fails as those of [`RungeKutta`] do, after it was made
/// shorter in vain.
///
/// The stages of Radau IIA are solved for until what is left is 10⁻⁴ of the tolerance; those of a step to
/// an output or to a crossing are solved for to rounding. A Jacobian is kept from step to step as
/// long as the iteration converges fast. A step in which it does not converge is made shorter.
///
/// Interfaces are looked for on the dense output: for Radau IIA the polynomial of degree s through
/// the stages; for Dormand & Prince the polynomial of order 4 (Hairer, Nørsett & Wanner, the same I,
/// eq. II.6.12). They are met on the method itself, in a step that ends on them.
///
/// ```
/// use dmm_runtime::{EmbeddedRungeKutta, Integrator, pws};
///
/// pws! {
///     /// Van der Pol's oscillator, ε = 10⁻⁶.
///     pub system VanDerPol {
///         state x, y;
///         der(x) = y;
///         der(y) = ((1 - x^2) * y - x) / 1e-6;
///     }
/// }
///
/// let solution = Integrator::new(&VanDerPol {}, EmbeddedRungeKutta::radau_iia::<3>().tolerance(1e-6))
///     .initial(0.0, [2.0, 0.0])
///     .run_until(2.0)?;
/// let end = solution.last().ok_or("no solution")?;
/// assert!((end.x[0] - 1.706_167_732_170_5).abs() < 1e-4);
/// assert!(solution.statistics().steps < 1000);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Other methods have no estimate:
///
/// ```compile_fail
/// let method = dmm_runtime::EmbeddedRungeKutta::radau_iia::<4>();
/// ```
///
/// ```compile_fail
/// let method = dmm_runtime::RungeKutta::gauss_legendre::<2>().tolerance(1e-6);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct EmbeddedRungeKutta {
    pub(super) pair: &'static Pair,
}

/// A method with its estimate.
#[derive(Debug)]
pub(super) struct Pair {
    pub(super) tableau: &'static Tableau,
    pub(super) estimate: Estimate,
}

/// What an error estimate and a dense output are made of.
#[derive(Debug)]
pub(super) enum Estimate {
    /// Of an explicit method.
    Explicit {
        /// eᵢ of the stages and of the end of the step.
        weights: &'static [f64],
        /// Of each stage, the coefficients of θ, θ², … of its weight in the dense output.
        dense: &'static [[f64; 4]],
    },
    /// Of a collocation method, as soon as it is used.
    Collocation(OnceLock<Collocation>),
}

/// What is computed of the nodes of a collocation method.
#[derive(Debug)]
pub(super) struct Collocation {
    /// The number of the real eigenvalue of A⁻¹.
    pub(super) eigenvalue: usize,
    /// γ₀
    pub(super) gamma: f64,
    /// Of zᵢ in Σ eᵢ τ f(xᵢ).
    pub(super) weights: Vec<f64>,
    /// The coefficients of θ, θ², … of the polynomial through the stages, by rows.
    pub(super) powers: DMatrix<f64>,
}

impl Collocation {
    pub(super) fn new(tableau: &Tableau) -> Self {
        let s = tableau.stages();
        let values = tableau.transform().eigen.iter().map(|eigen| eigen.value);
        let real = values
            .enumerate()
            .min_by(|(_, v), (_, w)| v.im.total_cmp(&w.im));
        let (eigenvalue, gamma) = real.map_or((0, 0.0), |(k, value)| (k, 1.0 / value.re));
        let c = tableau.c;
        // Σ eᵢ cᵢᵏ⁻¹ = −γ₀ for k = 1, 0 for k = 2, …, s
        let vandermonde = DMatrix::from_fn(s, s, |k, i| c[i].powi(k as i32));
        let right = DVector::from_fn(s, |k, _| if k == 0 { -gamma } else { 0.0 });
        let e = vandermonde.lu().solve(&right).unwrap_or_default();
        // τ f(xⱼ) = Σ (A⁻¹)ⱼᵢ zᵢ
        let transposed = DMatrix::from_fn(s, s, |i, j| tableau.a[j][i]);
        let weights = transposed.lu().solve(&e).unwrap_or_default();
        let powers = DMatrix::from_fn(s, s, |i, k| c[i].powi(k as i32 + 1));
        Self {
            eigenvalue,
            gamma,
            weights: weights.iter().copied().collect(),
            powers: powers.try_inverse().unwrap_or_default(),
        }
    }
}

/// b̂ − b of Dormand & Prince.
const DORMAND_PRINCE_WEIGHTS: [f64; 7] = [
    -71.0 / 57600.0,
    0.0,
    71.0 / 16695.0,
    -71.0 / 1920.0,
    17253.0 / 339_200.0,
    -22.0 / 525.0,
    1.0 / 40.0,
];

/// bᵢ(θ) of their dense output (Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I,
/// eq. II.6.12).
const DORMAND_PRINCE_DENSE: [[f64; 4]; 6] = [
    [1.0, -1337.0 / 480.0, 1039.0 / 360.0, -1163.0 / 1152.0],
    [0.0; 4],
    times(
        100.0 / 3.0,
        [1054.0 / 9275.0, -4682.0 / 27825.0, 379.0 / 5565.0],
    ),
    times(-5.0 / 2.0, [27.0 / 40.0, -9.0 / 5.0, 83.0 / 96.0]),
    times(18225.0 / 848.0, [-3.0 / 250.0, 22.0 / 375.0, -37.0 / 600.0]),
    times(-22.0 / 7.0, [-3.0 / 10.0, 29.0 / 30.0, -17.0 / 24.0]),
];

/// Coefficients of θ², θ³ and θ⁴ times a factor.
const fn times(factor: f64, [second, third, fourth]: [f64; 3]) -> [f64; 4] {
    [0.0, factor * second, factor * third, factor * fourth]
}

static DORMAND_PRINCE: Pair = Pair {
    tableau: &tableaux::DORMAND_PRINCE,
    estimate: Estimate::Explicit {
        weights: &DORMAND_PRINCE_WEIGHTS,
        dense: &DORMAND_PRINCE_DENSE,
    },
};

static RADAU_IIA_3: Pair = Pair {
    tableau: &tableaux::RADAU_IIA_3,
    estimate: Estimate::Collocation(OnceLock::new()),
};

static RADAU_IIA_5: Pair = Pair {
    tableau: &tableaux::RADAU_IIA_5,
    estimate: Estimate::Collocation(OnceLock::new()),
};

impl EmbeddedRungeKutta {
    /// The pair of orders 5 and 4 of Dormand & Prince, explicit.
    pub const fn dormand_prince() -> Self {
        Self {
            pair: &DORMAND_PRINCE,
        }
    }

    /// Radau IIA collocation of 3 or 5 stages, of order 5 or 9: L-stable, for stiff regions.
    pub const fn radau_iia<const STAGES: usize>() -> Self {
        const {
            assert!(
                STAGES == 3 || STAGES == 5,
                "of Radau IIA methods, those of 3 and 5 stages have an error estimate"
            );
        }
        Self {
            pair: match STAGES {
                3 => &RADAU_IIA_3,
                _ => &RADAU_IIA_5,
            },
        }
    }

    /// Its steps.
    pub(super) fn method(&self) -> RungeKutta {
        RungeKutta {
            tableau: self.pair.tableau,
        }
    }
}

impl PartialEq for EmbeddedRungeKutta {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.pair, other.pair)
    }
}

impl OneStep for EmbeddedRungeKutta {
    type Memory<const N: usize> = Memory<N>;

    fn conserves(&self) -> bool {
        self.method().conserves()
    }

    fn has_exact_velocity(&self) -> bool {
        self.method().has_exact_velocity()
    }

    fn order(&self) -> usize {
        self.method().order()
    }

    fn begin<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        dynamics: &F,
        step_size: Option<f64>,
    ) -> Memory<N> {
        self.method().begin(dynamics, step_size)
    }

    #[inline(always)]
    fn correction_interval<const N: usize>(memory: &Memory<N>) -> u64 {
        RungeKutta::correction_interval(memory)
    }

    fn full_step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        memory: &mut Memory<N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        self.method().full_step(step, memory, statistics)
    }

    fn varied_step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        memory: &mut Memory<N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        self.method().varied_step(step, memory, statistics)
    }

    fn step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        self.method().step(step, statistics)
    }

    fn correction<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        increment: &Vector<f64, N>,
    ) -> Option<Correction<N>> {
        self.method().correction(step, increment)
    }

    fn differentiate<D, S, const N: usize, const M: usize>(
        &self,
        step: &Variation<'_, D, S, N>,
    ) -> Option<Vector<S, N>>
    where
        D: Dynamics<S, N, M>,
        S: Scalar,
    {
        self.method().differentiate::<D, S, N, M>(step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radau_of_three_stages_has_the_weights_of_the_book() {
        let collocation = Collocation::new(&tableaux::RADAU_IIA_3);
        let root = 6.0f64.sqrt();
        let expected = [-13.0 - 7.0 * root, -13.0 + 7.0 * root, -1.0];
        for (weight, expected) in collocation.weights.iter().zip(expected) {
            let error = weight - collocation.gamma / 3.0 * expected;
            assert!(error.abs() < 1e-13, "{error}");
        }
        // 1/γ₀ = 3 + 3^(2/3) − 3^(1/3)
        let inverse = 3.0 + 9.0f64.cbrt() - 3.0f64.cbrt();
        assert!((1.0 / collocation.gamma - inverse).abs() < 1e-13);
    }

    #[test]
    fn polynomials_lead_through_the_stages() {
        for tableau in [&tableaux::RADAU_IIA_3, &tableaux::RADAU_IIA_5] {
            let collocation = Collocation::new(tableau);
            assert!(tableau.transform().eigen[collocation.eigenvalue].value.im == 0.0);
            let s = tableau.stages();
            for (i, c) in tableau.c.iter().enumerate() {
                for j in 0..s {
                    let at = (0..s)
                        .rev()
                        .fold(0.0, |sum, k| (sum + collocation.powers[(k, j)]) * c);
                    let expected = f64::from(u8::from(i == j));
                    assert!((at - expected).abs() < 1e-12, "{at}");
                }
            }
        }
    }

    #[test]
    fn explicit_weights_meet_the_conditions_of_the_trees_of_their_order() {
        let tableau = &tableaux::DORMAND_PRINCE;
        let (a, c) = (tableau.a, tableau.c);
        let apply = |x: [f64; 6]| -> [f64; 6] {
            std::array::from_fn(|i| a[i].iter().zip(x).map(|(a, x)| a * x).sum())
        };
        let times = |x: [f64; 6], y: [f64; 6]| -> [f64; 6] { std::array::from_fn(|i| x[i] * y[i]) };
        let c: [f64; 6] = std::array::from_fn(|i| c[i]);
        let square = times(c, c);
        let trees = [
            (1, [1.0; 6], 1.0, 1.0),
            (2, c, 2.0, 1.0),
            (3, square, 3.0, 1.0),
            (3, apply(c), 6.0, 0.5),
            (4, times(square, c), 4.0, 1.0),
            (4, times(c, apply(c)), 8.0, 0.5),
            (4, apply(square), 12.0, 1.0 / 3.0),
            (4, apply(apply(c)), 24.0, 1.0 / 6.0),
        ];
        for (order, tree, density, at_end) in trees {
            // Σ bᵢ(θ) Φᵢ = θᵖ/γ
            for n in 0..=10 {
                let theta = f64::from(n) / 10.0;
                let weights = DORMAND_PRINCE_DENSE
                    .map(|b| b.iter().rev().fold(0.0, |sum, b| (sum + b) * theta));
                let sum: f64 = weights.iter().zip(tree).map(|(b, phi)| b * phi).sum();
                let error = sum - theta.powi(order) / density;
                assert!(error.abs() < 1e-12, "{order} {theta}: {error}");
            }
            // b̂ is of order 4, with the field at the end of the step
            let [stages @ .., last] = DORMAND_PRINCE_WEIGHTS;
            let sum: f64 = stages.iter().zip(tree).map(|(e, phi)| e * phi).sum();
            assert!((sum + last * at_end).abs() < 1e-15, "{order}");
        }
        for (dense, b) in DORMAND_PRINCE_DENSE.iter().zip(tableau.b) {
            assert!((dense.iter().sum::<f64>() - b).abs() < 1e-12);
        }
    }
}
