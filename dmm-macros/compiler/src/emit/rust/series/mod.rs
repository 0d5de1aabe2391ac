//! The body of `advance`: the coefficients of one order of a [`Series`], with the recurrences of
//! the runtime's module `series`.

mod packs;
mod pairs;
mod recurrences;
mod sums;
mod together;
mod vectors;
mod writer;

use proc_macro2::TokenStream;
use quote::quote;

use self::writer::Writer;
use super::code::Block;
use super::function::Scope;
use super::names::Names;
use super::paths;
use super::store::variable;
use crate::program::series::{SeriesResult, Sums};
use crate::program::{Series, Variable};

/// Where the coefficients of the states are.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum States {
    /// In the first slots, which the recurrences fill.
    Own,
    /// In the slice `states`.
    Given,
}

impl States {
    /// The array of coefficients of a state.
    fn array(self, state: usize) -> TokenStream {
        let state = paths::count(state);
        match self {
            Self::Given => quote!(states[#state]),
            Self::Own => quote!(series[#state]),
        }
    }
}

/// How the sums are run: the type of the runtime.
pub(super) fn unrolled(series: &Series) -> TokenStream {
    match series.sums {
        Sums::Straight => quote!(dmm::series::Straight),
        Sums::Mixed(most) => {
            let most = paths::count(most);
            quote!(dmm::series::Mixed<#most>)
        }
    }
}

/// How many arrays of coefficients there are.
pub(super) fn arrays(series: &Series) -> TokenStream {
    let arrays = paths::count(series.tables.arrays());
    quote!(#arrays)
}

/// The body of `advance`: coefficient k of every node, and the statements that `keep` the result
/// of each root, by its number.
pub(super) fn body(
    scope: &Scope<'_>,
    series: &Series,
    states: States,
    keep: impl Fn(usize, &TokenStream) -> TokenStream,
) -> TokenStream {
    let mut names = Names::reserving(["self", "k", "t", "at", "states", "series", "base", "row"]);
    let mut known = scope.store.known();
    let mut locals = TokenStream::new();
    for input in &series.inputs {
        let local = names.take(&variable(scope.lowered, input.node).to_lowercase());
        let value = match input.variable {
            Variable::State(index) => {
                let array = states.array(index);
                quote!(#array[at])
            }
            _ => quote!(dmm::series::time(k, t)),
        };
        locals.extend(quote!(let #local = #value;));
        known.insert(input.node, quote!(#local));
    }
    let scalar = scope.scalar;
    let block = Block::new(
        scope.lowered,
        quote!(#scalar),
        names,
        &known,
        &series.operations,
        &series.roots,
    );
    let mut writer = Writer::new(scope, states, series, block.fusing(true));
    writer.keep_states();
    writer.sums();
    let mut packs = series.packs.iter().enumerate().peekable();
    let mut index = 0;
    while let Some(coefficient) = series.coefficients.get(index) {
        if let Some((number, pack)) = packs.next_if(|(_, pack)| pack.start == index) {
            writer.pack(number, &series.coefficients[pack.clone()]);
            index = pack.end;
        } else {
            writer.coefficient(coefficient);
            index += 1;
        }
    }
    writer.keep_rows();
    let results = results(&mut writer, series, keep);
    let statements = writer.block.statements();
    quote! {
        let at = k.get();
        #locals
        #statements
        #results
    }
}

/// The statements that keep the results.
fn results(
    writer: &mut Writer<'_, '_>,
    series: &Series,
    keep: impl Fn(usize, &TokenStream) -> TokenStream,
) -> TokenStream {
    let scalar = writer.scope.scalar;
    let step = quote!(dmm::series::step::<#scalar, _>(k));
    let mut scaled = Vec::new();
    for result in &series.results {
        if let SeriesResult::Solution { value, later } = result {
            scaled.push(match later {
                None => (value, step.clone()),
                Some(later) => (&later.value, writer.scale_of_later(later, &step)),
            });
        }
    }
    for (index, (one, _)) in scaled.iter().enumerate() {
        if scaled[..index].iter().any(|(other, _)| other == one) {
            writer.name(one);
        }
    }
    let mut scaled = writer.scaled_together(&scaled).into_iter();
    let mut values = Vec::new();
    for result in &series.results {
        values.push(match result {
            SeriesResult::Value(root) => (writer.value(*root), None),
            SeriesResult::Solution { later: None, .. } => (scaled.next().unwrap_or_default(), None),
            SeriesResult::Solution { value, .. } => {
                (writer.scaled(value, step.clone()), scaled.next())
            }
        });
    }
    let statements = values.iter().enumerate();
    statements
        .map(|(index, (value, later))| {
            let place = paths::count(index);
            match later {
                None => keep(index, value),
                Some(later) => quote! {
                    if at == 0 { series[#place][1] = #value; }
                    if at + 2 < series[#place].len() { series[#place][at + 2] = #later; }
                },
            }
        })
        .collect()
}
