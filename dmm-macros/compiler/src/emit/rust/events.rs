//! The events: a struct that computes what has to hold for each of them and the values after it.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::emission::Emission;
use super::function::Scope;
use super::paths;
use super::store::{Store, constructor_impl};
use crate::program::{Events, Quantity, Results};

/// The struct with its `impl`.
pub(super) fn events(emission: &Emission<'_>, program: &Events) -> TokenStream {
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
        &quote!(Events<#scalar>),
        emission.program.parameters.len(),
        &statements,
        &values,
    );
    let discrete = paths::count(emission.program.initial.len());
    let [vector, bound] = ["Vector", "Scalar"].map(paths::support);
    let count = paths::count(states);
    let after = quote!(::core::option::Option<(#vector<#scalar, #count>, [#scalar; #discrete])>);
    let names: Vec<_> = (0..program.conditions.len())
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
            let (x, after) = values.split_at_checked(states)?;
            let body = scope.body(function, |block| {
                let conditions = conditions.iter().map(|&one| block.value(one));
                let discrete = after.iter().map(|&one| block.value(one));
                let x = scope.vector(block, x);
                quote! {
                    #(if !(#scalar::to_f64(#conditions) > 0.0) {
                        return ::core::option::Option::None;
                    })*
                    ::core::option::Option::Some((#x, [#(#discrete),*]))
                }
            });
            let (name, after) = (
                &names[number],
                quote!(::core::option::Option<(#vector<#scalar, #count>, [#scalar; #discrete])>),
            );
            Some(quote! {
                fn #name(&self, t: #scalar, state: &#vector<#scalar, #count>) -> #after { #body }
            })
        });
    let methods: TokenStream = methods.flatten().collect();
    let numbers = (0..names.len()).map(paths::count);
    quote! {
        /// What has to hold for each event, and the values after it.
        #[derive(Clone, Copy, Debug)]
        struct Events<#scalar> { #fields }
        #constructor
        #[automatically_derived]
        impl<#scalar: #bound> Events<#scalar> {
            #methods
            fn after(
                &self, event: usize, t: #scalar, state: &#vector<#scalar, #count>
            ) -> #after {
                match event {
                    #(#numbers => self.#names(t, state),)*
                    _ => ::core::option::Option::None,
                }
            }
        }
    }
}
