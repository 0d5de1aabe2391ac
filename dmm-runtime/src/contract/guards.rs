//! The functions whose zeros end a mode.

use crate::arithmetic::{Scalar, Vector};
use crate::series::{self, Order, Unroll};

/// The side of an interface.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Side {
    /// g < 0
    Negative,
    /// g > 0
    Positive,
}

impl Side {
    /// That on which g has a value.
    #[inline]
    pub fn of(g: f64) -> Self {
        if g > 0.0 {
            Self::Positive
        } else {
            Self::Negative
        }
    }

    /// −1 or 1.
    pub fn sign(self) -> f64 {
        match self {
            Self::Negative => -1.0,
            Self::Positive => 1.0,
        }
    }
}

/// As many guards with their sides as there are.
#[doc(hidden)]
pub fn sides<const COUNT: usize>(sides: &[(usize, Side)]) -> [(usize, Side); COUNT] {
    std::array::from_fn(|index| sides.get(index).copied().unwrap_or((0, Side::Positive)))
}

/// The Taylor coefficients of a polynomial of at most this degree fall off like those of the state.
pub const LOW_DEGREE: u32 = 4;

/// The functions whose zeros end a mode: those of the interfaces that bound a region, and the
/// conditions of proofs that hold in it.
///
/// Functions take the index of the interface in [`Metadata::interfaces`](crate::Metadata::interfaces). Behind the interfaces
/// follow the [`Metadata::conditions`](crate::Metadata::conditions), which are positive where their conditions hold: the first one
/// has the index `interfaces.len()`.
pub trait Guards<S: Scalar, const N: usize>: Clone {
    /// Whether there may be guards. Where there are none, everything about transitions is compiled
    /// away.
    const MAY_END: bool = true;
    /// [`Guards::is_affine`], where the type tells.
    const AFFINE: Option<bool> = None;
    /// Whether the series of a g may have a radius of convergence of its own.
    const MAY_LEAVE_STATE: bool = true;

    /// The indices of the guards of the mode, with the side on which it lies.
    fn sides(&self) -> &[(usize, Side)];

    /// Whether a guard is the condition of a proof, and no interface: beyond it ψ may have another
    /// value.
    #[inline(always)]
    fn is_condition(&self, _guard: usize) -> bool {
        false
    }

    /// Whether no g depends on the time.
    fn is_autonomous(&self) -> bool;

    /// The degree of every g as a polynomial in t and x, if each is one: 1 where ∂ₜg and ∇g depend
    /// on parameters alone.
    fn degree(&self) -> Option<u32>;

    /// Whether every g is affine in t and x.
    #[inline(always)]
    fn is_affine(&self) -> bool {
        matches!(self.degree(), Some(0..=1))
    }

    /// Whether the Taylor coefficients of every g along a solution fall off like those of the
    /// solution: those of a polynomial of low degree do. Those of any other function may have a
    /// radius of convergence of their own.
    #[inline(always)]
    fn follows_state(&self) -> bool {
        !Self::MAY_LEAVE_STATE || matches!(self.degree(), Some(0..=LOW_DEGREE))
    }

    /// One value for each entry of [`Guards::sides`].
    type Each<T: Copy>: Clone + AsRef<[T]> + AsMut<[T]>;

    /// `value(0)`, `value(1)`, … of each entry of [`Guards::sides`].
    fn each<T: Copy>(&self, value: impl FnMut(usize) -> T) -> Self::Each<T>;

    /// The same guards over other scalars.
    type Over<Other: Scalar>: Guards<Other, N>;

    /// The guards over other scalars; see [`Dynamics::over`](crate::Dynamics::over).
    fn over<Other: Scalar>(&self) -> Self::Over<Other>;

    /// The same with guards that are positive at (t, x); see [`Dynamics::oriented`](crate::Dynamics::oriented).
    fn oriented(&self, _t: S, _x: &Vector<S, N>) -> Self {
        self.clone()
    }

    /// g(t, x)
    fn switching_function(&self, interface: usize, t: S, x: &Vector<S, N>) -> S;

    /// The size that the rounding error of g(t, x) is measured against: Σ|terms|, where the error of
    /// each factor of a product counts as often as the others are large.
    fn switching_size(&self, interface: usize, t: S, x: &Vector<S, N>) -> S;

    /// ∂ₜg and ∇g at (t, x).
    fn switching_gradient(&self, interface: usize, t: S, x: &Vector<S, N>) -> (S, Vector<S, N>);

    /// The Taylor coefficients of every g, in the order of [`Metadata::interfaces`](crate::Metadata::interfaces) and
    /// [`Metadata::conditions`](crate::Metadata::conditions), and of what they
    /// are computed from.
    type Series<const P: usize>: Clone + AsRef<[[S; P]]> + AsMut<[[S; P]]>;

    /// Whether [`Guards::advance`] is straight-line code for each order.
    type Unrolled: Unroll;

    /// Room for the coefficients.
    fn series<const P: usize>(&self) -> Self::Series<P>;

    /// The coefficients of order k of every g at time t, along the solution with the
    /// coefficients `states`.
    fn advance<K: Order, const P: usize>(
        &self,
        k: K,
        t: S,
        states: &[[S; P]],
        series: &mut Self::Series<P>,
    );
}

/// The guards of a mode that has none.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct NoGuards;

impl<S: Scalar, const N: usize> Guards<S, N> for NoGuards {
    const MAY_END: bool = false;
    const AFFINE: Option<bool> = Some(true);
    const MAY_LEAVE_STATE: bool = false;

    fn sides(&self) -> &[(usize, Side)] {
        &[]
    }

    fn is_autonomous(&self) -> bool {
        true
    }

    fn degree(&self) -> Option<u32> {
        Some(0)
    }

    type Each<T: Copy> = [T; 0];
    type Over<Other: Scalar> = Self;

    fn over<Other: Scalar>(&self) -> Self {
        Self
    }

    fn each<T: Copy>(&self, value: impl FnMut(usize) -> T) -> [T; 0] {
        std::array::from_fn(value)
    }

    fn switching_function(&self, _: usize, _: S, _: &Vector<S, N>) -> S {
        S::from_f64(1.0)
    }

    fn switching_size(&self, _: usize, _: S, _: &Vector<S, N>) -> S {
        S::from_f64(1.0)
    }

    fn switching_gradient(&self, _: usize, _: S, _: &Vector<S, N>) -> (S, Vector<S, N>) {
        (S::from_f64(0.0), Vector::from_element(S::from_f64(0.0)))
    }

    type Series<const P: usize> = [[S; P]; 0];
    type Unrolled = series::Straight;

    fn series<const P: usize>(&self) -> [[S; P]; 0] {
        []
    }

    fn advance<K: Order, const P: usize>(&self, _: K, _: S, _: &[[S; P]], _: &mut [[S; P]; 0]) {}
}
