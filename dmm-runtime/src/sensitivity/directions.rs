//! The directions of derivatives: the components of the initial state, then the parameters.

use nalgebra::DMatrix;

use crate::arithmetic::Vector;
use crate::arithmetic::dual::Dual;
use crate::contract::{DynamicsVisitor, System};

/// Directions that are carried at once.
pub(super) const WIDTH: usize = 4;

/// A double with its derivatives in some directions.
pub(super) type Number = Dual<f64, WIDTH>;

/// A system and its directions.
pub(super) struct Directions<'a, Sys, const N: usize> {
    pub(super) system: &'a Sys,
    parameters: Vec<f64>,
}

impl<'a, Sys: System<N>, const N: usize> Directions<'a, Sys, N> {
    pub(super) fn new(system: &'a Sys) -> Self {
        Self {
            system,
            parameters: system.parameters(),
        }
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        N + self.parameters.len()
    }

    /// Those that are carried at once, by their first ones.
    pub(super) fn firsts(&self) -> impl Iterator<Item = usize> + use<Sys, N> {
        (0..self.count()).step_by(WIDTH)
    }

    /// ∂x₀/∂x₀ and ∂x₀/∂p.
    pub(super) fn initial(&self) -> DMatrix<f64> {
        DMatrix::from_fn(N, self.count(), |i, j| f64::from(u8::from(i == j)))
    }

    /// A parameter with its derivatives in the directions from `first` on.
    pub(super) fn parameter(&self, index: usize, first: usize) -> Number {
        Dual::new(self.parameters[index], |k| {
            f64::from(u8::from(first + k == N + index))
        })
    }

    /// Calls `visitor` with the dynamics of a mode whose parameters have derivatives.
    pub(super) fn visit<V: DynamicsVisitor<N, Number>>(
        &self,
        region: Sys::Region,
        first: usize,
        visitor: V,
    ) -> V::Output {
        let parameter = |index| self.parameter(index, first);
        self.system.visit_with(region, parameter, visitor)
    }
}

/// A number with derivatives, of which there may be fewer than directions are carried.
pub(super) fn number(value: f64, derivatives: &[f64], first: usize) -> Number {
    Dual::new(value, |k| {
        derivatives.get(first + k).copied().unwrap_or_default()
    })
}

/// A state with the derivatives of a matrix.
pub(super) fn state<const N: usize>(
    x: &Vector<f64, N>,
    derivatives: &DMatrix<f64>,
    first: usize,
) -> Vector<Number, N> {
    Vector::from_fn(|i, _| {
        let part = |k: usize| derivatives.get((i, first + k)).copied();
        Dual::new(x[i], |k| part(k).unwrap_or_default())
    })
}

/// Writes the derivatives of a state into the columns of a matrix.
pub(super) fn store<const N: usize>(
    derivatives: &mut DMatrix<f64>,
    first: usize,
    x: &Vector<Number, N>,
) {
    for k in 0..WIDTH.min(derivatives.ncols() - first) {
        for i in 0..N {
            derivatives[(i, first + k)] = x[i].parts[k];
        }
    }
}
