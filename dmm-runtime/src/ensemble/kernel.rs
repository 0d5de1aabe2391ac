//! Steps of all lanes of a register, which are in the same region.

use std::hint::black_box;

use super::register::{Register, Wide, WideMask};
use crate::arithmetic::lanes::Vectorised;
use crate::arithmetic::linear::{dot, is_finite};
use crate::arithmetic::masked::{Mask, Masked, vector};
use crate::arithmetic::{Scalar, State, Time};
use crate::contract::{Dynamics, DynamicsVisitor, Guards};
use crate::events::ends::{Decay, Ends};
use crate::expansion::jet::{FirstSeries, GuardsUnrolled, expand, first_switching};
use crate::expansion::polynomial::increment;
use crate::expansion::radius::{
    FASTEST, LARGEST_DECISIVE, SMALLEST_DECISIVE, decisive, decisive_terms, radius,
};
use crate::level::{Level, RESCALING, Turn};
use crate::method::taylor::step_to;

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
    /// Steps, until a lane needs attention; if all of them come to an interface together, they move
    /// to it.
    Step,
    /// The same from the entry into the region, which may have been at an interface.
    Enter(Option<usize>),
    /// To move to the interface that all of them cross in their next step.
    Cross(usize),
}

/// The same for all trajectories.
#[derive(Clone, Copy, Debug)]
pub(super) struct Settings {
    pub(super) vectorised: Vectorised,
    pub(super) end: f64,
    /// The part of the radius of convergence that a step takes.
    pub(super) fraction: f64,
    pub(super) decay: Decay,
    pub(super) corrects: bool,
    /// See [`Turn`].
    pub(super) near: f64,
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
            let interface = if let Job::Cross(interface) = self.job {
                interface
            } else if !run.step(&entry) {
                entry = Entry::default();
                continue;
            } else if let Some(interface) = run.register.crossed_by_all() {
                interface
            } else {
                return;
            };
            return run.cross(interface);
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
    barred: Option<WideMask>,
}

/// What the lanes meet in a step.
struct Ahead {
    hard: WideMask,
    crosses: WideMask,
    from: Wide,
    elapsed: Wide,
    interface: Wide,
}

/// Where the lanes are.
type Place<const N: usize> = (Time<Wide>, State<N, Wide>);

impl<const N: usize> Register<N> {
    /// Moves the lanes of a mask.
    #[inline(always)]
    pub(super) fn move_to(&mut self, moved: WideMask, (time, state): &Place<N>) {
        self.time.value = moved.select(time.value, self.time.value);
        self.time.remainder = moved.select(time.remainder, self.time.remainder);
        self.state.x = moved.select_vector(&state.x, &self.state.x);
        self.state.remainder = moved.select_vector(&state.remainder, &self.state.remainder);
    }

    /// The level of the conserved quantities.
    #[inline(always)]
    pub(super) fn level<const M: usize>(&self) -> Level<N, M, Wide> {
        let [reference, remainder, scale] = &self.level;
        Level {
            reference: vector!(|m| reference[m]),
            remainder: vector!(|m| remainder[m]),
            scale: vector!(|m| scale[m]),
        }
    }

    /// Keeps that level.
    #[inline(always)]
    fn keep<const M: usize>(&mut self, level: &Level<N, M, Wide>) {
        for m in 0..M {
            self.level[0][m] = level.reference[m];
            self.level[1][m] = level.remainder[m];
            self.level[2][m] = level.scale[m];
        }
    }
}

