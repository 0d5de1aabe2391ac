//! Systems and methods that are chosen at run time.
//!
//! An [`AnySystem`] hides how many states and which regions a system has: it is a trait object,
//! implemented by [`Erased`] for every [`System`](crate::System). States are slices, regions are
//! numbers. The methods that it is integrated by are those of a [`MethodChoice`], so that a program
//! compiles the methods that it offers and no others.
//!
//! ```
//! use dmm_runtime::dynamic::{AnySystem, Erased, InitialValue, MethodChoice, MethodVisitor, Unobserved};
//! use dmm_runtime::{Best, Symmetric, pws};
//!
//! pws! {
//!     /// An oscillator.
//!     pub system Oscillator {
//!         state q, p;
//!         der(q) = p;
//!         der(p) = -q;
//!         conserved energy = (q^2 + p^2) / 2;
//!     }
//! }
//! pws! {
//!     /// Free fall.
//!     pub system Fall {
//!         state z, v;
//!         der(z) = v;
//!         der(v) = -1;
//!         conserved energy = v^2 / 2 + z;
//!     }
//! }
//!
//! /// A method by its name.
//! struct Named(&'static str);
//!
//! impl MethodChoice for Named {
//!     fn visit<V: MethodVisitor>(&self, visitor: V) -> V::Output {
//!         match self.0 {
//!             "symmetric" => visitor.visit(Symmetric::step_size(1e-3)),
//!             _ => visitor.visit(Best::tolerance(1e-12)),
//!         }
//!     }
//! }
//!
//! let systems: [Box<dyn AnySystem<Named>>; 2] =
//!     [Erased::boxed(Oscillator {}), Erased::boxed(Fall {})];
//! for system in &systems {
//!     let from = InitialValue::new(vec![1.0, 0.0], 1.0);
//!     let end = system.integrate(&Named("best"), &from, &mut Unobserved)?;
//!     println!("{}: {:?}", system.metadata().name, end.x);
//! }
//! # Ok::<(), dmm_runtime::Error>(())
//! ```

mod erased;
mod map;
mod method;
mod run;

use std::fmt::Debug;
use std::ops::ControlFlow;

use crate::contract::Metadata;
use crate::error::Error;
pub use erased::Erased;
pub use map::AnyMap;
pub use method::{MethodChoice, MethodVisitor};
pub use run::{
    AnyMode, AnyObserver, Arrival, Crossed, Finish, InitialValue, MemberOutcome, OutputTimes,
    Parallelism, Record, Start, Unobserved,
};

/// A system of any dimension, with its present parameters. C chooses the methods.
pub trait AnySystem<C>: Debug + Send + Sync {
    /// Names, and where the regions lie.
    fn metadata(&self) -> &'static Metadata;
    /// The declaration.
    fn declaration(&self) -> &str;
    /// The derived scheme in readable mathematics.
    fn listing(&self) -> &str;
    /// The parameters, in the order of [`Metadata::parameters`].
    fn parameters(&self) -> Vec<f64>;
    /// The declared values of the parameters.
    fn defaults(&self) -> &[f64];
    /// Sets a parameter; false if there is none of that name.
    fn set_parameter(&mut self, name: &str, value: f64) -> bool;
    /// f(t, x) in a region, by its index; empty if there is none.
    fn vector_field(&self, region: usize, t: f64, x: &[f64]) -> Vec<f64>;
    /// g(t, x) of an interface, by its index.
    fn switching_function(&self, interface: usize, t: f64, x: &[f64]) -> f64;
    /// ψ(t, x), the quantities that a region conserves.
    fn conserved(&self, region: usize, t: f64, x: &[f64]) -> Vec<f64>;
    /// Integrates, and tells `observer` of it.
    ///
    /// # Errors
    /// Bad input, or whatever stops the integration.
    fn integrate(
        &self,
        method: &C,
        from: &InitialValue,
        observer: &mut dyn AnyObserver,
    ) -> Result<Finish, Error>;
    /// Integrates without telling anybody, which is faster with uniform steps.
    ///
    /// # Errors
    /// Bad input, or whatever stops the integration.
    fn integrate_silently(&self, method: &C, from: &InitialValue) -> Result<Finish, Error>;
    /// Integrates from many starts until an end time, and tells `sink` of each in order.
    fn integrate_all(
        &self,
        method: &C,
        t_end: f64,
        parallelism: Parallelism,
        starts: &mut dyn Iterator<Item = Start>,
        sink: &mut dyn FnMut(MemberOutcome) -> ControlFlow<()>,
    );
    /// A copy.
    fn duplicate(&self) -> Box<dyn AnySystem<C>>;
}
