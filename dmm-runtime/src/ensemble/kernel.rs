//! Steps of all lanes of a register, which are in the same region.

use std::hint::black_box;

use super::ends::course;
use super::level::Place;
use super::register::{Register, WIDTH, Wide};
use crate::arithmetic::Scalar;
use crate::arithmetic::error_free::two_sum;
use crate::arithmetic::lanes::Mask;
use crate::contract::{Dynamics, DynamicsVisitor, Guards, Vector};
use crate::events::ends::Decay;
use crate::expansion::jet::{GuardsUnrolled, expand, first_switching};
use crate::expansion::polynomial::increment;
use crate::expansion::radius::{FASTEST, LARGEST_DECISIVE, SMALLEST_DECISIVE};

/// Halvings of a step of which the ends do not tell enough.
const MOST_HALVINGS: u32 = 2;
/// The order of all steps. Straight-line code for several trajectories takes long to compile, so
/// there is one order, next to the best one at every tolerance.
pub(super) const ORDER: usize = 18;
const COEFFICIENTS: usize = ORDER + 1;
/// A longer step costs more than it gains, because its ends do not tell enough of it.
pub(super) const LONGEST: f64 = 0.4;

/// What is to be done.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Job {
    /// Steps, until a lane needs attention.
    Step,
    /// The same from the entry into the region, which may have been at an interface.
    Enter(Option<usize>),
    /// To move to the interface that all of them cross in their next step.
    Cross(usize),
}

/// The same for all trajectories.
#[derive(Clone, Copy, Debug)]
pub(super) struct Settings {
    pub(super) end: f64,
    /// The part of the radius of convergence that a step takes.
    pub(super) fraction: f64,
    pub(super) decay: Decay,
    pub(super) corrects: bool,
}

/// The register with what is to be done.
pub(super) struct Kernel<'a, const N: usize> {
    pub(super) register: &'a mut Register<N>,
    pub(super) settings: &'a Settings,
    pub(super) job: Job,
}

impl<const N: usize> DynamicsVisitor<N, Wide> for Kernel<'_, N> {
    type Output = ();

    #[inline(always)]
    fn visit<const M: usize, F: Dynamics<Wide, N, M>>(self, dynamics: &F) {
        let mut series = dynamics.series::<COEFFICIENTS>();
        let mut run = Run::<F, N, M> {
            register: self.register,
            settings: self.settings,
            dynamics,
            // in memory, where the compiler finds what belongs into one register
            series: black_box(&mut series),
        };
        let mut entry = Entry::default();
        if let Job::Enter(interface) = self.job {
            entry = run.enter(interface);
        }
        loop {
            run.expand();
            if let Job::Cross(interface) = self.job {
                return run.cross(interface);
            }
            if run.step(&entry) {
                return;
            }
            entry = Entry::default();
        }
    }
}

/// A kernel in a mode.
pub(super) struct Run<'a, F: Dynamics<Wide, N, M>, const N: usize, const M: usize> {
    pub(super) register: &'a mut Register<N>,
    pub(super) settings: &'a Settings,
    pub(super) dynamics: &'a F,
    series: &'a mut F::Series<COEFFICIENTS>,
}

/// How the lanes have come to where a step starts.
#[derive(Default)]
struct Entry {
    /// There was no step in this region before.
    enters: bool,
    /// They are on this interface …
    interface: Option<usize>,
    /// … but these are not led into the region.
    barred: Option<Mask<WIDTH>>,
}

/// What the lanes meet in a step.
struct Ahead {
    hard: Mask<WIDTH>,
    crosses: Mask<WIDTH>,
    elapsed: Wide,
    interface: Wide,
}

impl<const N: usize> Register<N> {
    /// Where the lanes are.
    #[inline(always)]
    pub(super) fn place(&self) -> Place<N> {
        Place {
            t: self.t,
            t_remainder: self.t_remainder,
            x: self.x,
            remainder: self.remainder,
        }
    }

    /// Moves the lanes of a mask.
    #[inline(always)]
    pub(super) fn move_to(&mut self, moved: Mask<WIDTH>, place: &Place<N>) {
        self.t = moved.select(place.t, self.t);
        self.t_remainder = moved.select(place.t_remainder, self.t_remainder);
        for i in 0..N {
            self.x[i] = moved.select(place.x[i], self.x[i]);
            self.remainder[i] = moved.select(place.remainder[i], self.remainder[i]);
        }
    }
}

/// Where a place has finite coordinates.
#[inline(always)]
pub(super) fn is_finite<const N: usize>(place: &Place<N>) -> Mask<WIDTH> {
    let zero = Wide::from_f64(0.0);
    // 0·u is 0 for a finite u and NaN otherwise
    let sum = (0..N).fold(zero, |sum, i| sum + zero * place.x[i]);
    sum.equals(zero)
}

