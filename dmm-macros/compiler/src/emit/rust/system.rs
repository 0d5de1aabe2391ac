//! The system: its struct, `Default`, the enumeration of its regions and `impl System`.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::listing;
use super::dynamics::dynamics;
use super::emission::Emission;
use super::guards::{guards, sign};
use super::item::{default, item, regions};
use super::paths;
use crate::model::Parameter;
use crate::program::{Metadata, Program};

/// Everything that `pws!` emits for a system.
pub(in crate::emit) fn system(program: &Program<'_>, runtime: &TokenStream) -> TokenStream {
    let emission = Emission::new(program);
    let import = paths::import(runtime);
    let listing = listing::listing(program.scheme);
    let item = item(&emission, &listing);
    let regions = regions(&emission);
    let default = default(&emission);
    let metadata = metadata(&program.metadata);
    let implementation = implementation(&emission, &listing);
    let guards = (emission.guards.as_ref())
        .zip(program.guards.as_ref())
        .map(|(name, program)| guards(&emission, name, program));
    let dynamics_of = (program.dynamics.iter().enumerate())
        .map(|(region, program)| dynamics(&emission, region, program));
    quote! {
        #item
        #regions
        #[allow(
            non_snake_case,
            unused_variables,
            unused_parens,
            clippy::all,
            clippy::pedantic,
            clippy::nursery,
            clippy::restriction
        )]
        const _: () = {
            #import
            #default
            #metadata
            #implementation
            #guards
            #(#dynamics_of)*
        };
    }
}

/// The field, or the element of a field, that holds a parameter.
fn field(parameter: &Parameter) -> TokenStream {
    let ident = &parameter.ident;
    match parameter.element {
        Some(element) => {
            let element = paths::count(element);
            quote!(#ident[#element])
        }
        None => quote!(#ident),
    }
}

/// `impl System`
fn implementation(emission: &Emission<'_>, listing: &str) -> TokenStream {
    let model = &emission.program.scheme.model;
    let (name, region) = (&model.name, &emission.region);
    let (states, variants) = (paths::count(model.states.len()), &emission.variants);
    let [system, visitor, bound] = ["System", "DynamicsVisitor", "Scalar"].map(paths::support);
    let of_system = paths::support("Metadata");
    let regions: Vec<_> = (0..variants.len()).map(paths::count).collect();
    let across = across(emission);
    let declaration = &model.source;
    let fields: Vec<TokenStream> = model.parameters.iter().map(field).collect();
    let indices: Vec<_> = (0..fields.len()).map(paths::count).collect();
    let count = paths::count(fields.len());
    let (dynamics_of, scalar) = (&emission.dynamics_of, &emission.scalar);
    quote! {
        #[automatically_derived]
        impl #system<#states> for #name {
            type Region = #region;
            #[inline(always)]
            fn metadata(&self) -> &'static #of_system { &METADATA }
            fn declaration(&self) -> &str { #declaration }
            fn listing(&self) -> &str { #listing }
            #[inline(always)]
            fn region(&self, index: usize) -> ::core::option::Option<#region> {
                match index {
                    #(#regions => ::core::option::Option::Some(#region::#variants),)*
                    _ => ::core::option::Option::None,
                }
            }
            #[inline(always)]
            fn index(region: #region) -> usize { region as usize }
            #across
            fn parameters(&self) -> ::std::vec::Vec<f64> { ::std::vec![#(self.#fields),*] }
            fn parameter_mut(&mut self, index: usize) -> ::core::option::Option<&mut f64> {
                match index {
                    #(#indices => ::core::option::Option::Some(&mut self.#fields),)*
                    _ => ::core::option::Option::None,
                }
            }
            #[inline]
            fn visit<V: #visitor<#states>>(&self, region: #region, visitor: V) -> V::Output {
                let parameters: [f64; #count] = [#(self.#fields),*];
                self.visit_with::<f64, V>(region, |index| parameters[index], visitor)
            }
            #[inline(always)]
            fn visit_with<#scalar: #bound, V: #visitor<#states, #scalar>>(
                &self,
                region: #region,
                parameter: impl ::core::ops::Fn(usize) -> #scalar,
                visitor: V,
            ) -> V::Output {
                let parameters: [#scalar; #count] = [#(parameter(#indices)),*];
                match region {
                    #(#region::#variants => visitor.visit(&#dynamics_of::<#scalar>::new(&parameters)),)*
                }
            }
        }
    }
}

/// The side of a region and its neighbour at an interface, of systems that have such: what a
/// transition asks for.
fn across(emission: &Emission<'_>) -> Option<TokenStream> {
    let Metadata {
        interfaces,
        regions,
        ..
    } = &emission.program.metadata;
    if interfaces.is_empty() {
        return None;
    }
    let (region, variants, side) = (&emission.region, &emission.variants, paths::support("Side"));
    let (mut sides, mut neighbours) = (TokenStream::new(), TokenStream::new());
    for (one, from) in regions.iter().zip(variants) {
        for (interface, (&own, &other)) in one.sides.iter().zip(&one.neighbours).enumerate() {
            let Some(own) = own else { continue };
            let (interface, sign) = (paths::count(interface), sign(own));
            sides.extend(quote!((#region::#from, #interface) => #side::#sign,));
            if let Some(to) = other.and_then(|other| variants.get(other)) {
                neighbours.extend(quote!((#region::#from, #interface) => #region::#to,));
            }
        }
    }
    let none = quote!(_ => return ::core::option::Option::None,);
    let some = quote!(::core::option::Option::Some);
    Some(quote! {
        #[inline(always)]
        fn side(&self, region: #region, interface: usize) -> ::core::option::Option<#side> {
            #some(match (region, interface) { #sides #none })
        }
        #[inline(always)]
        fn neighbour(
            &self, region: #region, interface: usize
        ) -> ::core::option::Option<#region> {
            #some(match (region, interface) { #neighbours #none })
        }
    })
}

/// Names and signs.
fn metadata(metadata: &Metadata) -> TokenStream {
    let Metadata {
        name,
        states,
        parameters,
        interfaces,
        conditions,
        regions,
    } = metadata;
    let [of_system, of_region, condition, side] =
        ["Metadata", "RegionMetadata", "Condition", "Side"].map(paths::support);
    let conditions = conditions.iter().map(|one| {
        let region = paths::count(one.region);
        let (text, quantities, keeps_sign) = (&one.condition, &one.quantities, one.keeps_sign);
        quote!(#condition {
            region: #region,
            condition: #text,
            quantities: #quantities,
            keeps_sign: #keeps_sign,
        })
    });
    let regions = regions.iter().map(|one| {
        let (name, conserved) = (&one.name, &one.conserved);
        let sides = one.sides.iter().map(|one| match one.map(sign) {
            Some(sign) => quote!(::core::option::Option::Some(#side::#sign)),
            None => quote!(::core::option::Option::None),
        });
        let neighbours = one.neighbours.iter().map(|one| match one {
            Some(index) => {
                let index = paths::count(*index);
                quote!(::core::option::Option::Some(#index))
            }
            None => quote!(::core::option::Option::None),
        });
        quote!(#of_region {
            name: #name,
            conserved: &[#(#conserved),*],
            sides: &[#(#sides),*],
            neighbours: &[#(#neighbours),*],
        })
    });
    quote! {
        static METADATA: #of_system = #of_system {
            name: #name,
            states: &[#(#states),*],
            parameters: &[#(#parameters),*],
            interfaces: &[#(#interfaces),*],
            conditions: &[#(#conditions),*],
            regions: &[#(#regions),*],
        };
    }
}
