//! The signs of switching functions along a step of the solution, with certainty: where an
//! enclosure of g over a piece of the step has a sign, g has it; where an enclosure of dg/dt has
//! one, the signs at the ends decide. Other pieces are halved.
//!
//! The solution is enclosed by its polynomial at the middle of the piece, two derivatives there
//! and a bound on the third over the whole step.

use crate::formula::{Dual, Formulas, Number};
use crate::interval::Interval;
use crate::pairs::Pair;
use crate::series::{Real, slope, value};

/// A step of the solution, x(t₀ + τ) = Σ xₖ τᵏ for τ from 0 to its length.
pub(super) struct Step<'a, R> {
    switching: &'a Formulas,
    t0: R,
    length: f64,
    series: &'a [Vec<R>],
    /// The series in doubles.
    rounded: Vec<Vec<f64>>,
    /// Bounds on |d³x/dτ³| over the step.
    third: Vec<f64>,
    /// Bounds on the rounding errors of Σ xₖ τᵏ in doubles, and of its slope.
    rounding: Vec<[f64; 2]>,
}

/// Where the first sign changes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root<R> {
    pub(super) interface: usize,
    pub(super) tau: R,
}

/// A point where a switching function is nearest to 0, or farthest from it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extremum {
    pub(super) interface: usize,
    pub(super) tau: f64,
    pub(super) is_nearest: bool,
}

/// What is known of a step.
pub(super) struct Signs<R> {
    pub(super) root: Option<Root<R>>,
    /// Before the root.
    pub(super) extrema: Vec<Extremum>,
    /// Pieces so small that rounding hides the sign, with their interface: a touch.
    pub(super) touches: Vec<(usize, f64)>,
}

/// Too many pieces: the signs are not known.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Undecided;

/// In a piece.
enum Sign {
    Certain,
    Crossed,
    Unknown,
}

/// Pieces of a step.
const MOST_PIECES: usize = 200_000;
/// The smallest piece, as a part of the step.
const SMALLEST: f64 = 1e-15;
/// Below this part of a step doubles do not tell g apart from 0 where it touches.
const IN_PAIRS: f64 = 1e-4;

impl<'a, R: Real> Step<'a, R> {
    pub(super) fn new(switching: &'a Formulas, t0: R, series: &'a [Vec<R>], length: f64) -> Self {
        let rounded: Vec<Vec<f64>> = series
            .iter()
            .map(|x| x.iter().map(|c| c.to_double()).collect())
            .collect();
        let third = rounded.iter().map(|x| {
            let mut bound = 0.0;
            for (k, c) in x.iter().enumerate().skip(3).rev() {
                bound = bound * length + c.abs() * (k * (k - 1) * (k - 2)) as f64;
            }
            bound
        });
        let rounding = rounded.iter().map(|x| {
            let sizes: Vec<f64> = x.iter().map(|c| c.abs()).collect();
            let units = 64.0 * f64::EPSILON;
            [units * value(&sizes, length), units * slope(&sizes, length)]
        });
        Self {
            switching,
            t0,
            length,
            third: third.collect(),
            rounding: rounding.collect(),
            series,
            rounded,
        }
    }

    fn interfaces(&self) -> usize {
        self.switching.results.len()
    }

    /// x(t₀ + τ)
    pub(super) fn state(&self, tau: R) -> Vec<R> {
        self.series.iter().map(|x| value(x, tau)).collect()
    }

    /// The switching functions at t₀ + τ.
    pub(super) fn values(&self, tau: R) -> Vec<R> {
        let mut values = Vec::new();
        let x = self.state(tau);
        self.switching.evaluate(self.t0.plus(tau), &x, &mut values);
        self.results(&values)
    }

