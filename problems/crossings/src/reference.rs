//! The slow solution that runs are compared with: Taylor series in pairs of doubles from
//! crossing to crossing, with certain signs of all switching functions ([`crate::signs`]).
//!
//! Beside the crossings it tells how near the solution came to others: what a scheme with an
//! error of that size may rightly see otherwise.

use crate::formula::{Dual, Formulas};
use crate::pairs::Pair;
use crate::series::{Real, expand, slope, step, value};
use crate::signs::Step;

/// A piecewise-smooth initial value problem at t = 0, in formulas.
#[derive(Clone, Debug)]
pub(super) struct Problem {
    /// f where the switching functions in whose place a bit is set are positive, the others
    /// negative.
    pub(super) fields: Vec<Formulas>,
    /// The switching functions.
    pub(super) switching: Formulas,
    pub(super) initial: Vec<f64>,
    /// The size of states.
    pub(super) size: f64,
    /// The inverse of the time in which they change.
    pub(super) rate: f64,
}

/// The solution from t on, for a while.
#[derive(Clone, Debug)]
struct Segment {
    start: f64,
    series: Vec<Vec<f64>>,
}

/// A crossing of an interface.
#[derive(Clone, Debug)]
pub(super) struct Crossing {
    pub(super) t: f64,
    pub(super) interface: usize,
    /// The regions before and after, as in [`Problem::fields`].
    pub(super) regions: [usize; 2],
    /// dg/dt before and after.
    pub(super) rates: [f64; 2],
    /// The change of g by an error of the size of the state.
    pub(super) steepness: f64,
}

/// A point at which an error in the state, in units of its size, would change what is crossed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    pub(super) t: f64,
    /// The least such error.
    pub(super) margin: f64,
}

/// Why the solution ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Ending {
    /// At the time that was asked for.
    Time,
    /// With the crossing number that was asked for.
    Count,
    /// Both fields point at the interface.
    Sliding,
    /// Crossings accumulate.
    Accumulation,
    /// The solution, or the signs, could not be computed.
    Lost,
}

/// A solution.
#[derive(Clone, Debug)]
pub(super) struct Reference {
    segments: Vec<Segment>,
    pub(super) crossings: Vec<Crossing>,
    pub(super) contacts: Vec<Contact>,
    pub(super) t_end: f64,
    pub(super) ending: Ending,
}

/// A gap between crossings, in units of the time in which states change, of which
/// [`MOST_SHORT`] in succession are an accumulation.
const SHORT: f64 = 1e-7;
const MOST_SHORT: usize = 6;
/// The longest step, in the same units.
const LONGEST: f64 = 10.0;

impl Reference {
    /// x(t)
    pub(super) fn state(&self, t: f64) -> Vec<f64> {
        let after = self.segments.partition_point(|segment| segment.start <= t);
        match self.segments.get(after.saturating_sub(1)) {
            Some(segment) => {
                let tau = t - segment.start;
                segment.series.iter().map(|x| value(x, tau)).collect()
            }
            None => Vec::new(),
        }
    }
}

/// What is computed while a solution goes on.
struct Solver<'a, R> {
    problem: &'a Problem,
    t: R,
    x: Vec<R>,
    region: usize,
    entered: Option<usize>,
    /// For each interface the largest margin since it was crossed, and when; nothing before
    /// the first crossing.
    lobes: Vec<Option<Contact>>,
    short: usize,
    found: Reference,
}

/// The solution until `t_end`, or until `most` crossings have been made.
pub(super) fn solve<R: Real>(problem: &Problem, t_end: f64, most: usize) -> Reference {
    let interfaces = problem.switching.results.len();
    let x: Vec<R> = problem.initial.iter().map(|x| R::constant(*x)).collect();
    let mut values = Vec::new();
    problem
        .switching
        .evaluate(R::constant(0.0), &x, &mut values);
    let region = (0..interfaces)
        .filter(|j| problem.switching.result(*j, &values).pair().sign() > 0.0)
        .map(|j| 1 << j)
        .sum();
    let mut solver = Solver {
        problem,
        t: R::constant(0.0),
        x,
        region,
        entered: None,
        lobes: vec![None; interfaces],
        short: 0,
        found: Reference {
            segments: Vec::new(),
            crossings: Vec::new(),
            contacts: Vec::new(),
            t_end,
            ending: Ending::Time,
        },
    };
    loop {
        let ending = match solver.advance(t_end) {
            Some(ending) => Some(ending),
            None if solver.found.crossings.len() >= most => Some(Ending::Count),
            None => None,
        };
        if let Some(ending) = ending {
            solver.found.ending = ending;
            solver.found.t_end = solver.t.to_double();
            return solver.found;
        }
    }
}

