//! Taylor series of the solution of ẋ = f(t, x), by the recurrences of the coefficients of each
//! operation in f (Jorba & Zou, Experimental Mathematics 14, 2005).

use crate::formula::{Formulas, Function, Number, Operation};
use crate::pairs::Pair;

/// Numbers that a solution is computed with.
pub(super) trait Real: Number {
    /// The order of the series.
    const ORDER: usize;
    /// What a step may miss, relative to the size of the state.
    const ACCURACY: f64;

    fn of(value: Pair) -> Self;
    fn to_double(self) -> f64;
    fn pair(self) -> Pair;
}

impl Real for Pair {
    const ORDER: usize = 28;
    const ACCURACY: f64 = 1e-24;

    fn of(value: Pair) -> Self {
        value
    }

    fn to_double(self) -> f64 {
        self.to_double()
    }

    fn pair(self) -> Pair {
        self
    }
}

impl Real for f64 {
    const ORDER: usize = 20;
    const ACCURACY: f64 = 1e-16;

    fn of(value: Pair) -> Self {
        value.to_double()
    }

    fn to_double(self) -> f64 {
        self
    }

    fn pair(self) -> Pair {
        Pair::new(self)
    }
}

/// The coefficients of every operation of some formulas, and of one more function where a
/// recurrence needs it: the cosine of a sine, 1 − tanh², 1 + u² of atan u.
struct Rows<R> {
    width: usize,
    own: Vec<R>,
    other: Vec<R>,
}

impl<R: Real> Rows<R> {
    fn at(&self, row: usize, k: usize) -> R {
        self.own[row * self.width + k]
    }

    /// Σ aⱼ bₖ₋ⱼ for j from `first` to `last`, with the factor j where `weighted`.
    fn convolve(
        &self,
        (a, b): (&[R], &[R]),
        k: usize,
        (first, last): (usize, usize),
        weighted: bool,
    ) -> R {
        let mut sum = R::constant(0.0);
        for j in first..=last {
            let product = a[j].times(b[k - j]);
            sum = sum.plus(if weighted {
                product.times(R::constant(j as f64))
            } else {
                product
            });
        }
        sum
    }

    fn row(&self, row: usize) -> &[R] {
        &self.own[row * self.width..(row + 1) * self.width]
    }

    fn other(&self, row: usize) -> &[R] {
        &self.other[row * self.width..(row + 1) * self.width]
    }
}

/// xₖ of each state, for k up to the order: x(t₀ + τ) = Σ xₖ τᵏ.
pub(super) fn expand<R: Real>(field: &Formulas, t0: R, x0: &[R]) -> Vec<Vec<R>> {
    let width = R::ORDER + 1;
    let count = field.operations.len();
    let zero = R::constant(0.0);
    let mut rows = Rows {
        width,
        own: vec![zero; count * width],
        other: vec![zero; count * width],
    };
    let constant = constants(&field.operations);
    let mut x: Vec<Vec<R>> = x0.iter().map(|x| vec![*x; 1]).collect();
    for k in 0..R::ORDER {
        for (index, operation) in field.operations.iter().enumerate() {
            if constant[index] && k > 0 {
                continue;
            }
            let (own, other) = match *operation {
                Operation::Number(value) => (R::constant(value), zero),
                Operation::Time if k == 0 => (t0, zero),
                Operation::Time => (R::constant(if k == 1 { 1.0 } else { 0.0 }), zero),
                Operation::State(i) => (x[i][k], zero),
                Operation::Add(a, b) => (rows.at(a, k).plus(rows.at(b, k)), zero),
                Operation::Sub(a, b) => (rows.at(a, k).plus(rows.at(b, k).negative()), zero),
                Operation::Mul(a, b) if constant[a] => (rows.at(a, 0).times(rows.at(b, k)), zero),
                Operation::Mul(a, b) if constant[b] => (rows.at(a, k).times(rows.at(b, 0)), zero),
                Operation::Mul(a, b) => {
                    let factors = (rows.row(a), rows.row(b));
                    (rows.convolve(factors, k, (0, k), false), zero)
                }
                Operation::Div(a, b) => {
                    let rest = if constant[b] || k == 0 {
                        zero
                    } else {
                        let factors = (rows.row(b), rows.row(index));
                        rows.convolve(factors, k, (1, k), false)
                    };
                    let rest = rows.at(a, k).plus(rest.negative());
                    (rest.over(rows.at(b, 0)), zero)
                }
                Operation::Apply(function, a) if k == 0 => first(function, rows.at(a, 0)),
                Operation::Apply(function, a) => next(&rows, function, a, index, k),
            };
            rows.own[index * width + k] = own;
            rows.other[index * width + k] = other;
        }
        for (x, result) in x.iter_mut().zip(&field.results) {
            x.push(rows.at(*result, k).over(R::constant((k + 1) as f64)));
        }
    }
    x
}