    /// The switching functions and their rates at t₀ + τ, in doubles; τ may be a little beyond
    /// the step.
    pub(super) fn rates(&self, tau: f64) -> Vec<Dual<f64>> {
        let x: Vec<Dual<f64>> = self
            .rounded
            .iter()
            .map(|x| Dual {
                value: value(x, tau),
                rate: slope(x, tau),
            })
            .collect();
        let t = Dual {
            value: self.t0.to_double() + tau,
            rate: 1.0,
        };
        let mut values = Vec::new();
        self.switching.evaluate(t, &x, &mut values);
        self.results(&values)
    }

    fn results<S: Copy>(&self, values: &[S]) -> Vec<S> {
        (0..self.interfaces())
            .map(|j| self.switching.result(j, values))
            .collect()
    }

    /// Enclosures of t, x and their rates for |τ − middle| ≤ radius.
    fn piece(&self, middle: f64, radius: f64) -> (Dual<Interval>, Vec<Dual<Interval>>) {
        let t0 = self.t0.to_double();
        let t = Dual {
            value: Interval::around(
                t0 + middle,
                radius + 4.0 * f64::EPSILON * (t0.abs() + self.length),
            ),
            rate: Interval::point(1.0),
        };
        let x = self.rounded.iter().zip(&self.third).zip(&self.rounding);
        let x = x.map(|((x, third), [rounding, slope_rounding])| {
            let (mut at, mut first, mut second) = (0.0, 0.0, 0.0);
            for c in x.iter().rev() {
                second = second * middle + first;
                first = first * middle + at;
                at = at * middle + c;
            }
            // the recursion gives half of the second derivative
            let second = 2.0_f64 * second;
            let reach = second.abs() + third * radius;
            let bend = (second.abs() + third * radius / 3.0) * radius / 2.0;
            Dual {
                value: Interval::around(
                    at,
                    (first.abs() + bend) * radius * (1.0 + 1e-12) + rounding,
                ),
                rate: Interval::around(first, reach * radius * (1.0 + 1e-12) + slope_rounding),
            }
        });
        (t, x.collect())
    }

    /// The sign of a switching function at t₀ + τ.
    fn sign_at(&self, interface: usize, tau: f64) -> f64 {
        self.values(R::constant(tau))[interface].pair().sign()
    }

    /// The first change of sign from `sides`, and what g does before it. Where `entered` tells
    /// the interface that was crossed at the start, g is 0 there.
    pub(super) fn signs(
        &self,
        sides: &[f64],
        entered: Option<usize>,
    ) -> Result<Signs<R>, Undecided> {
        let mut found = Signs {
            root: None,
            extrema: Vec::new(),
            touches: Vec::new(),
        };
        let mut pieces = vec![(0.0, self.length)];
        let mut count = 0;
        let mut before = self.rates(0.0);
        let mut scratch = Vec::new();
        while let Some((from, to)) = pieces.pop() {
            count += 1;
            if count > MOST_PIECES {
                return Err(Undecided);
            }
            let radius = 0.5 * (to - from);
            let middle = from + radius;
            let is_smallest = radius < SMALLEST * self.length;
            let (t, x) = self.piece(middle, radius * (1.0 + 4.0 * f64::EPSILON));
            self.switching.evaluate(t, &x, &mut scratch);
            let mut crossed = Vec::new();
            let mut unknown = Vec::new();
            for (interface, side) in sides.iter().enumerate() {
                let enclosure = self.switching.result(interface, &scratch);
                let starts_at_root = from == 0.0 && entered == Some(interface);
                let at = (from, to, interface);
                match self.sign(at, enclosure, *side, starts_at_root) {
                    Sign::Certain => {}
                    Sign::Crossed => crossed.push(interface),
                    Sign::Unknown => unknown.push(interface),
                }
            }
            if !unknown.is_empty() && !is_smallest {
                pieces.push((middle, to));
                pieces.push((from, middle));
                continue;
            }
            for interface in unknown {
                found.touches.push((interface, middle));
                if self.sign_at(interface, to) == -sides[interface] {
                    crossed.push(interface);
                }
            }
            let roots = crossed.iter().map(|interface| Root {
                interface: *interface,
                tau: self.root((from, to), *interface, sides[*interface]),
            });
            let first = roots.min_by(|a, b| a.tau.to_double().total_cmp(&b.tau.to_double()));
            let end = first.map_or(to, |root| root.tau.to_double());
            let after = self.rates(end);
            for (interface, side) in sides.iter().enumerate() {
                let (a, b) = (before[interface].rate * side, after[interface].rate * side);
                // signs, because products underflow where g is flat
                if (a < 0.0) != (b < 0.0) {
                    found.extrema.push(Extremum {
                        interface,
                        tau: self.extremum((from, end), interface, a * side),
                        is_nearest: a < 0.0,
                    });
                }
            }
            before = after;
            if first.is_some() {
                found.root = first;
                break;
            }
        }
        Ok(found)
    }

