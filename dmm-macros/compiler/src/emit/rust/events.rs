//! The events: a struct that computes what has to hold for each of them and the values after it.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::emission::Emission;
use super::function::Scope;
use super::paths;
use super::store::{Store, constructor_impl};
use crate::program::{Events, Quantity, Results};

/// The struct with its `impl`.
pub(super) fn events(emission: &Emission<'_>, name: &Ident, program: &Events) -> TokenStream {
    let store = Store::new(&program.functions, &[]);
    let scalar = &emission.scalar;
    let states = emission.program.states.len();
    let scope = Scope {
        lowered: &program.functions.lowered,
        store: &store,
        scalar,
        states,
    };
    let fields = store.fields(scalar);
    let (statements, values) = store.constructor(scalar);
    let constructor = constructor_impl(
        scalar,
        &TokenStream::new(),
        &quote!(#name<#scalar>),
        emission.program.parameters.len(),
        &statements,
        &values,
    );
    let discrete = paths::count(emission.program.initial.len());
    let [vector, bound] = ["Vector", "Scalar"].map(paths::support);
    let count = paths::count(states);
    let after = quote!(::core::option::Option<(#vector<#scalar, #count>, [#scalar; #discrete])>);
    let methods_of: Vec<_> = (0..program.conditions.len())
        .map(|number| format_ident!("event_{number}"))
        .collect();
    let methods = program
        .conditions
        .iter()
        .enumerate()
        .map(|(number, &conditions)| {
            let function = program.functions.get(Quantity::Event(number))?;
            let Results::Column(column) = &function.results else {
                return None;
            };
            let (conditions, values) = column.split_at_checked(conditions)?;
            let (x, discrete) = values.split_at_checked(states)?;
            let body = scope.body(function, |block| {
                let conditions = conditions.iter().map(|&one| block.value(one));
                let discrete = discrete.iter().map(|&one| block.value(one));
                let x = scope.vector(block, x);
                quote! {
                    #(if !(#scalar::to_f64(#conditions) > 0.0) {
                        return ::core::option::Option::None;
                    })*
                    ::core::option::Option::Some((#x, [#(#discrete),*]))
                }
            });
            let method = &methods_of[number];
            Some(quote! {
                fn #method(&self, t: #scalar, state: &#vector<#scalar, #count>) -> #after { #body }
            })
        });
    let methods: TokenStream = methods.flatten().collect();
    let numbers = (0..methods_of.len()).map(paths::count);
    let derived = paths::derive(&["Clone", "Copy", "Debug"]);
    quote! {
        /// What has to hold for each event, and the values after it.
        #derived
        struct #name<#scalar> { #fields }
        #constructor
        #[automatically_derived]
        impl<#scalar: #bound> #name<#scalar> {
            #methods
            fn after(
                &self, event: usize, t: #scalar, state: &#vector<#scalar, #count>
            ) -> #after {
                match event {
                    #(#numbers => self.#methods_of(t, state),)*
                    _ => ::core::option::Option::None,
                }
            }
        }
    }
}
