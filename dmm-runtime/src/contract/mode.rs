//! A mode that is more than a region: what is constant between events belongs to it.

use super::{Metadata, Side};

/// A region with what is constant between events: the D discrete states, and on which sides of F
/// interfaces the solution is that have events or that formulas switch at. It is the [`System::Region`](crate::System::Region)
/// of a system that has such; of any other system that is the enumeration of its regions.
///
/// ```
/// use dmm_runtime::{Integrator, Taylor, pws};
///
/// pws! {
///     /// A ball that bounces, and counts.
///     pub system Ball {
///         state y, v;
///         discrete bounces = 0;
///         interface floor = y;
///         der(y) = v;
///         der(v) = -1;
///         on floor falling {
///             v = -v;
///             bounces = bounces + 1;
///         }
///     }
/// }
///
/// let solution = Integrator::new(&Ball {}, Taylor::tolerance(1e-12))
///     .initial(0.0, [0.5, 0.0])
///     .run_until(10.0)?;
/// let mode = solution.last().map(|point| point.region).ok_or("no point")?;
/// assert_eq!((mode.region, mode.discrete), (BallRegion::Everywhere, [5.0]));
/// assert!((solution.transitions()[4].t - 9.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Mode<R, const D: usize, const F: usize> {
    /// The region.
    pub region: R,
    /// The discrete states, in the order of [`Metadata::discrete`].
    pub discrete: [f64; D],
    /// The sides of the interfaces in [`Metadata::free`]; nothing for those that it slides on.
    pub sides: [Option<Side>; F],
}

impl<R: Copy, const D: usize, const F: usize> Mode<R, D, F> {
    /// A region, with discrete states.
    pub fn new(region: R, discrete: [f64; D]) -> Self {
        Self {
            region,
            discrete,
            sides: [Some(Side::Positive); F],
        }
    }

    /// Constant number `index`: the discrete states, then for each side 1 where g > 0 and 0 where
    /// g < 0, then for each of them 1 where it slides on g = 0 and 0 elsewhere.
    pub fn constant(&self, index: usize) -> f64 {
        if let Some(&value) = self.discrete.get(index) {
            return value;
        }
        let place = index - D;
        let is_one = match self.sides.get(place) {
            Some(side) => *side != Some(Side::Negative),
            None => self.sides.get(place - F) == Some(&None),
        };
        f64::from(u8::from(is_one))
    }

    /// The same with another value of a discrete state.
    pub fn with_constant(mut self, index: usize, value: f64) -> Self {
        if let Some(discrete) = self.discrete.get_mut(index) {
            *discrete = value;
        }
        self
    }

    /// The region on the sides of all interfaces, with the discrete states of another mode.
    pub fn on(mut self, metadata: &Metadata, sides: &[Option<Side>], like: Option<Self>) -> Self {
        if let Some(like) = like {
            self.discrete = like.discrete;
        }
        for (own, &interface) in self.sides.iter_mut().zip(metadata.free) {
            if let Some(&side) = sides.get(interface) {
                *own = side;
            }
        }
        self
    }

    /// On which side of an interface the mode lies, whose region has an index.
    pub fn side(&self, metadata: &Metadata, index: usize, interface: usize) -> Option<Side> {
        let region = metadata.regions.get(index)?;
        region.side(interface).or_else(|| {
            let place = metadata.free.iter().position(|&one| one == interface)?;
            self.sides.get(place).copied().flatten()
        })
    }

    /// Whether the mode, whose region has an index, slides on an interface.
    pub fn slides_on(&self, metadata: &Metadata, index: usize, interface: usize) -> bool {
        let region = metadata.regions.get(index);
        let free = metadata.free.iter().zip(&self.sides);
        let mut free = free.filter(|(one, _)| **one == interface);
        region.is_some_and(|region| region.on.contains(&interface))
            || free.any(|(_, side)| side.is_none())
    }
}
