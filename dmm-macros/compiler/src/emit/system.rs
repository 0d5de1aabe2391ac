//! The system: its struct, `Default`, the enumeration of its regions and `impl System`.

use std::collections::BTreeMap;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};
use syn::Attribute;

use super::boundary::{boundary, sign};
use super::code::{Block, double};
use super::constant::nearest_double;
use super::flow::flow;
use super::listing;
use super::lower::Lowered;
use super::names::Names;
use super::operations::Operations;
use super::paths;
use crate::algebra::{Math, Name, to_text};
use crate::model::camel_case;
use crate::model::{Parameter, Sign};
use crate::scheme::{Scheme, quantities};

/// What every emitted part of a system refers to.
pub(super) struct Emission<'a> {
    /// What is emitted.
    pub scheme: &'a Scheme,
    /// The states, in order.
    pub states: Vec<Name>,
    /// The parameters, in order.
    pub parameters: Vec<Name>,
    /// The generic type of the scalars.
    pub scalar: Ident,
    /// That of other scalars.
    pub other: Ident,
    /// The enumeration of the regions.
    pub region: Ident,
    /// Its variants, by region.
    pub variants: Vec<Ident>,
    /// The structs of the flows, by region.
    pub flows: Vec<Ident>,
    /// The struct of the boundaries, if there are any.
    pub boundary: Option<Ident>,
}

impl<'a> Emission<'a> {
    fn new(scheme: &'a Scheme) -> Self {
        let model = &scheme.model;
        let system = model.name.to_string();
        let region = format_ident!("{}Region", model.name, span = model.name.span());
        let mut types = Names::reserving([system.as_str(), &region.to_string(), "dmm"]);
        let mut variants = Names::default();
        let camel: Vec<String> = model
            .regions
            .iter()
            .map(|region| camel_case(&region.ident.to_string()))
            .collect();
        Self {
            scheme,
            states: model.state_names(),
            parameters: model
                .parameters
                .iter()
                .map(|one| one.name.clone())
                .collect(),
            scalar: types.take("S"),
            other: types.take("Other"),
            region,
            variants: camel.iter().map(|name| variants.take(name)).collect(),
            flows: camel
                .iter()
                .map(|name| types.take(&format!("{name}Flow")))
                .collect(),
            boundary: (!model.interfaces.is_empty() || scheme.guards().next().is_some())
                .then(|| types.take("Boundary")),
        }
    }

    /// The parameters, the elements of a group together.
    fn fields(&self) -> impl Iterator<Item = &'a [Parameter]> {
        let parameters = &self.scheme.model.parameters;
        parameters.chunk_by(|one, next| next.element.is_some() && one.ident == next.ident)
    }
}

