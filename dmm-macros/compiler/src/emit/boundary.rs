//! The boundary of the regions: an `impl Boundary` with g, Σ|terms of g|, ∂ₜg and ∇g.
//!
//! The functions are the same for every region; only the sides differ, and a region is a
//! constant of the type.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::function::{Arguments, Functions};
use super::lower::{Lowered, size};
use super::paths;
use super::series::{Series, States};
use super::store::{Store, constructor_impl};
use super::system::Emission;
use crate::algebra::{Dag, Id, Name};
use crate::model::Sign;
use crate::optimise::Optimiser;
use crate::scheme::Scheme;

/// What the functions of an interface evaluate.
pub(super) struct Nodes {
    /// g
    value: Id,
    /// Σ|terms of g|
    size: Id,
    /// ∂ₜg
    time_derivative: Id,
    /// ∇g
    gradient: Vec<Id>,
}

/// The operations of all interfaces, optimised.
pub(super) fn operations(
    dag: &mut Dag,
    scheme: &Scheme,
    parameters: Vec<Name>,
    optimiser: &mut Optimiser,
) -> (Vec<Nodes>, Lowered) {
    let mut lowered = Lowered::new(parameters.clone());
    let mut target = Lowered::new(parameters);
    let interfaces = scheme.model.interfaces.iter().zip(&scheme.interfaces);
    let nodes = interfaces
        .map(|(interface, derivatives)| {
            let size = size(dag, interface.switching_function);
            let size = lowered.lower(dag, size);
            let mut nodes = Nodes {
                value: lowered.lower(dag, interface.switching_function),
                size: target.copy(&lowered, size),
                time_derivative: lowered.lower(dag, derivatives.time_derivative),
                gradient: derivatives
                    .gradient
                    .iter()
                    .map(|&entry| lowered.lower(dag, entry))
                    .collect(),
            };
            let mut gradient = vec![&mut nodes.time_derivative];
            gradient.extend(&mut nodes.gradient);
            target.optimise(&lowered, vec![vec![&mut nodes.value], gradient], optimiser);
            nodes
        })
        .collect();
    (nodes, target)
}

