//! Polynomial invariants of a vector field: for who knows ẋ = f(x) and not what it conserves.
//!
//! The functions are [`find`] and, for people, [`report`]. The ansatz is ψ = Σ cₘ m(x) over the monomials m up to a degree,
//! in the states and in what f is made of besides them (exponentials, sines and cosines, roots
//! and reciprocals, and what these are the derivatives of: see the module `generators`).
//! ψ is conserved iff
//!
//! ```text
//! ∇ψ·f = Σ cₘ ∇m·f = 0
//! ```
//!
//! identically, a linear system for the cₘ. Its null space is found modulo a prime: each random
//! point at which the atoms of the normal form satisfy their relations gives an equation (a
//! polynomial identity of degree d fails at one with probability d/p: Schwartz 1980, Zippel
//! 1979). That tells the number of solutions and their monomials. Then
//!
//! - of solutions that depend on one another, as H and H² do, the ones of lower degree are kept:
//!   those whose gradients are independent;
//! - coefficients are found exactly: fractions and powers of parameters from their residues, other
//!   functions of the parameters by elimination with symbols;
//! - each is proved by the normal form, and nothing else is reported.
//!
//! With several regions, what is conserved in all of them comes first, and of each region's own
//! only what does not depend on that. What is not found need not be absent: an invariant may have
//! a higher degree, or be no polynomial of these quantities (Goriely 2001, *Integrability and
//! Nonintegrability of Dynamical Systems*, ch. 2).

mod ansatz;
mod candidate;
mod coefficients;
mod elimination;
mod field;
mod generators;
mod report;
mod residues;
mod search;
mod simplify;

#[cfg(test)]
mod tests;

use std::fmt;

use crate::algebra::normal_form::terms::terms;
use crate::algebra::{Id, Name};
use crate::model::Model;
use crate::proofs::Derivatives;
use ansatz::{Ansatz, MOST_MONOMIALS, monomials};
use candidate::occurring;
use search::{Findings, Known, Search};

pub use report::{read, report};

/// The polynomial invariants of a model.
#[derive(Debug)]
pub struct Invariants {
    /// The degree up to which they were sought.
    pub degree: u32,
    /// The quantities in which they are polynomials.
    pub generators: Vec<Id>,
    /// The number of monomials of the ansatz.
    pub monomials: usize,
    /// What is conserved in all regions, by rising degree and independent.
    pub common: Vec<Invariant>,
    /// By region, what is conserved there and does not depend on `common`; empty for a system
    /// without interfaces.
    pub regions: Vec<Vec<Invariant>>,
    /// Solutions whose coefficients could not be written down or not be proved.
    pub unresolved: usize,
}

/// An invariant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Invariant {
    /// ψ
    pub psi: Id,
    /// ∇ψ and ∂ₜψ
    pub derivatives: Derivatives,
    /// Its degree in the generators.
    pub degree: u32,
}

/// Why invariants could not be sought.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Obstacle {
    /// The degree is 0.
    NoDegree,
    /// There are too many monomials.
    TooLarge {
        /// The degree that was asked for.
        degree: u32,
        /// The number of quantities.
        generators: usize,
        /// The greatest degree for which there are not; 0 if there is none.
        largest: u32,
    },
    /// A vector field, or a derivative, is too large for the normal form.
    NoNormalForm,
    /// The roots in f are real nowhere, or a denominator vanishes everywhere.
    NoPoint,
}

impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoDegree => {
                f.write_str("the degree has to be at least 1: a constant is no invariant")
            }
            Self::TooLarge {
                degree,
                generators,
                largest,
            } => {
                write!(
                    f,
                    "polynomials of degree {degree} in {generators} quantities have more than {MOST_MONOMIALS} monomials, which is the limit of this search; "
                )?;
                match largest {
                    0 => f.write_str("there are too many states for it"),
                    _ => write!(f, "ask for a degree up to {largest}"),
                }
            }
            Self::NoNormalForm => f.write_str(
                "the vector field has no normal form, or one that is too large to work with",
            ),
            Self::NoPoint => f.write_str("no point was found at which the vector field is defined"),
        }
    }
}

impl std::error::Error for Obstacle {}

/// The invariants of `model` that are polynomials up to `degree`.
pub fn find(model: &mut Model, degree: u32) -> Result<Invariants, Obstacle> {
    if degree == 0 {
        return Err(Obstacle::NoDegree);
    }
    let states = model.state_names();
    let parameters: Vec<Name> = model
        .parameters
        .iter()
        .map(|parameter| parameter.name.clone())
        .collect();
    let fields: Vec<&[Id]> = model
        .regions
        .iter()
        .map(|region| region.field.as_slice())
        .collect();
    let dag = &mut model.dag;
    let components: Vec<Id> = fields.concat();
    let forms = terms(dag, &components).ok_or(Obstacle::NoNormalForm)?;
    let generators = generators::generators(dag, &states, &components, &forms);
    let expressions: Vec<Id> = generators.iter().map(|one| one.expression).collect();
    let monomials = monomials(&generators, degree).ok_or_else(|| too_large(&generators, degree))?;
    let ansatz = Ansatz::new(dag, &states, &parameters, &fields, generators, monomials)
        .ok_or(Obstacle::NoNormalForm)?;
    let search = Search {
        ansatz: &ansatz,
        states: &states,
        parameters: &parameters,
        fields: &fields,
    };
    let all: Vec<usize> = (0..fields.len()).collect();
    let columns: Vec<usize> = (0..ansatz.monomials.len()).collect();
    let mut own = Vec::new();
    for &region in &all {
        let candidates = search.candidates(&[region], &columns);
        own.push(candidates.ok_or(Obstacle::NoPoint)?);
    }
    // What all regions have in common is made of what any of them has.
    let shared = own.first().map(|candidates| occurring(candidates));
    let shared = search.candidates(&all, &shared.unwrap_or_default());
    let shared = shared.ok_or(Obstacle::NoPoint)?;
    let mut known = Known::new();
    let Findings {
        invariants: common,
        mut unresolved,
    } = search
        .select(dag, &all, &shared, &mut known)
        .ok_or(Obstacle::NoPoint)?;
    let mut regions = Vec::new();
    for (region, candidates) in own.iter().enumerate().filter(|_| all.len() > 1) {
        let mut known = known.clone();
        let findings = search.select(dag, &[region], candidates, &mut known);
        let findings = findings.ok_or(Obstacle::NoPoint)?;
        unresolved += findings.unresolved;
        regions.push(findings.invariants);
    }
    Ok(Invariants {
        degree,
        generators: expressions,
        monomials: columns.len(),
        common,
        regions,
        unresolved,
    })
}

fn too_large(generators: &[generators::Generator], degree: u32) -> Obstacle {
    let largest = (1..degree)
        .take_while(|&lower| monomials(generators, lower).is_some())
        .last();
    Obstacle::TooLarge {
        degree,
        generators: generators.len(),
        largest: largest.unwrap_or(0),
    }
}
