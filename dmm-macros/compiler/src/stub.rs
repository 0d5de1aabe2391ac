//! What is emitted beside the diagnostics of a wrong declaration: items with the names that the
//! rest of a program refers to, so that one mistake gives one message.
//!
//! A stub never runs; the program that contains it does not compile.

use std::collections::BTreeSet;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::model::camel_case;
use crate::syntax::{Declaration, Item};

/// The struct with its parameters, `Default`, the enumeration of the regions, and an
/// `impl System` with the right number of states.
pub fn stub(declaration: &Declaration) -> TokenStream {
    let (visibility, name) = (&declaration.visibility, &declaration.name);
    let region = format_ident!("{}Region", name, span = name.span());
    let parameters = parameters(declaration);
    let variants = variants(declaration);
    let states = states(declaration);
    let count = states.len();
    quote! {
        #[allow(missing_docs, non_snake_case, non_camel_case_types)]
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        #visibility struct #name { #(pub #parameters: f64,)* }

        #[allow(missing_docs, non_camel_case_types)]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #visibility enum #region { #(#variants,)* }

        impl ::dmm_runtime::support::System<#count> for #name {
            type Region = #region;
            const NAME: &'static str = "";
            const STATES: [&'static str; #count] = [#(#states),*];
            const PARAMETERS: &'static [&'static str] = &[];
            const INTERFACES: &'static [&'static str] = &[];
            const REGIONS: &'static [#region] = &[];
            const DECLARATION: &'static str = "";
            const LISTING: &'static str = "";
            fn region_name(_: #region) -> &'static str { "" }
            fn conserved_names(_: #region) -> &'static [&'static str] { &[] }
            fn sides(_: #region) -> &'static [::dmm_runtime::support::Side] { &[] }
            fn parameters(&self) -> ::std::vec::Vec<f64> { ::std::vec::Vec::new() }
            fn parameter_mut(&mut self, _: usize) -> ::core::option::Option<&mut f64> {
                ::core::option::Option::None
            }
            fn visit<V: ::dmm_runtime::support::FlowVisitor<#count>>(
                &self,
                _: #region,
                _: V,
            ) -> V::Output {
                ::core::unreachable!("the declaration of this system has errors")
            }
        }
    }
}

fn parameters(declaration: &Declaration) -> Vec<&Ident> {
    let mut seen = BTreeSet::new();
    let all = declaration.items.iter().filter_map(|item| match item {
        Item::Parameter(parameter) => Some(&parameter.ident),
        _ => None,
    });
    all.filter(|ident| seen.insert(ident.to_string())).collect()
}

fn variants(declaration: &Declaration) -> Vec<Ident> {
    let mut seen = BTreeSet::new();
    let all = declaration.items.iter().filter_map(|item| match item {
        Item::Region(region) => Some(&region.ident),
        _ => None,
    });
    let mut variants: Vec<Ident> = all
        .map(|ident| format_ident!("{}", camel_case(&ident.to_string()), span = ident.span()))
        .filter(|variant| seen.insert(variant.to_string()))
        .collect();
    if variants.is_empty() {
        variants.push(format_ident!("Everywhere"));
    }
    variants
}

fn states(declaration: &Declaration) -> Vec<String> {
    let mut seen = BTreeSet::new();
    let all = declaration.items.iter().filter_map(|item| match item {
        Item::State(states) => Some(states.iter().map(|state| state.ident.to_string())),
        _ => None,
    });
    all.flatten()
        .filter(|name| seen.insert(name.clone()))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostics::Diagnostics;
    use crate::syntax;

    #[test]
    fn a_stub_has_the_names_of_a_wrong_declaration() {
        let text = "pub system S { state x, x, y; param k = 1, k = 2;
            region far_left where g > 0 { } region far_left where g < 0 { } }";
        let tokens: TokenStream = text.parse().expect("tokens");
        let mut diagnostics = Diagnostics::new();
        let declaration = syntax::parse(tokens, &mut diagnostics).expect("a head");
        let file: syn::File = syn::parse2(stub(&declaration)).expect("Rust items");
        let text = quote!(#file).to_string();
        for part in [
            "pub struct S { pub k : f64 , }",
            "pub enum SRegion { FarLeft , }",
            "System < 2usize > for S",
            "[\"x\" , \"y\"]",
        ] {
            assert!(text.contains(part), "{part} / {text}");
        }
    }
}
