//! A system whose time runs backwards.
//!
//! With s = −t the solution x̃(s) = x(−s) satisfies
//!
//! dx̃/ds = −f(−s, x̃),  g̃(s, x̃) = g(−s, x̃),  ψ̃(s, x̃) = ψ(−s, x̃).
//!
//! Everything that is derived of a mode follows from that: f̃^τ(s₀, x₀, s₁, x₁) = −f^τ(−s₀, x₀, −s₁, x₁),
//! for which Λ^τ f̃^τ + ∂ₛ^τψ̃ = 0 as before, and the Taylor coefficients of odd order change their
//! sign. So the reversed dynamics are the forward ones between two changes of sign, and are compiled
//! for the systems that they are asked for.

use super::{
    Dynamics, DynamicsVisitor, Guards, Metadata, RegionMetadata, Side, Solvability, System,
};
use crate::arithmetic::{Matrix, Scalar, Vector};
use crate::series::Order;

/// A system backwards in time,
///
/// dx/ds = −f(−s, x),  s = −t,
///
/// with the same interfaces, regions and conserved quantities: to integrate from t₀ to an earlier
/// t₁, integrate it from s = −t₀ to s = −t₁. All methods conserve and locate as they do forwards.
///
/// A system with events is refused: what a state was before a jump does not follow from what it is
/// behind it. So is one that slides: many motions go on as the same sliding one.
///
/// Times are those of s: of the points and transitions of a solution, of output times, of errors.
/// Where the field of a region leads away from an interface forwards, it leads towards it backwards;
/// so a start that is ambiguous forwards slides backwards.
///
/// ```
/// use dmm_runtime::{Best, Integrator, Reversed, pws};
///
/// pws! {
///     /// A ball between two springs, the lower one of which stiffens with time.
///     pub system Ball {
///         state x, v;
///         interface spring = x;
///         region free where spring > 0 { der(x) = v; der(v) = -1; }
///         region pressed where spring < 0 { der(x) = v; der(v) = -1 - (4 + t)*x; }
///     }
/// }
///
/// let ball = Ball {};
/// let forwards = Integrator::new(&ball, Best::tolerance(1e-14))
///     .initial(0.0, [1.0, 0.0])
///     .run_until(10.0)?;
/// let end = forwards.at(10.0)?;
/// let backwards = Integrator::new(&Reversed(ball), Best::tolerance(1e-14))
///     .initial(-10.0, end)
///     .run_until(0.0)?;
/// let start = backwards.at(-0.0)?;
/// assert!((start[0] - 1.0).abs() < 1e-12 && start[1].abs() < 1e-12, "{start}");
/// let (last, first) = (forwards.transitions().last(), backwards.transitions().first());
/// let (last, first) = (last.expect("a bounce"), first.expect("the same"));
/// assert!((last.t + first.t).abs() < 1e-12);
/// assert_eq!((last.from, last.to), (first.to, first.from));
/// # Ok::<(), dmm_runtime::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Reversed<Sys>(
    /// The system forwards in time.
    pub Sys,
);

impl<Sys: System<N>, const N: usize> System<N> for Reversed<Sys> {
    type Region = Sys::Region;

    const IS_INTERPRETED: bool = Sys::IS_INTERPRETED;

    fn metadata(&self) -> &'static Metadata {
        self.0.metadata()
    }

    fn declaration(&self) -> &str {
        self.0.declaration()
    }

    fn listing(&self) -> &str {
        self.0.listing()
    }

    fn region(&self, index: usize) -> Option<Self::Region> {
        self.0.region(index)
    }

    fn index(region: Self::Region) -> usize {
        Sys::index(region)
    }

    fn parameters(&self) -> Vec<f64> {
        self.0.parameters()
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        self.0.parameter_mut(index)
    }

    fn visit<V: DynamicsVisitor<N>>(&self, region: Self::Region, visitor: V) -> V::Output {
        self.0.visit(region, Backwards(visitor))
    }

    fn visit_with<S: Scalar, V: DynamicsVisitor<N, S>>(
        &self,
        region: Self::Region,
        parameter: impl Fn(usize) -> S,
        visitor: V,
    ) -> V::Output {
        self.0.visit_with(region, parameter, Backwards(visitor))
    }

    fn of_region(&self, region: Self::Region) -> &'static RegionMetadata {
        self.0.of_region(region)
    }

    fn side(&self, region: Self::Region, interface: usize) -> Option<Side> {
        self.0.side(region, interface)
    }

    fn neighbour(&self, region: Self::Region, interface: usize) -> Option<Self::Region> {
        self.0.neighbour(region, interface)
    }

    fn region_on(
        &self,
        sides: &[Option<Side>],
        like: Option<Self::Region>,
    ) -> Option<Self::Region> {
        self.0.region_on(sides, like)
    }

    fn slides_on(&self, region: Self::Region, interface: usize) -> bool {
        self.0.slides_on(region, interface)
    }

    fn constants(region: Self::Region) -> Vec<f64> {
        Sys::constants(region)
    }

    fn refusal(&self) -> Option<&'static str> {
        let metadata = self.metadata();
        if !metadata.sliding.is_empty() {
            return Some(
                "slides, and where a solution came to an interface is not known from there",
            );
        }
        let has_events = !metadata.events.is_empty();
        has_events
            .then_some("has events, before which the state is not known from that behind them")
    }
}

