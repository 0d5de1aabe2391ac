//! The system: its struct, `Default`, the enumeration of its regions and `impl System`.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::{listing, plain_text};
use super::dynamics::dynamics;
use super::emission::Emission;
use super::guards::{guards, sign};
use super::item::{default, item, regions};
use super::paths;
use crate::algebra::Name;
use crate::model::Parameter;
use crate::program::Program;
use crate::scheme::quantities;

/// Everything that `pws!` emits for a system.
pub(in crate::emit) fn system(program: &Program<'_>) -> TokenStream {
    let emission = Emission::new(program);
    let import = paths::import();
    let listing = listing::listing(program.scheme);
    let item = item(&emission, &listing);
    let regions = regions(&emission);
    let default = default(&emission);
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
    let constants = constants(emission, listing);
    let by_region = by_region(emission);
    let fields: Vec<TokenStream> = model.parameters.iter().map(field).collect();
    let indices: Vec<_> = (0..fields.len()).map(paths::count).collect();
    let count = paths::count(fields.len());
    let (dynamics_of, scalar) = (&emission.dynamics_of, &emission.scalar);
    quote! {
        #[automatically_derived]
        impl #system<#states> for #name {
            type Region = #region;
            #constants
            #by_region
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
                Self::visit_with::<f64, V>(region, |index| parameters[index], visitor)
            }
            #[inline(always)]
            fn visit_with<#scalar: #bound, V: #visitor<#states, #scalar>>(
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

/// The names and texts of `impl System`.
fn constants(emission: &Emission<'_>, listing: &str) -> TokenStream {
    let model = &emission.program.scheme.model;
    let (region, variants) = (&emission.region, &emission.variants);
    let name = plain_text(&model.name);
    let count = paths::count(model.states.len());
    let states = emission.program.states.iter().map(Name::as_str);
    let parameters = emission.program.parameters.iter().map(Name::as_str);
    let interfaces = model.interfaces.iter().map(|one| plain_text(&one.ident));
    let declaration = &model.source;
    let conditions = conditions(emission);
    quote! {
        const NAME: &'static str = #name;
        const STATES: [&'static str; #count] = [#(#states),*];
        const PARAMETERS: &'static [&'static str] = &[#(#parameters),*];
        const INTERFACES: &'static [&'static str] = &[#(#interfaces),*];
        #conditions
        const REGIONS: &'static [#region] = &[#(#region::#variants),*];
        const DECLARATION: &'static str = #declaration;
        const LISTING: &'static str = #listing;
    }
}

/// What a run has to check of the conditions of proofs, if there is anything.
fn conditions(emission: &Emission<'_>) -> Option<TokenStream> {
    let scheme = emission.program.scheme;
    let condition_path = paths::support("Condition");
    let mut conditions = scheme.checked_conditions().peekable();
    conditions.peek()?;
    let conditions = conditions.map(|checked| {
        let region = paths::count(checked.region);
        let condition = checked.condition.statement(scheme.dag());
        let quantities = quantities(&scheme.model.regions[checked.region], checked);
        let keeps_sign = checked.keeps_sign();
        quote!(#condition_path {
            region: #region,
            condition: #condition,
            quantities: #quantities,
            keeps_sign: #keeps_sign,
        })
    });
    Some(quote!(const CONDITIONS: &'static [#condition_path] = &[#(#conditions),*];))
}

/// The functions of `impl System` that tell about a region.
fn by_region(emission: &Emission<'_>) -> TokenStream {
    let model = &emission.program.scheme.model;
    let (region, variants) = (&emission.region, &emission.variants);
    let side = paths::support("Side");
    let names = model.regions.iter().map(|one| plain_text(&one.ident));
    let conserved = model.regions.iter().map(|one| {
        let names = one.conserved.iter().map(|psi| plain_text(&psi.ident));
        quote!(&[#(#names),*])
    });
    let sides = model.regions.iter().map(|one| {
        // in the order of the interfaces
        let mut sides = one.sides.clone();
        sides.sort_by_key(|side| side.interface);
        let sides = sides.into_iter().map(|one| {
            let sign = sign(one.sign);
            quote!(#side::#sign)
        });
        quote!(&[#(#sides),*])
    });
    quote! {
        fn region_name(region: #region) -> &'static str {
            match region { #(#region::#variants => #names,)* }
        }
        fn conserved_names(region: #region) -> &'static [&'static str] {
            match region { #(#region::#variants => #conserved,)* }
        }
        fn sides(region: #region) -> &'static [#side] {
            match region { #(#region::#variants => #sides,)* }
        }
    }
}
