//! Enclosures: intervals that contain the value of an expression for certain, by interval
//! arithmetic with outward rounding (Moore 1966). At a point they prove that a value is not
//! zero; without values of the variables they bound what an expression can ever be.
//!
//! Sums, products, quotients and square roots round to nearest, so that one step outwards
//! encloses them. The elementary functions of the standard library are taken to be accurate to
//! [`LIBRARY_STEPS`] units in the last place, several times what its implementations claim.

use std::collections::BTreeMap;
use std::ops::{Add, Div, Mul, Neg, Sub};

use num_traits::ToPrimitive;

use super::super::{Dag, Function, Id, Math, Name, Rational};

/// Steps outwards from the value of a library function.
pub(in crate::algebra) const LIBRARY_STEPS: u32 = 8;

/// All numbers from `low` to `high`, but for 0 if `nonzero`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
    /// Whether 0 is excluded, even where it is an end.
    pub nonzero: bool,
    /// Whether the expression is defined for certain; otherwise the interval contains the
    /// values that it has where it is.
    pub defined: bool,
}

/// Intervals of `roots` at a point; a variable without a value may be any number.
pub fn enclose(dag: &Dag, roots: &[Id], values: &BTreeMap<Name, f64>) -> Vec<Interval> {
    let values = values
        .iter()
        .map(|(name, &value)| (name.clone(), Interval::point(value)))
        .collect();
    enclose_within(dag, roots, &values)
}

/// Intervals of `roots` where the variables lie in intervals; a variable without one may be any
/// number.
pub fn enclose_within(dag: &Dag, roots: &[Id], values: &BTreeMap<Name, Interval>) -> Vec<Interval> {
    let size = roots.iter().map(|&root| usize::from(root) + 1).max();
    let mut table = vec![Interval::WHOLE; size.unwrap_or(0)];
    for id in dag.reachable(roots.iter().copied()) {
        let of = |child: &Id| table[usize::from(*child)];
        let interval = match &dag[id] {
            Math::Pi => Interval::point(std::f64::consts::PI).widened(1),
            Math::Constant(value) => Interval::rational(value),
            Math::Variable(name) => match values.get(name) {
                Some(&interval) => interval,
                None => Interval::WHOLE,
            },
            Math::Neg(u) => -of(u),
            Math::Add([u, v]) => of(u) + of(v),
            Math::Sub([u, v]) => of(u) - of(v),
            Math::Mul([u, v]) => of(u) * of(v),
            Math::Div([u, v]) => of(u) / of(v),
            Math::Pow([u, v]) => match dag.as_integer(*v) {
                Some(n) => of(u).integer_power(n),
                None => of(u).power(of(v)),
            },
            Math::Call(function, u) => of(u).call(*function),
            Math::Pair(..) => Interval::WHOLE.undefined(),
        };
        table[usize::from(id)] = interval;
    }
    roots.iter().map(|&root| table[usize::from(root)]).collect()
}

impl Interval {
    /// All values that a node can have.
    pub fn of(dag: &Dag, id: Id) -> Self {
        Self::of_within(dag, id, &BTreeMap::new())
    }

    /// All values that a node can have where the variables lie in intervals.
    pub fn of_within(dag: &Dag, id: Id, values: &BTreeMap<Name, Self>) -> Self {
        let intervals = enclose_within(dag, &[id], values);
        intervals.first().copied().unwrap_or(Self::WHOLE)
    }

    /// All real numbers.
    pub const WHOLE: Self = Self {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
        nonzero: false,
        defined: true,
    };

    /// All numbers that are not negative.
    pub const NOT_NEGATIVE: Self = Self {
        low: 0.0,
        ..Self::WHOLE
    };

    /// Without 0.
    pub fn excluding_zero(self) -> Self {
        self.without_zero(true)
    }

    /// The number `value`.
    pub fn point(value: f64) -> Self {
        Self::new(value, value, true)
    }

