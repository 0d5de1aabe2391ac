//! The Taylor coefficients of a solution, and of switching functions along it: the recurrences of
//! a program, one order at a time.

use dmm_compiler::algebra::{Function, Id};
use dmm_compiler::program::series::{
    Base, Factor, Place, Primitive, Recurrence, Scaled, SeriesResult,
};
use dmm_compiler::program::{Functions, Lowered, Series, Variable};

use super::code::inputs;
use super::operation::{Operation, Register, call, register};
use crate::arithmetic::Scalar;
use crate::series::{self, Order};

/// The recurrences of some roots.
#[derive(Debug)]
pub(super) struct SeriesCode {
    inputs: Vec<(Register, Variable)>,
    /// How many arrays there are.
    slots: usize,
    /// How many of them are those of the states or of the roots.
    first: usize,
    steps: Vec<Step>,
    results: Vec<Outcome>,
}

/// A coefficient, or what is constant in time.
#[derive(Clone, Copy, Debug)]
struct Value {
    register: Register,
    is_fixed: bool,
}

/// One step of an order.
#[derive(Clone, Debug)]
enum Step {
    Operation(Operation),
    /// ±u ± c
    Shifted {
        to: Register,
        moving: (bool, Value),
        fixed: (bool, Register),
    },
    Square(Register, Place),
    Product(Register, [Place; 2]),
    Quotient {
        to: Register,
        numerator: Value,
        denominator: Place,
        own: Place,
        inverse: Place,
    },
    Power {
        to: Register,
        base: Place,
        exponent: Register,
        integer: Option<i32>,
        own: Place,
        inverse: Place,
    },
    VariablePower {
        to: Register,
        base: PowerBase,
        exponent: Value,
        derivative: Place,
        own: Place,
    },
    SquareRoot {
        to: Register,
        argument: Value,
        own: Place,
        inverse: Place,
    },
    Exponential {
        to: Register,
        argument: Value,
        /// p and its sign where the argument is ±p t.
        rate: Option<(bool, Register)>,
        derivative: Place,
        own: Place,
    },
    Pair {
        functions: [Function; 2],
        is_negative: bool,
        argument: Value,
        derivative: Place,
        places: [Place; 2],
    },
    Computed(Register, Place),
    Tangent {
        to: Register,
        function: Function,
        is_negative: bool,
        argument: Value,
        derivative: Place,
        own: Place,
        partner: Place,
    },
    Primitive(Register, Integral),
    ArcTangent {
        to: Register,
        argument: Place,
        integral: Integral,
    },
    ArcSine {
        to: Register,
        argument: Place,
        inverse: Place,
        integral: Integral,
    },
    /// The coefficient is kept in a slot.
    Keep(usize, Register),
}

/// ±∫ du/v, a function of u.
#[derive(Clone, Copy, Debug)]
struct Integral {
    function: Function,
    argument: Value,
    divisor: Place,
    slope: Place,
    inverse: Place,
    is_negative: bool,
}

/// The base of a power whose exponent changes.
#[derive(Clone, Copy, Debug)]
enum PowerBase {
    Moving {
        base: Place,
        exponent: Place,
        logarithm: Place,
        integral: Integral,
    },
    Fixed {
        base: Register,
        logarithm: Place,
    },
}

/// What is made of a root.
#[derive(Clone, Debug)]
enum Outcome {
    Value(Value),
    Solution {
        value: Multiple,
        later: Option<(Option<Multiplier>, Multiple)>,
    },
}

/// A coefficient times a scale.
#[derive(Clone, Debug)]
enum Multiple {
    Constant(Register),
    Node(Value),
    Times(Multiplier, Box<Self>),
    Shifted {
        is_negative: bool,
        moving: Box<Self>,
        fixed: (bool, Register),
    },
    Square(Place),
}

/// What a coefficient is multiplied by.
#[derive(Clone, Copy, Debug)]
enum Multiplier {
    Minus,
    Register(Register),
}

/// The nodes of a series whose values are constant in time.
pub(super) fn fixed(functions: &Functions, series: &Series) -> Vec<Id> {
    let lowered = &functions.lowered;
    let nodes = series.operations.iter().chain(&series.roots).copied();
    nodes.filter(|&id| lowered.is_fixed(id)).collect()
}

/// Translates recurrences.
struct Translation<'a> {
    lowered: &'a Lowered,
}

