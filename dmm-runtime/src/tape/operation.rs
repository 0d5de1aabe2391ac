//! Operations on registers.

use dmm_compiler::algebra::{Function, Id, Math, PairFunction};
use dmm_compiler::program::{Lowered, nearest_double};

use pulp::NullaryFnOnce;

use crate::arithmetic::Scalar;

/// The number of a register: that of the node whose value it holds.
pub(super) type Register = u32;

/// The register of a node.
pub(super) fn register(id: Id) -> Register {
    u32::try_from(usize::from(id)).unwrap_or(Register::MAX)
}

/// What is done with operands.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Add,
    Sub,
    Mul,
    Div,
    Neg,
    Square,
    /// uⁿ, n being the second operand.
    Integer,
    Power,
    /// e^{ab}, or e^{−ab}.
    ExpProduct(bool),
    Call(Function),
    Pair(PairFunction),
}

/// An operation: kind, result and operands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Operation {
    kind: Kind,
    to: Register,
    a: Register,
    b: Register,
}

impl Operation {
    /// The operation of a node; nothing for variables and constants, whose values are given.
    pub(super) fn of(lowered: &Lowered, id: Id) -> Option<Self> {
        let dag = lowered.dag();
        let with = |kind: Kind, a: Id, b: Id| Self {
            kind,
            to: register(id),
            a: register(a),
            b: register(b),
        };
        Some(match dag[id] {
            Math::Pi | Math::Constant(_) | Math::Variable(_) => return None,
            Math::Add([a, b]) => with(Kind::Add, a, b),
            Math::Sub([a, b]) => with(Kind::Sub, a, b),
            Math::Mul([a, b]) if a == b => with(Kind::Square, a, a),
            Math::Mul([a, b]) => with(Kind::Mul, a, b),
            Math::Div([a, b]) => with(Kind::Div, a, b),
            Math::Neg(a) => with(Kind::Neg, a, a),
            Math::Pow([a, b]) => match dag.as_integer(b).map(i32::try_from) {
                // the bits of the exponent stand in for the second register
                Some(Ok(n)) => Self {
                    b: n.cast_unsigned(),
                    ..with(Kind::Integer, a, a)
                },
                _ => with(Kind::Power, a, b),
            },
            Math::Call(function, a) => {
                let is_exp = function == Function::Exp;
                match lowered.secular(a).filter(|_| is_exp) {
                    Some((negative, p, q)) => with(Kind::ExpProduct(negative), p, q),
                    None => with(Kind::Call(function), a, a),
                }
            }
            Math::Pair(function, [a, b]) => with(Kind::Pair(function), a, b),
        })
    }

    /// Those of nodes, in their order.
    pub(super) fn all(lowered: &Lowered, ids: &[Id]) -> Vec<Self> {
        ids.iter().filter_map(|&id| Self::of(lowered, id)).collect()
    }

    /// Does it.
    #[inline(always)]
    pub(super) fn run<S: Scalar>(self, registers: &mut [S]) {
        let Self { kind, to, a, b } = self;
        let u = registers[a as usize];
        let second = |registers: &[S]| registers[b as usize];
        registers[to as usize] = match kind {
            Kind::Add => u + second(registers),
            Kind::Sub => u - second(registers),
            Kind::Mul => u * second(registers),
            Kind::Div => u / second(registers),
            Kind::Neg => -u,
            Kind::Square => u.squared(),
            Kind::Integer => u.powi(b.cast_signed()),
            Kind::Power => u.powf(second(registers)),
            Kind::ExpProduct(negative) => {
                let p = if negative { -u } else { u };
                p.exp_product(second(registers))
            }
            Kind::Call(function) => call(function, u),
            Kind::Pair(function) => pair(function, u, second(registers)),
        };
    }
}

/// Does operations one after the other. Compiled once, and not for every number of states.
pub(super) fn run<S: Scalar>(operations: &[Operation], registers: &mut [S]) {
    S::apart(InTurn {
        operations,
        registers,
    });
}

/// Operations that are done one after the other.
struct InTurn<'a, S> {
    operations: &'a [Operation],
    registers: &'a mut [S],
}

impl<S: Scalar> NullaryFnOnce for InTurn<'_, S> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for operation in self.operations {
            operation.run(self.registers);
        }
    }
}

/// The constants of lowered operations, by their registers.
pub(super) fn constants(lowered: &Lowered) -> Vec<(Register, f64)> {
    let dag = lowered.dag();
    let nodes = (0..dag.len()).map(Id::from);
    nodes
        .filter_map(|id| match &dag[id] {
            Math::Pi => Some((register(id), std::f64::consts::PI)),
            Math::Constant(value) => Some((register(id), nearest_double(value))),
            _ => None,
        })
        .collect()
}

/// The value of a function of one argument.
#[inline(always)]
pub(super) fn call<S: Scalar>(function: Function, u: S) -> S {
    // an instruction of the processor
    if function == Function::Sqrt {
        return u.sqrt();
    }
    elementary(function, u)
}

/// The same by a function of its own.
#[inline(never)]
fn elementary<S: Scalar>(function: Function, u: S) -> S {
    match function {
        Function::Sqrt => u.sqrt(),
        Function::Exp => u.exp(),
        Function::Ln => u.ln(),
        Function::Sin => u.sin(),
        Function::Cos => u.cos(),
        Function::Tan => u.tan(),
        Function::Sinh => u.sinh(),
        Function::Cosh => u.cosh(),
        Function::Tanh => u.tanh(),
        Function::Asin => u.asin(),
        Function::Acos => u.acos(),
        Function::Atan => u.atan(),
        Function::Abs => u.abs(),
        Function::Sinc => u.sinc(),
        Function::SincPrime => u.sinc_prime(),
        Function::Sinhc => u.sinhc(),
        Function::SinhcPrime => u.sinhc_prime(),
    }
}

/// The value of a divided difference or its derivative.
#[inline(never)]
fn pair<S: Scalar>(function: PairFunction, a: S, b: S) -> S {
    match function {
        PairFunction::LnDd => a.ln_dd(b),
        PairFunction::LnDdPrime => a.ln_dd_prime(b),
        PairFunction::AsinDd => a.asin_dd(b),
        PairFunction::AsinDdPrime => a.asin_dd_prime(b),
        PairFunction::AtanDd => a.atan_dd(b),
        PairFunction::AtanDdPrime => a.atan_dd_prime(b),
    }
}
