//! Formulas of t and x, written by operators, as lists of operations: evaluated at points, over
//! intervals, and as Taylor series ([`crate::series`]).

use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::interval::Interval;
use crate::pairs::Pair;

/// An operation on the results of earlier ones.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Operation {
    Number(f64),
    Time,
    State(usize),
    Add(usize, usize),
    Sub(usize, usize),
    Mul(usize, usize),
    Div(usize, usize),
    Apply(Function, usize),
}

/// A function of one number.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Function {
    Sqrt,
    Exp,
    Ln,
    Sin,
    Cos,
    Tanh,
    Atan,
}

/// A list of operations that is being written.
#[derive(Default)]
pub(super) struct Writer {
    operations: RefCell<Vec<Operation>>,
}

/// A formula: the result of one of the operations.
#[derive(Clone, Copy)]
pub(super) struct Formula<'w> {
    writer: &'w Writer,
    index: usize,
}

impl Writer {
    fn push(&self, operation: Operation) -> Formula<'_> {
        let mut operations = self.operations.borrow_mut();
        operations.push(operation);
        Formula {
            writer: self,
            index: operations.len() - 1,
        }
    }

    pub(super) fn number(&self, value: f64) -> Formula<'_> {
        self.push(Operation::Number(value))
    }

    pub(super) fn time(&self) -> Formula<'_> {
        self.push(Operation::Time)
    }

    pub(super) fn state<const N: usize>(&self) -> [Formula<'_>; N] {
        std::array::from_fn(|i| self.push(Operation::State(i)))
    }
}

impl Formula<'_> {
    fn apply(self, function: Function) -> Self {
        self.writer.push(Operation::Apply(function, self.index))
    }

    pub(super) fn sqrt(self) -> Self {
        self.apply(Function::Sqrt)
    }

    pub(super) fn exp(self) -> Self {
        self.apply(Function::Exp)
    }

    pub(super) fn ln(self) -> Self {
        self.apply(Function::Ln)
    }

    pub(super) fn sin(self) -> Self {
        self.apply(Function::Sin)
    }

    pub(super) fn cos(self) -> Self {
        self.apply(Function::Cos)
    }

    pub(super) fn tanh(self) -> Self {
        self.apply(Function::Tanh)
    }

    pub(super) fn atan(self) -> Self {
        self.apply(Function::Atan)
    }

    pub(super) fn square(self) -> Self {
        self * self
    }
}

macro_rules! operators {
    ($($name:ident, $method:ident;)+) => {$(
        impl $name for Formula<'_> {
            type Output = Self;

            fn $method(self, other: Self) -> Self {
                self.writer.push(Operation::$name(self.index, other.index))
            }
        }

        impl $name<f64> for Formula<'_> {
            type Output = Self;

            fn $method(self, other: f64) -> Self {
                let other = self.writer.number(other);
                self.$method(other)
            }
        }
    )+};
}

operators! {
    Add, add;
    Sub, sub;
    Mul, mul;
    Div, div;
}

impl Neg for Formula<'_> {
    type Output = Self;

    fn neg(self) -> Self {
        self * -1.0
    }
}

/// Formulas that are evaluated together.
#[derive(Clone, Debug)]
pub(super) struct Formulas {
    pub(super) operations: Vec<Operation>,
    /// Which results are theirs.
    pub(super) results: Vec<usize>,
}

impl Formulas {
    /// The formulas that `write` makes.
    pub(super) fn of(write: impl for<'w> Fn(&'w Writer) -> Vec<Formula<'w>>) -> Self {
        let writer = Writer::default();
        let results = write(&writer).iter().map(|formula| formula.index).collect();
        Self {
            operations: writer.operations.into_inner(),
            results,
        }
    }

    /// Their values where the time and the state are of whatever kind of number.
    pub(super) fn evaluate<S: Number>(&self, t: S, x: &[S], values: &mut Vec<S>) {
        values.clear();
        for operation in &self.operations {
            let value = match *operation {
                Operation::Number(value) => S::constant(value),
                Operation::Time => t,
                Operation::State(i) => x[i],
                Operation::Add(a, b) => values[a].plus(values[b]),
                Operation::Sub(a, b) => values[a].plus(values[b].negative()),
                Operation::Mul(a, b) if a == b => values[a].square(),
                Operation::Mul(a, b) => values[a].times(values[b]),
                Operation::Div(a, b) => values[a].over(values[b]),
                Operation::Apply(function, a) => values[a].apply(function),
            };
            values.push(value);
        }
    }

    /// The value of one of them after [`Formulas::evaluate`].
    pub(super) fn result<S: Copy>(&self, index: usize, values: &[S]) -> S {
        values[self.results[index]]
    }
}

/// What formulas are evaluated with.
pub(super) trait Number: Copy {
    fn constant(value: f64) -> Self;
    fn plus(self, other: Self) -> Self;
    fn negative(self) -> Self;
    fn times(self, other: Self) -> Self;
    fn over(self, other: Self) -> Self;
    fn apply(self, function: Function) -> Self;

    fn square(self) -> Self {
        self.times(self)
    }
}

/// The arithmetic of a type that has operators.
macro_rules! by_operators {
    () => {
        fn plus(self, other: Self) -> Self {
            self + other
        }

        fn negative(self) -> Self {
            -self
        }

        fn times(self, other: Self) -> Self {
            self * other
        }

        fn over(self, other: Self) -> Self {
            self / other
        }
    };
}