impl Translation<'_> {
    fn value(&self, id: Id) -> Value {
        Value {
            register: register(id),
            is_fixed: self.lowered.is_fixed(id),
        }
    }

    fn integral(&self, primitive: &Primitive, function: Function) -> Integral {
        Integral {
            function,
            argument: self.value(primitive.argument),
            divisor: primitive.divisor,
            slope: primitive.slope,
            inverse: primitive.inverse,
            is_negative: primitive.is_negative,
        }
    }

    fn step(&self, id: Id, recurrence: &Recurrence) -> Option<Step> {
        let to = register(id);
        Some(match *recurrence {
            Recurrence::Linear => Step::Operation(Operation::of(self.lowered, id)?),
            Recurrence::Shifted(sum) => Step::Shifted {
                to,
                moving: (sum.moving.0, self.value(sum.moving.1)),
                fixed: (sum.fixed.0, register(sum.fixed.1)),
            },
            Recurrence::Square(of) => Step::Square(to, of),
            Recurrence::Product(of) => Step::Product(to, of),
            Recurrence::Quotient {
                numerator,
                denominator,
                own,
                inverse,
            } => Step::Quotient {
                to,
                numerator: self.value(numerator),
                denominator,
                own,
                inverse,
            },
            Recurrence::Power {
                base,
                exponent,
                own,
                inverse,
            } => {
                let integer = self.lowered.dag().as_integer(exponent);
                Step::Power {
                    to,
                    base,
                    exponent: register(exponent),
                    integer: integer.and_then(|n| i32::try_from(n).ok()),
                    own,
                    inverse,
                }
            }
            Recurrence::VariablePower {
                base,
                exponent,
                derivative,
                own,
            } => Step::VariablePower {
                to,
                base: match base {
                    Base::Moving {
                        base,
                        exponent,
                        logarithm,
                        primitive,
                    } => PowerBase::Moving {
                        base,
                        exponent,
                        logarithm,
                        integral: self.integral(&primitive, Function::Ln),
                    },
                    Base::Fixed { base, logarithm } => PowerBase::Fixed {
                        base: register(base),
                        logarithm,
                    },
                },
                exponent: self.value(exponent),
                derivative,
                own,
            },
            _ => self.function(to, recurrence)?,
        })
    }

    fn function(&self, to: Register, recurrence: &Recurrence) -> Option<Step> {
        Some(match *recurrence {
            Recurrence::SquareRoot {
                argument,
                own,
                inverse,
            } => Step::SquareRoot {
                to,
                argument: self.value(argument),
                own,
                inverse,
            },
            Recurrence::Exponential {
                argument,
                derivative,
                own,
            } => {
                let secular = self.lowered.secular(argument);
                Step::Exponential {
                    to,
                    argument: self.value(argument),
                    rate: secular.map(|(negative, p, _)| (negative, register(p))),
                    derivative,
                    own,
                }
            }
            Recurrence::Pair {
                functions,
                is_negative,
                argument,
                derivative,
                places,
                ..
            } => Step::Pair {
                functions,
                is_negative,
                argument: self.value(argument),
                derivative,
                places,
            },
            Recurrence::Computed(own) => Step::Computed(to, own),
            Recurrence::Tangent {
                function,
                is_negative,
                argument,
                derivative,
                own,
                partner,
            } => Step::Tangent {
                to,
                function,
                is_negative,
                argument: self.value(argument),
                derivative,
                own,
                partner,
            },
            Recurrence::Logarithm(primitive) => {
                Step::Primitive(to, self.integral(&primitive, Function::Ln))
            }
            Recurrence::ArcTangent {
                argument,
                primitive,
            } => Step::ArcTangent {
                to,
                argument,
                integral: self.integral(&primitive, Function::Atan),
            },
            Recurrence::ArcSine {
                function,
                argument,
                inverse,
                primitive,
            } => Step::ArcSine {
                to,
                argument,
                inverse,
                integral: self.integral(&primitive, function),
            },
            _ => return None,
        })
    }

    fn multiplier(factor: Factor) -> Multiplier {
        match factor {
            Factor::Minus => Multiplier::Minus,
            Factor::Node(id) => Multiplier::Register(register(id)),
        }
    }

    fn multiple(&self, scaled: &Scaled) -> Multiple {
        match scaled {
            Scaled::Constant(id) => Multiple::Constant(register(*id)),
            Scaled::Node(id) => Multiple::Node(self.value(*id)),
            Scaled::Multiple(factor, of) => {
                Multiple::Times(Self::multiplier(*factor), Box::new(self.multiple(of)))
            }
            Scaled::Shifted {
                is_negative,
                moving,
                fixed,
            } => Multiple::Shifted {
                is_negative: *is_negative,
                moving: Box::new(self.multiple(moving)),
                fixed: (fixed.0, register(fixed.1)),
            },
            Scaled::Square { of, .. } => Multiple::Square(*of),
        }
    }
}

