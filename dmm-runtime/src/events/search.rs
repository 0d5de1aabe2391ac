//! The search for the first zero of a switching function g on a path.
//!
//! From the left to the right the path is taken in parts. A part is passed if g has no zero there:
//! if the enclosure of g is positive, or that of dg/ds is and g is positive at its start, or if the
//! [`Cubic`] through the values and slopes at its ends is positive by more than it differs from g,
//! which the enclosed coefficient of order 4 bounds. The search ends at a part on which g falls
//! through zero once, by the same bounds. Where neither is certain the part is halved.
//!
//! A path that starts on the interface, coming from there, has a root at its start that does not
//! count: g has to rise until it is above its rounding error.

use super::cubic::{Bounds, Course, Cubic, Reading};
use super::interval::Interval;
use super::path::Path;
use super::switching::{ENCLOSED, Switching};
use crate::arithmetic::Scalar;

/// Parts of a path that are looked at before it is given up.
const MOST_PARTS: u32 = 50_000;
/// A part whose ends differ by less than this, relative to its end, is not halved.
const FINEST: f64 = 1e-15;

/// What a path meets.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Met {
    /// No zero of g.
    Nothing,
    /// A zero at which g falls, the first one, between these places.
    Crossing {
        /// g ≥ 0 here.
        lower: f64,
        /// g ≤ 0 here.
        upper: f64,
    },
    /// What happens after this place cannot be decided: g has no finite value, or changes its sign
    /// too often.
    Undecided(f64),
}

/// A search of the zeros of g − `level`, g positive in the region, along a path up to `end`.
#[derive(Clone, Copy)]
pub(crate) struct Search<'a, const N: usize> {
    pub(crate) switching: &'a dyn Switching<N>,
    pub(crate) interface: usize,
    /// The sign of g in the region.
    pub(crate) sign: f64,
    pub(crate) path: &'a Path<'a, N>,
    pub(crate) end: f64,
    pub(crate) level: f64,
}

/// A place of the path.
#[derive(Clone, Copy, Debug)]
struct Place {
    s: f64,
    reading: Reading,
    /// The rounding error of g.
    noise: f64,
}

/// A part of the path.
struct Part {
    start: Place,
    end: Place,
    /// The enclosed coefficients.
    g: [Interval; ENCLOSED],
    noise: f64,
}

