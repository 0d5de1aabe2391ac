//! The methods of a flow: those at a point (t, x) and those over a step.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::function::{Arguments, Functions};
use super::minimal_norm::minimal_norm;
use super::nodes::{Discrete, Field, Nodes, Rows};
use super::paths;
use crate::algebra::Id;

/// One emitted method.
struct Method<'a> {
    doc: &'a str,
    name: &'a str,
    arguments: Arguments,
    result: TokenStream,
    body: TokenStream,
}

impl Method<'_> {
    fn emit(self, scalar: &Ident, states: usize) -> TokenStream {
        let states = paths::count(states);
        let vector = paths::support("Vector");
        let Self {
            doc,
            name,
            arguments,
            result,
            body,
        } = self;
        let doc = format!(" {doc}");
        let name = format_ident!("{name}");
        let arguments = match arguments {
            Arguments::Point => quote!(t: #scalar, state: &#vector<#scalar, #states>),
            Arguments::Step => quote! {
                t0: #scalar, start: &#vector<#scalar, #states>,
                t1: #scalar, end: &#vector<#scalar, #states>
            },
        };
        quote! {
            #[doc = #doc]
            #[inline]
            fn #name(&self, #arguments) -> #result { #body }
        }
    }
}

/// The bodies of the methods over a step.
pub(super) struct StepBodies {
    /// f^τ
    pub(super) value: TokenStream,
    /// (f^τ, ∂f^τ/∂x₁)
    pub(super) linearised: TokenStream,
    /// ∂f^τ/∂t₁, where the flow is not autonomous
    pub(super) time_derivative: Option<TokenStream>,
}

/// f, ψ, Σ|terms of ψ| and (ψ, Λ).
pub(super) fn point_functions(
    functions: &Functions<'_>,
    nodes: &Nodes,
    scalar: &Ident,
) -> TokenStream {
    let (count, m) = (functions.states.len(), paths::count(nodes.psi.len()));
    let n = paths::count(count);
    let [vector, matrix] = ["Vector", "Matrix"].map(paths::support);
    let column = |roots: &[Id]| {
        functions.body(Arguments::Point, roots, |block| {
            block.compute(roots);
            functions.vector(block, roots)
        })
    };
    let multiplier = pair(functions, Arguments::Point, &nodes.multiplier);
    let small = quote!(#vector<#scalar, #m>);
    [
        (
            "f(t, x)",
            "vector_field",
            quote!(#vector<#scalar, #n>),
            column(&nodes.field),
        ),
        ("ψ(t, x)", "conserved", small.clone(), column(&nodes.psi)),
        (
            "Σ|terms of ψ(t, x)|",
            "conserved_size",
            small.clone(),
            column(&nodes.psi_size),
        ),
        (
            "ψ(t, x) and Λ = ∇ψ(t, x)",
            "multiplier",
            quote!((#small, #matrix<#scalar, #m, #n>)),
            multiplier,
        ),
    ]
    .into_iter()
    .map(|(doc, name, result, body)| {
        Method {
            doc,
            name,
            arguments: Arguments::Point,
            result,
            body,
        }
        .emit(scalar, count)
    })
    .collect()
}

/// f^τ, (f^τ, ∂f^τ/∂x₁) and, where the flow is not autonomous, ∂f^τ/∂t₁.
pub(super) fn step_functions(
    functions: &Functions<'_>,
    discrete: &Discrete,
    scalar: &Ident,
) -> TokenStream {
    let count = functions.states.len();
    let n = paths::count(count);
    let [vector, matrix] = ["Vector", "Matrix"].map(paths::support);
    let column = quote!(#vector<#scalar, #n>);
    let StepBodies {
        value,
        linearised,
        time_derivative,
    } = match discrete {
        Discrete::Explicit(field) => explicit(functions, field),
        Discrete::MinimalNorm(nodes) => minimal_norm(functions, nodes),
    };
    let both = quote!((#column, #matrix<#scalar, #n, #n>));
    let mut methods = vec![
        (
            "f^τ(t₀, x₀, t₁, x₁)",
            "discrete_vector_field",
            column.clone(),
            value,
        ),
        (
            "f^τ(t₀, x₀, t₁, x₁) and ∂f^τ/∂x₁",
            "linearised",
            both,
            linearised,
        ),
    ];
    if let Some(body) = time_derivative {
        methods.push(("∂f^τ/∂t₁", "time_derivative", column, body));
    }
    methods
        .into_iter()
        .map(|(doc, name, result, body)| {
            Method {
                doc,
                name,
                arguments: Arguments::Step,
                result,
                body,
            }
            .emit(scalar, count)
        })
        .collect()
}

/// The bodies for f^τ as an expression.
fn explicit(functions: &Functions<'_>, field: &Field) -> StepBodies {
    let column = |roots: &[Id]| {
        functions.body(Arguments::Step, roots, |block| {
            block.compute(roots);
            functions.vector(block, roots)
        })
    };
    StepBodies {
        value: column(&field.value),
        linearised: pair(functions, Arguments::Step, &field.linearised),
        time_derivative: field.time_derivative.as_deref().map(column),
    }
}

/// The body for a column and a matrix.
fn pair(
    functions: &Functions<'_>,
    arguments: Arguments,
    (column, rows): &(Vec<Id>, Rows),
) -> TokenStream {
    let roots = [&column[..], &rows.concat()].concat();
    functions.body(arguments, &roots, |block| {
        block.compute(&roots);
        let column = functions.vector(block, column);
        let matrix = functions.matrix(block, rows);
        quote!((#column, #matrix))
    })
}