impl<R: Real> Solver<'_, R> {
    fn sides(&self) -> Vec<f64> {
        let side = |j: usize| if self.region >> j & 1 == 1 { 1.0 } else { -1.0 };
        (0..self.lobes.len()).map(side).collect()
    }

    /// A step, or the part of it before a crossing.
    fn advance(&mut self, t_end: f64) -> Option<Ending> {
        let problem = self.problem;
        let Some(field) = problem.fields.get(self.region) else {
            return Some(Ending::Lost);
        };
        let series = expand(field, self.t, &self.x);
        let left = R::constant(t_end).plus(self.t.negative()).to_double();
        let longest = left.min(LONGEST / problem.rate);
        let Some(length) = step(field, self.t, &series, problem.size, longest) else {
            return Some(Ending::Lost);
        };
        let is_last = length >= left;
        let step = Step::new(&problem.switching, self.t, &series, length);
        let Ok(signs) = step.signs(&self.sides(), self.entered) else {
            return Some(Ending::Lost);
        };
        self.found.segments.push(Segment {
            start: self.t.to_double(),
            series: series
                .iter()
                .map(|x| x.iter().map(|c| c.to_double()).collect())
                .collect(),
        });
        let start = self.t;
        let nearest = |tau: f64, interface: usize| Contact {
            t: start.to_double() + tau,
            margin: margin(problem, &step, (start, tau), interface),
        };
        for (interface, tau) in &signs.touches {
            self.found.contacts.push(Contact {
                margin: 0.0,
                ..nearest(*tau, *interface)
            });
        }
        for extremum in &signs.extrema {
            let contact = nearest(extremum.tau, extremum.interface);
            if extremum.is_nearest {
                self.found.contacts.push(contact);
            } else if let Some(lobe) = &mut self.lobes[extremum.interface]
                && lobe.margin < contact.margin
            {
                *lobe = contact;
            }
        }
        let Some(root) = signs.root else {
            let tau = R::constant(length);
            self.x = step.state(tau);
            self.t = if is_last {
                R::constant(t_end)
            } else {
                self.t.plus(tau)
            };
            self.entered = None;
            if !is_last {
                return None;
            }
            let last = (0..self.lobes.len()).map(|interface| nearest(length, interface));
            self.found.contacts.extend(last);
            return Some(Ending::Time);
        };
        // where the solution of the field that is left would go to beyond the interface
        let tau = root.tau.to_double();
        let beyond = (0..24).map(|k| {
            let ahead = tau + 0.5 * length * 0.5_f64.powi(k);
            let g = step.rates(ahead)[root.interface].value;
            let side = self.sides()[root.interface];
            if g * side < 0.0 {
                margin(problem, &step, (self.t, ahead), root.interface)
            } else {
                0.0
            }
        });
        let t = self.t.to_double() + tau;
        let deepest = Contact {
            t,
            margin: beyond.fold(0.0, f64::max),
        };
        self.found.contacts.push(deepest);
        self.found
            .contacts
            .extend(self.lobes[root.interface].take());
        self.x = step.state(root.tau);
        self.t = self.t.plus(root.tau);
        self.cross(root.interface, &series, tau)
    }

    /// Goes over to the other side of an interface on which the solution is.
    fn cross(&mut self, interface: usize, series: &[Vec<R>], tau: f64) -> Option<Ending> {
        let problem = self.problem;
        let t = self.t.to_double();
        let x: Vec<f64> = self.x.iter().map(|x| x.to_double()).collect();
        let before: Vec<f64> = series
            .iter()
            .map(|x| slope(x, R::constant(tau)).to_double())
            .collect();
        let region = self.region ^ 1 << interface;
        let side = if region >> interface & 1 == 1 {
            1.0
        } else {
            -1.0
        };
        let Some(field) = problem.fields.get(region) else {
            return Some(Ending::Lost);
        };
        let mut values = Vec::new();
        field.evaluate(t, &x, &mut values);
        let after: Vec<f64> = (0..x.len()).map(|i| field.result(i, &values)).collect();
        let rates = [
            rate(problem, (t, &x), (1.0, &before), interface).rate,
            rate(problem, (t, &x), (1.0, &after), interface).rate,
        ];
        // an error that turns the rate of the other side around
        let steepness = gradient(problem, t, &x, interface);
        let turned = rates[1].abs() / (steepness * problem.rate);
        self.found.contacts.push(Contact { t, margin: turned });
        if rates[1] * side <= 0.0 {
            self.found.crossings.push(Crossing {
                t,
                interface,
                regions: [self.region, region],
                rates,
                steepness,
            });
            return Some(Ending::Sliding);
        }
        let last = self.found.crossings.last().map_or(0.0, |last| last.t);
        self.short = if (t - last) * problem.rate < SHORT {
            self.short + 1
        } else {
            0
        };
        self.found.crossings.push(Crossing {
            t,
            interface,
            regions: [self.region, region],
            rates,
            steepness,
        });
        self.region = region;
        self.entered = Some(interface);
        self.lobes[interface] = Some(Contact { t, margin: 0.0 });
        (self.short >= MOST_SHORT).then_some(Ending::Accumulation)
    }
}

