//! The flow of ẋ = A x + b over a fixed time: x₁ = E x₀ + φ with
//!
//! E = exp(hA) = Σ (hA)ᵏ/k!, φ = ∫₀ʰ exp(sA) b ds = Σ h (hA)ᵏ b/(k + 1)!,
//!
//! which need neither an inverse nor an eigenvector of A, so that singular and defective ones
//! are like any other. Over longer times by composition: E(s + h) = E(s)E(h) and φ(s + h) =
//! E(s)φ(h) + φ(s). (Moler & Van Loan, SIAM Review 45, 2003, method 3, scaling and squaring; the
//! digits that squaring loses are those that a pair of doubles has beyond a double.)

use crate::arithmetic::Scalar;
use crate::arithmetic::State;
use crate::arithmetic::double::Double;
use crate::arithmetic::error_free::{two_product, two_sum};
use crate::contract::Vector;

/// A matrix by rows.
pub(crate) type Rows<T, const N: usize> = [[T; N]; N];

/// Terms of the series.
const MOST_TERMS: usize = 40;
/// 1/k, up to that of the last term of φ; k = 0 stands for none.
pub(super) const INVERSES: [Double; MOST_TERMS + 2] = {
    let mut inverses = [Double::ONE; MOST_TERMS + 2];
    let mut k = 1;
    while k < inverses.len() {
        inverses[k] = Double::inverse_of(k as f64);
        k += 1;
    }
    inverses
};
/// Terms below this part of the sum are computed in doubles.
const SMALL: f64 = 1e-17;
/// The series ends where its terms are below this part of the sum.
const NEGLIGIBLE: f64 = 1e-34;

/// A and b.
#[derive(Clone, Debug)]
pub(crate) struct Coefficients<const N: usize> {
    pub(crate) matrix: Rows<f64, N>,
    pub(crate) offset: [f64; N],
}

/// E and φ.
#[derive(Clone, Debug)]
pub(crate) struct Propagator<const N: usize> {
    matrix: Rows<Double, N>,
    offset: [Double; N],
    /// Whether φ ≠ 0.
    shifts: bool,
}

impl<const N: usize> Propagator<N> {
    /// Over `h` by the series; nothing if it does not converge in a few terms.
    pub(super) fn series(coefficients: &Coefficients<N>, h: f64) -> Option<Self> {
        let Coefficients { matrix: a, offset } = coefficients;
        let mut term = identity::<N>();
        let mut column = offset.map(|b| Double::from(b).scaled(h));
        let mut sum = Self {
            matrix: term,
            offset: column,
            shifts: offset.iter().any(|&b| b != 0.0),
        };
        for k in 1..=MOST_TERMS {
            let factor = INVERSES[k].scaled(h);
            term = product(a, &term, factor);
            let mut largest = add(sum.matrix.as_flattened_mut(), term.as_flattened());
            if sum.shifts {
                let factor = INVERSES[k + 1].scaled(h);
                column = image(a, &column, factor);
                largest = largest.max(add(&mut sum.offset, &column));
            }
            if largest <= SMALL {
                return sum.finished(coefficients, h, k, (&term, &column));
            }
        }
        None
    }

    /// The sum with the terms after number k, for which doubles do.
    fn finished(
        mut self,
        Coefficients { matrix: a, .. }: &Coefficients<N>,
        h: f64,
        k: usize,
        (term, column): (&Rows<Double, N>, &[Double; N]),
    ) -> Option<Self> {
        let mut term = term.map(|row| row.map(|entry| entry.high));
        let mut column = column.map(|entry| entry.high);
        let (mut rest, mut shift) = ([[0.0; N]; N], [0.0; N]);
        for k in k + 1..=MOST_TERMS {
            let mut next = [[0.0; N]; N];
            let factor = h / k as f64;
            let mut largest = 0.0f64;
            for ((next, rest), row) in next.iter_mut().zip(&mut rest).zip(a) {
                for (&entry, other) in row.iter().zip(&term) {
                    for (next, other) in next.iter_mut().zip(other) {
                        *next += entry * factor * other;
                    }
                }
                for (rest, next) in rest.iter_mut().zip(next) {
                    *rest += *next;
                    largest = largest.max(next.abs());
                }
            }
            term = next;
            if self.shifts {
                let factor = h / (k + 1) as f64;
                let image = a.map(|row| {
                    let terms = row.iter().zip(&column);
                    terms.map(|(entry, other)| entry * other).sum::<f64>() * factor
                });
                column = image;
                for (shift, entry) in shift.iter_mut().zip(&column) {
                    *shift += entry;
                    largest = largest.max(entry.abs());
                }
            }
            let sizes = self.matrix.iter().flatten();
            let size = sizes.fold(0.0f64, |size, entry| size.max(entry.high.abs()));
            if largest <= NEGLIGIBLE * size {
                let rest = rest.map(|row| row.map(Double::from));
                add(self.matrix.as_flattened_mut(), rest.as_flattened());
                add(&mut self.offset, &shift.map(Double::from));
                return Some(self);
            }
        }
        None
    }