impl<const N: usize> Search<'_, N> {
    /// The first zero, and how often zero was touched before. The guard `is_active` if the path comes from
    /// the interface.
    pub(crate) fn first(&self, is_active: bool) -> (Met, u32) {
        let mut here = self.place(0.0);
        // off the interface by rounding, and on its way from there
        let is_on = here.reading.value <= here.noise;
        let mut rises = is_active || is_on && here.reading.rate > 0.0;
        if !rises && here.reading.value < -here.noise {
            let at_once = Met::Crossing {
                lower: 0.0,
                upper: 0.0,
            };
            return (at_once, 0);
        }
        let mut inside = 0.0;
        let mut touches = 0;
        let mut touching = false;
        let mut width = self.end;
        for _ in 0..MOST_PARTS {
            let left = self.end - here.s;
            if left <= 0.0 {
                return (Met::Nothing, touches);
            }
            let s = if width * 1.5 > left {
                self.end
            } else {
                here.s + width
            };
            width = s - here.s;
            let part = self.part(here, s);
            let Place {
                reading: Reading { value, rate },
                ..
            } = part.end;
            let passed = match part.course(rises, self.level == 0.0) {
                Course::Free => true,
                Course::Falls { from, .. } => {
                    let lower = if part.start.reading.value > 0.0 {
                        here.s + from
                    } else {
                        inside
                    };
                    return (Met::Crossing { lower, upper: s }, touches);
                }
                Course::Unknown => {
                    let ends_in_a_fall = s == self.end && value <= 0.0 && rate < 0.0;
                    let is_finest = width <= FINEST * s || width < f64::MIN_POSITIVE;
                    if part.lowest() >= -2.0 * part.noise && !ends_in_a_fall {
                        touches += u32::from(!touching && !rises);
                        touching = true;
                        true
                    } else if is_finest && (value < -part.noise || ends_in_a_fall) {
                        let crossing = Met::Crossing {
                            lower: inside,
                            upper: s,
                        };
                        return (crossing, touches);
                    } else if is_finest && !value.is_finite() {
                        return (Met::Undecided(here.s), touches);
                    } else {
                        is_finest
                    }
                }
            };
            if !passed {
                width *= 0.5;
                continue;
            }
            if value > part.noise {
                (rises, touching, inside) = (false, false, s);
            }
            here = part.end;
            width *= 2.0;
        }
        (Met::Undecided(here.s), touches)
    }

    /// The first crossing of zero, unless it depends on less than `band`: a path that comes closer
    /// to zero than that and returns, or goes beyond by less and returns, is undecided.
    pub(crate) fn first_clear(&self, is_active: bool, band: f64) -> (Met, u32) {
        let at = |level: f64| Self { level, ..*self };
        match at(band).first(is_active) {
            (Met::Crossing { .. }, _) => {}
            other => return other,
        }
        if at(-band).first(false).0 == Met::Nothing {
            let Reading { value, rate } = self.place(self.end).reading;
            // not on its way through the band at the end
            if !(value.abs() <= band && rate < 0.0) {
                return (Met::Undecided(0.0), 0);
            }
        }
        self.first(is_active)
    }

    /// Whether g falls at the start and rises at the end, where it is positive, and bends upwards
    /// throughout: whether it has one minimum. Its rounding error then.
    pub(crate) fn single_dip(&self) -> Option<f64> {
        let (start, end) = (self.place(0.0), self.place(self.end));
        let noise = start.noise.max(end.noise);
        let g = self
            .switching
            .enclosed(self.interface, self.path, 0.0, self.end);
        let bends = g[2].turned(self.sign).low > 0.0;
        let dips = start.reading.rate < 0.0 && end.reading.rate > 0.0;
        (bends && dips && end.reading.value > -noise).then_some(noise)
    }

    /// The place between two where g falls through zero.
    pub(crate) fn root(&self, lower: f64, upper: f64) -> f64 {
        const MOST: u32 = 200;
        let (mut lower, mut upper) = (lower, upper);
        let mut s = f64::midpoint(lower, upper);
        for _ in 0..MOST {
            let Reading { value, rate } = self.reading(s);
            if value > 0.0 {
                lower = s;
            } else {
                upper = s;
            }
            let newton = s - value / rate;
            let next = if newton > lower && newton < upper {
                newton
            } else {
                f64::midpoint(lower, upper)
            };
            if (next - s).abs() <= 2.0 * f64::EPSILON * upper {
                return next;
            }
            s = next;
        }
        s
    }

    fn reading(&self, s: f64) -> Reading {
        let (value, rate) = self.switching.point(self.interface, self.path, s);
        Reading {
            value: self.sign * value - self.level,
            rate: self.sign * rate,
        }
    }

    fn place(&self, s: f64) -> Place {
        let noise = self
            .switching
            .noise(self.interface, self.path.time(s), &self.path.state(s));
        Place {
            s,
            reading: self.reading(s),
            noise: if noise.is_finite() { noise } else { 0.0 },
        }
    }

    fn part(&self, start: Place, s: f64) -> Part {
        let end = self.place(s);
        let mut g = self
            .switching
            .enclosed(self.interface, self.path, start.s, s);
        g = g.map(|g| g.turned(self.sign));
        g[0] -= Interval::from_f64(self.level);
        Part {
            start,
            end,
            g,
            noise: start.noise.max(end.noise),
        }
    }
}

impl Part {
    fn cubic(&self) -> (Cubic, Bounds) {
        let width = self.end.s - self.start.s;
        let square = width * width;
        let bounds = Bounds {
            truncation: self.g[4].magnitude() * (square * square),
            noise: self.noise,
            ends: self.noise,
        };
        (
            Cubic::new(self.start.reading, self.end.reading, width),
            bounds,
        )
    }

    /// What is certain, for a part that is not yet above the rounding error after the start on the
    /// interface if g `rises` from there; on the interface itself `at_zero`.
    fn course(&self, rises: bool, at_zero: bool) -> Course {
        let [value, rate, ..] = self.g;
        let (start, end) = (self.start.reading, self.end.reading);
        let falls = rate.high < 0.0;
        if rate.low > 0.0 && (rises || start.value > -self.noise) {
            return Course::Free;
        }
        if !rises && value.low > 0.0 {
            return Course::Free;
        }
        if !rises && falls && end.value > self.noise {
            return Course::Free;
        }
        if !rises && falls && end.value < -self.noise {
            let (from, at) = (0.0, 0.0);
            return Course::Falls { from, at };
        }
        let (cubic, bounds) = self.cubic();
        if rises && cubic.rises(bounds) {
            return Course::Free;
        }
        cubic.course(bounds, rises && at_zero)
    }