/// The struct `name` of the boundaries with its `impl`s.
pub(super) fn boundary(
    emission: &Emission<'_>,
    name: &Ident,
    (nodes, lowered): &(Vec<Nodes>, Lowered),
) -> TokenStream {
    let roots: Vec<Id> = nodes
        .iter()
        .flat_map(|nodes| {
            [nodes.value, nodes.size, nodes.time_derivative]
                .into_iter()
                .chain(nodes.gradient.iter().copied())
        })
        .collect();
    let store = Store::new(lowered, &roots, &[]);
    let functions = Functions {
        lowered,
        store: &store,
        scalar: &emission.scalar,
        states: &emission.states,
    };
    let scalar = &emission.scalar;
    let fields = store.fields(lowered, scalar);
    let (statements, values) = store.constructor(lowered, scalar, &emission.parameters);
    let constructor = constructor_impl(
        scalar,
        &quote!(const REGION: usize, const COUNT: usize),
        &quote!(#name<#scalar, REGION, COUNT>),
        emission.parameters.len(),
        &statements,
        &values,
    );
    let implementation = implementation(emission, name, &functions, nodes);
    quote! {
        /// The `COUNT` interfaces that bound region number `REGION`.
        #[derive(Clone, Copy, Debug)]
        struct #name<#scalar, const REGION: usize, const COUNT: usize> { #fields }
        #constructor
        #implementation
    }
}

/// `impl Boundary`
fn implementation(
    emission: &Emission<'_>,
    name: &Ident,
    functions: &Functions<'_>,
    nodes: &[Nodes],
) -> TokenStream {
    let (scalar, states) = (&emission.scalar, paths::count(emission.states.len()));
    let [boundary, bound, side, vector] =
        ["Boundary", "Scalar", "Side", "Vector"].map(paths::support);
    let regions = paths::count(emission.scheme.model.regions.len());
    let sides = emission.scheme.model.regions.iter().map(|region| {
        let sides = region.sides.iter().map(|one| {
            let (interface, sign) = (paths::count(one.interface), sign(one.sign));
            quote!((#interface, #side::#sign))
        });
        quote!(&[#(#sides),*])
    });
    let one_value = |root: fn(&Nodes) -> Id| {
        let arms = nodes.iter().map(|nodes| {
            let root = root(nodes);
            functions.body(Arguments::Point, &[root], |block| {
                block.compute(&[root]);
                block.value(root)
            })
        });
        select(arms.collect(), quote!(#scalar::from_f64(f64::NAN)))
    };
    let interfaces = &emission.scheme.interfaces;
    let autonomous = interfaces.iter().all(|interface| interface.autonomous);
    let degrees = interfaces.iter().map(|interface| interface.degree);
    let degree = degrees.reduce(|a, b| Some(a?.max(b?))).flatten();
    let degree = degree.map(|degree| {
        let degree = Literal::u32_unsuffixed(degree);
        quote! {
            const DEGREE: ::core::option::Option<u32> = ::core::option::Option::Some(#degree);
        }
    });
    let value = one_value(|nodes| nodes.value);
    let size = one_value(|nodes| nodes.size);
    let gradients = nodes.iter().map(|nodes| {
        let roots = [&[nodes.time_derivative][..], &nodes.gradient].concat();
        functions.body(Arguments::Point, &roots, |block| {
            block.compute(&roots);
            let by_time = block.value(nodes.time_derivative);
            let gradient = functions.vector(block, &nodes.gradient);
            quote!((#by_time, #gradient))
        })
    });
    let series = series(functions, nodes);
    let other = &emission.other;
    let fields = functions.store.converted(scalar, other);
    let unknown = quote! {(
        #scalar::from_f64(f64::NAN),
        #vector::<#scalar, #states>::from_element(#scalar::from_f64(f64::NAN)),
    )};
    let gradient = select(gradients.collect(), unknown);
    let point = quote!(interface: usize, t: #scalar, state: &#vector<#scalar, #states>);
    quote! {
        #[automatically_derived]
        impl<#scalar: #bound, const REGION: usize, const COUNT: usize>
            #boundary<#scalar, #states> for #name<#scalar, REGION, COUNT>
        {
            const SIDES: &'static [(usize, #side)] = {
                const BY_REGION: [&[(usize, #side)]; #regions] = [#(#sides),*];
                BY_REGION[REGION]
            };
            const AUTONOMOUS: bool = #autonomous;
            #degree
            type Each<T: ::core::marker::Copy> = [T; COUNT];
            #[inline]
            fn each<T: ::core::marker::Copy>(value: impl FnMut(usize) -> T) -> [T; COUNT] {
                ::core::array::from_fn(value)
            }
            type Over<#other: #bound> = #name<#other, REGION, COUNT>;
            #[inline]
            fn over<#other: #bound>(&self) -> Self::Over<#other> {
                #name { #fields }
            }
            /// g(t, x)
            #[inline]
            fn switching_function(&self, #point) -> #scalar { #value }
            /// Σ|terms of g(t, x)|
            #[inline]
            fn switching_size(&self, #point) -> #scalar { #size }
            /// ∂ₜg(t, x) and ∇g(t, x)
            #[inline]
            fn switching_gradient(&self, #point) -> (#scalar, #vector<#scalar, #states>) {
                #gradient
            }
            #series
        }
    }
}

/// The recurrences of the Taylor coefficients of every g.
fn series(functions: &Functions<'_>, nodes: &[Nodes]) -> TokenStream {
    let Functions {
        lowered,
        store,
        scalar,
        states,
    } = *functions;
    let roots: Vec<Id> = nodes.iter().map(|nodes| nodes.value).collect();
    let first = roots.len();
    let series = Series::new(lowered, store, scalar, states, States::Given, &roots, first);
    let slots = paths::count(first + series.slots());
    let unrolled = series.unrolled();
    let body = series.body(None, |values, _| {
        let places = (0..values.len()).map(paths::count);
        quote!(#(series[#places][at] = #values;)*)
    });
    quote! {
        type Series<const P: usize> = [[#scalar; P]; #slots];
        type Unrolled = #unrolled;
        /// No coefficients yet.
        #[inline]
        fn series<const P: usize>() -> Self::Series<P> {
            [[#scalar::from_f64(0.0); P]; #slots]
        }
        /// The coefficients of order k of every g along the series of the states.
        #[inline(always)]
        fn advance<K: dmm::series::Order, const P: usize>(
            &self, k: K, t: #scalar, states: &[[#scalar; P]], series: &mut Self::Series<P>
        ) {
            #body
        }
    }
}

/// The body for `interface`; without a choice where there is one interface only.
fn select(bodies: Vec<TokenStream>, unknown: TokenStream) -> TokenStream {
    if let [body] = &bodies[..] {
        return body.clone();
    }
    let arms = bodies.iter().enumerate().map(|(index, body)| {
        let index = paths::count(index);
        quote!(#index => { #body })
    });
    quote! {
        match interface {
            #(#arms)*
            _ => #unknown,
        }
    }
}

/// The variant of the runtime's `Side`.
pub(super) fn sign(sign: Sign) -> TokenStream {
    match sign {
        Sign::Negative => quote!(Negative),
        Sign::Positive => quote!(Positive),
    }
}
