//! A trajectory as arrays of ndarray.

use ndarray::{Array1, Array2};

use super::Solution;
use crate::contract::System;
use crate::method::Method;

impl<Sys: System<N>, Met: Method, const N: usize> Solution<Sys, Met, N> {
    /// The times of [`Solution::points`], and the states: a row a point, a column a state.
    ///
    /// ```
    /// use dmm_runtime::{Best, Integrator, pws};
    ///
    /// pws! {
    ///     /// Free fall.
    ///     pub system Fall {
    ///         state z, v;
    ///         der(z) = v;
    ///         der(v) = -1;
    ///     }
    /// }
    ///
    /// let solution = Integrator::new(&Fall {}, Best::tolerance(1e-12))
    ///     .initial(0.0, [1.0, 0.0])
    ///     .output_times([0.0, 0.5, 1.0])
    ///     .run_until(1.0)?;
    /// let (times, states) = solution.to_arrays();
    /// assert_eq!(times.to_vec(), [0.0, 0.5, 1.0]);
    /// assert_eq!(states.column(1).to_vec(), [0.0, -0.5, -1.0]);
    /// # Ok::<(), dmm_runtime::Error>(())
    /// ```
    pub fn to_arrays(&self) -> (Array1<f64>, Array2<f64>) {
        let points = self.points();
        // there may be room for more states than the system has
        let states = self.system().metadata().states.len().min(N);
        (
            points.iter().map(|point| point.t).collect(),
            Array2::from_shape_fn((points.len(), states), |(row, state)| points[row].x[state]),
        )
    }
}
