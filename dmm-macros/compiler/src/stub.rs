//! What is emitted beside the diagnostics of a wrong declaration: items with the names that the
//! rest of a program refers to, so that one mistake gives one message.
//!
//! A stub never runs; the program that contains it does not compile. Where the declaration does
//! not say how many states there are, the stub implements `System<N>` for every N.

mod count;

use std::collections::BTreeSet;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::model::camel_case;
use crate::syntax::{Declaration, Defaults, Item, is_identifier, is_name_of_type};
use count::Constants;

/// The length of a group of parameters that the declaration does not tell: more than any index
/// that is written in a program is likely to be.
const UNKNOWN_LENGTH: usize = 1024;

/// The struct with its parameters, `Default`, the enumeration of the regions, and an
/// `impl System` with the right number of states. There is none if the system's name is a
/// keyword or a type of Rust, to which nothing else in a program can refer.
pub fn stub(declaration: &Declaration, runtime: &TokenStream) -> TokenStream {
    if !is_name_of_type(&declaration.name.to_string()) {
        return TokenStream::new();
    }
    let constants = Constants::of(declaration);
    let (visibility, name) = (&declaration.visibility, &declaration.name);
    let region = format_ident!("{}Region", name, span = name.span());
    let variants = variants(declaration);
    let item = item(declaration, &constants);
    let implementation = implementation(name, &region, states(declaration, &constants), runtime);
    quote! {
        #item

        #[allow(missing_docs, non_camel_case_types)]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq, ::core::cmp::Eq, ::core::hash::Hash)]
        #visibility enum #region { #(#variants,)* }

        #implementation
    }
}