/// Which results depend neither on the time nor on the state.
fn constants(operations: &[Operation]) -> Vec<bool> {
    let mut constant = Vec::with_capacity(operations.len());
    for operation in operations {
        let is_constant = match *operation {
            Operation::Number(_) => true,
            Operation::Time | Operation::State(_) => false,
            Operation::Add(a, b)
            | Operation::Sub(a, b)
            | Operation::Mul(a, b)
            | Operation::Div(a, b) => constant[a] && constant[b],
            Operation::Apply(_, a) => constant[a],
        };
        constant.push(is_constant);
    }
    constant
}

/// The value of a function, and of the one that goes with it.
fn first<R: Real>(function: Function, u: R) -> (R, R) {
    let own = u.apply(function);
    let one = R::constant(1.0);
    let other = match function {
        Function::Sin => u.apply(Function::Cos),
        Function::Cos => u.apply(Function::Sin),
        Function::Tanh => one.plus(own.times(own).negative()),
        Function::Atan => one.plus(u.times(u)),
        Function::Sqrt | Function::Exp | Function::Ln => R::constant(0.0),
    };
    (own, other)
}

/// The coefficient k of a function z of u and of the one that goes with it.
fn next<R: Real>(rows: &Rows<R>, function: Function, u: usize, z: usize, k: usize) -> (R, R) {
    let zero = R::constant(0.0);
    let inverse = |value: R| value.over(R::constant(k as f64));
    let (u_row, z_row, w_row) = (rows.row(u), rows.row(z), rows.other(z));
    match function {
        Function::Sqrt => {
            let rest = rows.convolve((z_row, z_row), k, (1, k - 1), false);
            let rest = u_row[k].plus(rest.negative());
            (rest.over(z_row[0].plus(z_row[0])), zero)
        }
        Function::Exp => {
            let sum = rows.convolve((u_row, z_row), k, (1, k), true);
            (inverse(sum), zero)
        }
        Function::Ln => {
            let sum = rows.convolve((z_row, u_row), k, (1, k - 1), true);
            let rest = u_row[k].plus(inverse(sum).negative());
            (rest.over(u_row[0]), zero)
        }
        Function::Sin | Function::Cos => {
            let own = inverse(rows.convolve((u_row, w_row), k, (1, k), true));
            let other = inverse(rows.convolve((u_row, z_row), k, (1, k), true));
            match function {
                Function::Sin => (own, other.negative()),
                _ => (own.negative(), other),
            }
        }
        Function::Tanh => {
            let own = inverse(rows.convolve((u_row, w_row), k, (1, k), true));
            // z₀zₖ twice, and the products of what was known before
            let inner = rows.convolve((z_row, z_row), k, (1, k - 1), false);
            let ends = z_row[0].times(own);
            (own, ends.plus(ends).plus(inner).negative())
        }
        Function::Atan => {
            let other = rows.convolve((u_row, u_row), k, (0, k), false);
            let sum = inverse(rows.convolve((z_row, w_row), k, (1, k - 1), true));
            let rest = u_row[k].plus(sum.negative());
            (rest.over(w_row[0]), other)
        }
    }
}

/// Σ cₖ τᵏ
pub(super) fn value<R: Real>(coefficients: &[R], tau: R) -> R {
    let sum = |sum: R, c: &R| sum.times(tau).plus(*c);
    coefficients.iter().rev().fold(R::constant(0.0), sum)
}

