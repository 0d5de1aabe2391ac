//! What a flow or a boundary keeps: the parameters that it uses, and every expression of
//! parameters alone, computed once in its constructor.

use std::collections::{BTreeMap, BTreeSet};

use egg::Language;
use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::code::Block;
use super::lower::Lowered;
use super::names::Names;
use super::paths;
use super::readable::{plain, suggestion};
use crate::algebra::{Id, Math, Name, to_text};

/// The fields of an emitted struct.
pub(super) struct Store {
    parameters: BTreeMap<Id, Ident>,
    computed: BTreeMap<Id, Ident>,
}

impl Store {
    /// What the functions that evaluate `roots` need; `reserved` are other fields.
    pub(super) fn new(lowered: &Lowered, roots: &[Id], reserved: &[&str]) -> Self {
        let (leaves, compound) = fixed_frontier(lowered, roots);
        let mut names = Names::reserving(reserved.iter().copied().chain(["_scalar"]));
        let mut parameters = BTreeMap::new();
        for id in leaves {
            if let Math::Variable(name) = &lowered.dag()[id] {
                parameters.insert(id, names.take(&plain(name)));
            }
        }
        let mut computed = BTreeMap::new();
        for id in compound {
            let name = match suggestion(lowered, id) {
                Some(wish) => names.take(&wish),
                None => names.number("c"),
            };
            computed.insert(id, name);
        }
        Self {
            parameters,
            computed,
        }
    }

    /// The values within a method.
    pub(super) fn known(&self) -> BTreeMap<Id, TokenStream> {
        self.parameters
            .iter()
            .chain(&self.computed)
            .map(|(&id, field)| (id, quote!(self.#field)))
            .collect()
    }

    /// The declarations of the fields.
    pub(super) fn fields(&self, lowered: &Lowered, scalar: &Ident) -> TokenStream {
        let parameters = self.parameters.values();
        let computed = self.computed.iter().map(|(&id, field)| {
            let doc = format!(" {}", to_text(lowered.dag(), id));
            quote!(#[doc = #doc] #field: #scalar,)
        });
        quote! {
            #(#parameters: #scalar,)*
            #(#computed)*
            _scalar: ::core::marker::PhantomData<#scalar>,
        }
    }

    /// The field values of the same flow or boundary over the scalar `other`.
    pub(super) fn converted(&self, scalar: &Ident, other: &Ident) -> TokenStream {
        let fields = self.parameters.values().chain(self.computed.values());
        quote! {
            #(#fields: #other::from_f64(#scalar::to_f64(self.#fields)),)*
            _scalar: ::core::marker::PhantomData,
        }
    }

    /// The statements and field values of the constructor `new(parameters)`; `parameters` are
    /// all that the system has.
    pub(super) fn constructor(
        &self,
        lowered: &Lowered,
        scalar: &Ident,
        parameters: &[Name],
    ) -> (TokenStream, TokenStream) {
        let roots: Vec<Id> = self.computed.keys().copied().collect();
        let mut names = Names::reserving(["self", "parameters"]);
        let mut known = BTreeMap::new();
        let mut statements = TokenStream::new();
        for (id, name) in variables(lowered, self.parameters.keys().chain(&roots).copied()) {
            // a bare name would be taken for a constant of that name in the user's scope
            let local = names.take(&format!("parameter_{}", plain(&name)));
            // a variable that no parameter declares cannot occur in a fixed expression
            let Some(index) = parameters.iter().position(|one| *one == name) else {
                continue;
            };
            let index = paths::count(index);
            statements.extend(quote!(let #local = parameters[#index];));
            known.insert(id, quote!(#local));
        }
        let mut block = Block::new(lowered, quote!(#scalar), names, &known, &roots);
        block.compute(&roots);
        let mut values = TokenStream::new();
        for (id, field) in &self.parameters {
            let value = known.get(id);
            values.extend(quote!(#field: #value,));
        }
        for (&id, field) in &self.computed {
            let value = block.value(id);
            values.extend(quote!(#field: #value,));
        }
        values.extend(quote!(_scalar: ::core::marker::PhantomData,));
        statements.extend(block.statements());
        (statements, values)
    }
}

/// The outermost nodes under `roots` that depend on parameters alone: variables, and
/// expressions worth computing beforehand.
fn fixed_frontier(lowered: &Lowered, roots: &[Id]) -> (BTreeSet<Id>, BTreeSet<Id>) {
    let (mut leaves, mut compound) = (BTreeSet::new(), BTreeSet::new());
    let mut seen = BTreeSet::new();
    let mut stack = roots.to_vec();
    while let Some(id) = stack.pop() {
        if !seen.insert(id) {
            continue;
        }
        if !lowered.is_fixed(id) || matches!(lowered.dag()[id], Math::Neg(_)) {
            lowered.dag()[id].for_each(|child| stack.push(child));
        } else if lowered.is_leaf(id) {
            leaves.insert(id);
        } else {
            compound.insert(id);
        }
    }
    (leaves, compound)
}

/// The variables under `roots`, with their names.
fn variables(lowered: &Lowered, roots: impl IntoIterator<Item = Id>) -> Vec<(Id, Name)> {
    lowered
        .dag()
        .reachable(roots)
        .into_iter()
        .filter_map(|id| match &lowered.dag()[id] {
            Math::Variable(name) => Some((id, name.clone())),
            _ => None,
        })
        .collect()
}

/// An `impl` of the constructor `new`, for a struct with generics `generics`.
pub(super) fn constructor_impl(
    scalar: &Ident,
    generics: &TokenStream,
    target: &TokenStream,
    parameters: usize,
    statements: &TokenStream,
    values: &TokenStream,
) -> TokenStream {
    let bound = paths::support("Scalar");
    let count = paths::count(parameters);
    quote! {
        #[automatically_derived]
        impl<#scalar: #bound, #generics> #target {
            #[inline]
            fn new(parameters: &[#scalar; #count]) -> Self {
                #statements
                Self { #values }
            }
        }
    }
}
