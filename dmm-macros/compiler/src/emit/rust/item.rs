//! The items that a user sees: the struct of the parameters, `Default`, and the enumeration of
//! the regions.

use std::collections::BTreeMap;

use proc_macro2::TokenStream;
use quote::quote;
use syn::Attribute;

use super::super::listing;
use super::code::Block;
use super::emission::Emission;
use super::expression::double;
use super::names::Names;
use super::paths;
use crate::algebra::{Math, to_text};
use crate::model::{Parameter, Sign};
use crate::program::{DefaultValue, nearest_double};

/// The parameters, the elements of a group together.
fn fields<'a>(emission: &Emission<'a>) -> impl Iterator<Item = &'a [Parameter]> {
    let parameters = &emission.program.scheme.model.parameters;
    parameters.chunk_by(|one, next| next.element.is_some() && one.ident == next.ident)
}

/// The documentation in a declaration, or `otherwise`.
fn documentation(attributes: &[Attribute], otherwise: &str) -> TokenStream {
    if attributes.is_empty() {
        let otherwise = format!(" {otherwise}");
        quote!(#[doc = #otherwise])
    } else {
        quote!(#(#attributes)*)
    }
}

/// The struct with the parameters. Its documentation shows the scheme.
pub(super) fn item(emission: &Emission<'_>, listing: &str) -> TokenStream {
    let model = &emission.program.scheme.model;
    let (visibility, name) = (&model.visibility, &model.name);
    let docs = documentation(&model.attributes, &format!("The system `{name}`."));
    let scheme = listing::documentation(listing);
    let fields = fields(emission).filter_map(|elements| {
        let first = elements.first()?;
        let ident = &first.ident;
        let what = match first.element {
            Some(_) => "Parameters",
            None => "Parameter",
        };
        let docs = documentation(&first.attributes, &format!("{what} `{ident}`."));
        let default = format!(" Default: `{}`.", default_text(emission, elements));
        let kind = match first.element {
            Some(_) => {
                let count = paths::count(elements.len());
                quote!([::core::primitive::f64; #count])
            }
            None => quote!(::core::primitive::f64),
        };
        Some(quote!(#docs #[doc = ""] #[doc = #default] pub #ident: #kind,))
    });
    let derived = paths::derive(&["Clone", "Copy", "Debug", "PartialEq"]);
    quote! {
        #docs
        #[doc = ""]
        #[doc = #scheme]
        #derived
        #[allow(non_snake_case)]
        #visibility struct #name { #(#fields)* }
    }
}

/// The enumeration of the regions. The documentation of a variant shows f^τ in that region.
pub(super) fn regions(emission: &Emission<'_>) -> TokenStream {
    let model = &emission.program.scheme.model;
    let (visibility, name, region) = (&model.visibility, &model.name, &emission.region);
    let docs = format!(" The regions of [`{name}`].");
    let variants = model
        .regions
        .iter()
        .zip(&emission.variants)
        .enumerate()
        .map(|(index, (one, variant))| {
            let sides: Vec<String> = one
                .sides
                .iter()
                .map(|side| {
                    let sign = match side.sign {
                        Sign::Positive => '>',
                        Sign::Negative => '<',
                    };
                    format!("{} {sign} 0", model.interfaces[side.interface].ident)
                })
                .collect();
            let place = match &sides[..] {
                [] => "Everywhere.".to_owned(),
                sides => format!("Where `{}`.", sides.join(", ")),
            };
            let docs = documentation(&one.attributes, &place);
            let field = listing::discrete_vector_field(emission.program.scheme, index);
            let field = listing::documentation(&field);
            quote!(#docs #[doc = ""] #[doc = #field] #variant,)
        });
    let derived = paths::derive(&["Clone", "Copy", "Debug", "PartialEq", "Eq", "Hash"]);
    quote! {
        #[doc = #docs]
        #derived
        #visibility enum #region { #(#variants)* }
    }
}

/// `impl Default`, the declared values of the parameters.
pub(super) fn default(emission: &Emission<'_>) -> TokenStream {
    let model = &emission.program.scheme.model;
    let name = &model.name;
    let mut defaults = emission.program.defaults.iter();
    let values = fields(emission).filter_map(|elements| {
        let first = elements.first()?;
        let ident = &first.ident;
        let values: Vec<TokenStream> = (elements.iter().zip(defaults.by_ref()))
            .map(|(_, default)| default_value(default))
            .collect();
        Some(match first.element {
            Some(_) => quote!(#ident: [#(#values),*],),
            None => quote!(#ident: #(#values)*,),
        })
    });
    quote! {
        #[automatically_derived]
        impl ::core::default::Default for #name {
            fn default() -> Self { Self { #(#values)* } }
        }
    }
}

/// `1`, `[1, 2, 3]`, `[1; 3]`
fn default_text(emission: &Emission<'_>, elements: &[Parameter]) -> String {
    let texts: Vec<String> = elements
        .iter()
        .map(|parameter| to_text(emission.program.scheme.dag(), parameter.default))
        .collect();
    match texts.as_slice() {
        [only] if elements.iter().all(|one| one.element.is_none()) => only.clone(),
        [first, _, ..] if texts.iter().all(|text| text == first) => {
            format!("[{first}; {}]", texts.len())
        }
        texts => format!("[{}]", texts.join(", ")),
    }
}

pub(super) fn default_value(default: &DefaultValue) -> TokenStream {
    let DefaultValue {
        lowered,
        operations,
        value,
    } = default;
    if let Math::Constant(value) = &lowered.dag()[*value] {
        return double(nearest_double(value));
    }
    let bound = paths::support("Scalar");
    let mut block = Block::new(
        lowered,
        quote!(<f64 as #bound>),
        Names::default(),
        &BTreeMap::new(),
        operations,
        &[*value],
    );
    block.compute(operations);
    let value = block.value(*value);
    let statements = block.statements();
    if statements.is_empty() {
        value
    } else {
        quote!({ #statements #value })
    }
}
