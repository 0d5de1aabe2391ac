//! A system: its modes, their names, and the way to the dynamics of each.

use std::fmt::Debug;

use super::{Condition, Dynamics, DynamicsVisitor, Side};
use crate::arithmetic::{Scalar, Vector};

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
    /// check them; see [`Condition`].
    const CONDITIONS: &'static [Condition] = &[];
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
    /// [`Guards::SIDES`](crate::Guards::SIDES) stands for.
    fn guard_name(index: usize) -> &'static str {
        let guard = index.checked_sub(Self::INTERFACES.len());
        let guard = guard.and_then(|number| Self::CONDITIONS.get(number));
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

    /// Calls `visitor` with the dynamics of `region`, monomorphised for it.
    fn visit<V: DynamicsVisitor<N>>(&self, region: Self::Region, visitor: V) -> V::Output;

    /// The same with parameters of any scalar, in the order of [`System::PARAMETERS`]: those of
    /// several systems at once, for example.
    fn visit_with<S: Scalar, V: DynamicsVisitor<N, S>>(
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

impl<const N: usize> DynamicsVisitor<N> for Conserved<'_, N> {
    type Output = Vec<f64>;

    fn visit<const M: usize, F: Dynamics<f64, N, M>>(self, dynamics: &F) -> Vec<f64> {
        dynamics.conserved(self.t, self.x).iter().copied().collect()
    }
}
