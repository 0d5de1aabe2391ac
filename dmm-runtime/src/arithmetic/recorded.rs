//! Doubles whose operations are recorded, to be gone through backwards: the derivatives of a few results
//! by all that they are computed from, at a cost that does not depend on how many those are (Griewank
//! & Walther, Evaluating Derivatives, section 3.2).

use std::cell::RefCell;
use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use super::chain::{Chain, operators};
use super::{Derived, Scalar};

/// Stands for what depends on nothing that was declared a [`Recorded::variable`].
const CONSTANT: u32 = u32::MAX;

/// An operation: the places of its operands in the record, and its partial derivatives.
#[derive(Clone, Copy)]
struct Operation {
    operands: [u32; 2],
    slopes: [f64; 2],
}

thread_local! {
    static RECORD: RefCell<Vec<Operation>> = const { RefCell::new(Vec::new()) };
}

/// A double, and its place in the record of the thread.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recorded {
    value: f64,
    place: u32,
}

/// Records what `compute` does and forgets it afterwards.
pub(crate) fn recording<R>(compute: impl FnOnce() -> R) -> R {
    let start = RECORD.with_borrow(Vec::len);
    let result = compute();
    RECORD.with_borrow_mut(|record| record.truncate(start));
    result
}

impl Recorded {
    /// One that derivatives are wanted by.
    pub(crate) fn variable(value: f64) -> Self {
        Self::of(value, [CONSTANT; 2], [0.0; 2])
    }

    fn of(value: f64, operands: [u32; 2], slopes: [f64; 2]) -> Self {
        RECORD.with_borrow_mut(|record| {
            let place = record.len() as u32;
            record.push(Operation { operands, slopes });
            Self { value, place }
        })
    }
}

/// The derivatives of Σ wᵢ uᵢ by variables, for pairs (uᵢ, wᵢ).
pub(crate) fn gradient<'a>(
    of: impl IntoIterator<Item = (Recorded, f64)>,
    variables: impl IntoIterator<Item = &'a Recorded>,
) -> Vec<f64> {
    RECORD.with_borrow(|record| {
        let mut adjoints = vec![0.0; record.len()];
        for (one, weight) in of {
            if one.place != CONSTANT {
                adjoints[one.place as usize] += weight;
            }
        }
        for (place, operation) in record.iter().enumerate().rev() {
            let adjoint = adjoints[place];
            if adjoint == 0.0 {
                continue;
            }
            for (&operand, slope) in operation.operands.iter().zip(operation.slopes) {
                if operand != CONSTANT {
                    adjoints[operand as usize] += slope * adjoint;
                }
            }
        }
        let variables = variables.into_iter();
        variables.map(|one| adjoints[one.place as usize]).collect()
    })
}

impl Chain for Recorded {
    type Value = f64;

    fn constant(value: f64) -> Self {
        Self {
            value,
            place: CONSTANT,
        }
    }

    fn value(self) -> f64 {
        self.value
    }

    fn is_constant(self) -> bool {
        self.place == CONSTANT
    }

    fn chain(self, value: f64, slope: f64) -> Self {
        if self.is_constant() {
            return Self::constant(value);
        }
        Self::of(value, [self.place, CONSTANT], [slope, 0.0])
    }

    fn chain_two(self, v: Self, value: f64, slopes: [f64; 2]) -> Self {
        if self.is_constant() && v.is_constant() {
            return Self::constant(value);
        }
        Self::of(value, [self.place, v.place], slopes)
    }
}

impl Derived for Recorded {
    fn derivative(at: f64, h: impl FnOnce(Self) -> Option<Self>) -> Option<f64> {
        recording(|| {
            let u = Self::variable(at);
            Some(gradient([(h(u)?, 1.0)], [&u])[0])
        })
    }
}

operators!([] Recorded);

impl Add for Recorded {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        self.chain_two(b, self.value + b.value, [1.0, 1.0])
    }
}

impl Sub for Recorded {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self.chain_two(b, self.value - b.value, [1.0, -1.0])
    }
}

impl Neg for Recorded {
    type Output = Self;
    fn neg(self) -> Self {
        self.chain(-self.value, -1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::dual::Dual;
    use super::*;

    /// A function of three variables, of which one occurs often and one not at all.
    fn results<S: Scalar>(u: S, v: S) -> [S; 2] {
        let square = u * u;
        let mixed = (square + v).exp() / v.sin() - u.powf(v);
        [mixed * u.ln_dd(v), square.atan() - S::from_f64(2.0) * mixed]
    }

    #[test]
    fn gradients_are_those_of_dual_numbers() {
        let (u, v) = (0.7, 1.3);
        let forward = results(
            Dual::<f64, 2>::new(u, |k| [1.0, 0.0][k]),
            Dual::new(v, |k| [0.0, 1.0][k]),
        );
        recording(|| {
            let variables = [u, v, 5.0].map(Recorded::variable);
            let found = results(variables[0], variables[1]);
            for (k, result) in found.into_iter().enumerate() {
                let by = gradient([(result, 1.0)], &variables);
                for (found, expected) in by.iter().zip(forward[k].parts) {
                    assert!((found - expected).abs() < 1e-14 * expected.abs(), "{k}");
                }
                assert_eq!(by[2], 0.0);
            }
            let both = gradient([(found[0], 2.0), (found[1], -1.0)], &variables);
            let expected = 2.0 * forward[0].parts[0] - forward[1].parts[0];
            assert!((both[0] - expected).abs() < 1e-13 * expected.abs());
        });
        assert!(RECORD.with_borrow(Vec::is_empty));
    }
}