    /// What an enclosure of g and dg/dt over a piece says, and the signs at its ends.
    fn sign(
        &self,
        (from, to, interface): (f64, f64, usize),
        enclosure: Dual<Interval>,
        side: f64,
        starts_at_root: bool,
    ) -> Sign {
        if enclosure.value.sign() == Some(side) {
            return Sign::Certain;
        }
        // the mean value theorem from the middle
        let radius = 0.5 * (to - from);
        let middle = from + radius;
        let reach = Interval::around(0.0, radius * (1.0 + 4.0 * f64::EPSILON)).mul(enclosure.rate);
        let at_middle = if to - from < IN_PAIRS * self.length {
            let exact = self.values(R::constant(middle))[interface].pair();
            Interval::around(exact.high, 2.0 * exact.low.abs())
        } else {
            let (t, x) = self.piece(middle, 0.0);
            let mut values = Vec::new();
            let x: Vec<Interval> = x.iter().map(|x| x.value).collect();
            self.switching.evaluate(t.value, &x, &mut values);
            self.switching.result(interface, &values)
        };
        if at_middle.plus(reach).sign() == Some(side) {
            return Sign::Certain;
        }
        match enclosure.rate.sign() {
            // g moves away from the interface
            Some(sign) if sign == side && starts_at_root => Sign::Certain,
            Some(_) if self.sign_at(interface, to) == side => Sign::Certain,
            Some(_) => Sign::Crossed,
            None => Sign::Unknown,
        }
    }

    /// The root in a piece at whose start g has the sign `side`: Newton's method within a
    /// bracket.
    fn root(&self, (from, to): (f64, f64), interface: usize, side: f64) -> R {
        const MOST: usize = 200;
        let (mut lower, mut upper) = (Pair::new(from), Pair::new(to));
        let mut tau = Pair::new(0.5) * (lower + upper);
        for _ in 0..MOST {
            let g = self.values(R::of(tau))[interface].pair();
            if g.high == 0.0 {
                break;
            }
            if g.sign() == side {
                lower = tau;
            } else {
                upper = tau;
            }
            let rate = self.rates(tau.to_double())[interface].rate;
            let newton = tau - g / Pair::new(rate);
            let next = if newton > lower && newton < upper {
                newton
            } else {
                Pair::new(0.5) * (lower + upper)
            };
            let change = (next - tau).to_double().abs();
            tau = next;
            if change <= 1e-31 * self.length {
                break;
            }
        }
        R::of(tau)
    }

    /// Where dg/dt is 0 in a piece at whose start it has the sign of `rate`.
    fn extremum(&self, (mut from, mut to): (f64, f64), interface: usize, rate: f64) -> f64 {
        for _ in 0..50 {
            let middle = 0.5 * (from + to);
            if (self.rates(middle)[interface].rate < 0.0) == (rate < 0.0) {
                from = middle;
            } else {
                to = middle;
            }
        }
        0.5 * (from + to)
    }
}
