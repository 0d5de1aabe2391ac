//! What `pws!` emits for a system, and what the integrators ask of it.
//!
//! A [`System`] is a set of regions; in each of them a [`Flow`] holds one smooth vector field f
//! with its conserved quantities ψ and the conservative scheme derived from them. The flow's
//! [`Boundary`] is the set of interfaces g = 0 at which the region ends; for a smooth system
//! it is [`Unbounded`], and everything about transitions is compiled away.

use std::fmt::Debug;

use crate::scalar::Scalar;
use crate::series::{self, Order, Unroll};

/// A column of N scalars.
pub type Vector<S, const N: usize> = nalgebra::SVector<S, N>;
/// A matrix of R rows and C columns.
pub type Matrix<S, const R: usize, const C: usize> = nalgebra::SMatrix<S, R, C>;

/// A piecewise-smooth system with N states: ẋ = fᵣ(t, x) while x is in region r
/// (Hirani, Wan & Wojtalewicz, eq. 1.1).
///
/// Implemented by `pws!`.
pub trait System<const N: usize>: Clone + Debug + Send + Sync + 'static {
    /// The regions; an enumeration emitted beside the system.
    type Region: Copy + Eq + Debug + Send + Sync + 'static;

    /// The system's name.
    const NAME: &'static str;
    /// The names of the states.
    const STATES: [&'static str; N];
    /// The names of the parameters.
    const PARAMETERS: &'static [&'static str];
    /// The names of the interfaces.
    const INTERFACES: &'static [&'static str];
    /// The conditions under which quantities were proved to be conserved, as far as a run has to
    /// check them; see [`Guard`].
    const GUARDS: &'static [Guard] = &[];
    /// Every region, in the order of declaration.
    const REGIONS: &'static [Self::Region];
    /// The declaration, as text.
    const DECLARATION: &'static str;
    /// The derived scheme in readable mathematics.
    const LISTING: &'static str;

    /// The name of a region.
    fn region_name(region: Self::Region) -> &'static str;

    /// The names of the quantities that are conserved in a region.
    fn conserved_names(region: Self::Region) -> &'static [&'static str];

    /// The name of an interface or, behind them, the condition of a guard: what an index of
    /// [`Boundary::SIDES`] stands for.
    fn boundary_name(index: usize) -> &'static str {
        let guard = index.checked_sub(Self::INTERFACES.len());
        let guard = guard.and_then(|number| Self::GUARDS.get(number));
        let name = Self::INTERFACES.get(index).copied();
        name.or(guard.map(|guard| guard.condition))
            .unwrap_or_default()
    }

    /// On which side of each interface a region lies: the sign of g, in the order of
    /// [`System::INTERFACES`].
    fn sides(region: Self::Region) -> &'static [Side];

    /// The parameters, in the order of [`System::PARAMETERS`].
    fn parameters(&self) -> Vec<f64>;

    /// The parameter at `index`, to be changed; nothing if there are not so many.
    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64>;

    /// Calls `visitor` with the flow of `region`, monomorphised for it.
    fn visit<V: FlowVisitor<N>>(&self, region: Self::Region, visitor: V) -> V::Output;

    /// The same with parameters of any scalar, in the order of [`System::PARAMETERS`]: those of
    /// several systems at once, for example.
    fn visit_with<S: Scalar, V: FlowVisitor<N, S>>(
        region: Self::Region,
        parameter: impl Fn(usize) -> S,
        visitor: V,
    ) -> V::Output;

    /// ψ(t, x), the quantities that are conserved in `region`, in the order of
    /// [`System::conserved_names`]. The point need not lie in the region.
    ///
    /// ```
    /// use dmm_runtime::{System, pws};
    ///
    /// pws! {
    ///     /// An oscillator.
    ///     pub system Oscillator {
    ///         state q, p;
    ///         der(q) = p;
    ///         der(p) = -q;
    ///         conserved energy = (q^2 + p^2) / 2;
    ///     }
    /// }
    ///
    /// let region = OscillatorRegion::Everywhere;
    /// let psi = Oscillator {}.conserved(region, 0.0, &[3.0, 4.0].into());
    /// assert_eq!(Oscillator::conserved_names(region), ["energy"]);
    /// assert_eq!(psi, [12.5]);
    /// ```
    fn conserved(&self, region: Self::Region, t: f64, x: &Vector<f64, N>) -> Vec<f64> {
        self.visit(region, Conserved { t, x })
    }
}

/// ψ(t, x)
struct Conserved<'a, const N: usize> {
    t: f64,
    x: &'a Vector<f64, N>,
}

impl<const N: usize> FlowVisitor<N> for Conserved<'_, N> {
    type Output = Vec<f64>;

    fn visit<const M: usize, F: Flow<f64, N, M>>(self, flow: &F) -> Vec<f64> {
        flow.conserved(self.t, self.x).iter().copied().collect()
    }
}