/// A visitor that is shown the dynamics of each mode backwards.
struct Backwards<V>(V);

impl<V: DynamicsVisitor<N, S>, S: Scalar, const N: usize> DynamicsVisitor<N, S> for Backwards<V> {
    type Output = V::Output;

    fn visit<const M: usize, F: Dynamics<S, N, M>>(self, dynamics: &F) -> V::Output {
        self.0.visit(&ReversedDynamics::new(dynamics.clone()))
    }
}

/// Changes the sign of the coefficients of odd order: u(t + h) becomes u(t − h).
fn mirror<S: Scalar, const P: usize>(series: &mut [[S; P]]) {
    for coefficients in series {
        for coefficient in coefficients.iter_mut().skip(1).step_by(2) {
            *coefficient = -*coefficient;
        }
    }
}

/// The dynamics of a mode backwards, with its guards.
#[derive(Clone)]
struct ReversedDynamics<F, G> {
    forwards: F,
    guards: ReversedGuards<G>,
}

impl<F, G> ReversedDynamics<F, G> {
    fn new<S: Scalar, const N: usize, const M: usize>(forwards: F) -> Self
    where
        F: Dynamics<S, N, M, Guards = G>,
        G: Guards<S, N>,
    {
        let guards = ReversedGuards(forwards.guards().clone());
        Self { forwards, guards }
    }
}

impl<F, S: Scalar, const N: usize, const M: usize> Dynamics<S, N, M>
    for ReversedDynamics<F, F::Guards>
where
    F: Dynamics<S, N, M>,
{
    type Guards = ReversedGuards<F::Guards>;
    type Over<Other: Scalar> =
        ReversedDynamics<F::Over<Other>, <F::Over<Other> as Dynamics<Other, N, M>>::Guards>;

    fn over<Other: Scalar>(&self) -> Self::Over<Other> {
        ReversedDynamics::new(self.forwards.over::<Other>())
    }

    const AFFINE: Option<bool> = F::AFFINE;

    fn is_autonomous(&self) -> bool {
        self.forwards.is_autonomous()
    }

    fn solvability(&self) -> Solvability {
        self.forwards.solvability()
    }

    fn is_affine(&self) -> bool {
        self.forwards.is_affine()
    }

    fn quantities(&self) -> usize {
        self.forwards.quantities()
    }

    fn is_affine_quantity(&self, quantity: usize) -> bool {
        self.forwards.is_affine_quantity(quantity)
    }

    fn keeps_signs(&self) -> bool {
        self.forwards.keeps_signs()
    }

    fn guards(&self) -> &Self::Guards {
        &self.guards
    }

    fn sides(&self) -> &[(usize, Side)] {
        self.forwards.sides()
    }

    fn oriented(&self, t: S, x: &Vector<S, N>) -> Self {
        Self::new(self.forwards.oriented(-t, x))
    }

    fn vector_field(&self, t: S, x: &Vector<S, N>) -> Vector<S, N> {
        self.forwards.vector_field(-t, x).map(S::neg)
    }

    fn jacobian(&self, t: S, x: &Vector<S, N>) -> Matrix<S, N, N> {
        self.forwards.jacobian(-t, x).map(S::neg)
    }

    fn conserved(&self, t: S, x: &Vector<S, N>) -> Vector<S, M> {
        self.forwards.conserved(-t, x)
    }

    fn conserved_size(&self, t: S, x: &Vector<S, N>) -> Vector<S, M> {
        self.forwards.conserved_size(-t, x)
    }

    fn multiplier(&self, t: S, x: &Vector<S, N>) -> (Vector<S, M>, Matrix<S, M, N>) {
        self.forwards.multiplier(-t, x)
    }

    fn discrete_vector_field(
        &self,
        t0: S,
        x0: &Vector<S, N>,
        t1: S,
        x1: &Vector<S, N>,
    ) -> Vector<S, N> {
        let field = self.forwards.discrete_vector_field(-t0, x0, -t1, x1);
        field.map(S::neg)
    }

    fn linearised(
        &self,
        t0: S,
        x0: &Vector<S, N>,
        t1: S,
        x1: &Vector<S, N>,
    ) -> (Vector<S, N>, Matrix<S, N, N>) {
        let (field, jacobian) = self.forwards.linearised(-t0, x0, -t1, x1);
        (field.map(S::neg), jacobian.map(S::neg))
    }

    fn time_derivative(&self, t0: S, x0: &Vector<S, N>, t1: S, x1: &Vector<S, N>) -> Vector<S, N> {
        // two changes of sign
        self.forwards.time_derivative(-t0, x0, -t1, x1)
    }

    type Series<const P: usize> = F::Series<P>;
    type Unrolled = F::Unrolled;

    fn series<const P: usize>(&self) -> Self::Series<P> {
        self.forwards.series()
    }

    fn advance<K: Order, const P: usize>(&self, k: K, t: S, series: &mut Self::Series<P>) {
        mirror(series.as_mut());
        self.forwards.advance(k, -t, series);
        mirror(series.as_mut());
    }
}

