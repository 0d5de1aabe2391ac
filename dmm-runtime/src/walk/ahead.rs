//! What a Taylor step meets: by the ends of the step, or a shorter one, where they tell enough; else
//! by all coefficients of g, or by enclosures of it.

use crate::events::cubic::Course;
use crate::events::ends::Ends;
use crate::events::switching::NOISE;
use crate::events::{Enclosed, Met, Path, Search};
use crate::linear::{dot, is_finite};
use crate::observer::Observer;
use crate::scalar::Scalar;
use crate::scheme::Taylor;
use crate::series::Unroll;
use crate::series::jet::Jet;
use crate::series::polynomial::{Roots, dips, first_root, root};
use crate::state::State;
use crate::system::{Boundary, Flow, Side, System};
use crate::time::Time;
use crate::transition::Locator;
use crate::walk::Walk;
use crate::walk::arrive::Found;
use crate::walk::expand::Here;

/// What a step meets.
pub(super) enum Ahead {
    /// No interface, or the step cannot be made at all.
    Free,
    /// An interface.
    Crossing(Found),
    /// It comes so close to an interface that a shorter step has to decide.
    Undecided(Part),
    /// Whether this interface is met cannot be decided.
    Unknown(usize),
}

/// A part of the step that the tolerance allows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) share: f64,
    /// Whether the error of such a step is below rounding.
    is_finest: bool,
}

impl Part {
    pub(super) const WHOLE: Self = Self {
        share: 1.0,
        is_finest: false,
    };

    /// Half of it. The ends of a shorter step tell more, at less than the cost of all coefficients
    /// of g, until that has been tried in vain.
    #[inline(always)]
    fn half(self) -> Option<Self> {
        const SMALLEST: f64 = 0.25;
        let half = Self {
            share: 0.5 * self.share,
            ..self
        };
        (half.share >= SMALLEST && !self.is_finest).then_some(half)
    }
}

