//! Tests of the algebra: goals of the normal form, properties at random points, the rules as
//! rewrites, and the text of expressions.

mod decide;
mod display;
mod divided;
mod enclosures;
mod formula;
mod functions;
mod properties;
mod random;
mod rewrites;
mod text;
