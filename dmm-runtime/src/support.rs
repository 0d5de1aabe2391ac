//! What generated code names. Not for use by hand.

pub use crate::arithmetic::{Matrix, MinimalNorm, Scalar, Vector, sparse};
pub use crate::contract::{
    Condition, Dynamics, DynamicsVisitor, Event, Guards, LOW_DEGREE, Metadata, Mode, NoGuards,
    RegionMetadata, Side, SlideEnd, Solvability, System, sides,
};
pub use crate::series;
#[cfg(feature = "macros")]
pub use dmm_macros::pws;
