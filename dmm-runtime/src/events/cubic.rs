//! What the values and slopes of a switching function g at both ends of a step tell of it.
//!
//! The cubic H with these values and slopes differs from g on a step over h by
//!
//! |g − H| ≤ C s² (1 − s)², s = t/h, where C bounds |g⁗| h⁴/24.
//!
//! As s (1 − s) ≤ 1/4, that is less than to have the two inner Bernstein coefficients of H off by
//! C/12. Where all four are positive in spite of that, g is positive throughout. The slope h dg/dt
//! differs from that of H by C/(3√3) at most (Birkhoff & Priver, J. Math. and Phys. 46, 1967): where
//! the coefficients fall by more than C/12 each, g falls, and has one root at most.
//!
//! Where neither is so, H is split: g may rise and then fall. Up to the split g is positive if the
//! coefficients there are, each off by C/15 (the largest s² (1 − s)² as a part of the sum of all
//! Bernstein polynomials on that part but the first). After it g falls if the coefficients do by
//! (1 − p) C/15 each, p being the part before the split.

use crate::arithmetic::Scalar;
use crate::arithmetic::masked::{Mask, Masked};

/// g and dg/dt at a point, positive inside the region.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Reading<S = f64> {
    pub(crate) value: S,
    pub(crate) rate: S,
}

/// How far g may be from the cubic.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds<S = f64> {
    /// C
    pub(crate) truncation: S,
    /// The rounding error of g.
    pub(crate) noise: S,
    /// At the ends of the step g is not distinguished from zero below this.
    pub(crate) ends: S,
}

/// What the ends of a step tell of an interface: the course of g.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Course {
    /// It is not reached.
    Free,
    /// It is crossed once.
    Falls {
        /// So long after the start g begins to fall.
        from: f64,
        /// About so long after the start g is zero.
        at: f64,
    },
    /// It may be reached.
    Unknown,
}

/// The same lane by lane; what is neither free nor falls is unknown.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Courses<S: Masked> {
    pub(crate) free: S::Mask,
    pub(crate) falls: S::Mask,
    pub(crate) from: S,
    pub(crate) at: S,
}

impl Courses<f64> {
    /// That of the one lane.
    #[inline(always)]
    fn course(self) -> Course {
        let Self { from, at, .. } = self;
        if self.free {
            Course::Free
        } else if self.falls {
            Course::Falls { from, at }
        } else {
            Course::Unknown
        }
    }
}

/// Where a cubic is split, as parts of the step.
const PLACES: [f64; 3] = [0.75, 0.5, 0.25];

/// The cubic by its Bernstein coefficients.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cubic<S = f64> {
    start: Reading<S>,
    end: Reading<S>,
    tau: S,
    pub(crate) coefficients: [S; 4],
}

impl<S: Masked> Cubic<S> {
    /// That of a step over `tau`.
    #[inline(always)]
    pub(crate) fn new(start: Reading<S>, end: Reading<S>, tau: S) -> Self {
        let third = tau * S::from_f64(1.0 / 3.0);
        let inner_1 = start.rate.fused(third, start.value);
        let inner_2 = (-end.rate).fused(third, end.value);
        Self {
            start,
            end,
            tau,
            coefficients: [start.value, inner_1, inner_2, end.value],
        }
    }

    /// Whether g starts inside, and whether the interface is not reached.
    #[inline(always)]
    fn is_free(&self, bounds: Bounds<S>, is_active: bool) -> (S::Mask, S::Mask) {
        let [b0, b1, b2, b3] = self.coefficients;
        let rest = bounds.rest();
        let starts_inside = b0.above(bounds.ends);
        let free = b1
            .above(rest)
            .and(b2.above(rest))
            .and(b3.above(bounds.ends));
        let counts = starts_inside.or(S::Mask::all_are(is_active));
        (starts_inside, free.and(counts))
    }

    /// Whether g, if it starts inside, falls through zero.
    #[inline(always)]
    fn falls(&self, bounds: Bounds<S>) -> S::Mask {
        let [b0, b1, b2, b3] = self.coefficients;
        let slowest = (b0 - b1).min(b1 - b2).min(b2 - b3);
        let ends_outside = b3.above(-bounds.ends).not();
        ends_outside.and(slowest.above(bounds.rest() + bounds.noise))
    }

