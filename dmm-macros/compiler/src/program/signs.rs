//! Signs while lowering: each is moved outwards, and of a − b and b − a the one that comes first
//! stands for both. Nothing is rounded otherwise: −(a − b) is b − a to the last digit.

use super::lower::Lowered;
use crate::algebra::{Function, Id, Math};

impl Lowered {
    /// u without a sign, and whether it had one.
    fn unsigned(&self, id: Id) -> (Id, bool) {
        match self.dag()[id] {
            Math::Neg(a) => (a, true),
            _ => (id, false),
        }
    }

    fn with_sign(&mut self, id: Id, is_negative: bool) -> Id {
        if is_negative { self.negative(id) } else { id }
    }

    /// −a
    pub(super) fn negative(&mut self, a: Id) -> Id {
        match self.unsigned(a) {
            (a, true) => a,
            (a, false) => self.insert(Math::Neg(a)),
        }
    }

    /// a + b
    pub(super) fn sum(&mut self, a: Id, b: Id) -> Id {
        match (self.unsigned(a), self.unsigned(b)) {
            ((a, false), (b, false)) => {
                let turned = self.dag().find(&Math::Add([b, a]));
                turned.unwrap_or_else(|| self.insert(Math::Add([a, b])))
            }
            ((a, false), (b, true)) | ((b, true), (a, false)) => self.difference(a, b),
            ((a, true), (b, true)) => {
                let sum = self.sum(a, b);
                self.negative(sum)
            }
        }
    }

    /// a − b
    pub(super) fn difference(&mut self, a: Id, b: Id) -> Id {
        match (self.unsigned(a), self.unsigned(b)) {
            ((a, false), (b, false)) => match self.dag().find(&Math::Sub([b, a])) {
                Some(turned) => self.negative(turned),
                None => self.insert(Math::Sub([a, b])),
            },
            ((a, true), (b, true)) => self.difference(b, a),
            ((a, false), (b, true)) => self.sum(a, b),
            ((a, true), (b, false)) => {
                let sum = self.sum(a, b);
                self.negative(sum)
            }
        }
    }

    /// A product or a quotient of u and v, which is made without their signs.
    pub(super) fn signed(&mut self, [u, v]: [Id; 2], make: fn(&mut Self, Id, Id) -> Id) -> Id {
        let ((u, minus_u), (v, minus_v)) = (self.unsigned(u), self.unsigned(v));
        let value = make(self, u, v);
        self.with_sign(value, minus_u != minus_v)
    }

    /// aᵇ
    pub(super) fn signed_power(&mut self, a: Id, b: Id) -> Id {
        let (base, is_negative) = self.unsigned(a);
        match self.dag().as_integer(b) {
            Some(n) if is_negative => {
                let power = self.power(base, b);
                self.with_sign(power, n % 2 != 0)
            }
            _ => self.power(a, b),
        }
    }

    /// A function of a.
    pub(super) fn signed_call(&mut self, function: Function, a: Id) -> Id {
        match (function.properties().is_odd(), self.unsigned(a)) {
            (Some(is_odd), (a, true)) => {
                let value = self.insert(Math::Call(function, a));
                self.with_sign(value, is_odd)
            }
            _ => self.insert(Math::Call(function, a)),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::algebra::{Dag, Function, Id, Name, to_text};
    use crate::program::Lowered;

    /// The lowered forms of two formulas in a and b.
    fn lowered(formulas: impl FnOnce(&mut Dag, [Id; 2]) -> [Id; 2]) -> [String; 2] {
        let mut source = Dag::new();
        let variables = ["a", "b"].map(|name| source.variable(&Name::new(name)));
        let roots = formulas(&mut source, variables);
        let mut lowered = Lowered::new(Vec::new());
        let roots = roots.map(|root| lowered.lower(&source, root));
        roots.map(|root| to_text(lowered.dag(), root))
    }

    #[test]
    fn a_difference_is_there_once() {
        let both = lowered(|dag, [a, b]| [dag.sub(a, b), dag.sub(b, a)]);
        assert_eq!(both, ["a - b", "-(a - b)"]);
    }

    #[test]
    fn squares_of_opposite_differences_are_equal() {
        let [one, other] = lowered(|dag, [a, b]| {
            let differences = [dag.sub(a, b), dag.sub(b, a)];
            differences.map(|difference| dag.powi(difference, 2))
        });
        assert_eq!(one, other);
    }

    #[test]
    fn odd_and_even_functions_pass_a_sign_on() {
        let of = |function: Function| {
            lowered(|dag, [a, b]| {
                let differences = [dag.sub(a, b), dag.sub(b, a)];
                differences.map(|difference| dag.call(function, difference))
            })
        };
        assert_eq!(of(Function::Sin), ["sin(a - b)", "-sin(a - b)"]);
        assert_eq!(of(Function::Cos), ["cos(a - b)", "cos(a - b)"]);
        assert_eq!(of(Function::Exp), ["exp(a - b)", "exp(-(a - b))"]);
    }
}