impl SeriesCode {
    /// That of `series`, of which `first` arrays are those of the states or of the roots.
    pub(super) fn new(functions: &Functions, series: &Series, first: usize) -> Self {
        let translation = Translation {
            lowered: &functions.lowered,
        };
        let mut steps = Vec::new();
        for coefficient in &series.coefficients {
            let node = coefficient.node;
            let is_input = series.inputs.iter().any(|input| input.node == node);
            if !is_input {
                steps.extend(translation.step(node, &coefficient.recurrence));
                if let Recurrence::Pair { own, .. } = coefficient.recurrence {
                    steps.push(Step::Computed(register(node), own));
                }
            }
            if let Some(slot) = coefficient.kept {
                steps.push(Step::Keep(slot, register(node)));
            }
        }
        let results = series.results.iter().map(|result| match result {
            SeriesResult::Value(root) => Outcome::Value(translation.value(*root)),
            SeriesResult::Solution { value, later } => Outcome::Solution {
                value: translation.multiple(value),
                later: later.as_ref().map(|later| {
                    let factor = later.factor.map(Translation::multiplier);
                    (factor, translation.multiple(&later.value))
                }),
            },
        });
        Self {
            inputs: inputs(&series.inputs),
            slots: series.slots,
            first,
            steps,
            results: results.collect(),
        }
    }

    /// How many arrays there are, of which the first are `components`.
    pub(super) fn slots(&self, components: usize) -> usize {
        components + self.slots - self.first
    }

    /// How many roots there are.
    pub(super) fn roots(&self) -> usize {
        self.results.len()
    }

    /// Coefficients of order k + 1 of the solution, and those of order k of what it is made from.
    pub(super) fn solution<S: Scalar, K: Order, const N: usize, const P: usize>(
        &self,
        k: K,
        t: S,
        registers: &mut [S],
        series: &mut [[S; P]],
    ) {
        let mut orders = AtOrder {
            k,
            t,
            registers,
            series,
            states: None,
            shift: N - self.first,
        };
        orders.run(self);
    }

    /// Coefficients of order k of the roots along a solution.
    pub(super) fn along<S: Scalar, K: Order, const P: usize>(
        &self,
        k: K,
        t: S,
        registers: &mut [S],
        states: &[[S; P]],
        series: &mut [[S; P]],
    ) {
        let mut orders = AtOrder {
            k,
            t,
            registers,
            series,
            states: Some(states),
            shift: 0,
        };
        orders.run(self);
    }
}

/// The coefficients of one order.
struct AtOrder<'a, S, K, const P: usize> {
    k: K,
    t: S,
    registers: &'a mut [S],
    series: &'a mut [[S; P]],
    /// The coefficients of the states, where they are given.
    states: Option<&'a [[S; P]]>,
    /// By how much slots are behind their numbers.
    shift: usize,
}

