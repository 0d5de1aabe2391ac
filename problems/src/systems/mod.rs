//! The systems, one file each: declaration, source, initial value problem.
//!
//! Eight are piecewise smooth, with reference solutions of 32 digits under `reference/`. The
//! chains, the circuit and the food chain are piecewise smooth too; the others are smooth
//! classics that exercise other functions and strategies. These are compared with the
//! independent integrator of [`accurate`](crate::accurate).
//!
//! A program compiles their declarations when it runs. With the feature `types` they are types as well,
//! for comparisons and tests.
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

#[cfg(feature = "types")]
pub use {
    damped::Damped, double_pendulum::DoublePendulum, elliptic::Elliptic, food_chain::FoodChain,
    fput_chain::FputChain, fput_chain_32::FputChain32, harmonic::Harmonic,
    henon_heiles::HenonHeiles, kepler_refraction::KeplerRefraction,
    lotka_volterra_periodic::LotkaVolterra, pendulum::Pendulum, poschl_teller::PoschlTeller,
    relativistic_oscillator::RelativisticOscillator, rigid_body::RigidBody,
    saturating_inductor::SaturatingInductor, saturating_spring::SaturatingSpring, spiral::Spiral,
    three_body::ThreeBody, toda::Toda, toda_chain::TodaChain, toda_chain_32::TodaChain32,
};
