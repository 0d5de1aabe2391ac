//! Compiler of piecewise-smooth systems into conservative integrators: a declaration is read,
//! what it claims is proved, the Discrete Multiplier Method (Wan, Bihlo & Nave 2017) derives
//! the scheme that conserves it exactly, and the scheme becomes Rust.
//!
//! tokens → [`syntax`] → [`check`] → [`sliding`] → [`proofs`] → [`scheme`] → [`program`] → [`emit`] → tokens.
//!
//! A stage reports all that it can check to [`diagnostics`]; the next one starts if there was
//! nothing to report. [`compile`] is the way through all of them, [`read`] and [`explain`] stop
//! at the scheme. With the feature `explore` the module `invariants` stands beside them, which starts
//! from the model: what a system conserves of which only f is known.
//!
//! # One system, stage by stage
//!
//! Motion along an elliptic curve (Hirani, Wan & Wojtalewicz §4.2), in one region so that it
//! stays short. The values below are those that the stages give; they are tested.
//!
//! ## Tokens → declaration
//!
//! [`syntax::parse`] knows the grammar and no mathematics. What it gives can be printed, and
//! reads like what was written.
//!
//! ```
//! use dmm_compiler::diagnostics::Diagnostics;
//! use dmm_compiler::syntax;
//!
//! let declaration = "system Elliptic {
//!     state x, y;
//!     param a = -3;
//!     der(x) = 2 * y;
//!     der(y) = 3 * x^2 + a;
//!     conserved curve = y^2 - x^3 - a * x;
//! }";
//! let mut diagnostics = Diagnostics::new();
//! let parsed = syntax::parse(declaration.parse().unwrap(), &mut diagnostics).unwrap();
//! assert_eq!(parsed.items.len(), 5);
//! assert!(parsed.to_string().contains("    der(y) = 3 * x^2 + a;\n"));
//! ```
//!
//! ## Declaration → model
//!
//! [`check::resolve`] resolves every name. A formula is a node of a hash-consed
//! [`Dag`](algebra::Dag): equal expressions are the same node, here 3x² of f and of ∇ψ.
//!
//! ```
//! # use dmm_compiler::diagnostics::Diagnostics;
//! # use dmm_compiler::syntax;
//! # let declaration = "system Elliptic {
//! #     state x, y;
//! #     param a = -3;
//! #     der(x) = 2 * y;
//! #     der(y) = 3 * x^2 + a;
//! #     conserved curve = y^2 - x^3 - a * x;
//! # }";
//! # let mut diagnostics = Diagnostics::new();
//! # let parsed = syntax::parse(declaration.parse().unwrap(), &mut diagnostics).unwrap();
//! use dmm_compiler::algebra::to_text;
//! use dmm_compiler::check;
//!
//! let model = check::resolve(parsed, &mut diagnostics).unwrap();
//! let region = &model.regions[0];
//! assert_eq!(region.ident, "everywhere");
//! assert_eq!(to_text(&model.dag, region.field[1]), "3*x^2 + a");
//! assert_eq!(to_text(&model.dag, region.conserved[0].psi), "y^2 - x^3 - a*x");
//! ```
//!
//! ## Model → proved model
//!
//! [`proofs::prove`] decides ∂ₜψ + ∇ψ·f = 0 by a normal form of both: the derivative
//! 2y (3x² + a) − (3x² + a) 2y is zero identically, and no condition on x or y is needed.
//!
//! ```
//! # use dmm_compiler::diagnostics::Diagnostics;
//! # use dmm_compiler::{check, syntax};
//! # let declaration = "system Elliptic {
//! #     state x, y;
//! #     param a = -3;
//! #     der(x) = 2 * y;
//! #     der(y) = 3 * x^2 + a;
//! #     conserved curve = y^2 - x^3 - a * x;
//! # }";
//! # let mut diagnostics = Diagnostics::new();
//! # let parsed = syntax::parse(declaration.parse().unwrap(), &mut diagnostics).unwrap();
//! # let model = check::resolve(parsed, &mut diagnostics).unwrap();
//! use dmm_compiler::algebra::to_text;
//! use dmm_compiler::proofs::{self, Conservation};
//!
//! let proved = proofs::prove(model, &mut diagnostics).unwrap();
//! let region = &proved.regions[0];
//! assert_eq!(region.evidence, [Conservation::Proved(Vec::new())]);
//! assert_eq!(to_text(&proved.model.dag, region.multiplier[0][1]), "2*y");
//! ```
//!
//! ## Model → invariants
//!
//! Had the conserved quantity not been known, `invariants::find` would have found it among the
//! polynomials up to a degree; `invariants::report` writes what it finds as it is declared.
//!
//! ```
//! use dmm_compiler::algebra::to_text;
//! use dmm_compiler::invariants;
//!
//! let declaration = "system Elliptic {
//!     state x, y;
//!     param a = -3;
//!     der(x) = 2 * y;
//!     der(y) = 3 * x^2 + a;
//! }";
//! let mut model = invariants::read(declaration.parse().unwrap()).unwrap();
//! let found = invariants::find(&mut model, 3).unwrap();
//! assert_eq!(found.common.len(), 1);
//! assert_eq!(to_text(&model.dag, found.common[0].psi), "y^2 - a*x - x^3");
//! ```
//!
//! ## Proofs → Λ and Λ^τ
//!
//! The multiplier is Λ = ∇ψ. [`scheme::derive`] takes the symmetric divided differences of ψ
//! for Λ^τ: quotients of Δψ by Δx in which nothing is divided and nothing cancels.
//!
//! ```
//! # let declaration = "system Elliptic {
//! #     state x, y;
//! #     param a = -3;
//! #     der(x) = 2 * y;
//! #     der(y) = 3 * x^2 + a;
//! #     conserved curve = y^2 - x^3 - a * x;
//! # }";
//! # let tokens = declaration.parse::<proc_macro2::TokenStream>().unwrap();
//! # let scheme = dmm_compiler::read(tokens).unwrap();
//! # let (dag, region) = (scheme.dag(), &scheme.regions[0]);
//! use dmm_compiler::algebra::to_text;
//!
//! assert_eq!(to_text(dag, region.proved.multiplier[0][0]), "-(3*x^2 + a)");
//! assert_eq!(to_text(dag, region.proved.multiplier[0][1]), "2*y");
//! assert_eq!(to_text(dag, region.discrete_multiplier[0][0]), "-(x₁^2 + x₁*x₀ + x₀^2 + a)");
//! assert_eq!(to_text(dag, region.discrete_multiplier[0][1]), "y₁ + y₀");
//! ```
//!
//! ## Λ^τ → f^τ
//!
//! The first [`Strategy`](scheme::Strategy) fits, skew pairing: f = α (∂ψ/∂y, −∂ψ/∂x) with
//! α = 1, so f^τ is made from Λ^τ in the same way, and Λ^τ f^τ = 0 whatever its entries are.
//!
//! ```
//! # let declaration = "system Elliptic {
//! #     state x, y;
//! #     param a = -3;
//! #     der(x) = 2 * y;
//! #     der(y) = 3 * x^2 + a;
//! #     conserved curve = y^2 - x^3 - a * x;
//! # }";
//! # let tokens = declaration.parse::<proc_macro2::TokenStream>().unwrap();
//! # let scheme = dmm_compiler::read(tokens).unwrap();
//! # let (dag, region) = (scheme.dag(), &scheme.regions[0]);
//! use dmm_compiler::algebra::to_text;
//! use dmm_compiler::scheme::{Evidence, Solvability, Strategy};
//!
//! let Strategy::SkewPairing { pairs, field, .. } = &region.strategy else { panic!() };
//! assert_eq!(to_text(dag, pairs[0].alpha), "1");
//! assert_eq!(to_text(dag, field.value[0]), "y₁ + y₀");
//! assert_eq!(to_text(dag, field.value[1]), "x₁^2 + x₁*x₀ + x₀^2 + a");
//! assert_eq!(to_text(dag, field.jacobian[1][0]), "2*x₁ + x₀");
//! assert_eq!(region.proofs.conserves, Evidence::Proved);
//! assert_eq!(region.solvability, Solvability::Nonlinear);
//! ```
//!
//! ## Scheme → program
//!
//! [`program::Program`] has the functions that a machine evaluates. Their expressions are lowered
//! to its operations, and [`program::optimise`] finds cheaper ones: f^τ takes 6 operations, and
//! f^τ with its Jacobian 7. Of the Taylor coefficients of the solution only those of x² take a sum
//! over the lower ones, which is written out for every order.
//!
//! ```
//! # let declaration = "system Elliptic {
//! #     state x, y;
//! #     param a = -3;
//! #     der(x) = 2 * y;
//! #     der(y) = 3 * x^2 + a;
//! #     conserved curve = y^2 - x^3 - a * x;
//! # }";
//! # let tokens = declaration.parse::<proc_macro2::TokenStream>().unwrap();
//! # let scheme = dmm_compiler::read(tokens).unwrap();
//! # let (dag, region) = (scheme.dag(), &scheme.regions[0]);
//! use dmm_compiler::program::series::Sums;
//! use dmm_compiler::program::{Program, Quantity};
//!
//! let program = Program::new(&scheme);
//! let functions = &program.dynamics[0].functions;
//! let count = |quantity| functions.count(functions.get(quantity).unwrap()).operations;
//! assert_eq!(count(Quantity::DiscreteVectorField), 6);
//! assert_eq!(count(Quantity::Linearised), 7);
//! assert_eq!(program.dynamics[0].series.sums, Sums::Straight);
//! ```
//!
//! ## Program → Rust, scheme → listing
//!
//! [`emit::rust`] writes the items that `pws!` expands to, and [`emit::listing`] the mathematics
//! for people, which the documentation of these items shows as well.
//!
//! ```
//! # let declaration = "system Elliptic {
//! #     state x, y;
//! #     param a = -3;
//! #     der(x) = 2 * y;
//! #     der(y) = 3 * x^2 + a;
//! #     conserved curve = y^2 - x^3 - a * x;
//! # }";
//! # let tokens = declaration.parse::<proc_macro2::TokenStream>().unwrap();
//! # let scheme = dmm_compiler::read(tokens).unwrap();
//! # let (dag, region) = (scheme.dag(), &scheme.regions[0]);
//! use dmm_compiler::emit;
//! use dmm_compiler::program::Program;
//!
//! let runtime = "::dmm_runtime".parse().unwrap();
//! let code = emit::rust(&Program::new(&scheme), &runtime).to_string();
//! assert!(code.contains("struct Elliptic"));
//! assert!(code.contains("fn discrete_vector_field"));
//! let listing = emit::listing(&scheme);
//! assert!(listing.contains("F[y] = y₁ - y₀ - τ*(x₁^2 + x₁*x₀ + x₀^2 + a)"));
//! assert!(listing.contains("∂F[y]/∂x₁ = -τ*(2*x₁ + x₀)"));
//! ```
#![deny(missing_docs)]

