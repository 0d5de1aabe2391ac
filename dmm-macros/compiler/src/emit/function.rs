//! The body of one evaluation function: the arguments by their names in the declaration, the
//! shared sub-expressions, the result.

use std::collections::BTreeMap;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::code::Block;
use super::lower::Lowered;
use super::names::Names;
use super::paths;
use super::readable::plain;
use super::store::Store;
use crate::algebra::{Id, Math, Name};

/// What a function is evaluated at.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Arguments {
    /// `t` and `state`
    Point,
    /// `t0`, `start`, `t1` and `end`
    Step,
}

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

/// Makes the functions of one emitted struct.
pub(super) struct Functions<'a> {
    /// The expressions.
    pub lowered: &'a Lowered,
    /// What the struct keeps.
    pub store: &'a Store,
    /// The type of the scalars.
    pub scalar: &'a Ident,
    /// The states, in order.
    pub states: &'a [Name],
}

impl<'a> Functions<'a> {
    /// The body of a function: `roots` are all that it evaluates, `finish` computes them in
    /// its order and gives the result.
    pub(super) fn body(
        &self,
        arguments: Arguments,
        roots: &[Id],
        finish: impl FnOnce(&mut Block<'a>) -> TokenStream,
    ) -> TokenStream {
        self.body_with(arguments, roots, &[], |block, _| finish(block))
    }

    /// As [`Functions::body`], with the entries of the vectors `extra` as further variables;
    /// `finish` is given the statements that take them out of the vectors.
    pub(super) fn body_with(
        &self,
        arguments: Arguments,
        roots: &[Id],
        extra: &[(&str, &[Name])],
        finish: impl FnOnce(&mut Block<'a>, TokenStream) -> TokenStream,
    ) -> TokenStream {
        let variables = self.variables(roots);
        let mut names = Names::reserving(RESERVED.iter().copied());
        let mut known = self.store.known();
        let mut locals = TokenStream::new();
        let mut bind = |known: &mut BTreeMap<Id, TokenStream>, name: &Name, value: TokenStream| {
            if let Some(&id) = variables.get(name) {
                let local = names.take(&plain(name).to_lowercase());
                known.insert(id, quote!(#local));
                Some(quote!(let #local = #value;))
            } else {
                None
            }
        };
        for (index, state) in self.states.iter().enumerate() {
            let index = paths::count(index);
            let entries = match arguments {
                Arguments::Point => vec![(state.clone(), quote!(state[#index]))],
                Arguments::Step => vec![
                    (state.at_start(), quote!(start[#index])),
                    (state.at_end(), quote!(end[#index])),
                ],
            };
            for (name, value) in entries {
                locals.extend(bind(&mut known, &name, value));
            }
        }
        let mut late = TokenStream::new();
        for (vector, entries) in extra {
            let vector = quote::format_ident!("{vector}");
            for (index, name) in entries.iter().enumerate() {
                let index = paths::count(index);
                late.extend(bind(&mut known, name, quote!(#vector[#index])));
            }
        }
        for (name, local) in times(arguments) {
            if let Some(&id) = variables.get(&name) {
                known.insert(id, local);
            }
        }
        let scalar = self.scalar;
        let mut block = Block::new(self.lowered, quote!(#scalar), names, &known, roots);
        if arguments == Arguments::Step {
            block = block.fusing();
        }
        let result = finish(&mut block, late);
        let statements = block.statements();
        quote!(#locals #statements #result)
    }

    /// The variables that `roots` depend on.
    fn variables(&self, roots: &[Id]) -> BTreeMap<Name, Id> {
        let dag = self.lowered.dag();
        dag.reachable(roots.iter().copied())
            .into_iter()
            .filter_map(|id| match &dag[id] {
                Math::Variable(name) => Some((name.clone(), id)),
                _ => None,
            })
            .collect()
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
        let columns = (0..self.states.len()).map(|column| {
            let entries = rows.iter().map(|row| block.value(row[column]));
            quote!([#(#entries),*])
        });
        quote!(#matrix::from([#(#columns),*]))
    }

    /// The entries that are not zero, with their places.
    fn sparse_matrix(&self, block: &Block<'_>, rows: &[Vec<Id>]) -> TokenStream {
        let (sparse, scalar) = (paths::support("sparse"), self.scalar);
        let [count, columns] = [rows.len(), self.states.len()].map(paths::count);
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

fn times(arguments: Arguments) -> Vec<(Name, TokenStream)> {
    let time = crate::model::Model::time();
    match arguments {
        Arguments::Point => vec![(time, quote!(t))],
        Arguments::Step => vec![(time.at_start(), quote!(t0)), (time.at_end(), quote!(t1))],
    }
}