    /// From `low` to `high`; NaN is no bound.
    pub(in crate::algebra) fn new(low: f64, high: f64, defined: bool) -> Self {
        let low = if low.is_nan() { f64::NEG_INFINITY } else { low };
        let high = if high.is_nan() { f64::INFINITY } else { high };
        Self {
            low,
            high,
            nonzero: low > 0.0 || high < 0.0,
            defined,
        }
    }

    fn rational(value: &Rational) -> Self {
        let float = value.to_f64().unwrap_or(f64::NAN);
        let exact = value.is_integer() && float.abs() < 9e15;
        let interval = Self::point(float);
        if exact { interval } else { interval.widened(2) }
    }

    /// Whether every value is positive.
    pub fn is_positive(self) -> bool {
        self.low > 0.0 || self.low == 0.0 && self.nonzero
    }

    /// Whether every value is negative.
    pub fn is_negative(self) -> bool {
        self.neg().is_positive()
    }

    /// Whether no value is negative.
    pub fn is_not_negative(self) -> bool {
        self.low >= 0.0
    }

    /// Whether no value is positive.
    pub fn is_not_positive(self) -> bool {
        self.high <= 0.0
    }

    /// With `nonzero` set if 0 is known to be excluded.
    pub(in crate::algebra) fn without_zero(self, excluded: bool) -> Self {
        Self {
            nonzero: self.nonzero || excluded,
            ..self
        }
    }

    pub(in crate::algebra) fn undefined(self) -> Self {
        Self {
            defined: false,
            ..self
        }
    }

    /// Both ends `steps` floating-point numbers further out.
    pub(in crate::algebra) fn widened(self, steps: u32) -> Self {
        let (mut low, mut high) = (self.low, self.high);
        for _ in 0..steps {
            (low, high) = (low.next_down(), high.next_up());
        }
        Self::new(low, high, self.defined)
    }

    /// 1/u
    fn inverse(self) -> Self {
        if self.low > 0.0 || self.high < 0.0 {
            let low = (1.0 / self.high).next_down();
            let high = (1.0 / self.low).next_up();
            let (low, high) = if self.low > 0.0 {
                (low.max(0.0), high)
            } else {
                (low, high.min(0.0))
            };
            return Self::new(low, high, self.defined).without_zero(true);
        }
        let (low, high) = if self.low >= 0.0 {
            (0.0, f64::INFINITY)
        } else if self.high <= 0.0 {
            (f64::NEG_INFINITY, 0.0)
        } else {
            (f64::NEG_INFINITY, f64::INFINITY)
        };
        Self::new(low, high, self.defined && self.nonzero).without_zero(true)
    }

    /// |u|
    pub(in crate::algebra) fn size(self) -> Self {
        if self.low >= 0.0 {
            return self;
        }
        if self.high <= 0.0 {
            return self.neg();
        }
        Self::new(0.0, self.high.max(-self.low), self.defined).without_zero(self.nonzero)
    }

    fn integer_power(self, n: i64) -> Self {
        if n < 0 {
            return self.integer_power(n.saturating_neg()).inverse();
        }
        let mut square = if n % 2 == 0 { self.size() } else { self };
        let mut result = Self::point(1.0);
        let mut rest = n;
        while rest > 0 {
            if rest % 2 == 1 {
                result = result.mul(square);
            }
            rest /= 2;
            if rest > 0 {
                // an odd power keeps its sign through the last factor alone
                square = square.size().mul(square.size());
            }
        }
        result
    }

    /// exp(v ln u)
    fn power(self, v: Self) -> Self {
        let inside = self.restricted(0.0, f64::INFINITY);
        if v.is_positive() && inside.low == 0.0 {
            // 0^v = 0
            let greatest = v
                .mul(Self::point(inside.high).call(Function::Ln))
                .call(Function::Exp);
            return Self::new(0.0, greatest.high, inside.defined && v.defined)
                .without_zero(inside.nonzero);
        }
        v.mul(self.call(Function::Ln)).call(Function::Exp)
    }

