//! The values of formulas at one point, so that most divisors are known not to be zero without
//! a proof. Nothing is reported on their grounds.

use crate::algebra::{Dag, Id, Math};
use crate::syntax::Operator;

use super::number;

/// A value of this size is not a rounding error of zero.
const CLEARLY: f64 = 1e-6;

/// By node: its value where each variable has a value of its own between 0.3 and 1.5.
#[derive(Debug, Default)]
pub(super) struct Samples {
    values: Vec<f64>,
    variables: u32,
}

impl Samples {
    /// Whether `id` is not zero at the point.
    pub(super) fn is_not_zero(&mut self, dag: &Dag, id: Id) -> bool {
        // children have smaller identifiers than their parents, so that they are there already
        while self.values.len() < dag.len() {
            let value = self.value(dag, Id::from(self.values.len()));
            self.values.push(value);
        }
        let value = self.values.get(usize::from(id));
        value.is_some_and(|value| value.is_finite() && value.abs() > CLEARLY)
    }

    fn value(&mut self, dag: &Dag, id: Id) -> f64 {
        let of = |id: Id| {
            self.values
                .get(usize::from(id))
                .copied()
                .unwrap_or(f64::NAN)
        };
        match &dag[id] {
            Math::Pi => std::f64::consts::PI,
            Math::Constant(value) => number::double(value),
            Math::Variable(_) => {
                self.variables += 1;
                // multiples of the golden ratio spread evenly
                0.3 + 1.2 * (f64::from(self.variables) * 0.618_033_988_749_895).fract()
            }
            Math::Add([a, b]) => of(*a) + of(*b),
            Math::Sub([a, b]) => of(*a) - of(*b),
            Math::Mul([a, b]) => of(*a) * of(*b),
            Math::Div([a, b]) => of(*a) / of(*b),
            Math::Pow([a, b]) => number::operation(Operator::Power, of(*a), of(*b)),
            Math::Neg(a) => -of(*a),
            Math::Call(function, a) => number::call(*function, of(*a)),
            Math::Pair(..) => f64::NAN,
        }
    }
}
