//! Which recurrence a node has.

use std::collections::HashMap;

use egg::Language;

use super::super::lower::Lowered;
use super::recurrence::{Base, Place, Primitive, Recurrence, Shifted};
use super::slots::{Slot, Slots};
use super::{Coefficient, Sums};
use crate::algebra::{Equation, Function, Id, Math};

/// Chooses the recurrences of nodes.
pub(super) struct Choice<'a> {
    pub(super) lowered: &'a Lowered,
    pub(super) slots: Slots,
    /// How many operations follow on each other until a node that changes with the time has its
    /// coefficient.
    depths: HashMap<Id, usize>,
}

impl<'a> Choice<'a> {
    /// That of the recurrences of the nodes `moving`, children before parents.
    pub(super) fn new(lowered: &'a Lowered, slots: Slots, moving: &[Id]) -> Self {
        let mut depths = HashMap::new();
        for &id in moving {
            let children = lowered.dag()[id].children().iter();
            let below = children.filter_map(|child| depths.get(child)).max();
            depths.insert(id, below.map_or(1, |below| below + 1));
        }
        Self {
            lowered,
            slots,
            depths,
        }
    }

    /// How many operations follow on each other until a node has its coefficient; none where it is
    /// constant in time.
    pub(super) fn depth(&self, id: Id) -> usize {
        self.depths.get(&id).copied().unwrap_or(0)
    }

    /// The coefficients of nodes, in their order.
    pub(super) fn coefficients(&self, nodes: impl Iterator<Item = Id>) -> Vec<Coefficient> {
        let mut computed = Vec::new();
        let coefficients = nodes.map(|node| {
            let mut recurrence = self.recurrence(node);
            if let Recurrence::Pair { places, own, .. } = recurrence {
                if computed.contains(&places) {
                    recurrence = Recurrence::Computed(own);
                }
                computed.push(places);
            }
            Coefficient {
                node,
                recurrence,
                kept: self.slots.number(node),
                depth: self.depth(node),
            }
        });
        coefficients.collect()
    }

    /// Whether a node changes with the time.
    pub(super) fn is_moving(&self, id: Id) -> bool {
        !self.lowered.is_fixed(id)
    }

    /// The two terms of a sum of which one changes with the time.
    pub(super) fn shifted(&self, id: Id) -> Option<Shifted> {
        let (a, b, minus) = match self.lowered.dag()[id] {
            Math::Add([a, b]) => (a, b, false),
            Math::Sub([a, b]) => (a, b, true),
            _ => return None,
        };
        if self.is_moving(a) == self.is_moving(b) {
            return None;
        }
        let (moving, fixed) = if self.is_moving(a) {
            ((false, a), (minus, b))
        } else {
            ((minus, b), (false, a))
        };
        Some(Shifted { moving, fixed })
    }

    /// The place of a node's own coefficients.
    pub(super) fn node(&self, id: Id) -> Place {
        self.slots.place(Slot::Node(id))
    }

    fn recurrence(&self, id: Id) -> Recurrence {
        let place = |slot: Slot| self.slots.place(slot);
        match self.lowered.dag()[id] {
            Math::Add(_) | Math::Sub(_) => match self.shifted(id) {
                Some(shifted) => Recurrence::Shifted(shifted),
                None => Recurrence::Linear,
            },
            Math::Mul([a, b]) if a == b => Recurrence::Square(self.node(a)),
            Math::Mul([a, b]) if self.is_moving(a) && self.is_moving(b) => {
                let mut factors = [a, b];
                factors.sort_by_key(|&one| self.depth(one));
                Recurrence::Product(factors.map(|one| self.node(one)))
            }
            Math::Div([a, b]) if self.is_moving(b) => Recurrence::Quotient {
                numerator: a,
                denominator: self.node(b),
                own: self.node(id),
                inverse: place(Slot::Inverse(id)),
                is_late: self.slots.sums != Sums::Straight && self.depth(a) >= self.depth(b),
            },
            Math::Pow([a, b]) if !self.is_moving(b) => Recurrence::Power {
                base: self.node(a),
                exponent: b,
                own: self.node(id),
                inverse: place(Slot::Inverse(id)),
                derivative: place(Slot::Derivative(id)),
            },
            Math::Pow([a, b]) => Recurrence::VariablePower {
                base: self.base(id, a, b),
                exponent: b,
                derivative: place(Slot::Partner(Function::Exp, id)),
                own: self.node(id),
            },
            Math::Call(function, a) => self.call(id, function, a),
            Math::Pair(..) | Math::Pi | Math::Constant(_) => Recurrence::Missing,
            Math::Variable(_) | Math::Neg(_) | Math::Mul(_) | Math::Div(_) => Recurrence::Linear,
        }
    }

    /// The base `a` of the power `id` with the exponent `b`.
    fn base(&self, id: Id, a: Id, b: Id) -> Base {
        if self.is_moving(a) {
            Base::Moving {
                base: self.node(a),
                exponent: self.node(b),
                logarithm: self.slots.place(Slot::Partner(Function::Ln, id)),
                primitive: self.primitive(id, a, self.node(a)),
            }
        } else {
            Base::Fixed {
                base: a,
                logarithm: self.slots.place(Slot::Inverse(id)),
            }
        }
    }

    /// The integral of du/v for the node `id`.
    fn primitive(&self, id: Id, argument: Id, divisor: Place) -> Primitive {
        Primitive {
            argument,
            divisor,
            slope: self.slots.place(Slot::Slope(id)),
            inverse: self.slots.place(Slot::Inverse(id)),
            is_negative: false,
        }
    }

    /// The recurrence of a function of `a`.
    fn call(&self, id: Id, function: Function, a: Id) -> Recurrence {
        let place = |slot: Slot| self.slots.place(slot);
        let partner = |function: Function| place(Slot::Partner(function, a));
        match function.properties().equation {
            Equation::Root => Recurrence::SquareRoot {
                argument: a,
                own: self.node(id),
                inverse: place(Slot::Inverse(id)),
            },
            Equation::Exponential => Recurrence::Exponential {
                argument: a,
                derivative: place(Slot::Derivative(a)),
                own: self.node(id),
            },
            Equation::Pair {
                functions,
                is_negative,
            } => Recurrence::Pair {
                functions,
                is_negative,
                argument: a,
                derivative: place(Slot::Derivative(a)),
                places: functions.map(partner),
                own: partner(function),
            },
            Equation::Tangent { is_negative } => Recurrence::Tangent {
                function,
                is_negative,
                argument: a,
                derivative: place(Slot::Derivative(a)),
                own: self.node(id),
                partner: partner(function),
            },
            Equation::Logarithm => Recurrence::Logarithm(self.primitive(id, a, self.node(a))),
            Equation::ArcTangent => Recurrence::ArcTangent {
                argument: self.node(a),
                primitive: self.primitive(id, a, partner(function)),
            },
            Equation::ArcSine { is_negative } => Recurrence::ArcSine {
                function,
                argument: self.node(a),
                inverse: place(Slot::Inverse(a)),
                primitive: Primitive {
                    is_negative,
                    ..self.primitive(id, a, partner(function))
                },
            },
            Equation::Missing => Recurrence::Missing,
        }
    }
}
