//! A program as Rust: the struct of the system, its dynamics by region, and its guards.

mod code;
mod dynamics;
mod emission;
mod events;
mod expression;
mod function;
mod guards;
mod item;
mod methods;
mod minimal_norm;
mod names;
mod paths;
mod readable;
mod series;
mod store;
mod system;

pub(super) use system::system;
