//! The bodies of a step's methods for f^τ = f̄ − Λ^τᵀ λ, λ solved for by the runtime.

use proc_macro2::TokenStream;
use quote::quote;

use super::code::Block;
use super::function::Scope;
use super::paths;
use crate::program::{Derivative, Function, Projected};

/// The body for f^τ or one of its derivatives.
pub(super) fn projected(scope: &Scope<'_>, function: &Function, nodes: &Projected) -> TokenStream {
    scope.body_in_stages(function, |block, entries| {
        block.compute(&function.first.operations);
        project(scope, block, nodes);
        match (&nodes.derivative, &function.second) {
            (Some(derivative), Some(second)) => {
                block.push(entries);
                block.compute(&second.operations);
                differentiated(scope, block, derivative)
            }
            _ => quote!(field),
        }
    })
}

/// f^τ and λ, as the locals `field` and `multipliers`.
fn project(scope: &Scope<'_>, block: &mut Block<'_>, nodes: &Projected) {
    let scalar = scope.scalar;
    let n = paths::count(scope.states);
    let m = paths::count(nodes.by_time.len());
    let solver = paths::support("MinimalNorm");
    // the rows that count are chosen by Λ at the start of the step; a single one always does
    let at_start = match nodes.by_time.len() {
        1 => quote!(&multiplier),
        _ => quote!(&self.multiplier(t0, start).1),
    };
    let multiplier = scope.matrix(block, &nodes.multiplier);
    let mean = scope.vector(block, &nodes.mean);
    let by_time = scope.vector(block, &nodes.by_time);
    block.push(quote! {
        let multiplier = #multiplier;
        let projection = #solver::<#scalar, #n, #m>::new(&multiplier, #at_start);
        let mean = #mean;
        let by_time = #by_time;
        let (field, multipliers) = projection.field(&mean, &by_time);
    });
}

/// f^τ with its derivative by x₁, or the derivative by t₁.
fn differentiated(scope: &Scope<'_>, block: &Block<'_>, derivative: &Derivative) -> TokenStream {
    match derivative {
        Derivative::State(matrices) => {
            let [mean, transposed, constraint] =
                matrices.each_ref().map(|rows| scope.matrix(block, rows));
            quote! {
                let mean_jacobian = #mean;
                let transposed = #transposed;
                let constraint = #constraint;
                (field, projection.jacobian(&mean_jacobian, &transposed, &constraint))
            }
        }
        Derivative::Time(columns) => {
            let [mean, transposed, constraint] = columns
                .each_ref()
                .map(|entries| scope.vector(block, entries));
            quote! {
                let mean_derivative = #mean;
                let transposed = #transposed;
                let constraint = #constraint;
                projection.time_derivative(&mean_derivative, &transposed, &constraint)
            }
        }
    }
}
