//! The boundary of the regions: an `impl Boundary` with g, a bound of its rounding error, ∂ₜg and ∇g.
//!
//! The functions are the same for every region; only the sides differ, and a region is a
//! constant of the type.
//!
//! The guards of the regions follow the interfaces: functions that are positive where what is
//! proved of the region holds. Of a guard u ≠ 0 it is ±u, with the sign that u has where the
//! region is entered, which is a field.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::function::{Arguments, Functions};
use super::lower::{Lowered, rounding};
use super::paths;
use super::series::{Series, States};
use super::store::{Store, constructor_impl};
use super::system::Emission;
use crate::algebra::{Dag, Id, Name};
use crate::model::Sign;
use crate::optimise::Optimiser;
use crate::scheme::{Guard, Scheme, SwitchingScheme};

/// What the functions of an interface evaluate.
pub(super) struct Nodes {
    /// g
    value: Id,
    /// A bound of the rounding error of g, in units of that of 1.
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
    let nodes = functions(scheme)
        .map(|(function, derivatives)| {
            let size = rounding(dag, function);
            let size = lowered.lower(dag, size);
            let mut nodes = Nodes {
                value: lowered.lower(dag, function),
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

/// The switching functions of the interfaces, then the functions of the guards.
fn functions(scheme: &Scheme) -> impl Iterator<Item = (Id, &SwitchingScheme)> {
    let interfaces = scheme.model.interfaces.iter().zip(&scheme.interfaces);
    let interfaces = interfaces.map(|(interface, derived)| (interface.switching_function, derived));
    interfaces.chain(
        scheme
            .guards()
            .map(|guard| (guard.function, &guard.derivatives)),
    )
}

/// The number of sides of a region, with its guards.
pub(super) fn count(scheme: &Scheme, region: usize) -> usize {
    scheme.model.regions[region].sides.len() + guards(scheme, region).count()
}

/// The guards of a region that a trajectory can come to, with their numbers behind the
/// interfaces.
fn guards(scheme: &Scheme, region: usize) -> impl Iterator<Item = (usize, &Guard)> {
    let first = scheme.model.interfaces.len();
    let guards = scheme.guards().enumerate();
    guards
        .filter(move |(_, guard)| guard.region == region && !guard.is_fixed)
        .map(move |(number, guard)| (first + number, guard))
}

/// The numbers of the guards that keep a sign, behind the interfaces.
pub(super) fn oriented(scheme: &Scheme) -> Vec<usize> {
    let first = scheme.model.interfaces.len();
    let guards = scheme.guards().enumerate();
    guards
        .filter(|(_, guard)| guard.keeps_sign() && !guard.is_fixed)
        .map(|(number, _)| first + number)
        .collect()
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
    let store = Store::new(lowered, &roots, &["orientation"]);
    let functions = Functions {
        lowered,
        store: &store,
        scalar: &emission.scalar,
        states: &emission.states,
    };
    let scalar = &emission.scalar;
    let fields = store.fields(lowered, scalar);
    let (statements, mut values) = store.constructor(lowered, scalar, &emission.parameters);
    let signs = oriented(emission.scheme).len();
    let orientation = (signs > 0).then(|| {
        let signs = paths::count(signs);
        values.extend(quote!(orientation: [1.0; #signs],));
        quote!(orientation: [f64; #signs],)
    });
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
        struct #name<#scalar, const REGION: usize, const COUNT: usize> { #orientation #fields }
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
    let regions_of = emission.scheme.model.regions.iter().enumerate();
    let sides = regions_of.map(|(index, region)| {
        let interfaces = region.sides.iter().map(|one| (one.interface, one.sign));
        let guards = guards(emission.scheme, index).map(|(number, _)| (number, Sign::Positive));
        let sides = interfaces.chain(guards).map(|(interface, side_of)| {
            let (interface, sign) = (paths::count(interface), sign(side_of));
            quote!((#interface, #side::#sign))
        });
        quote!(&[#(#sides),*])
    });
    let turns = Turns {
        scalar: scalar.clone(),
        oriented: oriented(emission.scheme),
    };
    let one_value = |root: fn(&Nodes) -> Id, is_signed: bool| {
        let arms = nodes.iter().enumerate().map(|(index, nodes)| {
            let root = root(nodes);
            functions.body(Arguments::Point, &[root], |block| {
                block.compute(&[root]);
                let value = block.value(root);
                match turns.sign(index).filter(|_| is_signed) {
                    Some(sign) => quote!(#sign * (#value)),
                    None => value,
                }
            })
        });
        select(arms.collect(), quote!(#scalar::from_f64(f64::NAN)))
    };
    let autonomous = self::functions(emission.scheme).all(|(_, derived)| derived.autonomous);
    let degrees = self::functions(emission.scheme).map(|(_, derived)| derived.degree);
    let degree = degrees.reduce(|a, b| Some(a?.max(b?))).flatten();
    let degree = degree.map(|degree| {
        let degree = Literal::u32_unsuffixed(degree);
        quote! {
            const DEGREE: ::core::option::Option<u32> = ::core::option::Option::Some(#degree);
        }
    });
    let value = one_value(|nodes| nodes.value, true);
    let size = one_value(|nodes| nodes.size, false);
    let gradients = nodes.iter().enumerate().map(|(index, nodes)| {
        let roots = [&[nodes.time_derivative][..], &nodes.gradient].concat();
        functions.body(Arguments::Point, &roots, |block| {
            block.compute(&roots);
            let by_time = block.value(nodes.time_derivative);
            let gradient = functions.vector(block, &nodes.gradient);
            match turns.sign(index) {
                Some(sign) => quote!((#sign * #by_time, #gradient * #sign)),
                None => quote!((#by_time, #gradient)),
            }
        })
    });
    let series = series(functions, nodes, &turns);
    let (orientation, orient) = turns.orient(&vector, &quote!(#states));
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
                #name { #orientation #fields }
            }
            #orient
            /// g(t, x)
            #[inline]
            fn switching_function(&self, #point) -> #scalar { #value }
            /// A bound of the rounding error of g(t, x), in units of that of 1
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

/// The signs of the guards that keep theirs.
struct Turns {
    scalar: Ident,
    /// The numbers of these guards, behind the interfaces.
    oriented: Vec<usize>,
}

impl Turns {
    /// The sign of function number `index`, if it is a field.
    fn sign(&self, index: usize) -> Option<TokenStream> {
        let place = self.oriented.iter().position(|&number| number == index)?;
        let (scalar, place) = (&self.scalar, paths::count(place));
        Some(quote!(#scalar::from_f64(self.orientation[#place])))
    }

    /// The field over other scalars, and the method that turns guards.
    fn orient(&self, vector: &TokenStream, states: &TokenStream) -> (TokenStream, TokenStream) {
        if self.oriented.is_empty() {
            return (TokenStream::new(), TokenStream::new());
        }
        let scalar = &self.scalar;
        let numbers = self.oriented.iter().map(|&number| paths::count(number));
        let places = (0..self.oriented.len()).map(paths::count);
        let method = quote! {
            /// With guards that are positive at (t, x).
            fn oriented(&self, t: #scalar, state: &#vector<#scalar, #states>) -> Self {
                let mut oriented = *self;
                #(if #scalar::to_f64(self.switching_function(#numbers, t, state)) < 0.0 {
                    oriented.orientation[#places] = -self.orientation[#places];
                })*
                oriented
            }
        };
        (quote!(orientation: self.orientation,), method)
    }
}

/// The recurrences of the Taylor coefficients of every g.
fn series(functions: &Functions<'_>, nodes: &[Nodes], turns: &Turns) -> TokenStream {
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
        let values = values.iter().enumerate().map(|(index, value)| {
            let place = paths::count(index);
            match turns.sign(index) {
                Some(sign) => quote!(series[#place][at] = #sign * (#value);),
                None => quote!(series[#place][at] = #value;),
            }
        });
        quote!(#(#values)*)
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
