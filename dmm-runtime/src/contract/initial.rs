//! What an initial state may be given as.

use super::System;
use crate::arithmetic::Vector;
use crate::error::{Error, ErrorKind};

/// x₀ ∈ ℝᴺ, the initial state of a system.
///
/// | given as | its length is checked |
/// |---|---|
/// | `[f64; N]`, or an array of `f32` or of integers up to 32 bits | at compile time |
/// | [`Vector<f64, N>`](crate::Vector) | at compile time |
/// | `&[f64]`, `Vec<f64>`, nalgebra's `DVector<f64>` | when the run starts |
///
/// # Errors
/// [`ErrorKind::StateLength`], for a slice of another length than the system has states.
///
/// ```
/// use dmm_runtime::{Best, ErrorKind, Integrator, pws};
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
/// let integrator = || Integrator::new(&Fall {}, Best::tolerance(1e-12));
/// let from_array = integrator().initial(0.0, [10, 0]).run_until(1.0)?;
/// let read: Vec<f64> = "10 0".split(' ').map(str::parse).collect::<Result<_, _>>()?;
/// let from_slice = integrator().initial(0.0, &read[..]).run_until(1.0)?;
/// assert_eq!(from_array.points(), from_slice.points());
///
/// let refused = integrator().initial(0.0, &read[..1]).run_until(1.0).unwrap_err();
/// assert_eq!(refused.error().kind, ErrorKind::StateLength { states: 2, given: 1 });
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "the initial state of `{Sys}` is `[f64; {N}]`, not `{Self}`",
    label = "`{Sys}` has {N} states",
    note = "an array of {N} numbers, `Vector<f64, {N}>`, or a slice whose length is checked at run time"
)]
pub trait InitialState<Sys, const N: usize> {
    /// The state.
    ///
    /// # Errors
    /// See [`InitialState`].
    fn into_state(self, system: &Sys) -> Result<Vector<f64, N>, Error>;
}

#[diagnostic::do_not_recommend]
impl<Sys, T: Into<f64>, const N: usize> InitialState<Sys, N> for [T; N] {
    fn into_state(self, _system: &Sys) -> Result<Vector<f64, N>, Error> {
        Ok(Vector::from(self.map(Into::into)))
    }
}

#[diagnostic::do_not_recommend]
impl<Sys, T: Into<f64> + Copy, const N: usize> InitialState<Sys, N> for &[T; N] {
    fn into_state(self, _system: &Sys) -> Result<Vector<f64, N>, Error> {
        Ok(Vector::from(self.map(Into::into)))
    }
}

#[diagnostic::do_not_recommend]
impl<Sys, const N: usize> InitialState<Sys, N> for Vector<f64, N> {
    fn into_state(self, _system: &Sys) -> Result<Vector<f64, N>, Error> {
        Ok(self)
    }
}

#[diagnostic::do_not_recommend]
impl<Sys, const N: usize> InitialState<Sys, N> for &Vector<f64, N> {
    fn into_state(self, _system: &Sys) -> Result<Vector<f64, N>, Error> {
        Ok(*self)
    }
}

#[diagnostic::do_not_recommend]
impl<Sys: System<N>, T: Into<f64> + Copy, const N: usize> InitialState<Sys, N> for &[T] {
    fn into_state(self, system: &Sys) -> Result<Vector<f64, N>, Error> {
        // a system that was compiled at run time may have room for more states, which are zero
        let states = system.metadata().states.len().min(N);
        if self.len() != states {
            let given = self.len();
            return Err(ErrorKind::StateLength { states, given }.into());
        }
        Ok(Vector::from_fn(|i, _| {
            self.get(i).map_or(0.0, |&entry| entry.into())
        }))
    }
}

#[diagnostic::do_not_recommend]
impl<Sys: System<N>, T: Into<f64> + Copy, const N: usize> InitialState<Sys, N> for Vec<T> {
    fn into_state(self, system: &Sys) -> Result<Vector<f64, N>, Error> {
        self.as_slice().into_state(system)
    }
}

#[diagnostic::do_not_recommend]
impl<Sys: System<N>, T: Into<f64> + Copy, const N: usize> InitialState<Sys, N> for &Vec<T> {
    fn into_state(self, system: &Sys) -> Result<Vector<f64, N>, Error> {
        self.as_slice().into_state(system)
    }
}

#[diagnostic::do_not_recommend]
impl<Sys: System<N>, const N: usize> InitialState<Sys, N> for nalgebra::DVector<f64> {
    fn into_state(self, system: &Sys) -> Result<Vector<f64, N>, Error> {
        self.as_slice().into_state(system)
    }
}

#[diagnostic::do_not_recommend]
impl<Sys: System<N>, const N: usize> InitialState<Sys, N> for &nalgebra::DVector<f64> {
    fn into_state(self, system: &Sys) -> Result<Vector<f64, N>, Error> {
        self.as_slice().into_state(system)
    }
}