/// Σ k cₖ τᵏ⁻¹
pub(super) fn slope<R: Real>(coefficients: &[R], tau: R) -> R {
    let mut sum = R::constant(0.0);
    for (k, c) in coefficients.iter().enumerate().skip(1).rev() {
        sum = sum.times(tau).plus(c.times(R::constant(k as f64)));
    }
    sum
}

/// A step over which the series misses less than the accuracy: from its last coefficients, at
/// most `longest`, and halved until P′ = f(P) at its end. Nothing if there is none.
pub(super) fn step<R: Real>(
    field: &Formulas,
    t0: R,
    series: &[Vec<R>],
    size: f64,
    longest: f64,
) -> Option<f64> {
    /// Of a millionth of this part of the whole nothing is to be expected.
    const HALVINGS: usize = 60;
    let mut step = longest;
    for x in series {
        for k in [R::ORDER - 1, R::ORDER] {
            let c = x[k].to_double().abs() / size;
            if c > 0.0 {
                step = step.min((R::ACCURACY / c).powf(1.0 / k as f64));
            } else if c.is_nan() {
                return None;
            }
        }
    }
    let mut values = Vec::new();
    for _ in 0..HALVINGS {
        let tau = R::constant(step);
        let x: Vec<R> = series.iter().map(|x| value(x, tau)).collect();
        field.evaluate(t0.plus(tau), &x, &mut values);
        let defect = series.iter().enumerate().map(|(i, x)| {
            let f = field.result(i, &values);
            let change = slope(x, tau).plus(f.negative()).to_double();
            change.abs() * step / (size + f.to_double().abs() * step)
        });
        // the defect has the factor of the order, and rounding
        if defect.fold(0.0, worst) <= 100.0 * R::ACCURACY {
            return Some(step);
        }
        step *= 0.5;
    }
    None
}

/// The larger one, or NaN.
fn worst(a: f64, b: f64) -> f64 {
    if b <= a { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ẋ₀ = 1, ẋ₁ = the derivative of a function of x₀: the series of the function itself.
    #[test]
    fn every_recurrence_gives_the_function_itself() {
        let fields = [
            Formulas::of(|w| {
                let [x, _] = w.state();
                vec![w.number(1.0), x.cos() * 0.5 + w.time() * 0.0]
            }),
            Formulas::of(|w| {
                let [x, _] = w.state();
                vec![w.number(1.0), w.number(1.0) / (x.square() + 1.0)]
            }),
            Formulas::of(|w| {
                let [x, _] = w.state();
                vec![w.number(1.0), w.number(0.5) / x.sqrt()]
            }),
            Formulas::of(|w| {
                let [x, _] = w.state();
                vec![w.number(1.0), -x.tanh().square() + 1.0]
            }),
            Formulas::of(|w| {
                let [x, _] = w.state();
                vec![w.number(1.0), (x.ln() + x.exp()).sin() * x.atan()]
            }),
        ];
        let antiderivatives: [fn(Pair) -> Pair; 4] = [
            |x| x.sin_cos().0 * Pair::new(0.5),
            Pair::atan,
            Pair::sqrt,
            Pair::tanh,
        ];
        let start = Pair::new(1.25);
        for (field, function) in fields.iter().zip(antiderivatives) {
            let series = expand(field, Pair::new(0.0), &[start, function(start)]);
            let tau = Pair::new(0.01);
            let error = value(&series[1], tau) - function(start + tau);
            assert!(error.to_double().abs() < 1e-30, "{error:?}");
        }
        // no closed form: the derivative of the series is the field
        let field = &fields[4];
        let series = expand(field, Pair::new(0.0), &[start, Pair::ONE]);
        let tau = Pair::new(0.01);
        let mut values = Vec::new();
        let x = [start + tau, Pair::ONE];
        field.evaluate(tau, &x, &mut values);
        let error = slope(&series[1], tau) - field.result(1, &values);
        assert!(error.to_double().abs() < 1e-29, "{error:?}");
    }
}
