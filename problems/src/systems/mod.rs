//! The systems, one file each: declaration, source, initial value problem.
//!
//! Eight are piecewise smooth, with reference solutions of 32 digits under `reference/`. The
//! chains, the circuit and the food chain are piecewise smooth too; the others are smooth
//! classics that exercise other functions and strategies. These are compared with the
//! independent integrator of [`accurate`](crate::accurate).
//!
//! Systems with events and switches are files of their own, in `hybrid/`, and are compared with
//! closed forms and published numbers.

pub mod damped;
pub mod double_pendulum;
pub mod elliptic;
pub mod food_chain;
pub mod fput_chain;
pub mod fput_chain_32;
pub mod harmonic;
pub mod henon_heiles;
pub mod kepler_refraction;
pub mod lotka_volterra_periodic;
pub mod pendulum;
pub mod poschl_teller;
pub mod relativistic_oscillator;
pub mod rigid_body;
pub mod saturating_inductor;
pub mod saturating_spring;
pub mod spiral;
pub mod three_body;
pub mod toda;
pub mod toda_chain;
pub mod toda_chain_32;

pub use damped::Damped;
pub use double_pendulum::DoublePendulum;
pub use elliptic::Elliptic;
pub use food_chain::FoodChain;
pub use fput_chain::FputChain;
pub use fput_chain_32::FputChain32;
pub use harmonic::Harmonic;
pub use henon_heiles::HenonHeiles;
pub use kepler_refraction::KeplerRefraction;
pub use lotka_volterra_periodic::LotkaVolterra;
pub use pendulum::Pendulum;
pub use poschl_teller::PoschlTeller;
pub use relativistic_oscillator::RelativisticOscillator;
pub use rigid_body::RigidBody;
pub use saturating_inductor::SaturatingInductor;
pub use saturating_spring::SaturatingSpring;
pub use spiral::Spiral;
pub use three_body::ThreeBody;
pub use toda::Toda;
pub use toda_chain::TodaChain;
pub use toda_chain_32::TodaChain32;