    /// This one after `first`.
    pub(super) fn after(&self, first: &Self) -> Self {
        let row = |row: &[Double; N], column: &dyn Fn(usize) -> Double, start: Double| {
            let terms = row.iter().enumerate();
            let terms = terms.filter(|(_, entry)| entry.high != 0.0);
            terms.fold(start, |sum, (k, entry)| sum + *entry * column(k))
        };
        let mut whole = Self {
            matrix: [[Double::default(); N]; N],
            offset: self.offset,
            shifts: self.shifts,
        };
        for (target, own) in whole.matrix.iter_mut().zip(&self.matrix) {
            for (j, target) in target.iter_mut().enumerate() {
                *target = row(own, &|k| first.matrix[k][j], Double::default());
            }
        }
        if self.shifts {
            for (target, own) in whole.offset.iter_mut().zip(&self.matrix) {
                *target = row(own, &|k| first.offset[k], *target);
            }
        }
        whole
    }

    /// The row vector r E.
    pub(super) fn transposed(&self, row: &[Double; N]) -> [Double; N] {
        std::array::from_fn(|j| {
            let terms = row.iter().zip(&self.matrix);
            terms.fold(Double::default(), |sum, (entry, own)| sum + *entry * own[j])
        })
    }

    /// The same to the precision of a double.
    pub(super) fn transposed_roughly(&self, row: &[f64; N]) -> [f64; N] {
        std::array::from_fn(|j| {
            let terms = row.iter().zip(&self.matrix);
            terms.fold(0.0, |sum, (entry, own)| sum + entry * own[j].high)
        })
    }

    pub(super) fn is_finite(&self) -> bool {
        let entries = self.matrix.iter().flatten().chain(&self.offset);
        entries.fold(0.0, |sum, entry| sum + 0.0 * (entry.high + entry.low)) == 0.0
    }

    /// E x + φ, with an error of a few 2⁻¹⁰⁴ of the terms.
    #[inline(always)]
    pub(crate) fn apply(&self, state: &State<N>) -> State<N> {
        let mut next = State::new(Vector::zeros());
        for i in 0..N {
            let row = &self.matrix[i];
            let mut high = 0.0;
            let mut low = 0.0;
            for (j, entry) in row.iter().enumerate() {
                let (product, error) = two_product(entry.high, state.x[j]);
                let (sum, lost) = match j {
                    0 => (product, 0.0),
                    _ => two_sum(high, product),
                };
                high = sum;
                let cross = entry.low.fused(state.x[j], low + (lost + error));
                low = entry.high.fused(state.remainder[j], cross);
            }
            if self.shifts {
                let (sum, lost) = two_sum(high, self.offset[i].high);
                high = sum;
                low += lost + self.offset[i].low;
            }
            let sum = Double::fast_sum(high, low);
            (next.x[i], next.remainder[i]) = (sum.high, sum.low);
        }
        next
    }
}

/// The row vector r A.
pub(super) fn times<const N: usize>(a: &Rows<f64, N>, row: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|j| row.iter().zip(a).map(|(r, own)| r * own[j]).sum())
}

fn identity<const N: usize>() -> Rows<Double, N> {
    let mut matrix = [[Double::default(); N]; N];
    for (i, row) in matrix.iter_mut().enumerate() {
        row[i] = Double::ONE;
    }
    matrix
}

/// c A M
fn product<const N: usize>(a: &Rows<f64, N>, m: &Rows<Double, N>, c: Double) -> Rows<Double, N> {
    let mut product = [[Double::default(); N]; N];
    for (target, row) in product.iter_mut().zip(a) {
        for (&entry, other) in row.iter().zip(m) {
            if entry != 0.0 {
                for (target, other) in target.iter_mut().zip(other) {
                    *target += other.scaled(entry);
                }
            }
        }
        for target in target {
            *target *= c;
        }
    }
    product
}

/// c A u
fn image<const N: usize>(a: &Rows<f64, N>, u: &[Double; N], c: Double) -> [Double; N] {
    std::array::from_fn(|i| {
        let terms = a[i].iter().zip(u);
        let sum = terms.fold(Double::default(), |sum, (&entry, u)| sum + u.scaled(entry));
        sum * c
    })
}

/// Adds a term to a sum; the largest entry of the term, relative to that of the sum.
fn add(sum: &mut [Double], term: &[Double]) -> f64 {
    let (mut of_sum, mut of_term) = (0.0f64, 0.0f64);
    for (sum, term) in sum.iter_mut().zip(term) {
        *sum += *term;
        of_sum = of_sum.max(sum.high.abs());
        of_term = of_term.max(term.high.abs());
    }
    relative(of_term, of_sum)
}

fn relative(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}