    /// The part inside of \[low, high\].
    pub(in crate::algebra) fn restricted(self, low: f64, high: f64) -> Self {
        let inside = self.low >= low && self.high <= high;
        Self::new(
            self.low.max(low),
            self.high.min(high),
            self.defined && inside,
        )
        .without_zero(self.nonzero)
    }

    /// Values are known not to lie below `low`.
    pub(in crate::algebra) fn above(self, low: f64) -> Self {
        Self::new(self.low.max(low), self.high, self.defined)
    }

    /// Values are known to lie in \[low, high\].
    pub(in crate::algebra) fn within(self, low: f64, high: f64) -> Self {
        Self::new(self.low.max(low), self.high.min(high), self.defined)
    }

    /// A function that rises.
    pub(in crate::algebra) fn rising(self, h: impl Fn(f64) -> f64) -> Self {
        Self::new(h(self.low), h(self.high), self.defined).widened(LIBRARY_STEPS)
    }

    /// A function with |h′| ≤ 1, from the middle.
    pub(in crate::algebra) fn around_middle(self, h: impl Fn(f64) -> f64) -> Self {
        let radius = (0.5 * (self.high - self.low)).next_up();
        let middle = self.low + 0.5 * (self.high - self.low);
        if radius.is_nan() || radius >= 1.0 {
            return Self::new(-1.0, 1.0, self.defined);
        }
        let radius = (radius + 4.0 * f64::EPSILON * middle.abs()).next_up();
        let value = h(middle);
        Self::new(value - radius, value + radius, self.defined)
            .widened(LIBRARY_STEPS)
            .within(-1.0, 1.0)
    }

    /// The values of a function.
    pub(in crate::algebra) fn call(self, function: Function) -> Self {
        (function.properties().enclosure)(self)
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, v: Self) -> Self {
        let mut low = sum_below(self.low, v.low);
        let mut high = -sum_below(-self.high, -v.high);
        // the sign of a sum of equal signs is exact
        let (mut positive, mut negative) = (false, false);
        if self.low >= 0.0 && v.low >= 0.0 {
            low = low.max(0.0);
            positive = self.nonzero || v.nonzero;
        }
        if self.high <= 0.0 && v.high <= 0.0 {
            high = high.min(0.0);
            negative = self.nonzero || v.nonzero;
        }
        Self::new(low, high, self.defined && v.defined).without_zero(positive || negative)
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, v: Self) -> Self {
        self.add(v.neg())
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, v: Self) -> Self {
        let mut ends = (f64::INFINITY, f64::NEG_INFINITY);
        for a in [self.low, self.high] {
            for b in [v.low, v.high] {
                let (low, high) = end_product(a, b);
                ends = (ends.0.min(low), ends.1.max(high));
            }
        }
        Self::new(ends.0, ends.1, self.defined && v.defined).without_zero(self.nonzero && v.nonzero)
    }
}

impl Div for Interval {
    type Output = Self;

    fn div(self, v: Self) -> Self {
        self.mul(v.inverse())
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self::new(-self.high, -self.low, self.defined).without_zero(self.nonzero)
    }
}

/// A lower bound of a + b: the sum itself where it is exact, which Knuth's two-sum tells.
fn sum_below(a: f64, b: f64) -> f64 {
    let sum = a + b;
    let of_b = sum - a;
    let error = (a - (sum - of_b)) + (b - of_b);
    if error == 0.0 { sum } else { sum.next_down() }
}

/// Bounds of a·b of ends of intervals, where 0·∞ = 0.
fn end_product(a: f64, b: f64) -> (f64, f64) {
    if a == 0.0 || b == 0.0 {
        return (0.0, 0.0);
    }
    let product = a * b;
    if (a > 0.0) == (b > 0.0) {
        (product.next_down().max(0.0), product.next_up())
    } else {
        (product.next_down(), product.next_up().min(0.0))
    }
}
