//! The computer algebra: an expression DAG, its derivatives and divided differences, and the
//! normal form that decides whether an expression is zero. It knows no steps and no Rust.

mod dag;
pub mod differentiate;
pub mod display;
pub mod divided_difference;
pub mod evaluate;
mod functions;
mod language;
pub mod linear;
pub mod normal_form;
mod work;

#[cfg(test)]
mod tests;

pub use dag::Dag;
pub use differentiate::{differentiate, gradient, jacobian};
pub use display::to_text;
pub use divided_difference::{at_end, at_midpoint, at_start, divided_difference};
pub use egg::Id;
pub use evaluate::{evaluate, evaluate_bounded};
pub(crate) use functions::{Domain, Equation};
pub use functions::{Function, Latex, PairFunction};
pub use language::{Math, Name, Rational};
pub use normal_form::{
    Counterexample, Quotient, Verdict, decide_zero, divide_exactly, is_proved_zero, normalise,
};