pub mod algebra;
pub mod check;
pub mod diagnostics;
pub mod emit;
#[cfg(feature = "explore")]
pub mod invariants;
pub mod model;
pub mod program;
pub mod proofs;
pub mod scheme;
pub mod sliding;
pub mod stub;
pub mod syntax;
#[cfg(feature = "text")]
pub mod text;

use proc_macro2::TokenStream;
use quote::quote;

use diagnostics::Diagnostics;
use program::Program;
use scheme::Scheme;
use syntax::Declaration;

/// Compiles the declaration of a system into Rust items: the system's, or the diagnostics and
/// a [`stub`] of it. They refer to the runtime as `::dmm_runtime`.
pub fn compile(input: TokenStream) -> TokenStream {
    compile_with(input, &quote!(::dmm_runtime))
}

/// The same as [`compile`] where the runtime has the path `runtime`: whatever a program calls it,
/// and wherever it is re-exported.
pub fn compile_with(input: TokenStream, runtime: &TokenStream) -> TokenStream {
    let mut diagnostics = Diagnostics::new();
    let Some(declaration) = syntax::parse(input, &mut diagnostics) else {
        return diagnostics.into_compile_errors();
    };
    let stub = stub::stub(&declaration, runtime);
    match derive(declaration, &mut diagnostics) {
        Some(scheme) => {
            let items = emit::rust(&Program::new(&scheme), runtime);
            let warnings = diagnostics.warning_items();
            quote!(#items #warnings)
        }
        None => {
            let errors = diagnostics.into_compile_errors();
            quote!(#errors #stub)
        }
    }
}

/// The scheme of a declaration, or what is wrong with it.
pub fn read(input: TokenStream) -> Result<Scheme, Diagnostics> {
    let mut diagnostics = Diagnostics::new();
    read_with(input, &mut diagnostics).ok_or(diagnostics)
}

/// The scheme of a declaration, if nothing is wrong with it, and in `diagnostics` what is wrong
/// with it and the warnings.
pub fn read_with(input: TokenStream, diagnostics: &mut Diagnostics) -> Option<Scheme> {
    syntax::parse(input, diagnostics).and_then(|declaration| derive(declaration, diagnostics))
}

/// The scheme of a declaration in readable mathematics, or the messages of all diagnostics.
pub fn explain(input: TokenStream) -> Result<String, Vec<String>> {
    read(input)
        .map(|scheme| emit::listing(&scheme))
        .map_err(|diagnostics| diagnostics.messages())
}

/// The scheme of a declaration without errors.
pub fn derive(declaration: Declaration, diagnostics: &mut Diagnostics) -> Option<Scheme> {
    if !diagnostics.is_empty() {
        return None;
    }
    let mut model = check::resolve(declaration, diagnostics)?;
    sliding::extend(&mut model, diagnostics);
    if !diagnostics.is_empty() {
        return None;
    }
    let proved = proofs::prove(model, diagnostics)?;
    scheme::derive(proved, diagnostics)
}