/// The struct and its `Default`.
fn item(declaration: &Declaration, constants: &Constants) -> TokenStream {
    let (visibility, name) = (&declaration.visibility, &declaration.name);
    let mut fields = Vec::new();
    let mut defaults = Vec::new();
    for (parameter, length) in parameters(declaration, constants) {
        match length {
            Some(length) => {
                fields.push(quote!(pub #parameter: [::core::primitive::f64; #length]));
                defaults.push(quote!(#parameter: [0.0; #length]));
            }
            None => {
                fields.push(quote!(pub #parameter: ::core::primitive::f64));
                defaults.push(quote!(#parameter: 0.0));
            }
        }
    }
    quote! {
        #[allow(missing_docs, non_snake_case, non_camel_case_types)]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq)]
        #visibility struct #name { #(#fields,)* }

        impl ::core::default::Default for #name {
            fn default() -> Self {
                Self { #(#defaults,)* }
            }
        }
    }
}

/// `impl System<N>`, for the number of states if there is one, or else for all.
fn implementation(
    name: &Ident,
    region: &Ident,
    states: Option<usize>,
    runtime: &TokenStream,
) -> TokenStream {
    let (generics, count) = match states {
        Some(states) => (quote!(), quote!(#states)),
        None => (
            quote!(<const STATES: ::core::primitive::usize>),
            quote!(STATES),
        ),
    };
    quote! {
        impl #generics #runtime::support::System<#count> for #name {
            type Region = #region;
            fn metadata(&self) -> &'static #runtime::support::Metadata {
                ::core::unreachable!("the declaration of this system has errors")
            }
            fn declaration(&self) -> &::core::primitive::str { "" }
            fn listing(&self) -> &::core::primitive::str { "" }
            fn region(&self, _: ::core::primitive::usize) -> ::core::option::Option<#region> {
                ::core::option::Option::None
            }
            fn index(_: #region) -> ::core::primitive::usize { 0 }
            fn parameters(&self) -> ::std::vec::Vec<::core::primitive::f64> { ::std::vec::Vec::new() }
            fn parameter_mut(&mut self, _: ::core::primitive::usize) -> ::core::option::Option<&mut ::core::primitive::f64> {
                ::core::option::Option::None
            }
            fn visit<Visitor: #runtime::support::DynamicsVisitor<#count>>(
                &self,
                _: #region,
                _: Visitor,
            ) -> Visitor::Output {
                ::core::unreachable!("the declaration of this system has errors")
            }
            fn visit_with<
                Scalar: #runtime::support::Scalar,
                Visitor: #runtime::support::DynamicsVisitor<#count, Scalar>,
            >(
                &self,
                _: #region,
                _: impl ::core::ops::Fn(::core::primitive::usize) -> Scalar,
                _: Visitor,
            ) -> Visitor::Output {
                ::core::unreachable!("the declaration of this system has errors")
            }
        }
    }
}

/// The parameters, with their numbers of elements if they are groups.
fn parameters<'a>(
    declaration: &'a Declaration,
    constants: &Constants,
) -> Vec<(&'a Ident, Option<usize>)> {
    let mut seen = BTreeSet::new();
    let mut parameters = Vec::new();
    for item in flat(&declaration.items) {
        let Item::Parameter(parameter) = item else {
            continue;
        };
        let name = parameter.group.ident.to_string();
        if !is_identifier(&name) || !seen.insert(name) {
            continue;
        }
        let length = parameter.group.length.as_ref().map(|length| {
            let from_defaults = match &parameter.defaults {
                Defaults::Same(_) => UNKNOWN_LENGTH,
                Defaults::Each(defaults, _) => defaults.len(),
            };
            constants.count(length).unwrap_or(from_defaults)
        });
        parameters.push((&parameter.group.ident, length));
    }
    parameters
}

/// The items with those of regions and loops, where some may stand by mistake.
fn flat(items: &[Item]) -> Vec<&Item> {
    let mut all = Vec::new();
    for item in items {
        all.push(item);
        match item {
            Item::Region(region) => all.extend(flat(&region.items)),
            Item::For(repeated) => all.extend(flat(&repeated.items)),
            _ => {}
        }
    }
    all
}

fn variants(declaration: &Declaration) -> Vec<Ident> {
    let mut seen = BTreeSet::new();
    let mut variants = Vec::new();
    for item in &declaration.items {
        if let Item::Region(region) = item {
            let variant = camel_case(&region.ident.to_string());
            if is_identifier(&variant) && seen.insert(variant.clone()) {
                variants.push(format_ident!("{}", variant, span = region.ident.span()));
            }
        }
    }
    if variants.is_empty() {
        variants.push(format_ident!("Everywhere"));
    }
    variants
}

/// The number of states, elements of groups counted; nothing if it cannot be told.
fn states(declaration: &Declaration, constants: &Constants) -> Option<usize> {
    let mut seen = BTreeSet::new();
    let mut count = 0_usize;
    for item in flat(&declaration.items) {
        let Item::State(states) = item else {
            continue;
        };
        for state in states {
            let elements = match &state.length {
                Some(length) => constants.count(length)?,
                None => 1,
            };
            if seen.insert(state.ident.to_string()) {
                count = count.checked_add(elements)?;
            }
        }
    }
    (count > 0).then_some(count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostics::Diagnostics;
    use crate::syntax;

    /// The stub of a system S with these items, as formatted tokens.
    fn stubbed(items: &str) -> String {
        let text = format!("pub system S {{ {items} }}");
        let tokens: TokenStream = text.parse().expect("tokens");
        let mut diagnostics = Diagnostics::new();
        let declaration = syntax::parse(tokens, &mut diagnostics).expect("a head");
        let file: syn::File =
            syn::parse2(stub(&declaration, &quote!(::dmm_runtime))).expect("Rust items");
        quote!(#file).to_string()
    }

    #[test]
    fn a_stub_has_the_names_of_a_wrong_declaration() {
        let text = stubbed(
            "state x, x, y; param k = 1, k = 2;
            region far_left where g > 0 { } region far_left where g < 0 { }",
        );
        for part in [
            "pub struct S { pub k : :: core :: primitive :: f64 , }",
            "pub enum SRegion { FarLeft , }",
            "System < 2usize > for S",
            "Self { k : 0.0 , }",
        ] {
            assert!(text.contains(part), "{part} / {text}");
        }
    }

    #[test]
    fn misplaced_parameters_and_states_are_there() {
        let text = stubbed(
            "state x; interface g = x;
            region a where g > 0 { param k = 1, m[2] = [1, 2]; state y; der(x) = k; }
            region b where g < 0 { for i in 0..2 { param l = 1; } }",
        );
        for part in [
            "pub struct S { pub k : :: core :: primitive :: f64 , pub m : [:: core :: primitive :: f64 ; 2usize] , pub l : :: core :: primitive :: f64 , }",
            "System < 2usize > for S",
        ] {
            assert!(text.contains(part), "{part} / {text}");
        }
    }

    /// What the macro gives for a system of this name.
    fn compiled(name: &str) -> String {
        let text = format!("system {name} {{ state x; param k = 1; der(x) = k; }}");
        crate::compile(text.parse().expect("tokens")).to_string()
    }

    #[test]
    fn a_refused_name_of_a_system_has_a_stub_if_it_can() {
        for name in ["region", "sum", "param", "r#type"] {
            let text = compiled(name);
            for part in [
                "compile_error !".into(),
                format!("struct {name} {{ pub k : :: core :: primitive :: f64 , }}"),
            ] {
                assert!(text.contains(&part), "{part} / {text}");
            }
        }
        for name in ["f64", "type", "_", "for"] {
            let text = compiled(name);
            assert_eq!(text.matches("compile_error !").count(), 1, "{text}");
            assert!(!text.contains("struct"), "{text}");
        }
    }

    #[test]
    fn groups_have_their_elements() {
        for (items, part) in [
            (
                "const n = 3; state q[n], p[2*n - 1], x;",
                "System < 9usize >",
            ),
            (
                "const n = (2^3 + 7) % 10, m = n/5; state q[m];",
                "System < 1usize >",
            ),
            (
                "const n = 3; param m[n] = 1;",
                "pub m : [:: core :: primitive :: f64 ; 3usize]",
            ),
            ("param m[40] = 1; state x;", "m : [0.0 ; 40usize]"),
            (
                "param m[2] = [1, 2, 3];",
                "pub m : [:: core :: primitive :: f64 ; 2usize]",
            ),
        ] {
            let text = stubbed(items);
            assert!(text.contains(part), "{part} / {text}");
        }
    }

    #[test]
    fn what_cannot_be_told_fits_whatever_the_program_does() {
        for (items, part) in [
            (
                "state q[k];",
                "impl < const STATES : :: core :: primitive :: usize >",
            ),
            (
                "state q[0];",
                "impl < const STATES : :: core :: primitive :: usize >",
            ),
            (
                "state q[1/2];",
                "impl < const STATES : :: core :: primitive :: usize >",
            ),
            (
                "state q[1/0], x;",
                "impl < const STATES : :: core :: primitive :: usize >",
            ),
            (
                "state q[2^999], x;",
                "impl < const STATES : :: core :: primitive :: usize >",
            ),
            (
                "const n = n; state q[n];",
                "impl < const STATES : :: core :: primitive :: usize >",
            ),
            ("", "impl < const STATES : :: core :: primitive :: usize >"),
            (
                "param m[k] = [1, 2, 3];",
                "pub m : [:: core :: primitive :: f64 ; 3usize]",
            ),
            (
                "param m[k] = 1;",
                "pub m : [:: core :: primitive :: f64 ; 1024usize]",
            ),
            (
                "param type = 1, sum = 2;",
                "pub struct S { pub sum : :: core :: primitive :: f64 , }",
            ),
            (
                "param k = 1.0f64, m: f64 = 2;",
                "pub struct S { pub k : :: core :: primitive :: f64 , pub m : :: core :: primitive :: f64 , }",
            ),
            (
                "region a; region self where g > 0 { }",
                "pub enum SRegion { A , RegionSelf , }",
            ),
        ] {
            let text = stubbed(items);
            assert!(text.contains(part), "{part} / {text}");
        }
    }
}
