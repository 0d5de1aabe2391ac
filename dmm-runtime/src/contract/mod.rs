//! What `pws!` emits for a system, and what the integrators ask of it.
//!
//! A [`System`] is a set of modes. Each has its [`Dynamics`]: one smooth vector field f with its
//! conserved quantities ψ and the conservative scheme derived from them. The [`Guards`] of the
//! dynamics are the functions g whose zeros end the mode; a smooth system has [`NoGuards`], and
//! everything about transitions is compiled away.

mod condition;
mod dynamics;
mod guards;
mod initial;
mod metadata;
mod mode;
mod reversed;
mod system;

pub use condition::Condition;
pub use dynamics::{Dynamics, DynamicsVisitor, Solvability};
pub use guards::{Guards, LOW_DEGREE, NoGuards, Side, sides};
pub use initial::InitialState;
pub use metadata::{Event, Metadata, RegionMetadata, SlideEnd};
pub use mode::Mode;
pub use reversed::Reversed;
pub use system::System;

pub(crate) use crate::arithmetic::{Matrix, Vector};
