//! What is known of the switching functions along its flow: bounds of how they
//! bend in a step, and their series next to a root.

use super::propagator::{Coefficients, INVERSES, times};
use super::step_sizes::{FIRST, PARTS, StepSizes, Switching, TERMS};
use crate::arithmetic::Scalar;
use crate::arithmetic::double::Double;
use crate::contract::Vector;

impl<const N: usize> StepSizes<N> {
    /// What is to be known of a switching function with these ∂ₜg and ∇g.
    pub(super) fn switching(&self, (by_time, gradient): (f64, Vector<f64, N>)) -> Switching<N> {
        let Coefficients { matrix, offset } = &self.coefficients;
        let sizes = gradient.map(f64::abs);
        let products = (0..N).map(|i| sizes[i] * offset[i].abs());
        let terms = std::array::from_fn(|k| {
            let power = &self.powers[k];
            Vector::from_fn(|j, _| (0..N).map(|i| gradient[i] * power[i][j]).sum())
        });
        Switching {
            terms,
            rate: Vector::from_fn(|j, _| (0..N).map(|i| sizes[i] * matrix[i][j].abs()).sum()),
            offset: by_time.abs() + products.sum::<f64>(),
            early: self.early(&gradient),
            later: Vec::new(),
            expected: f64::NAN,
            gradient,
        }
    }

    /// max |c A³ exp(sA)| over 0 ≤ s ≤ h: on each eighth by the sum of the terms of its series, of
    /// which those that are left out are below 10⁻⁷ of it.
    fn early(&self, gradient: &Vector<f64, N>) -> Vector<f64, N> {
        const TERMS: usize = 9;
        const MARGIN: f64 = 1.0 + 1e-6;
        const EXPONENT: usize = 1;
        let a = &self.coefficients.matrix;
        let part = &self.flows[EXPONENT];
        let mut row = times(a, &times(a, &times(a, &(*gradient).into())));
        let mut largest = Vector::<f64, N>::zeros();
        for number in 0..PARTS >> EXPONENT {
            if number > 0 {
                row = part.transposed_roughly(&row);
            }
            let mut term = row;
            let mut sum = [0.0; N];
            for inverse in &INVERSES[1..=TERMS] {
                for (sum, term) in sum.iter_mut().zip(&term) {
                    *sum += term.abs();
                }
                let factor = self.size(EXPONENT) * inverse.high;
                term = times(a, &term).map(|entry| entry * factor);
            }
            largest = largest.sup(&Vector::from(sum));
        }
        largest * MARGIN
    }

    /// c A³
    fn third(&self, row: &[Double; N]) -> [Double; N] {
        let a = &self.coefficients.matrix;
        let image = |row: &[Double; N]| -> [Double; N] {
            std::array::from_fn(|j| {
                let terms = row.iter().zip(a);
                terms.fold(Double::default(), |sum, (entry, own)| {
                    sum + entry.scaled(own[j])
                })
            })
        };
        image(&image(&image(row)))
    }

    /// About max |c A³ exp(sA)| from half a step to two steps of a exponent: at points an eighth of
    /// it apart, with the slope in between.
    fn later(&self, gradient: &Vector<f64, N>, exponent: usize) -> Vector<f64, N> {
        const POINTS: usize = 13;
        const MARGIN: f64 = 1.25;
        // half of that
        let between = self.size(exponent) * (1.0 / 16.0);
        // first what is fast is left out, then the powers of A are taken
        let decayed = self.flows[exponent - 1].transposed(&pairs(gradient));
        let mut row = self.third(&decayed);
        let mut largest = Vector::<f64, N>::zeros();
        for _ in 0..POINTS {
            let values = row.map(|entry| entry.high);
            let slopes = times(&self.coefficients.matrix, &values);
            for j in 0..N {
                let size = values[j].abs() + between * slopes[j].abs();
                largest[j] = largest[j].max(MARGIN * size);
            }
            row = self.flows[exponent - 3].transposed(&row);
        }
        largest
    }

    /// Bounds for one more exponent.
    pub(super) fn settle(&mut self, exponent: usize) {
        let gradients = self.switching.iter().map(|one| &one.gradient);
        let later: Vec<_> = gradients.map(|c| self.later(c, exponent)).collect();
        for (switching, later) in self.switching.iter_mut().zip(later) {
            switching.later.push(later);
        }
    }

    /// A bound of |g⁗| over at most h from where the field is `field`.
    #[inline(always)]
    pub(crate) fn fourth(&self, side: usize, field: &Vector<f64, N>) -> f64 {
        size_of(&self.switching[side].early, field)
    }

    /// A bound of |g⁗| from half a step of a exponent to two steps after the field was `field`.
    #[inline(always)]
    pub(crate) fn fourth_later(&self, side: usize, exponent: usize, field: &Vector<f64, N>) -> f64 {
        size_of(&self.switching[side].later[exponent - FIRST - 1], field)
    }

    /// Σ|terms of dg/dt|
    #[inline(always)]
    pub(crate) fn rate_size(&self, side: usize, x: &Vector<f64, N>) -> f64 {
        let switching = &self.switching[side];
        size_of(&switching.rate, x) + switching.offset
    }

    /// About how long after the start of its step a crossing is, of which there is an estimate. As
    /// long as the last one where that is not far from it: that is known before the step has been
    /// looked at, so that the processor locates the crossing meanwhile.
    #[inline(always)]
    pub(crate) fn expected(&self, side: usize, estimate: f64) -> f64 {
        let expected = self.switching[side].expected;
        if (expected - estimate).abs() <= self.lowest {
            expected
        } else {
            unexpected(estimate)
        }
    }

    /// Keeps how long after the start of its step a crossing was.
    #[inline(always)]
    pub(crate) fn keep(&mut self, side: usize, elapsed: f64) {
        self.switching[side].expected = elapsed;
    }

    /// The coefficients of c·x along the flow, from the first on, where the field is `field`.
    #[inline(always)]
    pub(crate) fn along(&self, side: usize, field: &Vector<f64, N>) -> [f64; TERMS] {
        let terms = &self.switching[side].terms;
        let mut along = [0.0; TERMS];
        for (along, row) in along.iter_mut().zip(terms) {
            *along = product(row, field);
        }
        along
    }
}

/// The estimate itself. A call, so that the other case is a branch that need not wait for it.
#[cold]
#[inline(never)]
fn unexpected(estimate: f64) -> f64 {
    estimate
}

/// Σ rowⱼ vⱼ
#[inline(always)]
fn product<const N: usize>(row: &Vector<f64, N>, v: &Vector<f64, N>) -> f64 {
    row.iter()
        .zip(v)
        .fold(0.0, |sum, (row, v)| row.fused(*v, sum))
}

/// Σ rowⱼ |vⱼ|
#[inline(always)]
fn size_of<const N: usize>(row: &Vector<f64, N>, v: &Vector<f64, N>) -> f64 {
    product(row, &v.map(f64::abs))
}

fn pairs<const N: usize>(row: &Vector<f64, N>) -> [Double; N] {
    std::array::from_fn(|j| Double::from(row[j]))
}
