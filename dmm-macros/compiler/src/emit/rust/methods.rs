//! The methods of the dynamics of a region: those at a point (t, x) and those over a step.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::code::Block;
use super::function::Scope;
use super::minimal_norm::projected;
use super::paths;
use crate::program::{Function, Quantity, Results};

/// The method of a region's dynamics for `function`; `conserved` quantities there are.
pub(super) fn method(
    scope: &Scope<'_>,
    function: &Function,
    conserved: usize,
) -> Option<TokenStream> {
    let (doc, name) = names(function.quantity)?;
    let (scalar, n, m) = (
        scope.scalar,
        paths::count(scope.states),
        paths::count(conserved),
    );
    let [vector, matrix] = ["Vector", "Matrix"].map(paths::support);
    let column = quote!(#vector<#scalar, #n>);
    let small = quote!(#vector<#scalar, #m>);
    let result = match function.quantity {
        Quantity::Conserved | Quantity::ConservedSize => small,
        Quantity::Jacobian => quote!(#matrix<#scalar, #n, #n>),
        Quantity::Multiplier => quote!((#small, #matrix<#scalar, #m, #n>)),
        Quantity::Linearised => quote!((#column, #matrix<#scalar, #n, #n>)),
        _ => column,
    };
    let arguments = if function.quantity.is_over_step() {
        quote! {
            t0: #scalar, start: &#vector<#scalar, #n>,
            t1: #scalar, end: &#vector<#scalar, #n>
        }
    } else {
        quote!(t: #scalar, state: &#vector<#scalar, #n>)
    };
    let doc = format!(" {doc}");
    let name = format_ident!("{name}");
    let body = body(scope, function);
    let inline = match function.quantity {
        // what is not inlined does not compute in lanes, and of pairs this is much
        Quantity::Conserved => quote!(#[inline(always)]),
        _ => quote!(#[inline]),
    };
    Some(quote! {
        #[doc = #doc]
        #inline
        fn #name(&self, #arguments) -> #result { #body }
    })
}

/// The documentation and the name of a method of the dynamics; guards and events
/// have methods of their own, which choose among functions.
fn names(quantity: Quantity) -> Option<(&'static str, &'static str)> {
    Some(match quantity {
        Quantity::VectorField => ("f(t, x)", "vector_field"),
        Quantity::Jacobian => ("∂f/∂x at (t, x)", "jacobian"),
        Quantity::Conserved => ("ψ(t, x)", "conserved"),
        Quantity::ConservedSize => ("Σ|terms of ψ(t, x)|", "conserved_size"),
        Quantity::Multiplier => ("ψ(t, x) and Λ = ∇ψ(t, x)", "multiplier"),
        Quantity::DiscreteVectorField => ("f^τ(t₀, x₀, t₁, x₁)", "discrete_vector_field"),
        Quantity::Linearised => ("f^τ(t₀, x₀, t₁, x₁) and ∂f^τ/∂x₁", "linearised"),
        Quantity::TimeDerivative => ("∂f^τ/∂t₁", "time_derivative"),
        Quantity::SwitchingFunction(_)
        | Quantity::SwitchingSize(_)
        | Quantity::SwitchingGradient(_)
        | Quantity::Event(_) => return None,
    })
}

/// The body of a function, with its results as the runtime takes them.
pub(super) fn body(scope: &Scope<'_>, function: &Function) -> TokenStream {
    match &function.results {
        Results::Projected(nodes) => projected(scope, function, nodes),
        results => scope.body(function, |block| values(scope, block, results)),
    }
}

/// The values of results that were computed.
fn values(scope: &Scope<'_>, block: &Block<'_>, results: &Results) -> TokenStream {
    match results {
        Results::Scalar(root) => block.value(*root),
        Results::Column(column) => scope.vector(block, column),
        Results::Matrix(rows) => scope.matrix(block, rows),
        Results::ScalarAndColumn(scalar, column) => {
            let (scalar, column) = (block.value(*scalar), scope.vector(block, column));
            quote!((#scalar, #column))
        }
        Results::ColumnAndMatrix(column, rows) => {
            let (column, matrix) = (scope.vector(block, column), scope.matrix(block, rows));
            quote!((#column, #matrix))
        }
        // they are made by the projection
        Results::Projected(_) => TokenStream::new(),
    }
}