impl Number for f64 {
    fn constant(value: f64) -> Self {
        value
    }

    by_operators!();

    fn apply(self, function: Function) -> Self {
        match function {
            Function::Sqrt => self.sqrt(),
            Function::Exp => self.exp(),
            Function::Ln => self.ln(),
            Function::Sin => self.sin(),
            Function::Cos => self.cos(),
            Function::Tanh => self.tanh(),
            Function::Atan => self.atan(),
        }
    }
}

impl Number for Pair {
    fn constant(value: f64) -> Self {
        Self::new(value)
    }

    by_operators!();

    fn apply(self, function: Function) -> Self {
        match function {
            Function::Sqrt => self.sqrt(),
            Function::Exp => self.exp(),
            Function::Ln => self.ln(),
            Function::Sin => self.sin_cos().0,
            Function::Cos => self.sin_cos().1,
            Function::Tanh => self.tanh(),
            Function::Atan => self.atan(),
        }
    }
}

impl Number for Interval {
    fn constant(value: f64) -> Self {
        Self::point(value)
    }

    fn plus(self, other: Self) -> Self {
        self.add(other)
    }

    fn negative(self) -> Self {
        self.negative()
    }

    fn times(self, other: Self) -> Self {
        self.mul(other)
    }

    fn over(self, other: Self) -> Self {
        self.mul(other.inverse())
    }

    fn square(self) -> Self {
        self.square()
    }

    fn apply(self, function: Function) -> Self {
        match function {
            Function::Sqrt => self.sqrt(),
            Function::Exp => self.growing(f64::exp),
            Function::Ln => self.ln(),
            Function::Sin => self.sin(),
            Function::Cos => self.cos(),
            Function::Tanh => self.growing(f64::tanh),
            Function::Atan => self.growing(f64::atan),
        }
    }
}

/// A number with its derivative by one variable.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dual<S> {
    pub(super) value: S,
    pub(super) rate: S,
}

impl<S: Number> Number for Dual<S> {
    fn constant(value: f64) -> Self {
        Self {
            value: S::constant(value),
            rate: S::constant(0.0),
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            value: self.value.plus(other.value),
            rate: self.rate.plus(other.rate),
        }
    }

    fn negative(self) -> Self {
        Self {
            value: self.value.negative(),
            rate: self.rate.negative(),
        }
    }

    fn times(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        Self {
            value: a.times(b),
            rate: self.rate.times(b).plus(a.times(other.rate)),
        }
    }

    fn square(self) -> Self {
        let two = S::constant(2.0);
        Self {
            value: self.value.square(),
            rate: two.times(self.value).times(self.rate),
        }
    }

    fn over(self, other: Self) -> Self {
        let value = self.value.over(other.value);
        let change = self.rate.plus(value.times(other.rate).negative());
        Self {
            value,
            rate: change.over(other.value),
        }
    }

    fn apply(self, function: Function) -> Self {
        let value = self.value.apply(function);
        let one = S::constant(1.0);
        let slope = match function {
            Function::Sqrt => S::constant(0.5).over(value),
            Function::Exp => value,
            Function::Ln => one.over(self.value),
            Function::Sin => self.value.apply(Function::Cos),
            Function::Cos => self.value.apply(Function::Sin).negative(),
            Function::Tanh => one.plus(value.square().negative()),
            Function::Atan => one.over(one.plus(self.value.square())),
        };
        Self {
            value,
            rate: slope.times(self.rate),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_has_the_same_value_in_every_arithmetic() {
        let formulas = Formulas::of(|w| {
            let [x, y] = w.state();
            let r = (x.square() + y.square() + 0.5).sqrt();
            let first = (r * 3.0 - w.time()).sin() + (x - y).tanh() * r.ln();
            vec![first, (x / r).atan() - (-y).exp() * (x * y).cos()]
        });
        let (t, x) = (0.3, [0.7, -1.2]);
        let mut doubles = Vec::new();
        formulas.evaluate(t, &x, &mut doubles);
        let mut pairs = Vec::new();
        formulas.evaluate(Pair::new(t), &x.map(Pair::new), &mut pairs);
        // x moves with the velocity 1, y with 2
        let dual = |value: f64, rate: f64| Dual {
            value: Interval::around(value, 1e-3),
            rate: Interval::point(rate),
        };
        let mut duals = Vec::new();
        let moving = [dual(x[0], 1.0), dual(x[1], 2.0)];
        formulas.evaluate(dual(t, 0.0), &moving, &mut duals);
        let mut later = Vec::new();
        let h = 1e-7;
        formulas.evaluate(t, &[x[0] + h, x[1] + 2.0 * h], &mut later);
        for k in 0..2 {
            let value = formulas.result(k, &doubles);
            assert!((formulas.result(k, &pairs).to_double() - value).abs() < 1e-14);
            let Dual { value: range, rate } = formulas.result(k, &duals);
            assert!(range.lower < value && value < range.upper && range.upper - range.lower < 0.05);
            let slope = (formulas.result(k, &later) - value) / h;
            assert!(rate.lower < slope && slope < rate.upper && rate.upper - rate.lower < 0.1);
        }
    }
}