impl<S: Scalar, K: Order, const P: usize> AtOrder<'_, S, K, P> {
    /// Compiled once, and not for every number of states.
    #[inline(never)]
    fn run(&mut self, code: &SeriesCode) {
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
    fn inverse(&mut self, place: Place, value: S) -> S {
        if self.is_start() {
            self.set(place, 0, S::from_f64(1.0) / value);
        }
        self.array(place)[0]
    }

    /// h du/dh
    fn derivative(&mut self, u: S, place: Place) {
        self.set(place, self.k.get(), series::derivative(self.k, u));
    }

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
            } => {
                let inverse = self.inverse(inverse, self.array(base)[0]);
                let (u, exponent) = (self.array(base), self.fixed(exponent));
                let value = match (at, integer) {
                    (0, Some(n)) => u[0].powi(n),
                    (0, None) => u[0].powf(exponent),
                    _ => series::power(k, u, exponent, self.array(own), inverse),
                };
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
            ref other => self.function(other),
        };
        self.registers[to as usize] = value;
    }

    /// sin and cos, sinh and cosh: each the integral of the other.
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
            let (sine, cosine) = (series::integral(k, d, c), series::integral(k, d, s));
            [sine, if is_negative { -cosine } else { cosine }]
        };
        for (place, value) in places.into_iter().zip(values) {
            self.set(place, at, value);
        }
    }

    fn function(&mut self, step: &Step) -> (Register, S) {
        let (k, at, one) = (self.k, self.k.get(), S::from_f64(1.0));
        match *step {
            Step::VariablePower {
                to,
                base,
                exponent,
                derivative,
                own,
            } => (to, self.variable_power(base, exponent, derivative, own)),
            Step::SquareRoot {
                to,
                argument,
                own,
                inverse,
            } => (to, self.square_root(self.value(argument), own, inverse)),
            Step::Exponential {
                to,
                argument,
                rate,
                derivative,
                own,
            } => {
                let u = self.value(argument);
                self.derivative(u, derivative);
                let value = match (at, rate) {
                    (0, Some((negative, p))) => {
                        let p = self.fixed(p);
                        (if negative { -p } else { p }).exp_product(self.t)
                    }
                    (0, None) => u.exp(),
                    _ => series::integral(k, self.array(derivative), self.array(own)),
                };
                (to, value)
            }
            Step::Tangent {
                to,
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
                    _ => series::integral(k, self.array(derivative), self.array(partner)),
                };
                self.set(own, at, value);
                let square = series::square(k, self.array(own));
                let square = if is_negative { -square } else { square };
                self.set(partner, at, series::plus(k, square, one));
                (to, value)
            }
            Step::Primitive(to, ref integral) => (to, self.integral(integral)),
            Step::ArcTangent {
                to,
                argument,
                ref integral,
            } => {
                let square = series::square(k, self.array(argument));
                self.set(integral.divisor, at, series::plus(k, square, one));
                (to, self.integral(integral))
            }
            Step::ArcSine {
                to,
                argument,
                inverse,
                ref integral,
            } => {
                let square = series::square(k, self.array(argument));
                let base = series::plus(k, -square, one);
                let root = self.square_root(base, integral.divisor, inverse);
                self.set(integral.divisor, at, root);
                (to, self.integral(integral))
            }
            // the others are done where they are met
            _ => (0, self.registers[0]),
        }
    }

    /// √u; `own` has those of lower order.
    fn square_root(&mut self, u: S, own: Place, inverse: Place) -> S {
        let root = u.sqrt();
        let inverse = self.inverse(inverse, S::from_f64(2.0) * root);
        match self.k.get() {
            0 => root,
            _ => series::square_root(self.k, u, self.array(own), inverse),
        }
    }

    /// u^v = e^(v ln u), v changing with the time.
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
            _ => series::integral(k, self.array(derivative), self.array(own)),
        }
    }

    /// w = ±∫ du/v
    fn integral(&mut self, integral: &Integral) -> S {
        let (k, at) = (self.k, self.k.get());
        let inverse = self.inverse(integral.inverse, self.array(integral.divisor)[0]);
        let u = self.value(integral.argument);
        if at == 0 {
            self.set(integral.slope, 0, S::from_f64(0.0));
            return call(integral.function, u);
        }
        let d = series::derivative(k, if integral.is_negative { -u } else { u });
        let (v, e) = (self.array(integral.divisor), self.array(integral.slope));
        let slope = series::slope(k, d, v, e, inverse);
        self.set(integral.slope, at, slope);
        series::antiderivative(k, slope)
    }

    fn multiplied(&self, multiplier: Multiplier, scale: S) -> S {
        match multiplier {
            Multiplier::Minus => -scale,
            Multiplier::Register(register) => self.fixed(register) * scale,
        }
    }

    fn multiple(&self, multiple: &Multiple, scale: S) -> S {
        let k = self.k;
        match multiple {
            Multiple::Constant(c) => series::constant(k, self.fixed(*c) * scale),
            Multiple::Node(u) => series::scaled(k, self.value(*u), scale),
            Multiple::Times(multiplier, of) => {
                self.multiple(of, self.multiplied(*multiplier, scale))
            }
            Multiple::Shifted {
                is_negative,
                moving,
                fixed,
            } => {
                let u = self.multiple(moving, if *is_negative { -scale } else { scale });
                let c = self.fixed(fixed.1) * scale;
                series::plus(k, u, if fixed.0 { -c } else { c })
            }
            Multiple::Square(of) => {
                let half = series::half_square(k, self.array(*of));
                series::scaled(k, half, S::from_f64(2.0) * scale)
            }
        }
    }

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
