//! The system: its struct, `Default`, the enumeration of its regions and `impl System`.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::listing;
use super::dynamics::dynamics;
use super::emission::Emission;
use super::events::events;
use super::guards::{guards, sign};
use super::item::{default, default_value, item, regions};
use super::paths;
use crate::model::{Parameter, Sign};
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
    let events = (emission.events.as_ref())
        .zip(program.events.as_ref())
        .map(|(name, program)| events(&emission, name, program));
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
            #events
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
    let all = paths::count(emission.program.parameters.len());
    let constants = Constants::of(emission);
    let (of_mode, parameters_of_mode) = (&constants.region, &constants.parameters);
    let mode = &constants.mode;
    let (of_constants, some_region) = (&constants.methods, &constants.some);
    let (dynamics_of, scalar) = (&emission.dynamics_of, &emission.scalar);
    quote! {
        #[automatically_derived]
        impl #system<#states> for #name {
            type Region = #mode;
            #[inline(always)]
            fn metadata(&self) -> &'static #of_system { &METADATA }
            fn declaration(&self) -> &str { #declaration }
            fn listing(&self) -> &str { #listing }
            #[inline(always)]
            fn region(&self, index: usize) -> ::core::option::Option<#mode> {
                let region = match index {
                    #(#regions => #region::#variants,)*
                    _ => return ::core::option::Option::None,
                };
                ::core::option::Option::Some(#some_region)
            }
            #[inline(always)]
            fn index(region: #mode) -> usize { region #of_mode as usize }
            #across
            #of_constants
            fn parameters(&self) -> ::std::vec::Vec<f64> { ::std::vec![#(self.#fields),*] }
            fn parameter_mut(&mut self, index: usize) -> ::core::option::Option<&mut f64> {
                match index {
                    #(#indices => ::core::option::Option::Some(&mut self.#fields),)*
                    _ => ::core::option::Option::None,
                }
            }
            #[inline]
            fn visit<V: #visitor<#states>>(&self, region: #mode, visitor: V) -> V::Output {
                let parameters: [f64; #count] = [#(self.#fields),*];
                self.visit_with::<f64, V>(region, |index| parameters[index], visitor)
            }
            #[inline(always)]
            fn visit_with<#scalar: #bound, V: #visitor<#states, #scalar>>(
                &self,
                region: #mode,
                parameter: impl ::core::ops::Fn(usize) -> #scalar,
                visitor: V,
            ) -> V::Output {
                let parameters: [#scalar; #all] =
                    [#(parameter(#indices),)* #(#scalar::from_f64(#parameters_of_mode)),*];
                match region #of_mode {
                    #(#region::#variants => visitor.visit(&#dynamics_of::<#scalar>::new(&parameters)),)*
                }
            }
        }
    }
}

/// What is said of the constants of a mode, of systems that have such.
struct Constants {
    /// The type of a mode.
    mode: TokenStream,
    /// What a mode is called `region` by.
    region: TokenStream,
    /// The constants of the mode `region`.
    parameters: Vec<TokenStream>,
    /// The mode of `region` with initial constants.
    some: TokenStream,
    methods: TokenStream,
}

impl Constants {
    fn of(emission: &Emission<'_>) -> Self {
        let (program, region) = (emission.program, &emission.region);
        let metadata = &program.metadata;
        let (discrete, free) = (metadata.discrete.len(), metadata.free.len());
        if discrete + free == 0 {
            return Self {
                mode: quote!(#region),
                region: TokenStream::new(),
                parameters: Vec::new(),
                some: quote!(region),
                methods: TokenStream::new(),
            };
        }
        let constants = program.parameters.len() - program.scheme.model.parameters.len();
        let constants = (0..constants).map(paths::count);
        let [mode, vector, side] = ["Mode", "Vector", "Side"].map(paths::support);
        let initial = program.initial.iter().map(default_value);
        let states = paths::count(program.states.len());
        let [discrete, free] = [discrete, free].map(paths::count);
        let parameters: Vec<TokenStream> = constants
            .map(|index| quote!(region.constant(#index)))
            .collect();
        let all = quote!(#(#parameters),*);
        let (bound, scalar) = (paths::support("Scalar"), &emission.scalar);
        let indices: Vec<_> = (0..program.scheme.model.parameters.len())
            .map(paths::count)
            .collect();
        let jump = emission.events.as_ref().map(|events| {
            quote! {
                fn jump_with<#scalar: #bound>(
                    &self,
                    region: Self::Region,
                    event: usize,
                    t: #scalar,
                    state: &#vector<#scalar, #states>,
                    parameter: impl ::core::ops::Fn(usize) -> #scalar,
                ) -> ::core::option::Option<(#vector<#scalar, #states>, ::std::vec::Vec<#scalar>)> {
                    let parameters =
                        [#(parameter(#indices),)* #(#scalar::from_f64(#parameters)),*];
                    let (state, discrete) = #events::<#scalar>::new(&parameters).after(event, t, state)?;
                    ::core::option::Option::Some((state, discrete.to_vec()))
                }
            }
        });
        Self {
            mode: quote!(#mode<#region, #discrete, #free>),
            region: quote!(.region),
            parameters,
            some: quote!(#mode::new(region, [#(#initial),*])),
            methods: quote! {
                fn region_on(
                    &self,
                    sides: &[::core::option::Option<#side>],
                    like: ::core::option::Option<Self::Region>,
                ) -> ::core::option::Option<Self::Region> {
                    let region = self.region(METADATA.region_on(sides)?)?;
                    ::core::option::Option::Some(region.on(&METADATA, sides, like))
                }
                fn side(
                    &self, region: Self::Region, interface: usize
                ) -> ::core::option::Option<#side> {
                    let index = region.region as usize;
                    region.side(&METADATA, index, interface)
                }
                fn slides_on(&self, region: Self::Region, interface: usize) -> bool {
                    region.slides_on(&METADATA, region.region as usize, interface)
                }
                fn constants(region: Self::Region) -> ::std::vec::Vec<f64> {
                    ::std::vec![#all]
                }
                fn with_constant(region: Self::Region, index: usize, value: f64) -> Self::Region {
                    region.with_constant(index, value)
                }
                #jump
            },
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
    let is_free = !emission.program.metadata.free.is_empty();
    if interfaces.is_empty() || is_free || !emission.program.metadata.discrete.is_empty() {
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
        discrete,
        free,
        switches,
        sliding,
        ends,
        events,
        conditions,
        regions,
    } = metadata;
    let [of_system, of_region, condition, side, event, end] = [
        "Metadata",
        "RegionMetadata",
        "Condition",
        "Side",
        "Event",
        "SlideEnd",
    ]
    .map(paths::support);
    let option = |index: Option<usize>| match index.map(paths::count) {
        Some(index) => quote!(::core::option::Option::Some(#index)),
        None => quote!(::core::option::Option::None),
    };
    let free = free.iter().copied().map(paths::count);
    let switches = switches.iter().copied().map(paths::count);
    let sliding = sliding.iter().copied().map(paths::count);
    let some_side = |one: Option<Sign>| match one.map(sign) {
        Some(sign) => quote!(::core::option::Option::Some(#side::#sign)),
        None => quote!(::core::option::Option::None),
    };
    let ends = ends.iter().map(|one| {
        let (interface, side) = (paths::count(one.interface), some_side(one.side));
        quote!(#end { interface: #interface, side: #side })
    });
    let events = events.iter().map(|one| {
        let (rises, falls) = (one.rises, one.falls);
        let interface = paths::count(one.interface);
        let (region, clock) = (option(one.region), option(one.clock));
        quote!(#event {
            interface: #interface,
            rises: #rises,
            falls: #falls,
            region: #region,
            clock: #clock,
        })
    });
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
        let sides = one.sides.iter().map(|one| some_side(*one));
        let on = one.on.iter().copied().map(paths::count);
        let may_slide = one.may_slide.iter().copied().map(paths::count);
        let neighbours = one.neighbours.iter().copied().map(option);
        quote!(#of_region {
            name: #name,
            conserved: &[#(#conserved),*],
            sides: &[#(#sides),*],
            neighbours: &[#(#neighbours),*],
            on: &[#(#on),*],
            may_slide: &[#(#may_slide),*],
        })
    });
    quote! {
        static METADATA: #of_system = #of_system {
            name: #name,
            states: &[#(#states),*],
            parameters: &[#(#parameters),*],
            interfaces: &[#(#interfaces),*],
            discrete: &[#(#discrete),*],
            free: &[#(#free),*],
            switches: &[#(#switches),*],
            sliding: &[#(#sliding),*],
            ends: &[#(#ends),*],
            events: &[#(#events),*],
            conditions: &[#(#conditions),*],
            regions: &[#(#regions),*],
        };
    }
}
