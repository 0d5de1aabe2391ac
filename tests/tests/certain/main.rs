//! The sign of every switching function is certain along a trajectory: no crossing is missed and
//! none invented, whatever the functions are written with, by every scheme.

mod accumulations;
mod affine;
mod functions;
mod rest;
mod steps;