impl<Sys, Loc, Obs, const N: usize> Walk<'_, Sys, Taylor, Loc, Obs, N>
where
    Sys: System<N>,
    Loc: Locator,
    Obs: Observer<Sys::Region, N>,
{
    /// The first crossing of a step that ends at `state`, if there is one.
    #[inline(always)]
    pub(super) fn look_ahead<const P: usize, const M: usize, F: Flow<f64, N, M>, U: Unroll>(
        &mut self,
        flow: &F,
        jet: &mut Jet<F, U, N, M, P>,
        here: &Here<N>,
        (tau, time, state): (f64, Time, &State<N>),
        (fresh, part): (Option<usize>, Part),
    ) -> Ahead {
        if !<F::Boundary as Boundary<f64, N>>::FOLLOWS_STATE {
            if !is_finite(&state.x) {
                return Ahead::Free;
            }
            return self.first_enclosed::<P, M, F, U>(flow, jet, here, tau, (fresh, part));
        }
        let field = flow.vector_field(time.value, &state.x);
        let ends = Ends {
            tau: jet.in_units(tau),
            decay: self.progress.decay,
        };
        let mut once: Option<Found> = None;
        let mut near = false;
        let series = jet.first_switching(flow, here.time.value);
        for &(interface, side) in sides::<N, M, F>() {
            let c = &series.as_ref()[interface];
            let boundary = flow.boundary();
            let value = boundary.switching_function(interface, time.value, &state.x);
            let (by_time, gradient) = boundary.switching_gradient(interface, time.value, &state.x);
            let slope = (by_time + dot(&gradient, &field)) * jet.unit();
            let fresh = fresh == Some(interface);
            match ends.course(c, (value, slope), side.sign(), fresh) {
                Course::Free => {}
                Course::Falls { from, at } => {
                    near |= once.is_some();
                    once = Some(Found {
                        interface,
                        sign: side.sign(),
                        elapsed: at * jet.unit(),
                        bracket: (from * jet.unit(), tau),
                        start: Some((c[0], jet.in_units(c[1]))),
                    });
                }
                Course::Unknown => near = true,
            }
        }
        match (near, once) {
            (true, _) => match part.half() {
                Some(half) => Ahead::Undecided(half),
                // the step cannot be made
                None if !is_finite(&state.x) => Ahead::Free,
                None if const { <F::Boundary as Boundary<f64, N>>::AFFINE } => {
                    self.first::<P, M, F, U>(flow, jet, here, tau, (fresh, part))
                }
                // between roots that are close g is smaller than the rounding errors of its series
                None => self.first_enclosed::<P, M, F, U>(flow, jet, here, tau, (fresh, part)),
            },
            (false, Some(found)) => Ahead::Crossing(found),
            (false, None) => Ahead::Free,
        }
    }

    /// The first crossing of a step by all coefficients of every g, which is affine. What comes as
    /// close to an interface as the error of the step, and returns, is left undecided.
    #[cold]
    #[inline(never)]
    fn first<const P: usize, const M: usize, F: Flow<f64, N, M>, U: Unroll>(
        &mut self,
        flow: &F,
        jet: &mut Jet<F, U, N, M, P>,
        here: &Here<N>,
        tau: f64,
        (fresh, part): (Option<usize>, Part),
    ) -> Ahead {
        let band = if part.is_finest {
            0.0
        } else {
            self.scheme.undecided()
        };
        let (t, x) = (here.time.value, &here.state.x);
        jet.expand_switching(flow, t);
        // in units, like the coefficients
        let tau = jet.in_units(tau);
        let mut first: Option<Found> = None;
        let mut horizon = tau;
        for &(interface, side) in sides::<N, M, F>() {
            let sign = side.sign();
            let series = jet.switching(interface).map(|c| sign * c);
            if !series.iter().all(|c| c.is_finite()) {
                return Ahead::Unknown(interface);
            }
            let size = flow.boundary().switching_size(interface, t, x);
            let noise = NOISE * f64::ROUNDING * size;
            let on_it = fresh == Some(interface) || (series[0] <= noise && series[1] > 0.0);
            // on the interface zero is a root, which is divided off
            let (series, part) = match on_it {
                true => (&series[1..], 1.0 / tau),
                false => (&series[..], 1.0),
            };
            let (noise, band) = (noise * part, band * size * part);
            if band > noise && dips(series, horizon, band) {
                return Ahead::Undecided(Part {
                    share: self.progress.finest,
                    is_finest: true,
                });
            }
            let Roots {
                first: found,
                touches,
            } = first_root(series, horizon, noise);
            self.statistics.grazes += u64::from(touches);
            if let Some((lower, upper)) = found {
                horizon = root(series, lower, upper);
                first = Some(Found {
                    interface,
                    sign,
                    elapsed: horizon * jet.unit(),
                    bracket: (lower * jet.unit(), upper * jet.unit()),
                    start: None,
                });
            }
        }
        first.map_or(Ahead::Free, Ahead::Crossing)
    }

    /// The first crossing of a step by enclosures of every g along the solution's polynomial: where
    /// its series may converge more slowly than that of the state, or the ends of the step do not
    /// tell enough.
    #[cold]
    #[inline(never)]
    fn first_enclosed<const P: usize, const M: usize, F: Flow<f64, N, M>, U: Unroll>(
        &mut self,
        flow: &F,
        jet: &Jet<F, U, N, M, P>,
        here: &Here<N>,
        tau: f64,
        (fresh, part): (Option<usize>, Part),
    ) -> Ahead {
        let path = Path {
            t0: here.time.value,
            unit: jet.unit(),
            coefficients: std::array::from_fn(|i| &jet.coefficients()[i][..]),
        };
        let enclosed = Enclosed::new(flow.boundary());
        let mut first: Option<Found> = None;
        let mut end = jet.in_units(tau);
        for &(interface, side) in sides::<N, M, F>() {
            let search = Search {
                switching: &enclosed,
                interface,
                sign: side.sign(),
                path: &path,
                end,
                level: 0.0,
            };
            let fresh = fresh == Some(interface);
            let (met, touches) = if part.is_finest {
                search.first(fresh)
            } else {
                let boundary = flow.boundary();
                let size =
                    |s: f64| boundary.switching_size(interface, path.time(s), &path.state(s));
                let size = size(0.0).max(size(end));
                search.first_clear(fresh, self.scheme.undecided() * size)
            };
            match met {
                Met::Nothing => {}
                Met::Crossing { lower, upper } => {
                    end = search.root(lower, upper);
                    first = Some(Found {
                        interface,
                        sign: side.sign(),
                        elapsed: end * jet.unit(),
                        bracket: (lower * jet.unit(), upper * jet.unit()),
                        start: None,
                    });
                }
                Met::Undecided(_) if part.is_finest => return Ahead::Unknown(interface),
                Met::Undecided(_) => {
                    return Ahead::Undecided(Part {
                        share: self.progress.finest,
                        is_finest: true,
                    });
                }
            }
            self.statistics.grazes += u64::from(touches);
        }
        first.map_or(Ahead::Free, Ahead::Crossing)
    }
}

/// The interfaces that bound the region of a flow, with its sides.
#[inline(always)]
pub(super) fn sides<const N: usize, const M: usize, F: Flow<f64, N, M>>() -> &'static [(usize, Side)]
{
    <F::Boundary as Boundary<f64, N>>::SIDES
}
