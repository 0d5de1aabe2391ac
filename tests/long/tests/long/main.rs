//! Runs of many steps or from many starts, with optimised code.

mod accumulations;
mod curves;
mod pinned;
mod rest;
mod roundings;
mod sliding;

type Failure = Box<dyn std::error::Error>;
