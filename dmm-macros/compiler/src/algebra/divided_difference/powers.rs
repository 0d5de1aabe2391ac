//! The sums that telescope a difference of powers: Δ(uⁿ) = (Σ u₁ʲ u₀ⁿ⁻¹⁻ʲ) Δu, and the same of
//! roots.

use num_traits::ToPrimitive;

use super::super::{Dag, Id};
use super::chain::Weight;

/// u^(p/q) is treated through u^(1/q) up to this q.
const LARGEST_ROOT: i64 = 8;
/// Odd powers up to this one are telescoped term by term.
const LARGEST_WRITTEN_SUM: i64 = 9;

/// p/q if `exponent` is a fraction that is taken through u^(1/q).
pub(super) fn small_fraction(dag: &Dag, exponent: Id) -> Option<(i64, i64)> {
    let value = dag.as_constant(exponent)?;
    let q = value.denom().to_i64().filter(|&q| q <= LARGEST_ROOT)?;
    Some((value.numer().to_i64()?, q))
}

/// Δ(uⁿ)/Δu; for a negative n, −(Δ(u⁻ⁿ)/Δu)/(u₀⁻ⁿu₁⁻ⁿ).
pub(super) fn power_weight(dag: &mut Dag, ends: [Id; 2], n: i64) -> Weight {
    let size = n.saturating_abs();
    let sum = telescoped_sum(dag, ends, size);
    if n >= 0 {
        return Weight::factor(sum);
    }
    let [start, end] = ends.map(|u| dag.powi(u, size));
    let divisor = dag.mul(end, start);
    Weight::quotient(dag.neg(sum), divisor)
}

/// Δ(u^(p/q))/Δu through w = u^(1/q): Δ(wᵖ)/Δw divided by Δ(w^q)/Δw.
pub(super) fn rational_power_weight(dag: &mut Dag, ends: [Id; 2], p: i64, q: i64) -> Weight {
    let exponent = dag.fraction(1, q);
    let roots = ends.map(|u| dag.pow(u, exponent));
    let power = power_weight(dag, roots, p);
    let root = telescoped_sum(dag, roots, q);
    let divisor = match power.divisor {
        Some(divisor) => dag.mul(divisor, root),
        None => root,
    };
    Weight::quotient(power.factor, divisor)
}

/// Σ u₁ʲ u₀ⁿ⁻¹⁻ʲ over 0 ≤ j < n, the highest power of u₁ first.
///
/// Even powers are split, uⁿ = (u^(n/2))²: (u₁^(n/2) + u₀^(n/2))·(the sum of n/2), which costs
/// less and loses no digits where the ends have opposite signs.
fn telescoped_sum(dag: &mut Dag, [start, end]: [Id; 2], n: i64) -> Id {
    if n <= 1 {
        return dag.integer(n);
    }
    if n % 2 == 0 {
        let [start_half, end_half] = [start, end].map(|u| dag.powi(u, n / 2));
        let sum = dag.add(end_half, start_half);
        let rest = telescoped_sum(dag, [start, end], n / 2);
        return dag.mul(sum, rest);
    }
    if n <= LARGEST_WRITTEN_SUM {
        let terms: Vec<Id> = (0..n)
            .map(|j| {
                let end_power = dag.powi(end, n - 1 - j);
                let start_power = dag.powi(start, j);
                dag.mul(end_power, start_power)
            })
            .collect();
        return dag.sum(terms);
    }
    // uⁿ = u·uⁿ⁻¹ at the mean: ū·(the sum of n−1) + (the mean of uⁿ⁻¹)
    let [start_power, end_power] = [start, end].map(|u| dag.powi(u, n - 1));
    let power_mean = dag.mean(end_power, start_power);
    let mean = dag.mean(end, start);
    let rest = telescoped_sum(dag, [start, end], n - 1);
    let product = dag.mul(mean, rest);
    dag.add(product, power_mean)
}