    /// What is certain about the step in every lane that is `used`; see [`Cubic::course`].
    #[inline(always)]
    pub(crate) fn courses(&self, bounds: Bounds<S>, is_active: bool, used: S::Mask) -> Courses<S> {
        let zero = S::from_f64(0.0);
        let (starts_inside, free) = self.is_free(bounds, is_active);
        let falls = self.falls(bounds).and(starts_inside).and(free.not());
        let mut courses = Courses {
            free,
            falls,
            from: zero,
            at: zero,
        };
        if used.and(falls).any() {
            courses.at = fall(self.start, self.end, self.tau);
        }
        let counts = starts_inside.or(S::Mask::all_are(is_active));
        let unknown = free.or(falls).not().and(used).and(counts);
        if unknown.any() {
            self.courses_of_parts(bounds, &PLACES, unknown, &mut courses);
        }
        courses
    }

    /// The same on both sides of each place, in the lanes that are `unknown`.
    #[inline(always)]
    fn courses_of_parts(
        &self,
        bounds: Bounds<S>,
        places: &[f64],
        mut unknown: S::Mask,
        courses: &mut Courses<S>,
    ) {
        for &place in places {
            let parts = self.parts(bounds, place, unknown);
            courses.free = courses.free.or(parts.free);
            courses.falls = courses.falls.or(parts.falls);
            courses.from = parts.falls.select(parts.from, courses.from);
            courses.at = parts.falls.select(parts.at, courses.at);
            unknown = unknown.and(parts.free.or(parts.falls).not());
            if !unknown.any() {
                break;
            }
        }
    }

    /// The same on both sides of a place, in every lane that is `used`.
    #[inline(always)]
    fn parts(&self, bounds: Bounds<S>, place: f64, used: S::Mask) -> Courses<S> {
        let n = S::from_f64;
        let [b0, b1, b2, b3] = self.coefficients;
        let off = bounds.truncation * n(1.0 / 15.0);
        let rest = off + bounds.noise;
        let between = |a: S, b: S| (b - a).fused(n(place), a);
        let (left_1, middle, right_2) = (between(b0, b1), between(b1, b2), between(b2, b3));
        let (left_2, right_1) = (between(left_1, middle), between(middle, right_2));
        let split = between(left_2, right_1);
        let counts = used.and(left_1.min(left_2).min(split).above(rest));
        let stays = right_1.min(right_2).above(rest).and(b3.above(bounds.ends));
        let free = counts.and(stays);
        let after = 1.0 - place;
        let slowest = (split - right_1).min(right_1 - right_2).min(right_2 - b3);
        let bound = off.fused(n(after), n(2.0) * bounds.noise);
        let leaves = b3.at_most(-bounds.ends).and(slowest.above(bound));
        let falls = counts.and(leaves).and(free.not());
        let mut courses = Courses {
            free,
            falls,
            from: n(0.0),
            at: n(0.0),
        };
        if falls.any() {
            let tau = n(after) * self.tau;
            let start = Reading {
                value: split,
                rate: n(3.0) * (right_1 - split) / tau,
            };
            courses.from = n(place) * self.tau;
            courses.at = courses.from + fall(start, self.end, tau);
        }
        courses
    }
}

impl<S: Scalar> Bounds<S> {
    /// How far an inner Bernstein coefficient may be off.
    #[inline(always)]
    fn rest(self) -> S {
        self.truncation.fused(S::from_f64(1.0 / 12.0), self.noise)
    }
}

impl Cubic {
    /// What is certain about the step. The guard `is_active` if the step starts on it; that root does
    /// not count.
    #[inline(always)]
    pub(crate) fn course(&self, bounds: Bounds, is_active: bool) -> Course {
        let (starts_inside, is_free) = self.is_free(bounds, is_active);
        if is_free {
            return Course::Free;
        }
        if starts_inside && self.falls(bounds) {
            return Course::Falls {
                from: 0.0,
                at: fall(self.start, self.end, self.tau),
            };
        }
        if !(starts_inside || is_active) {
            return Course::Unknown;
        }
        // mostly the first place is enough: apart, so that it works with registers
        match self.parts(bounds, PLACES[0], true).course() {
            Course::Unknown => self.course_of_parts(bounds),
            course => course,
        }
    }

    /// The same on both sides of the other places.
    #[inline(never)]
    fn course_of_parts(&self, bounds: Bounds) -> Course {
        let mut courses = Courses {
            free: false,
            falls: false,
            from: 0.0,
            at: 0.0,
        };
        self.courses_of_parts(bounds, &PLACES[1..], true, &mut courses);
        courses.course()
    }

    /// Whether g rises throughout.
    pub(crate) fn rises(&self, bounds: Bounds) -> bool {
        let [b0, b1, b2, b3] = self.coefficients;
        let slowest = (b1 - b0).min(b2 - b1).min(b3 - b2);
        slowest > bounds.truncation.fused(1.0 / 12.0, 2.0 * bounds.noise)
    }

