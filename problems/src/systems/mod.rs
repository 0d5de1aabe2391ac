//! The systems, one file each: declaration, source, initial value problem.
//!
//! Eight are piecewise smooth, with reference solutions of 32 digits under `reference/`; the
//! others are smooth classics that exercise other functions and strategies.

#[cfg(test)]
mod check;
pub mod damped;
pub mod elliptic;
pub mod harmonic;
pub mod henon_heiles;
pub mod kepler_refraction;
pub mod lotka_volterra_periodic;
pub mod pendulum;
pub mod poschl_teller;
pub mod relativistic_oscillator;
pub mod rigid_body;
pub mod saturating_spring;
pub mod spiral;
pub mod toda;

pub use damped::Damped;
pub use elliptic::Elliptic;
pub use harmonic::Harmonic;
pub use henon_heiles::HenonHeiles;
pub use kepler_refraction::KeplerRefraction;
pub use lotka_volterra_periodic::LotkaVolterra;
pub use pendulum::Pendulum;
pub use poschl_teller::PoschlTeller;
pub use relativistic_oscillator::RelativisticOscillator;
pub use rigid_body::RigidBody;
pub use saturating_spring::SaturatingSpring;
pub use spiral::Spiral;
pub use toda::Toda;
