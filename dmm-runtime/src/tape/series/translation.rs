//! Recurrences of a program, translated once.

use dmm_compiler::algebra::{Function, Id};
use dmm_compiler::program::Lowered;
use dmm_compiler::program::series::{Base, Factor, Primitive, Recurrence, Scaled};

use super::steps::{FunctionStep, Integral, Multiple, Multiplier, PowerBase, Step, Value};
use crate::tape::operation::{Operation, register};

/// Translates recurrences.
pub(super) struct Translation<'a> {
    pub(super) lowered: &'a Lowered,
}

impl Translation<'_> {
    pub(super) fn value(&self, id: Id) -> Value {
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

    pub(super) fn step(&self, id: Id, recurrence: &Recurrence) -> Option<Step> {
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
                ..
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
                derivative,
            } => {
                let integer = self.lowered.dag().as_integer(exponent);
                Step::Power {
                    to,
                    base,
                    exponent: register(exponent),
                    integer: integer.and_then(|n| i32::try_from(n).ok()),
                    own,
                    inverse,
                    derivative,
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
            _ => Step::Function(to, self.function(recurrence)?),
        })
    }

    fn function(&self, recurrence: &Recurrence) -> Option<FunctionStep> {
        Some(match *recurrence {
            Recurrence::VariablePower {
                base,
                exponent,
                derivative,
                own,
            } => FunctionStep::VariablePower {
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
            Recurrence::SquareRoot {
                argument,
                own,
                inverse,
            } => FunctionStep::SquareRoot {
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
                FunctionStep::Exponential {
                    argument: self.value(argument),
                    rate: secular.map(|(negative, p, _)| (negative, register(p))),
                    derivative,
                    own,
                }
            }
            Recurrence::Tangent {
                function,
                is_negative,
                argument,
                derivative,
                own,
                partner,
            } => FunctionStep::Tangent {
                function,
                is_negative,
                argument: self.value(argument),
                derivative,
                own,
                partner,
            },
            Recurrence::Logarithm(primitive) => {
                FunctionStep::Primitive(self.integral(&primitive, Function::Ln))
            }
            Recurrence::ArcTangent {
                argument,
                primitive,
            } => FunctionStep::ArcTangent {
                argument,
                integral: self.integral(&primitive, Function::Atan),
            },
            Recurrence::ArcSine {
                function,
                argument,
                inverse,
                primitive,
            } => FunctionStep::ArcSine {
                argument,
                inverse,
                integral: self.integral(&primitive, function),
            },
            _ => return None,
        })
    }

    pub(super) fn multiplier(factor: Factor) -> Multiplier {
        match factor {
            Factor::Minus => Multiplier::Minus,
            Factor::Node(id) => Multiplier::Register(register(id)),
        }
    }

    pub(super) fn multiple(&self, scaled: &Scaled) -> Multiple {
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