/// Everything that `pws!` emits for a system.
pub(super) fn system(scheme: &Scheme, operations: &Operations) -> TokenStream {
    let emission = Emission::new(scheme);
    let import = paths::import();
    let listing = listing::listing(scheme);
    let item = item(&emission, &listing);
    let regions = regions(&emission);
    let default = default(&emission);
    let implementation = implementation(&emission, &listing);
    let boundary = emission
        .boundary
        .as_ref()
        .zip(operations.boundary.as_ref())
        .map(|(name, operations)| boundary(&emission, name, operations));
    let flows = operations
        .regions
        .iter()
        .enumerate()
        .map(|(region, operations)| flow(&emission, region, &operations.optimised));
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
            #boundary
            #(#flows)*
        };
    }
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
fn item(emission: &Emission<'_>, listing: &str) -> TokenStream {
    let model = &emission.scheme.model;
    let (visibility, name) = (&model.visibility, &model.name);
    let docs = documentation(&model.attributes, &format!("The system `{name}`."));
    let scheme = listing::documentation(listing);
    let fields = emission.fields().filter_map(|elements| {
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
                quote!([f64; #count])
            }
            None => quote!(f64),
        };
        Some(quote!(#docs #[doc = ""] #[doc = #default] pub #ident: #kind,))
    });
    quote! {
        #docs
        #[doc = ""]
        #[doc = #scheme]
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[allow(non_snake_case)]
        #visibility struct #name { #(#fields)* }
    }
}

/// The enumeration of the regions. The documentation of a variant shows f^τ in that region.
fn regions(emission: &Emission<'_>) -> TokenStream {
    let model = &emission.scheme.model;
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
            let field = listing::discrete_vector_field(emission.scheme, index);
            let field = listing::documentation(&field);
            quote!(#docs #[doc = ""] #[doc = #field] #variant,)
        });
    quote! {
        #[doc = #docs]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #visibility enum #region { #(#variants)* }
    }
}

/// `impl Default`, the declared values of the parameters.
fn default(emission: &Emission<'_>) -> TokenStream {
    let model = &emission.scheme.model;
    let name = &model.name;
    let values = emission.fields().filter_map(|elements| {
        let first = elements.first()?;
        let ident = &first.ident;
        let values: Vec<TokenStream> = elements
            .iter()
            .map(|parameter| default_value(emission, parameter))
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

/// `1`, `[1, 2, 3]`, `[1; 3]`
fn default_text(emission: &Emission<'_>, elements: &[Parameter]) -> String {
    let texts: Vec<String> = elements
        .iter()
        .map(|parameter| to_text(emission.scheme.dag(), parameter.default))
        .collect();
    match texts.as_slice() {
        [only] if elements.iter().all(|one| one.element.is_none()) => only.clone(),
        [first, _, ..] if texts.iter().all(|text| text == first) => {
            format!("[{first}; {}]", texts.len())
        }
        texts => format!("[{}]", texts.join(", ")),
    }
}

fn default_value(emission: &Emission<'_>, parameter: &Parameter) -> TokenStream {
    let mut lowered = Lowered::new(Vec::new());
    let root = lowered.lower(emission.scheme.dag(), parameter.default);
    if let Math::Constant(value) = &lowered.dag()[root] {
        return double(nearest_double(value));
    }
    let bound = paths::support("Scalar");
    let mut block = Block::new(
        &lowered,
        quote!(<f64 as #bound>),
        Names::default(),
        &BTreeMap::new(),
        &[root],
    );
    block.compute(&[root]);
    let value = block.value(root);
    let statements = block.statements();
    if statements.is_empty() {
        value
    } else {
        quote!({ #statements #value })
    }
}

/// `impl System`
fn implementation(emission: &Emission<'_>, listing: &str) -> TokenStream {
    let model = &emission.scheme.model;
    let (name, region) = (&model.name, &emission.region);
    let (states, variants) = (paths::count(model.states.len()), &emission.variants);
    let [system, visitor, bound] = ["System", "FlowVisitor", "Scalar"].map(paths::support);
    let constants = constants(emission, listing);
    let by_region = by_region(emission);
    let fields: Vec<TokenStream> = model.parameters.iter().map(field).collect();
    let indices: Vec<_> = (0..fields.len()).map(paths::count).collect();
    let count = paths::count(fields.len());
    let (flows, scalar) = (&emission.flows, &emission.scalar);
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
                    #(#region::#variants => visitor.visit(&#flows::<#scalar>::new(&parameters)),)*
                }
            }
        }
    }
}

/// The names and texts of `impl System`.
fn constants(emission: &Emission<'_>, listing: &str) -> TokenStream {
    let model = &emission.scheme.model;
    let (region, variants) = (&emission.region, &emission.variants);
    let name = plain_text(&model.name);
    let count = paths::count(model.states.len());
    let states = emission.states.iter().map(Name::as_str);
    let parameters = emission.parameters.iter().map(Name::as_str);
    let interfaces = model.interfaces.iter().map(|one| plain_text(&one.ident));
    let declaration = &model.source;
    let guards = guards(emission);
    quote! {
        const NAME: &'static str = #name;
        const STATES: [&'static str; #count] = [#(#states),*];
        const PARAMETERS: &'static [&'static str] = &[#(#parameters),*];
        const INTERFACES: &'static [&'static str] = &[#(#interfaces),*];
        #guards
        const REGIONS: &'static [#region] = &[#(#region::#variants),*];
        const DECLARATION: &'static str = #declaration;
        const LISTING: &'static str = #listing;
    }
}

/// What a run has to check of the conditions of proofs, if there is anything.
fn guards(emission: &Emission<'_>) -> Option<TokenStream> {
    let scheme = emission.scheme;
    let guard_path = paths::support("Guard");
    let mut guards = scheme.guards().peekable();
    guards.peek()?;
    let guards = guards.map(|guard| {
        let region = paths::count(guard.region);
        let condition = guard.condition.statement(scheme.dag());
        let quantities = quantities(&scheme.model.regions[guard.region], guard);
        let keeps_sign = guard.keeps_sign();
        quote!(#guard_path {
            region: #region,
            condition: #condition,
            quantities: #quantities,
            keeps_sign: #keeps_sign,
        })
    });
    Some(quote!(const GUARDS: &'static [#guard_path] = &[#(#guards),*];))
}

/// The functions of `impl System` that tell about a region.
fn by_region(emission: &Emission<'_>) -> TokenStream {
    let model = &emission.scheme.model;
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

/// An identifier as people read it.
pub(super) fn plain_text(ident: &Ident) -> String {
    ident.to_string().trim_start_matches("r#").to_owned()
}
