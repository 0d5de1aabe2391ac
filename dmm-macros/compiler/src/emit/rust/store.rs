//! What emitted dynamics and guards store: the fields of their structs, and the constructors that
//! compute these from the parameters.

use std::collections::BTreeMap;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::code::Block;
use super::names::Names;
use super::paths;
use super::readable::{plain, suggestion};
use crate::algebra::{Id, Math, to_text};
use crate::program::{Functions, Lowered, Stored, Variable};

/// The fields of an emitted struct.
pub(super) struct Store<'a> {
    lowered: &'a Lowered,
    stored: &'a Stored,
    parameters: BTreeMap<Id, Ident>,
    computed: BTreeMap<Id, Ident>,
}

impl<'a> Store<'a> {
    /// What `functions` find stored; `reserved` are other fields.
    pub(super) fn new(functions: &'a Functions, reserved: &[&str]) -> Self {
        let Functions {
            lowered, stored, ..
        } = functions;
        let mut names = Names::reserving(reserved.iter().copied().chain(["_scalar"]));
        let mut parameters = BTreeMap::new();
        for &id in &stored.parameters {
            parameters.insert(id, names.take(&variable(lowered, id)));
        }
        let mut computed = BTreeMap::new();
        for &id in &stored.computed {
            let name = match suggestion(lowered, id) {
                Some(wish) => names.take(&wish),
                None => names.number("c"),
            };
            computed.insert(id, name);
        }
        Self {
            lowered,
            stored,
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
    pub(super) fn fields(&self, scalar: &Ident) -> TokenStream {
        let parameters = self.parameters.values();
        let computed = self.computed.iter().map(|(&id, field)| {
            let doc = format!(" {}", to_text(self.lowered.dag(), id));
            quote!(#[doc = #doc] #field: #scalar,)
        });
        quote! {
            #(#parameters: #scalar,)*
            #(#computed)*
            _scalar: ::core::marker::PhantomData<#scalar>,
        }
    }

    /// The field values of the same struct over the scalar `other`.
    pub(super) fn converted(&self, scalar: &Ident, other: &Ident) -> TokenStream {
        let fields = self.parameters.values().chain(self.computed.values());
        quote! {
            #(#fields: #other::by_lane(|lane| #scalar::lane(self.#fields, lane)),)*
            _scalar: ::core::marker::PhantomData,
        }
    }

    /// The statements and field values of the constructor `new(parameters)`; `parameters` are
    /// all that the system has.
    pub(super) fn constructor(&self, scalar: &Ident) -> (TokenStream, TokenStream) {
        let mut names = Names::reserving(["self", "parameters"]);
        let mut known = BTreeMap::new();
        let mut statements = TokenStream::new();
        for input in &self.stored.inputs {
            let Variable::Parameter(index) = input.variable else {
                continue;
            };
            // a bare name would be taken for a constant of that name in the user's scope
            let name = variable(self.lowered, input.node);
            let local = names.take(&format!("parameter_{name}"));
            let index = paths::count(index);
            statements.extend(quote!(let #local = parameters[#index];));
            known.insert(input.node, quote!(#local));
        }
        let Stored {
            operations,
            computed,
            ..
        } = self.stored;
        let scalar = quote!(#scalar);
        let mut block = Block::new(self.lowered, scalar, names, &known, operations, computed);
        block.compute(operations);
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

/// The name of a variable as an identifier.
pub(super) fn variable(lowered: &Lowered, id: Id) -> String {
    match &lowered.dag()[id] {
        Math::Variable(name) => plain(name),
        _ => String::from("value"),
    }
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
