//! A piece of a trajectory as a polynomial: the dense output of a step.

use super::interval::Interval;
use crate::arithmetic::Scalar;
use crate::contract::Vector;
use crate::expansion::jet::FIRST;

/// x(t₀ + h) = Σ cⱼ (h/σ)ʲ for 0 ≤ h ≤ τ, σ the unit of time of the coefficients.
///
/// Times along the path are told in the unit σ, from t₀ on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path<'a, const N: usize> {
    /// t₀
    pub(crate) t0: f64,
    /// σ
    pub(crate) unit: f64,
    /// The coefficients of each component.
    pub(crate) coefficients: [&'a [f64]; N],
}

impl<const N: usize> Path<'_, N> {
    /// The time at `s`.
    pub(crate) fn time(&self, s: f64) -> f64 {
        self.t0 + s * self.unit
    }

    /// x at `s`.
    pub(crate) fn state(&self, s: f64) -> Vector<f64, N> {
        Vector::from_fn(|i, _| {
            self.coefficients[i]
                .iter()
                .rev()
                .fold(0.0, |x, c| x * s + c)
        })
    }

    /// x and dx/ds at `s`, as the first two coefficients there.
    pub(super) fn expanded(&self, s: f64) -> [[f64; FIRST]; N] {
        self.coefficients.map(|coefficients| {
            let (mut x, mut slope) = (0.0, 0.0);
            for &c in coefficients.iter().rev() {
                slope = slope * s + x;
                x = x * s + c;
            }
            let mut first = [0.0; FIRST];
            (first[0], first[1]) = (x, slope);
            first
        })
    }

    /// The first coefficients at every point from `a` to `b`, 0 ≤ a ≤ b, enclosed: coefficient k
    /// at s is Σ binomial(j, k) cⱼ sʲ⁻ᵏ.
    pub(super) fn enclosed(&self, a: f64, b: f64) -> [[Interval; FIRST]; N] {
        let s = Interval { low: a, high: b };
        self.coefficients.map(|coefficients| {
            std::array::from_fn(|k| {
                let mut sum = Interval::from_f64(0.0);
                for (j, &c) in coefficients.iter().enumerate().skip(k).rev() {
                    sum = sum * s + Interval::from_f64(BINOMIALS[k][j]) * Interval::from_f64(c);
                }
                sum
            })
        })
    }
}

/// The most coefficients of a path.
pub(crate) const MOST: usize = crate::series::MOST_COEFFICIENTS + 1;

/// binomial(j, k) at [k][j]
const BINOMIALS: [[f64; MOST]; FIRST] = {
    let mut table = [[0.0; MOST]; FIRST];
    let mut j = 0;
    while j < MOST {
        table[0][j] = 1.0;
        let mut k = 1;
        while k < FIRST {
            if j > 0 {
                table[k][j] = table[k][j - 1] + table[k - 1][j - 1];
            }
            k += 1;
        }
        j += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coefficients_are_enclosed_at_every_point() {
        let c = [0.3, -1.0, 0.7, 0.2, -0.4, 0.05, 0.01, -0.003];
        let path = Path {
            t0: 0.0,
            unit: 1.0,
            coefficients: [&c[..]],
        };
        for (a, b) in [(0.0, 0.1), (0.2, 0.9), (0.7, 0.7001)] {
            let [enclosed] = path.enclosed(a, b);
            for n in 0..=50 {
                let s = a + (b - a) * f64::from(n) / 50.0;
                let mut exact = [0.0; FIRST];
                for (k, exact) in exact.iter_mut().enumerate() {
                    for (j, c) in c.iter().enumerate().skip(k) {
                        *exact += BINOMIALS[k][j] * c * s.powi((j - k) as i32);
                    }
                }
                let [point] = path.expanded(s);
                assert!((point[0] - exact[0]).abs() < 1e-15 && (point[1] - exact[1]).abs() < 1e-14);
                for (enclosed, exact) in enclosed.iter().zip(exact) {
                    assert!(enclosed.low <= exact + 1e-15 && exact - 1e-15 <= enclosed.high);
                }
            }
        }
    }
}
