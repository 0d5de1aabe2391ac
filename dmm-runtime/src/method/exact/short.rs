//! The exact flow over a short time d: x + d f + Σ dᵏ Aᵏ⁻¹ f/k!, with the first term in pairs of
//! doubles. The others are below d²/2, and their rounding errors far below those of x.

use super::propagator::{Coefficients, INVERSES, Rows};
use crate::arithmetic::Scalar;
use crate::arithmetic::State;
use crate::arithmetic::double::Double;
use crate::contract::Vector;
use crate::expansion::polynomial::increment;

/// Terms: 5/4 of the lowest exponent is at most 0.3/‖A‖, and the first one left out below 10⁻²³ there.
pub(super) const TERMS: usize = 16;

/// Aᵏ⁻¹/k!, k from 1.
pub(super) type Powers<const N: usize> = [Rows<f64, N>; TERMS];

/// The matrices of the terms.
pub(super) fn powers<const N: usize>(a: &Rows<f64, N>) -> Powers<N> {
    let mut powers = [[[0.0; N]; N]; TERMS];
    for (i, row) in powers[0].iter_mut().enumerate() {
        row[i] = 1.0;
    }
    for k in 1..TERMS {
        let inverse = INVERSES[k + 1].high;
        let (before, rest) = powers.split_at_mut(k);
        for (target, row) in rest[0].iter_mut().zip(a) {
            for (&entry, factor) in row.iter().zip(&before[k - 1]) {
                for (target, factor) in target.iter_mut().zip(factor) {
                    *target += entry * inverse * factor;
                }
            }
        }
    }
    powers
}

/// The series of the flow at a state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Short<const N: usize> {
    at: State<N>,
    /// f
    field: [Double; N],
    /// Aᵏ⁻¹ f/k! by component.
    terms: [[f64; TERMS]; N],
}

impl<const N: usize> Short<N> {
    #[inline(always)]
    pub(super) fn new(coefficients: &Coefficients<N>, powers: &Powers<N>, at: State<N>) -> Self {
        let mut short = Self {
            at,
            field: [Double::default(); N],
            terms: [[0.0; TERMS]; N],
        };
        for i in 0..N {
            let mut sum = Double::from(coefficients.offset[i]);
            for (j, &entry) in coefficients.matrix[i].iter().enumerate() {
                let x = Double {
                    high: at.x[j],
                    low: at.remainder[j],
                };
                sum += x.scaled(entry);
            }
            short.field[i] = sum;
        }
        for (i, terms) in short.terms.iter_mut().enumerate() {
            for (term, power) in terms.iter_mut().zip(powers) {
                for (&entry, field) in power[i].iter().zip(&short.field) {
                    *term = entry.fused(field.high, *term);
                }
            }
        }
        short
    }

    /// f
    #[inline(always)]
    pub(crate) fn field(&self) -> Vector<f64, N> {
        Vector::from_fn(|i, _| self.field[i].high)
    }

    /// The state after d.
    #[inline(always)]
    pub(crate) fn after(&self, d: f64) -> State<N> {
        let mut state = self.at;
        for i in 0..N {
            let first = self.field[i].scaled(d);
            let rest = d * increment(&self.terms[i], d, 0.0);
            let x = Double {
                high: state.x[i],
                low: state.remainder[i],
            };
            let sum = x + first + Double::from(rest);
            (state.x[i], state.remainder[i]) = (sum.high, sum.low);
        }
        state
    }
}