/// A condition under which quantities of a region were proved to be conserved, and beyond which
/// the emitted code has values nevertheless.
///
/// Of x^k the compiler knows that k is a parameter; for an integer k there is a value also where
/// x < 0. A proof that needs x > 0 says nothing there. Where neither the region nor a root or a
/// logarithm in the formulas keeps solutions from leaving the condition, a run checks it: at its
/// start, where it enters the region, and in each step, in which a guard is watched like an
/// interface. What comes to it ends as [`Error::ConditionFails`](crate::Error::ConditionFails),
/// and nothing is ever corrected towards a level beyond.
///
/// ```
/// use dmm_runtime::{Error, Integrator, Symmetric, System, pws};
///
/// pws! {
///     /// ẏ = |x| x: y − x³/3 is conserved where x > 0.
///     pub system Ramp {
///         state x, y;
///         param k = 2;
///         der(x) = 1;
///         der(y) = sqrt(x^2) * x^k / x^k * x;
///         conserved e = y - x^3 / 3;
///     }
/// }
///
/// assert_eq!(Ramp::GUARDS[0].condition, "x > 0");
/// let ramp = Ramp::default();
/// let from = |x| Integrator::new(&ramp, Symmetric::step_size(0.01)).initial(0.0, [x, 0.5]);
/// assert!(from(1.0).run_until(0.5).is_ok());
/// let stopped = from(-1.0).run_until(0.5).unwrap_err();
/// assert!(matches!(stopped.error(), Error::ConditionFails { quantity: "e", .. }));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Guard {
    /// The index of the region in [`System::REGIONS`].
    pub region: usize,
    /// The condition, as text.
    pub condition: &'static str,
    /// The names of the quantities.
    pub quantities: &'static str,
    /// Whether the condition is u ≠ 0, so that the sign of u is kept.
    pub keeps_sign: bool,
}

/// The side of an interface.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Side {
    /// g < 0
    Negative,
    /// g > 0
    Positive,
}

impl Side {
    /// −1 or 1.
    pub fn sign(self) -> f64 {
        match self {
            Self::Negative => -1.0,
            Self::Positive => 1.0,
        }
    }
}

/// What is to be done with the flow of a region; see [`System::visit`].
pub trait FlowVisitor<const N: usize, S: Scalar = f64> {
    /// The result.
    type Output;

    /// Does it, for a flow with M conserved quantities.
    fn visit<const M: usize, F: Flow<S, N, M>>(self, flow: &F) -> Self::Output;
}

/// How the discrete vector field depends on the state at the later end of a step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Solvability {
    /// In general: Newton's method.
    Nonlinear,
    /// f^τ = A x₁ + b with A and b depending on x₀, t₀ and t₁: one linear solve.
    Affine,
    /// f^τ = A₀ x₀ + A₁ x₁ + b with A₀, A₁ and b depending on parameters alone: the
    /// propagator is computed once a step size.
    Linear,
}

/// The smooth flow of one region, with M conserved quantities and the conservative scheme
/// that the compiler derived from them.
///
/// Every function is generic over the scalar. `x` has N entries, ψ has M, Λ is M×N, a
/// Jacobian N×N with a row an equation.
pub trait Flow<S: Scalar, const N: usize, const M: usize>: Clone {
    /// The interfaces that bound the region.
    type Boundary: Boundary<S, N>;

    /// The same flow over other scalars.
    type Over<Other: Scalar>: Flow<Other, N, M>;

    /// The flow over other scalars with the same parameters, and with the same values of what
    /// is computed from them alone.
    fn over<Other: Scalar>(&self) -> Self::Over<Other>;

    /// Whether neither f nor ψ depends on the time.
    const AUTONOMOUS: bool;
    /// How the implicit equation of a step is solved.
    const SOLVABILITY: Solvability;
    /// Whether f = A x + b with A and b depending on parameters alone. Then they can be read off
    /// f at the origin and far out along each axis, and the flow is exact.
    const AFFINE: bool = false;

    /// Whether a guard of the region keeps the sign that it has where the region is entered.
    const KEEPS_SIGNS: bool = false;

    /// The interfaces that bound the region, and its guards.
    fn boundary(&self) -> &Self::Boundary;

    /// The flow with guards that are positive at (t, x), of those that keep a sign.
    fn oriented(&self, _t: S, _x: &Vector<S, N>) -> Self {
        self.clone()
    }

    /// f(t, x)
    fn vector_field(&self, t: S, x: &Vector<S, N>) -> Vector<S, N>;

    /// ψ(t, x)
    fn conserved(&self, t: S, x: &Vector<S, N>) -> Vector<S, M>;

    /// Σ|terms of ψ(t, x)|, the size that the rounding error of ψ is measured against.
    fn conserved_size(&self, t: S, x: &Vector<S, N>) -> Vector<S, M>;

