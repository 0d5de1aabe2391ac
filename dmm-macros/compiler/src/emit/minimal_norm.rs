//! The bodies of a step's methods for f^τ = f̄ − Λ^τᵀ λ, λ solved for by the runtime.

use proc_macro2::TokenStream;
use quote::quote;

use super::code::Block;
use super::function::{Arguments, Functions};
use super::methods::StepBodies;
use super::nodes::MinimalNorm;
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
    /// The roots that it is made from: Λ^τ, f̄ and ∂ₜ^τψ.
    base: Vec<Id>,
}

impl<'a> Projection<'a> {
    fn new(functions: &'a Functions<'a>, nodes: &'a MinimalNorm) -> Self {
        let base = [
            &nodes.multiplier.concat()[..],
            &nodes.mean.value,
            &nodes.by_time,
        ]
        .concat();
        Self {
            functions,
            nodes,
            base,
        }
    }

    /// f^τ and λ, as the locals `field` and `multipliers`.
    fn project(&self, block: &mut Block<'_>) {
        let Self {
            functions, nodes, ..
        } = self;
        let scalar = functions.scalar;
        let n = paths::count(functions.states.len());
        let m = paths::count(nodes.by_time.len());
        let solver = paths::support("MinimalNorm");
        // the rows that count are chosen by Λ at the start of the step; a single one always does
        let at_start = match nodes.by_time.len() {
            1 => quote!(&multiplier),
            _ => quote!(&self.multiplier(t0, start).1),
        };
        block.compute(&self.base);
        let multiplier = functions.matrix(block, &nodes.multiplier);
        let mean = functions.vector(block, &nodes.mean.value);
        let by_time = functions.vector(block, &nodes.by_time);
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
        self.functions.body(Arguments::Step, &self.base, |block| {
            self.project(block);
            quote!(field)
        })
    }

    /// (f^τ, ∂f^τ/∂x₁)
    fn linearised(&self) -> TokenStream {
        let nodes = self.nodes;
        let matrices = [
            &nodes.mean.jacobian,
            &nodes.transposed_jacobian,
            &nodes.constraint_jacobian,
        ];
        let later = matrices.map(|rows| rows.concat()).concat();
        self.derivative(&later, |block| {
            let [mean, transposed, constraint] =
                matrices.map(|rows| self.functions.matrix(block, rows));
            quote! {
                let mean_jacobian = #mean;
                let transposed = #transposed;
                let constraint = #constraint;
                (field, projection.jacobian(&mean_jacobian, &transposed, &constraint))
            }
        })
    }

    /// ∂f^τ/∂t₁
    fn time_derivative(&self) -> TokenStream {
        let nodes = self.nodes;
        let columns = [
            &nodes.mean.time_derivative,
            &nodes.transposed_time_derivative,
            &nodes.constraint_time_derivative,
        ];
        let later = columns.map(|entries| entries.as_slice()).concat();
        self.derivative(&later, |block| {
            let [mean, transposed, constraint] =
                columns.map(|entries| self.functions.vector(block, entries));
            quote! {
                let mean_derivative = #mean;
                let transposed = #transposed;
                let constraint = #constraint;
                projection.time_derivative(&mean_derivative, &transposed, &constraint)
            }
        })
    }

    /// A body that needs `later` after f^τ and λ are known.
    fn derivative(
        &self,
        later: &[Id],
        result: impl FnOnce(&Block<'_>) -> TokenStream,
    ) -> TokenStream {
        let roots = [&self.base[..], later].concat();
        let solved: [(&str, &[Name]); 2] = [
            ("field", &self.nodes.field),
            ("multipliers", &self.nodes.lambda),
        ];
        let finish = |block: &mut Block<'_>, entries| {
            self.project(block);
            block.push(entries);
            block.compute(later);
            result(block)
        };
        self.functions
            .body_with(Arguments::Step, &roots, &solved, finish)
    }
}
