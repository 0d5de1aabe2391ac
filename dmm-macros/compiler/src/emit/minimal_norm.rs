//! The bodies of a step's methods for f^τ = f̄ − Λ^τᵀ λ, λ solved for by the runtime.

use proc_macro2::TokenStream;
use quote::quote;

use super::code::Block;
use super::function::{Arguments, Functions};
use super::methods::StepBodies;
use super::nodes::{Base, MinimalNorm};
use super::paths;
use crate::algebra::{Id, Name};

/// The bodies of the methods over a step.
pub(super) fn minimal_norm(functions: &Functions<'_>, nodes: &MinimalNorm) -> StepBodies {
    let projection = Projection::new(functions, nodes);
    StepBodies {
        value: projection.value(),
        linearised: projection.linearised(),
        time_derivative: projection.time_derivative(),
    }
}

/// What all of the bodies begin with: the projection on the conserved quantities.
struct Projection<'a> {
    functions: &'a Functions<'a>,
    nodes: &'a MinimalNorm,
}

impl<'a> Projection<'a> {
    fn new(functions: &'a Functions<'a>, nodes: &'a MinimalNorm) -> Self {
        Self { functions, nodes }
    }

    /// f^τ and λ, as the locals `field` and `multipliers`.
    fn project(&self, block: &mut Block<'_>, base: &Base) {
        let functions = self.functions;
        let scalar = functions.scalar;
        let n = paths::count(functions.states.len());
        let m = paths::count(base.by_time.len());
        let solver = paths::support("MinimalNorm");
        // the rows that count are chosen by Λ at the start of the step; a single one always does
        let at_start = match base.by_time.len() {
            1 => quote!(&multiplier),
            _ => quote!(&self.multiplier(t0, start).1),
        };
        block.compute(&base.all());
        let multiplier = functions.matrix(block, &base.multiplier);
        let mean = functions.vector(block, &base.mean);
        let by_time = functions.vector(block, &base.by_time);
        block.push(quote! {
            let multiplier = #multiplier;
            let projection = #solver::<#scalar, #n, #m>::new(&multiplier, #at_start);
            let mean = #mean;
            let by_time = #by_time;
            let (field, multipliers) = projection.field(&mean, &by_time);
        });
    }

    /// f^τ
    fn value(&self) -> TokenStream {
        let base = &self.nodes.value;
        self.functions.body(Arguments::Step, &base.all(), |block| {
            self.project(block, base);
            quote!(field)
        })
    }

    /// (f^τ, ∂f^τ/∂x₁)
    fn linearised(&self) -> TokenStream {
        let (base, matrices) = &self.nodes.linearised;
        let later = matrices.concat().concat();
        self.derivative(base, &later, |block| {
            let [mean, transposed, constraint] = matrices
                .each_ref()
                .map(|rows| self.functions.matrix(block, rows));
            quote! {
                let mean_jacobian = #mean;
                let transposed = #transposed;
                let constraint = #constraint;
                (field, projection.jacobian(&mean_jacobian, &transposed, &constraint))
            }
        })
    }

    /// ∂f^τ/∂t₁
    fn time_derivative(&self) -> Option<TokenStream> {
        let (base, columns) = self.nodes.time_derivative.as_ref()?;
        let later = columns.concat();
        Some(self.derivative(base, &later, |block| {
            let [mean, transposed, constraint] = columns
                .each_ref()
                .map(|entries| self.functions.vector(block, entries));
            quote! {
                let mean_derivative = #mean;
                let transposed = #transposed;
                let constraint = #constraint;
                projection.time_derivative(&mean_derivative, &transposed, &constraint)
            }
        }))
    }

    /// A body that needs `later` after f^τ and λ are known.
    fn derivative(
        &self,
        base: &Base,
        later: &[Id],
        result: impl FnOnce(&Block<'_>) -> TokenStream,
    ) -> TokenStream {
        let roots = [&base.all()[..], later].concat();
        let solved: [(&str, &[Name]); 2] = [
            ("field", &self.nodes.field),
            ("multipliers", &self.nodes.lambda),
        ];
        let finish = |block: &mut Block<'_>, entries| {
            self.project(block, base);
            block.push(entries);
            block.compute(later);
            result(block)
        };
        self.functions
            .body_with(Arguments::Step, &roots, &solved, finish)
    }
}
