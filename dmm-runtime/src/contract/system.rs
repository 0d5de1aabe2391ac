//! A system: its modes, their names, and the way to the dynamics of each.

use std::fmt::Debug;

use super::{Dynamics, DynamicsVisitor, Guards, Metadata, RegionMetadata, Side};
use crate::arithmetic::{Scalar, Vector};

/// A piecewise-smooth system with N states: ẋ = fᵣ(t, x) while x is in region r
/// (Hirani, Wan & Wojtalewicz, eq. 1.1).
///
/// Implemented by `pws!`.
pub trait System<const N: usize>: Clone + Debug + Send + Sync + 'static {
    /// The regions; an enumeration emitted beside the system. Of a system with events it is a
    /// [`Mode`](crate::Mode), a region with what is constant between events.
    type Region: Copy + PartialEq + Debug + Send + Sync + 'static;

    /// Whether formulas are evaluated operation by operation. Beside that it costs nothing to ask whether
    /// anybody is told of a point, and silent runs are not compiled apart from observed ones.
    const IS_INTERPRETED: bool = false;

    /// Names and signs: what is known of the system besides its functions.
    fn metadata(&self) -> &'static Metadata;

    /// The declaration, as text.
    fn declaration(&self) -> &str;

    /// The derived scheme in readable mathematics.
    fn listing(&self) -> &str;

    /// The region with an index in [`Metadata::regions`]; discrete states have their initial values.
    fn region(&self, index: usize) -> Option<Self::Region>;

    /// The index of a region in [`Metadata::regions`].
    fn index(region: Self::Region) -> usize;

    /// The parameters, in the order of [`Metadata::parameters`].
    fn parameters(&self) -> Vec<f64>;

    /// The parameter at `index`, to be changed; nothing if there are not so many.
    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64>;

    /// Calls `visitor` with the dynamics of `region`, monomorphised for it.
    fn visit<V: DynamicsVisitor<N>>(&self, region: Self::Region, visitor: V) -> V::Output;

    /// The same with parameters of any scalar, in the order of [`Metadata::parameters`]: those of
    /// several systems at once, for example.
    fn visit_with<S: Scalar, V: DynamicsVisitor<N, S>>(
        &self,
        region: Self::Region,
        parameter: impl Fn(usize) -> S,
        visitor: V,
    ) -> V::Output;

    /// Every region, in the order of declaration.
    fn regions(&self) -> impl Iterator<Item = Self::Region> {
        let regions = 0..self.metadata().regions.len();
        regions.filter_map(|index| self.region(index))
    }

    /// The name, the sides and the conserved quantities of a region.
    #[inline]
    fn of_region(&self, region: Self::Region) -> &'static RegionMetadata {
        const UNKNOWN: &RegionMetadata = &RegionMetadata::UNKNOWN;
        let regions = self.metadata().regions;
        regions.get(Self::index(region)).unwrap_or(UNKNOWN)
    }

    /// The region on these sides of the interfaces, in the order of [`Metadata::interfaces`], of which
    /// nothing stands for those that it slides on. Where there are discrete states, they are those of
    /// `like`, or the initial ones.
    fn region_on(
        &self,
        sides: &[Option<Side>],
        _like: Option<Self::Region>,
    ) -> Option<Self::Region> {
        self.region(self.metadata().region_on(sides)?)
    }

    /// Whether a mode slides on an interface.
    fn slides_on(&self, region: Self::Region, interface: usize) -> bool {
        self.of_region(region).on.contains(&interface)
    }

    /// What is constant in a mode: the values of the discrete states, then 1 for each interface of
    /// [`Metadata::free`] where g > 0, and 0 where g < 0; where switches slide, then 1 for each that
    /// the mode slides on, and 0 for the others.
    fn constants(_region: Self::Region) -> Vec<f64> {
        Vec::new()
    }

    /// A mode with another value of the discrete state at an index.
    fn with_constant(region: Self::Region, _index: usize, _value: f64) -> Self::Region {
        region
    }

    /// Why the system cannot be integrated, if it cannot.
    fn refusal(&self) -> Option<&'static str> {
        None
    }

    /// The state and the mode after event number `event` of [`Metadata::events`]; nothing where a
    /// condition of it does not hold.
    fn jump(
        &self,
        region: Self::Region,
        event: usize,
        t: f64,
        state: &Vector<f64, N>,
    ) -> Option<(Vector<f64, N>, Self::Region)> {
        let parameters = self.parameters();
        let (state, discrete) =
            self.jump_with(region, event, t, state, |index| parameters[index])?;
        let values = discrete.into_iter().enumerate();
        let mode = values.fold(region, |mode, (index, value)| {
            Self::with_constant(mode, index, value)
        });
        Some((state, mode))
    }

    /// The states and the discrete states after event number `event`, with a state and parameters of
    /// any scalar; see [`System::visit_with`].
    fn jump_with<S: Scalar>(
        &self,
        _region: Self::Region,
        _event: usize,
        _t: S,
        _state: &Vector<S, N>,
        _parameter: impl Fn(usize) -> S,
    ) -> Option<(Vector<S, N>, Vec<S>)> {
        None
    }

    /// On which side of an interface a region lies, if the interface bounds it.
    #[inline]
    fn side(&self, region: Self::Region, interface: usize) -> Option<Side> {
        self.of_region(region).side(interface)
    }

    /// The region on the other side of an interface that bounds a region, if it is the only one:
    /// where several regions lie there, the other interfaces decide between them.
    #[inline]
    fn neighbour(&self, region: Self::Region, interface: usize) -> Option<Self::Region> {
        let neighbour = self.of_region(region).neighbours.get(interface)?;
        self.region((*neighbour)?)
    }

    /// ψ(t, x), the quantities that are conserved in `region`, in the order of
    /// [`RegionMetadata::conserved`]. The point need not lie in the region.
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
    /// let oscillator = Oscillator {};
    /// let psi = oscillator.conserved(region, 0.0, &[3.0, 4.0].into());
    /// assert_eq!(oscillator.of_region(region).conserved, ["energy"]);
    /// assert_eq!(psi, [12.5]);
    /// ```
    fn conserved(&self, region: Self::Region, t: f64, x: &Vector<f64, N>) -> Vec<f64> {
        self.visit(region, Conserved { t, x })
    }

    /// f(t, x), the vector field of `region`. The point need not lie in the region; where a formula
    /// has no value there, entries are NaN or infinite. For an example see
    /// [the guide](crate::guide#f-g-and-ψ-at-a-point).
    fn vector_field(&self, region: Self::Region, t: f64, x: &Vector<f64, N>) -> Vector<f64, N> {
        self.visit(region, Field { t, x })
    }

    /// g(t, x), the switching function of an interface, by its index in [`Metadata::interfaces`];
    /// nothing if there are not so many. For an example see
    /// [the guide](crate::guide#f-g-and-ψ-at-a-point).
    fn switching_function(&self, interface: usize, t: f64, x: &Vector<f64, N>) -> Option<f64> {
        if interface >= self.metadata().interfaces.len() {
            return None;
        }
        // it is the same function in every region
        let region = self.region(0)?;
        Some(self.visit(region, Switching { interface, t, x }))
    }
}

/// f(t, x)
struct Field<'a, const N: usize> {
    t: f64,
    x: &'a Vector<f64, N>,
}

impl<const N: usize> DynamicsVisitor<N> for Field<'_, N> {
    type Output = Vector<f64, N>;

    fn visit<const M: usize, F: Dynamics<f64, N, M>>(self, dynamics: &F) -> Vector<f64, N> {
        dynamics.vector_field(self.t, self.x)
    }
}

/// g(t, x)
struct Switching<'a, const N: usize> {
    interface: usize,
    t: f64,
    x: &'a Vector<f64, N>,
}

impl<const N: usize> DynamicsVisitor<N> for Switching<'_, N> {
    type Output = f64;

    fn visit<const M: usize, F: Dynamics<f64, N, M>>(self, dynamics: &F) -> f64 {
        let guards = dynamics.guards();
        guards.switching_function(self.interface, self.t, self.x)
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
        let psi = dynamics.conserved(self.t, self.x);
        psi.iter().copied().take(dynamics.quantities()).collect()
    }
}
