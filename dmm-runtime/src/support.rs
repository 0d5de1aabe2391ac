//! What generated code names. Not for use by hand.

pub use crate::minimal_norm::MinimalNorm;
pub use crate::scalar::Scalar;
pub use crate::series;
pub use crate::sparse::sparse;
pub use crate::system::{
    Boundary, Flow, FlowVisitor, Guard, Matrix, Side, Solvability, System, Unbounded, Vector,
};
