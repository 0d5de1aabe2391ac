//! Coefficients of a Runge–Kutta method.

use std::sync::OnceLock;

use super::transform::Transform;

/// Stages of the largest method.
pub(super) const MOST_STAGES: usize = 7;

/// The coefficients aᵢⱼ, bᵢ and cᵢ of a method
///
/// xᵢ = x₀ + τ Σⱼ aᵢⱼ f(t₀ + cⱼτ, xⱼ), x₁ = x₀ + τ Σᵢ bᵢ f(t₀ + cᵢτ, xᵢ).
#[derive(Debug)]
pub(super) struct Tableau {
    /// p
    pub(super) order: usize,
    /// By rows; those of an explicit method end in front of the diagonal.
    pub(super) a: &'static [&'static [f64]],
    pub(super) b: &'static [f64],
    pub(super) c: &'static [f64],
    /// Of an implicit method, as soon as it is used.
    pub(super) transform: OnceLock<Transform>,
}

impl Tableau {
    /// s
    pub(super) fn stages(&self) -> usize {
        self.b.len()
    }

    /// Whether each stage depends on those before it alone.
    pub(super) fn is_explicit(&self) -> bool {
        self.a.first().is_none_or(|row| row.is_empty())
    }

    /// Whether the last stage is the end of the step.
    pub(super) fn ends_in_stage(&self) -> bool {
        self.a.last() == Some(&self.b)
    }

    /// A⁻¹ on its eigenvectors.
    pub(super) fn transform(&self) -> &Transform {
        self.transform.get_or_init(|| Transform::new(self.a))
    }
}

#[cfg(test)]
mod tests {
    use super::super::tableaux::*;
    use super::*;

    /// aᵢⱼ, zero where it is not written.
    fn entry(tableau: &Tableau, i: usize, j: usize) -> f64 {
        tableau.a[i].get(j).copied().unwrap_or_default()
    }

    /// Σᵢ bᵢ cᵢᵏ⁻¹ − 1/k, the quadrature condition B(k).
    fn quadrature(tableau: &Tableau, k: i32) -> f64 {
        let terms = tableau.b.iter().zip(tableau.c);
        terms.map(|(b, c)| b * c.powi(k - 1)).sum::<f64>() - 1.0 / f64::from(k)
    }

    /// The largest Σⱼ aᵢⱼ cⱼᵏ⁻¹ − cᵢᵏ/k, the condition C(k).
    fn stage_order(tableau: &Tableau, k: i32) -> f64 {
        let rows = tableau.c.iter().enumerate().map(|(i, c)| {
            let terms = tableau.c.iter().enumerate();
            let sum: f64 = terms
                .map(|(j, cj)| entry(tableau, i, j) * cj.powi(k - 1))
                .sum();
            (sum - c.powi(k) / f64::from(k)).abs()
        });
        rows.fold(0.0, f64::max)
    }

    /// The largest Σᵢ bᵢ cᵢᵏ⁻¹ aᵢⱼ − bⱼ (1 − cⱼᵏ)/k, the condition D(k).
    fn adjoint(tableau: &Tableau, k: i32) -> f64 {
        let columns = tableau.c.iter().enumerate().map(|(j, c)| {
            let terms = tableau.b.iter().zip(tableau.c).enumerate();
            let terms = terms.map(|(i, (b, c))| b * c.powi(k - 1) * entry(tableau, i, j));
            (terms.sum::<f64>() - tableau.b[j] * (1.0 - c.powi(k)) / f64::from(k)).abs()
        });
        columns.fold(0.0, f64::max)
    }

    /// B(p), C(η) and D(ζ), of which the order p follows if p ≤ η + ζ + 1 and p ≤ 2η + 2 (Butcher
    /// 1964; Hairer, Nørsett & Wanner, theorem II.7.4), to the rounding errors of the coefficients.
    fn assert_conditions(tableau: &Tableau, eta: i32, zeta: i32) {
        const ROUNDING: f64 = 4.0 * f64::EPSILON;
        let order = i32::try_from(tableau.order).expect("small");
        assert!(order <= eta + zeta + 1 && order <= 2 * eta + 2);
        for k in 1..=order {
            assert!(
                quadrature(tableau, k).abs() < ROUNDING,
                "{tableau:?} B({k})"
            );
        }
        for k in 1..=eta {
            assert!(stage_order(tableau, k) < ROUNDING, "{tableau:?} C({k})");
        }
        for k in 1..=zeta {
            assert!(adjoint(tableau, k) < ROUNDING, "{tableau:?} D({k})");
        }
        // and no more
        assert!(quadrature(tableau, order + 1).abs() > 1e-9, "{tableau:?}");
    }