    /// Whether the cubic goes on well inside for twice the step.
    #[inline(always)]
    pub(crate) fn has_room(&self, bounds: Bounds) -> bool {
        /// A step twice as long bends so many times as much.
        const TWICE: f64 = 16.0;
        let [b0, _, _, b3] = self.coefficients;
        let (d0, d3) = (self.start.rate * self.tau, self.end.rate * self.tau);
        let rise = b3 - b0;
        let (square, cube) = (3.0 * rise - 2.0 * d0 - d3, d0 + d3 - 2.0 * rise);
        let double = b0 + 2.0 * (d0 + 2.0 * (square + 2.0 * cube));
        let triple = b0 + 3.0 * (d0 + 3.0 * (square + 3.0 * cube));
        double.min(triple) > TWICE * bounds.rest()
    }
}

/// About where a function falls through zero, from its values and slopes at 0 and `tau`: the
/// cubic of the inverse function, or where that leaves the step, the chord.
#[inline(always)]
fn fall<S: Masked>(start: Reading<S>, end: Reading<S>, tau: S) -> S {
    let n = S::from_f64;
    let change = end.value - start.value;
    let u = -start.value / change;
    let v = n(1.0) - u;
    let cubic =
        tau * (u * u * (n(3.0) - n(2.0) * u)) + change * (u * v) * (v / start.rate - u / end.rate);
    let within = cubic.above(n(0.0)).and(cubic.above(tau).not());
    within.select(cubic, tau * u)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cubic(g: impl Fn(f64) -> (f64, f64), tau: f64, fourth: f64) -> (Cubic, Bounds) {
        let [start, end] = [0.0, tau].map(|t| {
            let (value, rate) = g(t);
            Reading { value, rate }
        });
        let bounds = Bounds {
            truncation: fourth * tau.powi(4) / 24.0,
            noise: 1e-15,
            ends: 1e-15,
        };
        (Cubic::new(start, end, tau), bounds)
    }

    #[test]
    fn a_dip_between_the_ends_is_never_overlooked() {
        // cos(t − phase) + shift dips to shift − 1 at t = phase + π; every position, every depth
        let mut crossings = 0;
        for tau in [0.7, 1.3, 2.6] {
            for (i, j) in (0..200).flat_map(|i| (0..200).map(move |j| (i, j))) {
                let (phase, shift) = (f64::from(i) * 0.03 - 3.0, f64::from(j) * 0.01);
                let g = |t: f64| ((t - phase).cos() + shift, -(t - phase).sin());
                let values: Vec<f64> = (0..=1000)
                    .map(|k| g(tau * f64::from(k) / 1000.0).0)
                    .collect();
                let lowest = values.iter().copied().fold(f64::INFINITY, f64::min);
                let (cubic, bounds) = cubic(g, tau, 1.0);
                match cubic.course(bounds, false) {
                    Course::Free => assert!(lowest > 0.0, "{phase} {shift}"),
                    Course::Falls { at, .. } => {
                        assert!(g(0.0).0 > 0.0 && g(tau).0 < 0.0);
                        assert!((0.0..=tau).contains(&at), "{phase} {shift}: {at}");
                        let changes = values.windows(2).filter(|w| (w[0] > 0.0) != (w[1] > 0.0));
                        assert_eq!(changes.count(), 1, "{phase} {shift}");
                        crossings += 1;
                    }
                    Course::Unknown => {}
                }
            }
        }
        assert!(crossings > 5_000, "{crossings}");
    }

    #[test]
    fn half_a_turn_from_the_interface_and_beyond_is_told_at_once() {
        let (cubic, bounds) = cubic(|t| (t.sin(), t.cos()), 3.3, 1.0);
        let Course::Falls { at, .. } = cubic.course(bounds, true) else {
            panic!("{:?}", cubic.course(bounds, true));
        };
        assert!((at - std::f64::consts::PI).abs() < 0.01, "{at}");
        assert_eq!(cubic.course(bounds, false), Course::Unknown);
    }

    #[test]
    fn what_is_far_is_told_at_once() {
        let told = |g: &dyn Fn(f64) -> (f64, f64), tau: f64, is_active: bool| {
            let (cubic, bounds) = cubic(g, tau, 1.0);
            (cubic.course(bounds, is_active), cubic.has_room(bounds))
        };
        assert_eq!(
            told(&|t| (2.0 + t.sin(), t.cos()), 0.5, false),
            (Course::Free, true)
        );
        assert_eq!(
            told(&|t| (t.sin(), t.cos()), 1.0, true),
            (Course::Free, false)
        );
        let touching = |t: f64| (1.0 - (t + 1.0).sin(), -(t + 1.0).cos());
        assert_eq!(told(&touching, 1.0, false).0, Course::Unknown);
    }
}