    /// A lower bound of g.
    fn lowest(&self) -> f64 {
        let (cubic, bounds) = self.cubic();
        let lowest = cubic
            .coefficients
            .iter()
            .fold(f64::INFINITY, |a, &b| a.min(b));
        let by_cubic = lowest - bounds.truncation * (1.0 / 12.0);
        self.g[0].low.max(by_cubic)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Vector;
    use crate::events::Path;

    /// g(s) in intervals with derivatives by hand.
    struct Function {
        value: fn(f64) -> f64,
        slope: fn(f64) -> f64,
        enclosed: fn(Interval) -> [Interval; ENCLOSED],
        noise: f64,
    }

    impl Switching<1> for Function {
        fn point(&self, _: usize, _: &Path<'_, 1>, s: f64) -> (f64, f64) {
            ((self.value)(s), (self.slope)(s))
        }

        fn enclosed(&self, _: usize, _: &Path<'_, 1>, a: f64, b: f64) -> [Interval; ENCLOSED] {
            (self.enclosed)(Interval::new(a, b))
        }

        fn noise(&self, _: usize, _: f64, _: &Vector<f64, 1>) -> f64 {
            self.noise
        }
    }

    fn search(function: &Function, end: f64, level: f64, is_active: bool) -> (Met, u32) {
        let path = Path {
            t0: 0.0,
            unit: 1.0,
            coefficients: [&[0.0][..]],
        };
        let search = Search {
            switching: function,
            interface: 0,
            sign: 1.0,
            path: &path,
            end,
            level,
        };
        let (met, touches) = search.first(is_active);
        if let Met::Crossing { lower, upper } = met {
            let root = search.root(lower, upper);
            return (
                Met::Crossing {
                    lower: root,
                    upper: root,
                },
                touches,
            );
        }
        (met, touches)
    }

    fn n(value: f64) -> Interval {
        Interval::from_f64(value)
    }

    /// cos(50 s) + 1, which touches zero at π/50, 3π/50 …
    fn wave() -> Function {
        fn enclosed(s: Interval) -> [Interval; ENCLOSED] {
            let (u, w) = (s * n(50.0), 50.0);
            let (sin, cos) = (Scalar::sin(u), Scalar::cos(u));
            [
                cos + n(1.0),
                -sin * n(w),
                -cos * n(w * w / 2.0),
                sin * n(w * w * w / 6.0),
                cos * n(w * w * w * w / 24.0),
            ]
        }
        Function {
            value: |s| (50.0 * s).cos() + 1.0,
            slope: |s| -50.0 * (50.0 * s).sin(),
            enclosed,
            noise: 1e-15,
        }
    }

    #[test]
    fn a_wave_of_many_periods_is_told_from_its_level() {
        let turn = std::f64::consts::PI / 50.0;
        // far above, touching, and cut
        assert_eq!(search(&wave(), 10.0, -1e-6, false), (Met::Nothing, 0));
        let (met, touches) = search(&wave(), 10.0, 0.0, false);
        assert_eq!(met, Met::Nothing);
        // all of them together, or one by one
        assert!((1..=85).contains(&touches), "{touches}");
        let (met, _) = search(&wave(), 10.0, 1e-6, false);
        let Met::Crossing { lower, .. } = met else {
            panic!("{met:?}");
        };
        let exact = turn - (1e-6f64 * 2.0).sqrt() / 50.0;
        assert!((lower - exact).abs() < 1e-9, "{lower} {exact}");
    }

    #[test]
    fn a_root_at_the_start_does_not_count() {
        let sine = Function {
            value: f64::sin,
            slope: f64::cos,
            enclosed: |s| {
                let (sin, cos) = (Scalar::sin(s), Scalar::cos(s));
                [
                    sin,
                    cos,
                    -sin * n(0.5),
                    -cos * n(1.0 / 6.0),
                    sin * n(1.0 / 24.0),
                ]
            },
            noise: 1e-16,
        };
        for end in [4.0, 40.0] {
            let (met, touches) = search(&sine, end, 0.0, true);
            let Met::Crossing { lower, .. } = met else {
                panic!("{met:?}");
            };
            assert!((lower - std::f64::consts::PI).abs() < 1e-14 && touches == 0);
        }
        assert_eq!(search(&sine, 3.0, 0.0, true), (Met::Nothing, 0));
        assert_eq!(search(&sine, 1e-9, 0.0, true), (Met::Nothing, 0));
    }

    #[test]
    fn a_function_that_ends_is_undecided_there() {
        let root = Function {
            value: |s| (1.0 - s).sqrt() + 0.1,
            slope: |s| -0.5 / (1.0 - s).sqrt(),
            enclosed: |s| {
                let u = n(1.0) - s;
                let root = Scalar::sqrt(u);
                let slope = n(-0.5) / root;
                let bend = slope * n(0.25) / u;
                [
                    root + n(0.1),
                    slope,
                    bend,
                    bend * n(0.5) / u,
                    Interval::WHOLE,
                ]
            },
            noise: 1e-16,
        };
        assert_eq!(search(&root, 0.999, 0.0, false), (Met::Nothing, 0));
        let (met, _) = search(&root, 2.0, 0.0, false);
        let Met::Undecided(place) = met else {
            panic!("{met:?}");
        };
        assert!((place - 1.0).abs() < 1e-12, "{place}");
    }
}