    #[test]
    fn implicit_methods_meet_their_conditions() {
        let gauss = [
            &GAUSS_LEGENDRE_1,
            &GAUSS_LEGENDRE_2,
            &GAUSS_LEGENDRE_3,
            &GAUSS_LEGENDRE_4,
        ];
        for (s, tableau) in (1..).zip(gauss) {
            assert_conditions(tableau, s, s);
        }
        let radau = [
            &RADAU_IIA_1,
            &RADAU_IIA_2,
            &RADAU_IIA_3,
            &RADAU_IIA_4,
            &RADAU_IIA_5,
        ];
        for (s, tableau) in (1..).zip(radau) {
            assert_conditions(tableau, s, s - 1);
            assert!(tableau.ends_in_stage());
        }
        for (s, tableau) in (2..).zip([&LOBATTO_IIIC_2, &LOBATTO_IIIC_3, &LOBATTO_IIIC_4]) {
            assert_conditions(tableau, s - 1, s - 1);
            assert!(tableau.ends_in_stage());
        }
    }

    /// Σ b Φ(tree) − 1/γ(tree) of every rooted tree up to order 5 (Hairer, Nørsett & Wanner, table
    /// II.2.1).
    fn trees(tableau: &Tableau) -> Vec<(usize, f64)> {
        let s = tableau.stages();
        let times =
            |x: &[f64], y: &[f64]| -> Vec<f64> { x.iter().zip(y).map(|(x, y)| x * y).collect() };
        let apply = |x: &[f64]| -> Vec<f64> {
            (0..s)
                .map(|i| (0..s).map(|j| entry(tableau, i, j) * x[j]).sum())
                .collect()
        };
        let one = vec![1.0; s];
        let c = apply(&one);
        let (c2, ac) = (times(&c, &c), apply(&c));
        let (c3, aac, ac2) = (times(&c2, &c), apply(&ac), apply(&c2));
        let weights = [
            (1, one, 1.0),
            (2, c.clone(), 2.0),
            (3, c2.clone(), 3.0),
            (3, ac.clone(), 6.0),
            (4, c3.clone(), 4.0),
            (4, times(&c, &ac), 8.0),
            (4, ac2.clone(), 12.0),
            (4, aac.clone(), 24.0),
            (5, times(&c3, &c), 5.0),
            (5, times(&c2, &ac), 10.0),
            (5, times(&ac, &ac), 20.0),
            (5, times(&c, &ac2), 15.0),
            (5, times(&c, &aac), 30.0),
            (5, apply(&c3), 20.0),
            (5, apply(&times(&c, &ac)), 40.0),
            (5, apply(&ac2), 60.0),
            (5, apply(&aac), 120.0),
        ];
        let sums = weights.into_iter().map(|(order, weight, density)| {
            let sum: f64 = tableau.b.iter().zip(&weight).map(|(b, w)| b * w).sum();
            (order, sum - 1.0 / density)
        });
        sums.collect()
    }

    #[test]
    fn explicit_methods_meet_the_conditions_of_their_trees() {
        for tableau in [&EULER, &MIDPOINT, &HEUN, &CLASSICAL, &DORMAND_PRINCE] {
            assert!(tableau.is_explicit());
            let conditions = trees(tableau);
            for (order, residual) in &conditions {
                if *order <= tableau.order {
                    assert!(residual.abs() < 4.0 * f64::EPSILON, "{tableau:?} {order}");
                }
            }
            let more = conditions
                .iter()
                .filter(|(order, _)| *order > tableau.order);
            let mut misses = more.filter(|(_, residual)| residual.abs() > 1e-3);
            assert!(tableau.order == 5 || misses.next().is_some(), "{tableau:?}");
        }
    }
}
