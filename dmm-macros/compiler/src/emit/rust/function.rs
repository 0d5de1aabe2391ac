//! The body of one evaluation function: the arguments by their names in the declaration, the
//! shared sub-expressions, the result.

use std::collections::BTreeMap;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::code::Block;
use super::names::Names;
use super::paths;
use super::store::{Store, variable};
use crate::algebra::Id;
use crate::program::{Function, Input, Lowered, Variable};

/// Matrices with as many entries are written without their zeros, if they have many.
const LARGE_MATRIX: usize = 64;

/// Names that emitted functions use themselves.
const RESERVED: &[&str] = &[
    "self",
    "t",
    "state",
    "t0",
    "start",
    "t1",
    "end",
    "interface",
    "mean",
    "mean_jacobian",
    "mean_derivative",
    "by_time",
    "field",
    "multipliers",
    "multiplier",
    "projection",
    "jacobian",
    "transposed",
    "constraint",
];

/// What the functions of one emitted struct refer to.
pub(super) struct Scope<'a> {
    /// The operations.
    pub lowered: &'a Lowered,
    /// What the struct stores.
    pub store: &'a Store<'a>,
    /// The type of the scalars.
    pub scalar: &'a Ident,
    /// The number of states.
    pub states: usize,
}

impl<'a> Scope<'a> {
    /// The body of `function`: `finish` gives its result when its first stage is computed.
    pub(super) fn body(
        &self,
        function: &Function,
        finish: impl FnOnce(&mut Block<'a>) -> TokenStream,
    ) -> TokenStream {
        self.body_in_stages(function, |block, _| {
            block.compute(&function.first.operations);
            finish(block)
        })
    }

    /// As [`Scope::body`], for one that may have two stages: `finish` computes them, and is given
    /// the statements that take the inputs of the second out of their vectors.
    pub(super) fn body_in_stages(
        &self,
        function: &Function,
        finish: impl FnOnce(&mut Block<'a>, TokenStream) -> TokenStream,
    ) -> TokenStream {
        let mut names = Names::reserving(RESERVED.iter().copied());
        let mut known = self.store.known();
        let mut locals = TokenStream::new();
        for input in &function.first.inputs {
            locals.extend(self.bind(input, &mut names, &mut known));
        }
        let mut late = TokenStream::new();
        for input in function.second.iter().flat_map(|stage| &stage.inputs) {
            late.extend(self.bind(input, &mut names, &mut known));
        }
        let scalar = self.scalar;
        let block = Block::new(
            self.lowered,
            quote!(#scalar),
            names,
            &known,
            &function.operations(),
            &function.results.roots(),
        );
        let mut block = block.fusing(function.quantity.is_fused());
        let result = finish(&mut block, late);
        let statements = block.statements();
        quote!(#locals #statements #result)
    }

    /// Gives an input a name, by a statement if it is an entry of a vector.
    fn bind(
        &self,
        input: &Input,
        names: &mut Names,
        known: &mut BTreeMap<Id, TokenStream>,
    ) -> Option<TokenStream> {
        let (vector, index) = match input.variable {
            Variable::State(index) => (quote!(state), index),
            Variable::StartState(index) => (quote!(start), index),
            Variable::EndState(index) => (quote!(end), index),
            Variable::Field(index) => (quote!(field), index),
            Variable::Multiplier(index) => (quote!(multipliers), index),
            Variable::Parameter(index) => (quote!(parameters), index),
            Variable::Time => return given(input, quote!(t), known),
            Variable::StartTime => return given(input, quote!(t0), known),
            Variable::EndTime => return given(input, quote!(t1), known),
        };
        let index = paths::count(index);
        let local = names.take(&variable(self.lowered, input.node).to_lowercase());
        known.insert(input.node, quote!(#local));
        Some(quote!(let #local = #vector[#index];))
    }

    /// A column with the values of `entries`.
    pub(super) fn vector(&self, block: &Block<'_>, entries: &[Id]) -> TokenStream {
        let vector = paths::support("Vector");
        let entries = entries.iter().map(|&entry| block.value(entry));
        quote!(#vector::from([#(#entries),*]))
    }

    /// A matrix with the values of `rows`: by columns as nalgebra stores it, or, where most
    /// entries of a large one are zero, by the places of the others.
    pub(super) fn matrix(&self, block: &Block<'_>, rows: &[Vec<Id>]) -> TokenStream {
        let matrix = paths::support("Matrix");
        let dag = self.lowered.dag();
        let entries = || rows.iter().flatten();
        let others = entries().filter(|&&entry| !dag.is_zero(entry)).count();
        if entries().count() >= LARGE_MATRIX && 2 * others < entries().count() {
            return self.sparse_matrix(block, rows);
        }
        let columns = (0..self.states).map(|column| {
            let entries = rows.iter().map(|row| block.value(row[column]));
            quote!([#(#entries),*])
        });
        quote!(#matrix::from([#(#columns),*]))
    }

    /// The entries that are not zero, with their places.
    fn sparse_matrix(&self, block: &Block<'_>, rows: &[Vec<Id>]) -> TokenStream {
        let (sparse, scalar) = (paths::support("sparse"), self.scalar);
        let [count, columns] = [rows.len(), self.states].map(paths::count);
        let entries = rows.iter().enumerate().flat_map(|(i, row)| {
            let row = row.iter().enumerate();
            let others = row.filter(|&(_, &entry)| !self.lowered.dag().is_zero(entry));
            others.map(move |(j, &entry)| {
                let ([i, j], value) = ([i, j].map(paths::count), block.value(entry));
                quote!(((#i, #j), #value))
            })
        });
        quote!(#sparse::<#scalar, #count, #columns, _>([#(#entries),*]))
    }
}

/// Knows an input under the name of an argument.
fn given(
    input: &Input,
    argument: TokenStream,
    known: &mut BTreeMap<Id, TokenStream>,
) -> Option<TokenStream> {
    known.insert(input.node, argument);
    None
}
