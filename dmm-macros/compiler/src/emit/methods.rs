//! The methods of a flow: those at a point (t, x) and those over a step.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::function::{Arguments, Functions};
use super::minimal_norm::minimal_norm;
use super::nodes::{Discrete, Field, Nodes};
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
    /// ∂f^τ/∂t₁
    pub(super) time_derivative: TokenStream,
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
    let linear: Vec<Id> = [&nodes.psi[..], &nodes.multiplier.concat()].concat();
    let multiplier = functions.body(Arguments::Point, &linear, |block| {
        block.compute(&linear);
        let value = functions.vector(block, &nodes.psi);
        let rows = functions.matrix(block, &nodes.multiplier);
        quote!((#value, #rows))
    });
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
    autonomous: bool,
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
    if !autonomous {
        methods.push(("∂f^τ/∂t₁", "time_derivative", column, time_derivative));
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
    let roots = [&field.value[..], &field.jacobian.concat()].concat();
    let linearised = functions.body(Arguments::Step, &roots, |block| {
        block.compute(&roots);
        let value = functions.vector(block, &field.value);
        let jacobian = functions.matrix(block, &field.jacobian);
        quote!((#value, #jacobian))
    });
    StepBodies {
        value: column(&field.value),
        linearised,
        time_derivative: column(&field.time_derivative),
    }
}
