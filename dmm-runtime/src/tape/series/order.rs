//! The coefficients of one order, by the recurrences of the module `series`.

use dmm_compiler::algebra::Function;
use dmm_compiler::program::Variable;
use dmm_compiler::program::series::Place;

use pulp::NullaryFnOnce;

use super::SeriesCode;
use super::steps::{FunctionStep, Integral, Multiple, Multiplier, Outcome, PowerBase, Step, Value};
use crate::arithmetic::Scalar;
use crate::series::{self, Order};
use crate::tape::operation::{Register, call};

/// The coefficients of one order.
pub(super) struct AtOrder<'a, S, K, const P: usize> {
    pub(super) k: K,
    pub(super) t: S,
    pub(super) registers: &'a mut [S],
    pub(super) series: &'a mut [[S; P]],
    /// The coefficients of the states, where they are given.
    pub(super) states: Option<&'a [[S; P]]>,
    /// By how much slots are behind their numbers.
    pub(super) shift: usize,
}

impl<S: Scalar, K: Order, const P: usize> AtOrder<'_, S, K, P> {
    /// Compiled once, and not for every number of states.
    pub(super) fn run(&mut self, code: &SeriesCode) {
        S::apart(Whole { order: self, code });
    }

    #[inline(always)]
    fn whole(&mut self, code: &SeriesCode) {
        let at = self.k.get();
        for &(register, variable) in &code.inputs {
            self.registers[register as usize] = match variable {
                Variable::State(index) => self.array(Place::State(index))[at],
                _ => series::time(self.k, self.t),
            };
        }
        for step in &code.steps {
            self.step(step);
        }
        for (index, result) in code.results.iter().enumerate() {
            self.result(index, result);
        }
    }

    #[inline(always)]
    fn slot(&self, place: Place) -> usize {
        match place {
            Place::State(index) => index,
            Place::Slot(index) => index + self.shift,
        }
    }

    #[inline(always)]
    fn array(&self, place: Place) -> &[S; P] {
        match (place, self.states) {
            (Place::State(index), Some(states)) => &states[index],
            _ => &self.series[self.slot(place)],
        }
    }

    #[inline(always)]
    fn set(&mut self, place: Place, at: usize, value: S) {
        let slot = self.slot(place);
        self.series[slot][at] = value;
    }

    #[inline(always)]
    fn fixed(&self, register: Register) -> S {
        self.registers[register as usize]
    }

    /// A coefficient, a constant's too.
    #[inline(always)]
    fn value(&self, value: Value) -> S {
        let of = self.fixed(value.register);
        if value.is_fixed {
            series::constant(self.k, of)
        } else {
            of
        }
    }

    #[inline(always)]
    fn is_start(&self) -> bool {
        self.k.get() == 0
    }

    /// The reciprocal of `value`, taken at order zero.
    #[inline(always)]
    fn inverse(&mut self, place: Place, value: S) -> S {
        if self.is_start() {
            self.set(place, 0, S::from_f64(1.0) / value);
        }
        self.array(place)[0]
    }

    /// h du/dh
    #[inline(always)]
    fn derivative(&mut self, u: S, place: Place) {
        self.set(place, self.k.get(), series::derivative(self.k, u));
    }

    #[inline(always)]
    fn step(&mut self, step: &Step) {
        let (k, at) = (self.k, self.k.get());
        let signed = |is_negative: bool, u: S| if is_negative { -u } else { u };
        let (to, value) = match *step {
            Step::Operation(operation) => {
                operation.run(self.registers);
                return;
            }
            Step::Keep(slot, from) => {
                self.set(Place::Slot(slot), at, self.fixed(from));
                return;
            }
            Step::Shifted { to, moving, fixed } => {
                let u = signed(moving.0, self.value(moving.1));
                let c = signed(fixed.0, self.fixed(fixed.1));
                (to, series::plus(k, u, c))
            }
            Step::Square(to, of) => (to, series::square(k, self.array(of))),
            Step::Product(to, [u, v]) => (to, series::product(k, self.array(u), self.array(v))),
            Step::Quotient {
                to,
                numerator,
                denominator,
                own,
                inverse,
            } => {
                let inverse = self.inverse(inverse, self.array(denominator)[0]);
                let (v, w) = (self.array(denominator), self.array(own));
                (
                    to,
                    series::quotient(k, self.value(numerator), v, w, inverse),
                )
            }
            Step::Power {
                to,
                base,
                exponent,
                integer,
                own,
                inverse,
                derivative,
            } => {
                let inverse = self.inverse(inverse, self.array(base)[0]);
                let (u, exponent) = (self.array(base), self.fixed(exponent));
                let value = match (at, integer) {
                    (0, Some(n)) => u[0].powi(n),
                    (0, None) => u[0].powf(exponent),
                    _ => {
                        let w = [own, derivative].map(|place| self.array(place));
                        series::power(k, u, exponent, w, inverse)
                    }
                };
                self.derivative(value, derivative);
                (to, value)
            }
            Step::Computed(to, own) => (to, self.array(own)[at]),
            Step::Pair {
                functions,
                is_negative,
                argument,
                derivative,
                places,
            } => {
                let u = self.value(argument);
                self.pair((functions, is_negative), u, derivative, places);
                return;
            }
            Step::Function(to, function) => (to, self.function(function)),
        };
        self.registers[to as usize] = value;
    }

    /// sin and cos, sinh and cosh: each the integral of the other.
    #[inline(always)]
    fn pair(
        &mut self,
        (functions, is_negative): ([Function; 2], bool),
        u: S,
        derivative: Place,
        places: [Place; 2],
    ) {
        let (k, at) = (self.k, self.k.get());
        self.derivative(u, derivative);
        let values = if at == 0 {
            functions.map(|function| call(function, u))
        } else {
            let d = self.array(derivative);
            let [s, c] = places.map(|place| self.array(place));
            let [sine, cosine] = [c, s].map(|of| series::integral(k, u, d, of));
            [sine, if is_negative { -cosine } else { cosine }]
        };
        for (place, value) in places.into_iter().zip(values) {
            self.set(place, at, value);
        }
    }

    #[inline(always)]
    fn function(&mut self, step: FunctionStep) -> S {
        let (k, at, one) = (self.k, self.k.get(), S::from_f64(1.0));
        match step {
            FunctionStep::VariablePower {
                base,
                exponent,
                derivative,
                own,
            } => self.variable_power(base, exponent, derivative, own),
            FunctionStep::SquareRoot {
                argument,
                own,
                inverse,
            } => self.square_root(self.value(argument), own, inverse),
            FunctionStep::Exponential {
                argument,
                rate,
                derivative,
                own,
            } => {
                let u = self.value(argument);
                self.derivative(u, derivative);
                match (at, rate) {
                    (0, Some((negative, p))) => {
                        let p = self.fixed(p);
                        (if negative { -p } else { p }).exp_product(self.t)
                    }
                    (0, None) => u.exp(),
                    _ => series::integral(k, u, self.array(derivative), self.array(own)),
                }
            }
            FunctionStep::Tangent {
                function,
                is_negative,
                argument,
                derivative,
                own,
                partner,
            } => {
                let u = self.value(argument);
                self.derivative(u, derivative);
                let value = match at {
                    0 => call(function, u),
                    _ => series::integral(k, u, self.array(derivative), self.array(partner)),
                };
                self.set(own, at, value);
                let square = series::square(k, self.array(own));
                let square = if is_negative { -square } else { square };
                self.set(partner, at, series::plus(k, square, one));
                value
            }
            FunctionStep::Primitive(ref integral) => self.integral(integral),
            FunctionStep::ArcTangent {
                argument,
                ref integral,
            } => {
                let square = series::square(k, self.array(argument));
                self.set(integral.divisor, at, series::plus(k, square, one));
                self.integral(integral)
            }
            FunctionStep::ArcSine {
                argument,
                inverse,
                ref integral,
            } => {
                let square = series::square(k, self.array(argument));
                let base = series::plus(k, -square, one);
                let root = self.square_root(base, integral.divisor, inverse);
                self.set(integral.divisor, at, root);
                self.integral(integral)
            }
        }
    }

    /// √u; `own` has those of lower order.
    #[inline(always)]
    fn square_root(&mut self, u: S, own: Place, inverse: Place) -> S {
        let root = u.sqrt();
        let inverse = self.inverse(inverse, S::from_f64(2.0) * root);
        match self.k.get() {
            0 => root,
            _ => series::square_root(self.k, u, self.array(own), inverse),
        }
    }

    /// u^v = e^(v ln u), v changing with the time.
    #[inline(always)]
    fn variable_power(
        &mut self,
        base: PowerBase,
        exponent: Value,
        derivative: Place,
        own: Place,
    ) -> S {
        let (k, at) = (self.k, self.k.get());
        let v = self.value(exponent);
        let (base, product) = match base {
            PowerBase::Moving {
                base,
                exponent,
                logarithm,
                ref integral,
            } => {
                let ln = self.integral(integral);
                self.set(logarithm, at, ln);
                let (v, ln) = (self.array(exponent), self.array(logarithm));
                (self.array(base)[0], series::product(k, v, ln))
            }
            PowerBase::Fixed { base, logarithm } => {
                let base = self.fixed(base);
                if at == 0 {
                    self.set(logarithm, 0, base.ln());
                }
                (base, v * self.array(logarithm)[0])
            }
        };
        self.derivative(product, derivative);
        match at {
            0 => base.powf(v),
            _ => series::integral(k, product, self.array(derivative), self.array(own)),
        }
    }

    /// w = ±∫ du/v
    #[inline(always)]
    fn integral(&mut self, integral: &Integral) -> S {
        let (k, at) = (self.k, self.k.get());
        let inverse = self.inverse(integral.inverse, self.array(integral.divisor)[0]);
        let u = self.value(integral.argument);
        if at == 0 {
            self.set(integral.slope, 0, S::from_f64(0.0));
            return call(integral.function, u);
        }
        let u = if integral.is_negative { -u } else { u };
        let (v, e) = (self.array(integral.divisor), self.array(integral.slope));
        let w = series::primitive(k, u, v, e, inverse);
        self.derivative(w, integral.slope);
        w
    }

    #[inline(always)]
    fn multiplied(&self, multiplier: Multiplier, scale: S) -> S {
        match multiplier {
            Multiplier::Minus => -scale,
            Multiplier::Register(register) => self.fixed(register) * scale,
        }
    }

    #[inline(always)]
    fn multiple(&self, multiple: &Multiple, scale: S) -> S {
        let k = self.k;
        let within = |of, scale| {
            S::apart(Scaled {
                order: self,
                of,
                scale,
            })
        };
        match multiple {
            Multiple::Constant(c) => series::constant(k, self.fixed(*c) * scale),
            Multiple::Node(u) => self.value(*u) * scale,
            Multiple::Times(multiplier, of) => within(of, self.multiplied(*multiplier, scale)),
            Multiple::Shifted {
                is_negative,
                moving,
                fixed,
            } => {
                let u = within(moving, if *is_negative { -scale } else { scale });
                let c = self.fixed(fixed.1) * scale;
                series::plus(k, u, if fixed.0 { -c } else { c })
            }
            Multiple::Square(of) => {
                let half = series::half_square(k, self.array(*of));
                half * (S::from_f64(2.0) * scale)
            }
        }
    }

    #[inline(always)]
    fn result(&mut self, index: usize, result: &Outcome) {
        let (k, at) = (self.k, self.k.get());
        match result {
            Outcome::Value(value) => self.series[index][at] = self.value(*value),
            Outcome::Solution { value, later } => {
                let step = series::step(k);
                if later.is_none() || at == 0 {
                    self.series[index][at + 1] = self.multiple(value, step);
                }
                if let Some((factor, later)) = later
                    && at + 2 < P
                {
                    let scale = step * series::next_step(k);
                    let scale = factor.map_or(scale, |factor| self.multiplied(factor, scale));
                    self.series[index][at + 2] = self.multiple(later, scale);
                }
            }
        }
    }
}

/// All steps of an order.
struct Whole<'a, 'b, S, K, const P: usize> {
    order: &'a mut AtOrder<'b, S, K, P>,
    code: &'a SeriesCode,
}

impl<S: Scalar, K: Order, const P: usize> NullaryFnOnce for Whole<'_, '_, S, K, P> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.order.whole(self.code);
    }
}

/// A multiple within another.
struct Scaled<'a, S, K, const P: usize> {
    order: &'a AtOrder<'a, S, K, P>,
    of: &'a Multiple,
    scale: S,
}

impl<S: Scalar, K: Order, const P: usize> NullaryFnOnce for Scaled<'_, S, K, P> {
    type Output = S;

    #[inline(always)]
    fn call(self) -> S {
        self.order.multiple(self.of, self.scale)
    }
}