impl<F: Dynamics<Wide, N, M>, const N: usize, const M: usize> Run<'_, F, N, M> {
    /// The interfaces that bound the region, with its sides.
    #[inline(always)]
    fn sides(&self) -> &'_ [(usize, crate::contract::Side)] {
        self.dynamics.sides()
    }

    /// The sign of g in the region.
    #[inline(always)]
    fn sign(&self, interface: usize) -> f64 {
        let mut sides = self.sides().iter();
        let side = sides.find(|(other, _)| *other == interface);
        side.map_or(0.0, |(_, side)| side.sign())
    }

    /// The level of a region that is entered.
    #[inline(always)]
    fn enter(&mut self, interface: Option<usize>) -> Entry {
        self.register.enter_level(self.dynamics);
        let barred = interface.map(|interface| {
            let rate = self.approach(interface, &self.register.place()).rate;
            let inwards = Wide::from_f64(self.sign(interface)) * rate;
            inwards.above(Wide::from_f64(0.0)).not()
        });
        Entry {
            enters: true,
            interface,
            barred,
        }
    }

    /// The solution's coefficients.
    #[inline(always)]
    fn expand(&mut self) {
        let Register { t, x, .. } = &*self.register;
        let series = &mut *self.series;
        expand::<_, F, F::Unrolled, N, M, _>(self.dynamics, (*t, x), series, COEFFICIENTS, 1.0);
    }

    /// The steps that the tolerance allows, and where coefficients may have left the range of
    /// doubles; see [`crate::expansion::jet::Jet::step`].
    #[inline(always)]
    fn wanted(&self, enters: bool) -> (Wide, Mask<WIDTH>) {
        let zero = Wide::from_f64(0.0);
        let (mut last, mut second) = (zero, zero);
        let series = &self.series.as_ref()[..N];
        let largest = |k: usize| {
            series
                .iter()
                .fold(zero, |largest, c| largest.max(c[k].abs()))
        };
        for c in series {
            let mut size = c[1].abs().fused(self.register.before, c[0].abs());
            if enters {
                // there may have been no step before
                let first = largest(0).above(zero).select(largest(0), largest(1));
                size = self.register.before.above(zero).select(size, first);
            }
            let scale = Wide::from_f64(1.0) / size.max(Wide::from_f64(f64::MIN_POSITIVE));
            last = last.max(c[ORDER].abs() * scale);
            second = second.max(c[ORDER - 1].abs() * scale);
        }
        let radius = inverse_root(last, ORDER).min(inverse_root(second, ORDER - 1));
        let n = Wide::from_f64;
        // what is lost to underflow counts only in a time of powers as large
        let remaining = n(self.settings.end) - self.register.t;
        let is_long = remaining.above(n(FASTEST));
        let too_small = n(SMALLEST_DECISIVE).above(last).and(is_long);
        let too_large = n(LARGEST_DECISIVE).above(last).not();
        let step = n(self.settings.fraction) * radius;
        (step, too_small.or(too_large))
    }

    /// Σ xⱼ hʲ over j ≥ 1.
    #[inline(always)]
    fn increment(&self, h: Wide) -> Vector<Wide, N> {
        // a loop, as closures are not inlined for certain
        let mut sum: Vector<Wide, N> = Vector::from_element(Wide::from_f64(0.0));
        for (sum, series) in sum.iter_mut().zip(self.series.as_ref()) {
            *sum = increment(series, h).settled();
        }
        sum
    }

    /// The place after `elapsed`, without correction.
    #[inline(always)]
    pub(super) fn after(&self, elapsed: Wide) -> Place<N> {
        let mut place = self.register.place();
        place.add_time(elapsed);
        place.add(&self.increment(elapsed));
        place
    }

    /// Steps over `size`, or up to the end: their sizes, which are the last ones, and where they
    /// lead, without correction.
    #[inline(always)]
    fn reached(&self, size: Wide) -> (Wide, Mask<WIDTH>, Place<N>) {
        let n = Wide::from_f64;
        let (start, start_remainder) = (self.register.t, self.register.t_remainder);
        let (difference, error) = two_sum(n(self.settings.end), -start);
        let remaining = difference + (error - start_remainder);
        let last = size.above(remaining).or(size.equals(remaining));
        let mut tau = last.select(remaining, size);
        let mut place = self.register.place();
        if self.dynamics.is_autonomous() {
            place.add_time(tau);
        } else {
            // the formulas are evaluated at a double
            place.t = start + size;
            let (difference, error) = two_sum(place.t, -start);
            tau = last.select(remaining, difference + (error - start_remainder));
            place.t_remainder = n(0.0);
        }
        place.t = last.select(n(self.settings.end), place.t);
        place.t_remainder = last.select(n(0.0), place.t_remainder);
        place.add(&self.increment(tau));
        (tau, last, place)
    }

    /// A step of every lane, and whether one needs attention.
    #[inline(always)]
    fn step(&mut self, entry: &Entry) -> bool {
        let n = Wide::from_f64;
        let (start, start_remainder) = (self.register.t, self.register.t_remainder);
        let (wanted, out_of_range) = self.wanted(entry.enters);
        let wanted = wanted.settled();
        let mut size = wanted;
        let mut halvings = 0;
        let (tau, last, mut place, ahead) = loop {
            let (tau, last, place) = self.reached(size);
            let ahead = self.look_ahead(tau, &place, entry.interface);
            let near = ahead.hard.and(self.register.used());
            if halvings == MOST_HALVINGS || !near.any() {
                break (tau, last, place, ahead);
            }
            halvings += 1;
            size = near.select(n(0.5) * size, size);
        };
        if self.settings.corrects {
            self.register.correct(self.dynamics, &mut place);
        } else {
            place.normalise();
        }
        let stands = place
            .t
            .equals(start)
            .and(place.t_remainder.equals(start_remainder));
        let moves = tau.above(n(0.0)).and(stands.not());
        let mut hard = ahead.hard.or(is_finite(&place).not()).or(moves.not());
        hard = hard.or(out_of_range);
        if let Some(barred) = entry.barred {
            hard = hard.or(barred);
        }
        let moved = hard.or(ahead.crosses).not();
        self.register.move_to(moved, &place);
        self.register.before = moved.select(wanted, self.register.before);
        self.register.steps += moved.select(n(1.0), n(0.0));
        self.register.elapsed = ahead.elapsed;
        self.register.tau = tau;
        let crosses = (ahead.crosses, ahead.interface);
        self.register.note(hard, crosses, moved.and(last))
    }

    /// What the lanes meet in steps over `tau` that end at a place.
    #[inline(always)]
    fn look_ahead(&self, tau: Wide, place: &Place<N>, active: Option<usize>) -> Ahead {
        let none = Mask::all(false);
        let mut ahead = Ahead {
            hard: none,
            crosses: none,
            elapsed: Wide::from_f64(0.0),
            interface: Wide::from_f64(0.0),
        };
        if !<F::Guards as Guards<Wide, N>>::MAY_END {
            return ahead;
        }
        let field = self.dynamics.vector_field(place.t, &place.x);
        let (t, solution) = (self.register.t, self.series.as_ref());
        let first = first_switching::<_, F, GuardsUnrolled<_, F, N, M>, N, M, COEFFICIENTS>(
            self.dynamics,
            t,
            solution,
            1.0,
        );
        for &(interface, side) in self.sides() {
            let sign = Wide::from_f64(side.sign());
            let series = first.as_ref()[interface].map(|c| sign * c);
            let guards = self.dynamics.guards();
            let value = guards.switching_function(interface, place.t, &place.x);
            let (by_time, gradient) = guards.switching_gradient(interface, place.t, &place.x);
            let slope = (0..N).fold(by_time, |sum, i| gradient[i].fused(field[i], sum));
            let end = (sign * value, sign * slope);
            let active = active == Some(interface);
            let seen = course(&series, end, tau, self.settings.decay, active);
            ahead.hard = ahead.hard.or(seen.free.or(seen.falls).not());
            // one crossing or the other may come first
            ahead.hard = ahead.hard.or(seen.falls.and(ahead.crosses));
            ahead.crosses = ahead.crosses.or(seen.falls);
            ahead.elapsed = seen.falls.select(seen.elapsed, ahead.elapsed);
            let interface = Wide::from_f64(interface as f64);
            ahead.interface = seen.falls.select(interface, ahead.interface);
        }
        ahead
    }
}

/// m^(−1/k) for m > 0 in every lane; see [`crate::expansion::polynomial::inverse_root`]. Half of
/// the bits are enough for a step, and are multiplied by one instruction.
#[inline(always)]
fn inverse_root(m: Wide, k: usize) -> Wide {
    const ONE: i64 = 1023 << 52;
    let inverse = (1i64 << 31) / k as i64;
    let mut root = m;
    for root in &mut root.0 {
        let logarithm = (ONE - root.to_bits() as i64) >> 32;
        *root = f64::from_bits((ONE + ((logarithm * inverse) << 1)) as u64);
    }
    root
}