/// The guards of a mode backwards.
#[derive(Clone)]
struct ReversedGuards<G>(G);

impl<G: Guards<S, N>, S: Scalar, const N: usize> Guards<S, N> for ReversedGuards<G> {
    const MAY_END: bool = G::MAY_END;
    const AFFINE: Option<bool> = G::AFFINE;
    const MAY_LEAVE_STATE: bool = G::MAY_LEAVE_STATE;

    fn sides(&self) -> &[(usize, Side)] {
        self.0.sides()
    }

    fn is_condition(&self, guard: usize) -> bool {
        self.0.is_condition(guard)
    }

    fn is_autonomous(&self) -> bool {
        self.0.is_autonomous()
    }

    fn degree(&self) -> Option<u32> {
        self.0.degree()
    }

    type Each<T: Copy> = G::Each<T>;

    fn each<T: Copy>(&self, value: impl FnMut(usize) -> T) -> Self::Each<T> {
        self.0.each(value)
    }

    type Over<Other: Scalar> = ReversedGuards<G::Over<Other>>;

    fn over<Other: Scalar>(&self) -> Self::Over<Other> {
        ReversedGuards(self.0.over())
    }

    fn oriented(&self, t: S, x: &Vector<S, N>) -> Self {
        Self(self.0.oriented(-t, x))
    }

    fn switching_function(&self, interface: usize, t: S, x: &Vector<S, N>) -> S {
        self.0.switching_function(interface, -t, x)
    }

    fn switching_size(&self, interface: usize, t: S, x: &Vector<S, N>) -> S {
        self.0.switching_size(interface, -t, x)
    }

    fn switching_gradient(&self, interface: usize, t: S, x: &Vector<S, N>) -> (S, Vector<S, N>) {
        let (by_time, gradient) = self.0.switching_gradient(interface, -t, x);
        (-by_time, gradient)
    }

    type Series<const P: usize> = G::Series<P>;
    type Unrolled = G::Unrolled;

    fn series<const P: usize>(&self) -> Self::Series<P> {
        self.0.series()
    }

    fn advance<K: Order, const P: usize>(
        &self,
        k: K,
        t: S,
        states: &[[S; P]],
        series: &mut Self::Series<P>,
    ) {
        let zero = [S::from_f64(0.0); P];
        let mut forwards: [[S; P]; N] =
            std::array::from_fn(|i| states.get(i).copied().unwrap_or(zero));
        mirror(&mut forwards);
        mirror(series.as_mut());
        self.0.advance(k, -t, &forwards, series);
        mirror(series.as_mut());
    }
}