impl<F: Dynamics<Wide, N, M>, const N: usize, const M: usize> Run<'_, F, N, M> {
    /// The interfaces that bound the region, with its sides.
    #[inline(always)]
    fn sides(&self) -> &'_ [(usize, crate::contract::Side)] {
        self.dynamics.sides()
    }

    /// The sign of g in the region.
    #[inline(always)]
    pub(super) fn sign(&self, interface: usize) -> f64 {
        let mut sides = self.sides().iter();
        let side = sides.find(|(other, _)| *other == interface);
        side.map_or(0.0, |(_, side)| side.sign())
    }

    /// The level of a region that is entered.
    #[inline(always)]
    fn enter(&mut self, interface: Option<usize>) -> Entry {
        let Register { time, state, .. } = &*self.register;
        let level = Level::in_lanes(self.dynamics, *time, state);
        let barred = interface.map(|interface| {
            let rate = self.dynamics.rate(interface, time.value, &state.x);
            let inwards = Wide::from_f64(self.sign(interface)) * rate;
            inwards.above(Wide::from_f64(0.0)).not()
        });
        self.register.keep(&level);
        self.register.since = Wide::from_f64(0.0);
        self.register.free = Wide::from_f64(0.0);
        Entry {
            enters: true,
            interface,
            barred,
        }
    }

    /// The solution's coefficients.
    #[inline(always)]
    fn expand(&mut self) {
        let Register { time, state, .. } = &*self.register;
        let series = &mut *self.series;
        let place = (time.value, &state.x);
        expand::<_, F, F::Unrolled, N, M, _>(self.dynamics, place, series, COEFFICIENTS, 1.0);
    }

    /// The first coefficients of g.
    #[inline(always)]
    pub(super) fn first_switching(&self) -> FirstSeries<Wide, F, N, M> {
        first_switching::<_, F, GuardsUnrolled<_, F, N, M>, N, M, COEFFICIENTS>(
            self.dynamics,
            self.register.time.value,
            self.series.as_ref(),
            1.0,
        )
    }

    /// The steps that the tolerance allows, and where coefficients may have left the range of
    /// doubles; see [`crate::expansion::jet::Jet::step`].
    #[inline(always)]
    fn wanted(&self, enters: bool) -> (Wide, WideMask) {
        let n = Wide::from_f64;
        let order = const { decisive(ORDER) };
        let series = &self.series.as_ref()[..N];
        let before = self.register.before;
        let (mut last, mut second) = decisive_terms(series, order, before);
        if enters {
            // there may have been no step before
            let largest = |k: usize| {
                let mut largest = n(0.0);
                for c in series {
                    largest = largest.max(c[k].abs());
                }
                largest
            };
            let none = before.above(n(0.0)).not();
            let size = largest(0).above(n(0.0)).select(largest(0), largest(1));
            let scale = n(1.0) / size.max(n(f64::MIN_POSITIVE));
            last = none.select(largest(order) * scale, last);
            second = none.select(largest(order - 1) * scale, second);
        }
        // what is lost to underflow counts only in a time of powers as large
        let remaining = n(self.settings.end) - self.register.time.value;
        let is_long = remaining.above(n(FASTEST)).or(last.above(n(0.0)));
        let too_small = n(SMALLEST_DECISIVE).above(last).and(is_long);
        let largest = n(LARGEST_DECISIVE);
        let too_large = largest.above(last).and(largest.above(second)).not();
        let step = n(self.settings.fraction) * radius(order, last, second);
        (step, too_small.or(too_large))
    }

    /// The states h after those at which the coefficients are those of the solution; see
    /// [`crate::expansion::jet::Jet::after`].
    #[inline(always)]
    pub(super) fn after(&self, h: Wide) -> State<N, Wide> {
        // a loop, as closures are not inlined for certain
        let mut increments = self.register.state.remainder;
        for (sum, series) in increments.iter_mut().zip(self.series.as_ref()) {
            *sum = increment(series, h, *sum).settled();
        }
        self.register.state.moved(&increments)
    }

    /// A step of every lane, and whether one needs attention.
    #[inline(always)]
    fn step(&mut self, entry: &Entry) -> bool {
        let n = Wide::from_f64;
        let (start, used) = (self.register.time, self.register.used());
        let (wanted, out_of_range) = self.wanted(entry.enters);
        let wanted = wanted.settled();
        let mut size = wanted;
        let mut halvings = 0;
        let (tau, last, time, mut state, ahead) = loop {
            let end = n(self.settings.end);
            let (tau, time, last) = step_to(self.dynamics.is_autonomous(), start, size, end);
            let state = self.after(tau);
            let ahead = self.look_ahead(tau, (time, &state), entry.interface);
            let near = ahead.hard.and(used);
            if halvings == MOST_HALVINGS || !near.any() {
                break (tau, last, time, state, ahead);
            }
            halvings += 1;
            size = near.select(n(0.5) * size, size);
        };
        let mut level = self.register.level();
        let displacement = vector!(|i| state.x[i] - self.register.state.x[i]);
        let Settings { corrects, near, .. } = *self.settings;
        let mut free = self.register.free;
        let turn = Turn {
            free: &mut free,
            last,
            near,
        };
        let how = (corrects, used);
        let left = level.nearly_reached(self.dynamics, time, &mut state, &displacement, how, turn);
        let left = left.and(last);
        if left.any() {
            let how = (true, left);
            state = level.reached(self.dynamics, time, state, &displacement, how);
        }
        let stands = time.value.equals(start.value);
        let stands = stands.and(time.remainder.equals(start.remainder));
        let moves = tau.above(n(0.0)).and(stands.not());
        let mut hard = ahead.hard.or(is_finite(&state.x).not()).or(moves.not());
        hard = hard.or(out_of_range);
        if let Some(barred) = entry.barred {
            hard = hard.or(barred);
        }
        let moved = hard.or(ahead.crosses).not();
        self.register.move_to(moved, &(time, state));
        self.register.before = moved.select(wanted, self.register.before);
        self.register.free = moved.select(free, self.register.free);
        let step = moved.select(n(1.0), n(0.0));
        self.register.steps += step;
        self.register.since += step;
        let many = self.register.since.equals(n(RESCALING as f64));
        if many.any() {
            let before = level.scale;
            level.rescale(self.dynamics, time.value, &self.register.state);
            level.scale = many.select_vector(&level.scale, &before);
            self.register.keep(&level);
            self.register.since = many.select(n(0.0), self.register.since);
        }
        self.register.from = ahead.from;
        self.register.elapsed = ahead.elapsed;
        self.register.tau = tau;
        let crosses = (ahead.crosses, ahead.interface);
        self.register.note(hard, crosses, moved.and(last))
    }

    /// What the lanes meet in steps over `tau` that end at a place.
    #[inline(always)]
    fn look_ahead(
        &self,
        tau: Wide,
        (time, state): (Time<Wide>, &State<N, Wide>),
        active: Option<usize>,
    ) -> Ahead {
        let none = WideMask::all_are(false);
        let zero = Wide::from_f64(0.0);
        let mut ahead = Ahead {
            hard: none,
            crosses: none,
            from: zero,
            elapsed: zero,
            interface: zero,
        };
        if !<F::Guards as Guards<Wide, N>>::MAY_END {
            return ahead;
        }
        let field = self.dynamics.vector_field(time.value, &state.x);
        let series = self.first_switching();
        let ends = Ends {
            tau,
            decay: self.settings.decay,
        };
        for &(interface, side) in self.sides() {
            let guards = self.dynamics.guards();
            let value = guards.switching_function(interface, time.value, &state.x);
            let (by_time, gradient) = guards.switching_gradient(interface, time.value, &state.x);
            let end = (value, by_time + dot(&gradient, &field));
            let (cubic, bounds) = ends.cubic(&series.as_ref()[interface], end, side.sign());
            let is_active = active == Some(interface);
            let seen = cubic.courses(bounds, is_active, self.register.used());
            ahead.hard = ahead.hard.or(seen.free.or(seen.falls).not());
            // one crossing or the other may come first
            ahead.hard = ahead.hard.or(seen.falls.and(ahead.crosses));
            ahead.crosses = ahead.crosses.or(seen.falls);
            ahead.from = seen.falls.select(seen.from, ahead.from);
            ahead.elapsed = seen.falls.select(seen.at, ahead.elapsed);
            let interface = Wide::from_f64(interface as f64);
            ahead.interface = seen.falls.select(interface, ahead.interface);
        }
        ahead
    }
}
