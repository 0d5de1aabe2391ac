//! What generated code names. Not for use by hand.

pub use crate::arithmetic::{Matrix, MinimalNorm, Scalar, Vector, sparse};
pub use crate::contract::{
    Condition, Dynamics, DynamicsVisitor, Guards, LOW_DEGREE, Metadata, NoGuards, RegionMetadata,
    Side, Solvability, System,
};
pub use crate::series;
pub use dmm_macros::pws;
