//! The recurrences of a program, order by order, as they are defined and without care for speed.

use dmm_compiler::algebra::{Function, Id};
use dmm_compiler::program::series::SeriesResult;
use dmm_compiler::program::series::{Base, Factor, Place, Primitive, Recurrence, Scaled};
use dmm_compiler::program::{Functions, Series, Variable};

use crate::arithmetic::{call, operation};
use crate::tape::{Point, Values};

/// The coefficients of all slots.
pub(crate) struct Coefficients {
    pub(crate) slots: Vec<Vec<f64>>,
    /// Those of the states, where they are given.
    states: Option<Vec<Vec<f64>>>,
    /// The largest difference of a coefficient from what it was computed as an order before.
    pub(crate) disagreement: f64,
}

impl Coefficients {
    /// None yet but the initial state.
    pub(crate) fn of_solution(series: &Series, point: &Point, order: usize) -> Self {
        let mut slots = vec![vec![0.0; order + 2]; series.slots];
        for (slot, &state) in slots.iter_mut().zip(&point.state) {
            slot.truncate(order + 1);
            slot[0] = state;
        }
        Self {
            slots,
            states: None,
            disagreement: 0.0,
        }
    }

    /// None yet, along a solution.
    pub(crate) fn along(series: &Series, states: &[Vec<f64>], order: usize) -> Self {
        Self {
            slots: vec![vec![0.0; order + 1]; series.slots],
            states: Some(states.to_vec()),
            disagreement: 0.0,
        }
    }

    /// Computes the coefficients of order k, and those of order k + 1 of a solution.
    pub(crate) fn advance(
        &mut self,
        functions: &Functions,
        series: &Series,
        stored: &Values,
        k: usize,
        time: f64,
    ) {
        let mut order = Order {
            functions,
            values: stored.clone(),
            k,
            all: self,
        };
        for input in &series.inputs {
            let value = match input.variable {
                Variable::State(index) => order.at(Place::State(index), k),
                _ => [time, 1.0].get(k).copied().unwrap_or(0.0),
            };
            order.values.insert(input.node, value);
        }
        for coefficient in &series.coefficients {
            let value = order.coefficient(coefficient.node, &coefficient.recurrence);
            order.values.insert(coefficient.node, value);
            if let Some(slot) = coefficient.kept {
                order.all.slots[slot][k] = value;
            }
        }
        order.results(series);
    }
}

/// One order.
struct Order<'a> {
    functions: &'a Functions,
    values: Values,
    k: usize,
    all: &'a mut Coefficients,
}

