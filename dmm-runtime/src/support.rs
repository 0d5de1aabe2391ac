//! What generated code names. Not for use by hand.

pub use crate::arithmetic::{Matrix, MinimalNorm, Scalar, Vector, sparse};
pub use crate::contract::{
    Condition, Dynamics, DynamicsVisitor, Guards, NoGuards, Side, Solvability, System,
};
pub use crate::series;