/// g and its rate where t and x move with given velocities.
fn rate(
    problem: &Problem,
    (t, x): (f64, &[f64]),
    (t_rate, x_rate): (f64, &[f64]),
    interface: usize,
) -> Dual<f64> {
    let moving: Vec<Dual<f64>> = x
        .iter()
        .zip(x_rate)
        .map(|(value, rate)| Dual {
            value: *value,
            rate: *rate,
        })
        .collect();
    let t = Dual {
        value: t,
        rate: t_rate,
    };
    let mut values = Vec::new();
    problem.switching.evaluate(t, &moving, &mut values);
    problem.switching.result(interface, &values)
}

/// Σ |∂g/∂xᵢ| times the size of states.
fn gradient(problem: &Problem, t: f64, x: &[f64], interface: usize) -> f64 {
    let slope = |i: usize| {
        let mut direction = vec![0.0; x.len()];
        direction[i] = 1.0;
        rate(problem, (t, x), (0.0, &direction), interface)
            .rate
            .abs()
    };
    (0..x.len()).map(slope).sum::<f64>() * problem.size
}

/// The error in the state, in units of its size, that g is away from 0.
fn margin<R: Real>(
    problem: &Problem,
    step: &Step<'_, R>,
    (t0, tau): (R, f64),
    interface: usize,
) -> f64 {
    let tau = R::constant(tau);
    let t = t0.plus(tau).to_double();
    let g = step.values(tau)[interface].to_double().abs();
    let x: Vec<f64> = step.state(tau).iter().map(|x| x.to_double()).collect();
    let margin = g / gradient(problem, t, &x, interface);
    if margin.is_nan() { 0.0 } else { margin }
}

/// By how much errors grow: the largest ratio of the distance of two solutions to what it was
/// before, at times that are evenly spread.
pub(super) struct Growth {
    until: f64,
    factors: Vec<f64>,
}

/// How many times.
const SAMPLES: usize = 96;

impl Growth {
    /// Of the distance to a solution from a start that is moved by `shift` times the size.
    pub(super) fn measure(problem: &Problem, reference: &Reference, shift: f64) -> Self {
        let mut moved = problem.clone();
        for (i, x) in moved.initial.iter_mut().enumerate() {
            let direction = [0.8, -0.6, 0.7][i % 3];
            *x += shift * direction * problem.size;
        }
        // crossings may come a little later
        let most = reference.crossings.len() + 1;
        let other = solve::<f64>(&moved, reference.t_end, most);
        let mut growth = Self {
            until: reference.t_end,
            factors: Vec::with_capacity(SAMPLES + 1),
        };
        let (mut least, mut factor) = (shift, 1.0_f64);
        for k in 0..=SAMPLES {
            let t = growth.until * k as f64 / SAMPLES as f64;
            if t <= other.t_end {
                let distance = distance(&reference.state(t), &other.state(t), problem.size);
                // the doubles of the other solution
                least = least.min(distance.max(1e-3 * shift));
                factor = factor.max(distance / least);
            }
            growth.factors.push(factor);
        }
        growth
    }

    /// Up to the time t.
    pub(super) fn until(&self, t: f64) -> f64 {
        let index = (t / self.until * SAMPLES as f64).ceil().max(0.0) as usize;
        let last = self.factors.last();
        self.factors.get(index).or(last).copied().unwrap_or(1.0)
    }

    /// The last time up to which it is at most `factor`.
    pub(super) fn last_below(&self, factor: f64) -> f64 {
        let count = self.factors.partition_point(|known| *known <= factor);
        self.until * count.saturating_sub(1) as f64 / SAMPLES as f64
    }
}

/// The largest difference of two states in units of their size; NaN if one is.
pub(super) fn distance(a: &[f64], b: &[f64], size: f64) -> f64 {
    let difference = a.iter().zip(b).map(|(a, b)| (a - b).abs() / size);
    difference.fold(0.0, |largest: f64, d| {
        if d <= largest || largest.is_nan() {
            largest
        } else {
            d
        }
    })
}

/// The solution in pairs of doubles.
pub(super) fn accurate(problem: &Problem, t_end: f64, most: usize) -> Reference {
    solve::<Pair>(problem, t_end, most)
}
