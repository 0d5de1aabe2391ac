//! What is computed at every order of a series.

use dmm_compiler::algebra::Function;
use dmm_compiler::program::series::Place;

use crate::tape::operation::{Operation, Register};

/// A coefficient, or what is constant in time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Value {
    pub(super) register: Register,
    pub(super) is_fixed: bool,
}

/// One step of an order.
#[derive(Clone, Debug)]
pub(super) enum Step {
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
        derivative: Place,
    },
    Pair {
        functions: [Function; 2],
        is_negative: bool,
        argument: Value,
        derivative: Place,
        places: [Place; 2],
    },
    Computed(Register, Place),
    Function(Register, FunctionStep),
    /// The coefficient is kept in a slot.
    Keep(usize, Register),
}

/// A function of one argument, or a power with an exponent that changes.
#[derive(Clone, Copy, Debug)]
pub(super) enum FunctionStep {
    VariablePower {
        base: PowerBase,
        exponent: Value,
        derivative: Place,
        own: Place,
    },
    SquareRoot {
        argument: Value,
        own: Place,
        inverse: Place,
    },
    Exponential {
        argument: Value,
        /// p and its sign where the argument is ±p t.
        rate: Option<(bool, Register)>,
        derivative: Place,
        own: Place,
    },
    Tangent {
        function: Function,
        is_negative: bool,
        argument: Value,
        derivative: Place,
        own: Place,
        partner: Place,
    },
    Primitive(Integral),
    ArcTangent {
        argument: Place,
        integral: Integral,
    },
    ArcSine {
        argument: Place,
        inverse: Place,
        integral: Integral,
    },
}

/// ±∫ du/v, a function of u.
#[derive(Clone, Copy, Debug)]
pub(super) struct Integral {
    pub(super) function: Function,
    pub(super) argument: Value,
    pub(super) divisor: Place,
    pub(super) slope: Place,
    pub(super) inverse: Place,
    pub(super) is_negative: bool,
}

/// The base of a power whose exponent changes.
#[derive(Clone, Copy, Debug)]
pub(super) enum PowerBase {
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
pub(super) enum Outcome {
    Value(Value),
    Solution {
        value: Multiple,
        later: Option<(Option<Multiplier>, Multiple)>,
    },
}

/// A coefficient times a scale.
#[derive(Clone, Debug)]
pub(super) enum Multiple {
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
pub(super) enum Multiplier {
    Minus,
    Register(Register),
}