impl Order<'_> {
    fn array(&self, place: Place) -> &[f64] {
        match (place, &self.all.states) {
            (Place::State(index), Some(states)) => &states[index],
            (Place::State(index), None) | (Place::Slot(index), _) => &self.all.slots[index],
        }
    }

    fn at(&self, place: Place, k: usize) -> f64 {
        self.array(place)[k]
    }

    fn set(&mut self, place: Place, k: usize, value: f64) {
        if let Place::Slot(index) = place {
            self.all.slots[index][k] = value;
        }
    }

    /// Σ uⱼ vₖ₋ⱼ over `range`.
    fn sum(&self, u: Place, v: Place, range: std::ops::Range<usize>) -> f64 {
        range.map(|j| self.at(u, j) * self.at(v, self.k - j)).sum()
    }

    fn product(&self, u: Place, v: Place) -> f64 {
        self.sum(u, v, 0..self.k + 1)
    }

    /// Coefficient k ≥ 1 of ∫ v du from d = h du/dh.
    fn integral(&self, d: Place, v: Place) -> f64 {
        self.sum(d, v, 1..self.k + 1) / self.k as f64
    }

    /// The value of a node that is constant in time.
    fn fixed(&self, id: Id) -> f64 {
        match self.values.get(&id) {
            Some(&value) => value,
            None => operation(self.functions.lowered.dag(), id, |child| self.fixed(child)),
        }
    }

    /// Of something constant in time.
    fn constant(&self, value: f64) -> f64 {
        if self.k == 0 { value } else { 0.0 }
    }

    fn value(&self, id: Id) -> f64 {
        if self.functions.lowered.is_fixed(id) {
            self.constant(self.fixed(id))
        } else {
            self.values[&id]
        }
    }

    /// 1/value, which is kept at order zero.
    fn inverse(&mut self, place: Place, value: f64) -> f64 {
        if self.k == 0 {
            self.set(place, 0, 1.0 / value);
        }
        self.at(place, 0)
    }

    fn derivative(&mut self, argument: Id, place: Place) {
        self.set(place, self.k, self.k as f64 * self.value(argument));
    }

    fn coefficient(&mut self, id: Id, recurrence: &Recurrence) -> f64 {
        let k = self.k;
        let signed = |minus: bool, value: f64| if minus { -value } else { value };
        match *recurrence {
            Recurrence::Linear => match self.values.get(&id) {
                Some(&input) => input,
                None => operation(self.functions.lowered.dag(), id, |child| {
                    self.values
                        .get(&child)
                        .copied()
                        .unwrap_or_else(|| self.fixed(child))
                }),
            },
            Recurrence::Shifted(sum) => {
                let fixed = self.constant(signed(sum.fixed.0, self.fixed(sum.fixed.1)));
                signed(sum.moving.0, self.value(sum.moving.1)) + fixed
            }
            Recurrence::Square(u) => self.product(u, u),
            Recurrence::Product([u, v]) => self.product(u, v),
            Recurrence::Quotient {
                numerator,
                denominator,
                own,
                inverse,
                ..
            } => {
                let inverse = self.inverse(inverse, self.at(denominator, 0));
                (self.value(numerator) - self.sum(denominator, own, 1..k + 1)) * inverse
            }
            Recurrence::Power {
                base,
                exponent,
                own,
                inverse,
                ..
            } => {
                let (c, inverse) = (
                    self.fixed(exponent),
                    self.inverse(inverse, self.at(base, 0)),
                );
                let weight = |j: usize| c * (k - j) as f64 - j as f64;
                let terms = (0..k).map(|j| weight(j) * self.at(own, j) * self.at(base, k - j));
                match k {
                    0 => self.at(base, 0).powf(c),
                    _ => terms.sum::<f64>() * inverse / k as f64,
                }
            }
            _ => self.function(recurrence),
        }
    }

    fn function(&mut self, recurrence: &Recurrence) -> f64 {
        let k = self.k;
        match *recurrence {
            Recurrence::VariablePower {
                base,
                exponent,
                derivative,
                own,
            } => self.variable_power(base, exponent, derivative, own),
            Recurrence::SquareRoot {
                argument,
                own,
                inverse,
            } => self.square_root(self.value(argument), own, inverse),
            Recurrence::Exponential {
                argument,
                derivative,
                own,
            } => {
                self.derivative(argument, derivative);
                match k {
                    0 => self.value(argument).exp(),
                    _ => self.integral(derivative, own),
                }
            }
            Recurrence::Pair {
                functions,
                is_negative,
                argument,
                derivative,
                places: [s, c],
                own,
            } => {
                self.derivative(argument, derivative);
                let sign = if is_negative { -1.0 } else { 1.0 };
                let values = match k {
                    0 => functions.map(|one| call(one, self.value(argument))),
                    _ => [
                        self.integral(derivative, c),
                        sign * self.integral(derivative, s),
                    ],
                };
                self.set(s, k, values[0]);
                self.set(c, k, values[1]);
                self.at(own, k)
            }
            Recurrence::Computed(own) => self.at(own, k),
            Recurrence::Tangent {
                function,
                is_negative,
                argument,
                derivative,
                own,
                partner,
            } => {
                self.derivative(argument, derivative);
                let value = match k {
                    0 => call(function, self.value(argument)),
                    _ => self.integral(derivative, partner),
                };
                self.set(own, k, value);
                let sign = if is_negative { -1.0 } else { 1.0 };
                self.set(
                    partner,
                    k,
                    self.constant(1.0) + sign * self.product(own, own),
                );
                value
            }
            Recurrence::Logarithm(primitive) => self.primitive(&primitive, Function::Ln),
            Recurrence::ArcTangent {
                argument,
                primitive,
            } => {
                let square = self.product(argument, argument);
                self.set(primitive.divisor, k, self.constant(1.0) + square);
                self.primitive(&primitive, Function::Atan)
            }
            Recurrence::ArcSine {
                function,
                argument,
                inverse,
                primitive,
            } => {
                let base = self.constant(1.0) - self.product(argument, argument);
                let root = self.square_root(base, primitive.divisor, inverse);
                self.set(primitive.divisor, k, root);
                self.primitive(&primitive, function)
            }
            _ => f64::NAN,
        }
    }

    /// Coefficient k of w = √u from uₖ.
    fn square_root(&mut self, u: f64, own: Place, inverse: Place) -> f64 {
        let inverse = self.inverse(inverse, 2.0 * u.sqrt());
        match self.k {
            0 => u.sqrt(),
            k => (u - self.sum(own, own, 1..k)) * inverse,
        }
    }

    fn variable_power(&mut self, base: Base, exponent: Id, derivative: Place, own: Place) -> f64 {
        let k = self.k;
        let v = self.value(exponent);
        let (base, product) = match base {
            Base::Moving {
                base,
                exponent,
                logarithm,
                primitive,
            } => {
                let ln = self.primitive(&primitive, Function::Ln);
                self.set(logarithm, k, ln);
                (self.at(base, 0), self.product(exponent, logarithm))
            }
            Base::Fixed { base, logarithm } => {
                if k == 0 {
                    self.set(logarithm, 0, self.fixed(base).ln());
                }
                (self.fixed(base), v * self.at(logarithm, 0))
            }
        };
        self.set(derivative, k, k as f64 * product);
        match k {
            0 => base.powf(v),
            _ => self.integral(derivative, own),
        }
    }

    /// Coefficient k of w = ±∫ du/v, which is a `function` of u.
    fn primitive(&mut self, primitive: &Primitive, function: Function) -> f64 {
        let (k, u) = (self.k, self.value(primitive.argument));
        let inverse = self.inverse(primitive.inverse, self.at(primitive.divisor, 0));
        if k == 0 {
            return call(function, u);
        }
        let sign = if primitive.is_negative { -1.0 } else { 1.0 };
        let rest = self.sum(primitive.slope, primitive.divisor, 1..k);
        let slope = (sign * k as f64 * u - rest) * inverse;
        self.set(primitive.slope, k, slope);
        slope / k as f64
    }

    fn scaled(&self, scaled: &Scaled, scale: f64) -> f64 {
        match scaled {
            Scaled::Constant(id) => self.constant(self.fixed(*id)) * scale,
            Scaled::Node(id) => self.values[id] * scale,
            Scaled::Multiple(factor, of) => self.scaled(of, scale * self.factor(*factor)),
            Scaled::Shifted {
                is_negative,
                moving,
                fixed,
            } => {
                let sign = |minus: bool| if minus { -1.0 } else { 1.0 };
                let fixed = sign(fixed.0) * self.constant(self.fixed(fixed.1)) * scale;
                self.scaled(moving, sign(*is_negative) * scale) + fixed
            }
            Scaled::Square { of, .. } => self.product(*of, *of) * scale,
        }
    }

    fn factor(&self, factor: Factor) -> f64 {
        match factor {
            Factor::Minus => -1.0,
            Factor::Node(id) => self.fixed(id),
        }
    }

    fn results(&mut self, series: &Series) {
        let k = self.k;
        for (index, result) in series.results.iter().enumerate() {
            match result {
                SeriesResult::Value(root) => self.all.slots[index][k] = self.value(*root),
                SeriesResult::Solution { value, later } => {
                    let next = self.scaled(value, 1.0 / (k + 1) as f64);
                    // what a coefficient was computed as an order before
                    let known = self.all.slots[index][k + 1];
                    if k > 0 && later.is_some() && next.is_finite() {
                        let difference = (next - known).abs() / (1.0 + next.abs());
                        self.all.disagreement = self.all.disagreement.max(difference);
                    }
                    self.all.slots[index][k + 1] = next;
                }
            }
        }
        for (index, result) in series.results.iter().enumerate() {
            let SeriesResult::Solution {
                later: Some(later), ..
            } = result
            else {
                continue;
            };
            let scale = 1.0 / ((k + 1) * (k + 2)) as f64;
            let factor = later.factor.map_or(1.0, |factor| self.factor(factor));
            let value = self.scaled(&later.value, factor * scale);
            if let Some(place) = self.all.slots[index].get_mut(k + 2) {
                *place = value;
            }
        }
    }
}