    /// ψ(t, x) and the multiplier Λ = ∇ψ(t, x).
    fn multiplier(&self, t: S, x: &Vector<S, N>) -> (Vector<S, M>, Matrix<S, M, N>);

    /// f^τ(t₀, x₀, t₁, x₁)
    fn discrete_vector_field(
        &self,
        t0: S,
        x0: &Vector<S, N>,
        t1: S,
        x1: &Vector<S, N>,
    ) -> Vector<S, N>;

    /// f^τ(t₀, x₀, t₁, x₁) and ∂f^τ/∂x₁.
    fn linearised(
        &self,
        t0: S,
        x0: &Vector<S, N>,
        t1: S,
        x1: &Vector<S, N>,
    ) -> (Vector<S, N>, Matrix<S, N, N>);

    /// ∂f^τ/∂t₁; zero, and not emitted, where the flow is autonomous.
    fn time_derivative(
        &self,
        _t0: S,
        _x0: &Vector<S, N>,
        _t1: S,
        _x1: &Vector<S, N>,
    ) -> Vector<S, N> {
        Vector::from_element(S::from_f64(0.0))
    }

    /// The Taylor coefficients x₀ … x_{P−1} of the solution's N components, and of what f is
    /// computed from: an array of P coefficients each, the components first.
    type Series<const P: usize>: Clone + AsRef<[[S; P]]> + AsMut<[[S; P]]>;

    /// Whether [`Flow::advance`] is straight-line code for each order.
    type Unrolled: Unroll;

    /// Room for the coefficients.
    fn series<const P: usize>() -> Self::Series<P>;

    /// From the coefficients up to order k, those of order k + 1 of the solution, at time t. Of
    /// the order 0 only those of the components are given.
    fn advance<K: Order, const P: usize>(&self, k: K, t: S, series: &mut Self::Series<P>);
}

/// The interfaces that bound a region.
///
/// Functions take the index of the interface in [`System::INTERFACES`]. Behind the interfaces
/// follow the [`System::GUARDS`], which are positive where their conditions hold: the first one
/// has the index `INTERFACES.len()`.
pub trait Boundary<S: Scalar, const N: usize>: Clone {
    /// The indices of the interfaces that bound the region, with its side, and those of its guards.
    const SIDES: &'static [(usize, Side)];
    /// Whether no g depends on the time.
    const AUTONOMOUS: bool;
    /// The degree of every g as a polynomial in t and x, if each is one: 1 where ∂ₜg and ∇g depend
    /// on parameters alone.
    const DEGREE: Option<u32> = None;
    /// Whether every g is affine in t and x.
    const AFFINE: bool = matches!(Self::DEGREE, Some(0..=1));
    /// Whether the Taylor coefficients of every g along a solution fall off like those of the
    /// solution: those of a polynomial of low degree do. Those of any other function may have a
    /// radius of convergence of their own.
    const FOLLOWS_STATE: bool = matches!(Self::DEGREE, Some(0..=4));

    /// One value for each entry of [`Boundary::SIDES`]: the array `[T; SIDES.len()]`.
    type Each<T: Copy>: Copy + AsRef<[T]> + AsMut<[T]>;

    /// The array of `value(0)`, `value(1)`, …
    fn each<T: Copy>(value: impl FnMut(usize) -> T) -> Self::Each<T>;

    /// The same interfaces over other scalars.
    type Over<Other: Scalar>: Boundary<Other, N>;

    /// The interfaces over other scalars; see [`Flow::over`].
    fn over<Other: Scalar>(&self) -> Self::Over<Other>;

    /// The same with guards that are positive at (t, x); see [`Flow::oriented`].
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

    /// The Taylor coefficients of every g, in the order of [`System::INTERFACES`] and
    /// [`System::GUARDS`], and of what they
    /// are computed from.
    type Series<const P: usize>: Clone + AsRef<[[S; P]]> + AsMut<[[S; P]]>;

    /// Whether [`Boundary::advance`] is straight-line code for each order.
    type Unrolled: Unroll;

    /// Room for the coefficients.
    fn series<const P: usize>() -> Self::Series<P>;

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

/// The boundary of a region that has none.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Unbounded;

impl<S: Scalar, const N: usize> Boundary<S, N> for Unbounded {
    const SIDES: &'static [(usize, Side)] = &[];
    const AUTONOMOUS: bool = true;
    const DEGREE: Option<u32> = Some(0);

    type Each<T: Copy> = [T; 0];
    type Over<Other: Scalar> = Self;

    fn over<Other: Scalar>(&self) -> Self {
        Self
    }

    fn each<T: Copy>(value: impl FnMut(usize) -> T) -> [T; 0] {
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

    fn series<const P: usize>() -> [[S; P]; 0] {
        []
    }

    fn advance<K: Order, const P: usize>(&self, _: K, _: S, _: &[[S; P]], _: &mut [[S; P]; 0]) {}
}
