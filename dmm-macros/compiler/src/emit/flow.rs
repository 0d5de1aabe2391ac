//! The flow of a region: an `impl Flow`, whose functions are
//!
//! ```text
//! f(t, x),   ψ(t, x),   Σ|terms of ψ|,   (ψ, Λ),   f^τ,   (f^τ, ∂f^τ/∂x₁),   ∂f^τ/∂t₁.
//! ```

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::boundary;
use super::function::Functions;
use super::lower::Lowered;
use super::methods::{point_functions, step_functions};
use super::nodes::Nodes;
use super::paths;
use super::series::{Series, States};
use super::store::{Store, constructor_impl};
use super::system::Emission;
use crate::scheme::Solvability;

/// The struct of a region's flow with its `impl`s.
pub(super) fn flow(
    emission: &Emission<'_>,
    region: usize,
    (nodes, lowered): &(Nodes, Lowered),
) -> TokenStream {
    let store = Store::new(lowered, &nodes.roots(), &["boundary"]);
    let functions = Functions {
        lowered,
        store: &store,
        scalar: &emission.scalar,
        states: &emission.states,
    };
    let item = item(emission, region, lowered, &store);
    let implementation = implementation(emission, region, &functions, nodes);
    quote!(#item #implementation)
}

/// The struct and its constructor.
fn item(emission: &Emission<'_>, region: usize, lowered: &Lowered, store: &Store) -> TokenStream {
    let (name, scalar) = (&emission.flows[region], &emission.scalar);
    let fields = store.fields(lowered, scalar);
    let (statements, values) = store.constructor(lowered, scalar, &emission.parameters);
    let (boundary_field, boundary_value) = match &emission.boundary {
        Some(boundary) => {
            let target = boundary_type(emission, boundary, region);
            (
                quote!(boundary: #target,),
                quote!(boundary: #boundary::new(parameters),),
            )
        }
        None => (TokenStream::new(), TokenStream::new()),
    };
    let ident = &emission.scheme.model.regions[region].ident;
    let doc =
        format!(" The flow of region `{ident}`: its parameters, and what depends on them alone.");
    let constructor = constructor_impl(
        scalar,
        &TokenStream::new(),
        &quote!(#name<#scalar>),
        emission.parameters.len(),
        &statements,
        &quote!(#boundary_value #values),
    );
    quote! {
        #[doc = #doc]
        #[derive(Clone, Copy, Debug)]
        struct #name<#scalar> { #boundary_field #fields }
        #constructor
    }
}

/// `impl Flow`
fn implementation(
    emission: &Emission<'_>,
    region: usize,
    functions: &Functions<'_>,
    nodes: &Nodes,
) -> TokenStream {
    let scheme = &emission.scheme.regions[region];
    let (name, scalar) = (&emission.flows[region], &emission.scalar);
    let (states, conserved) = (
        paths::count(emission.states.len()),
        paths::count(nodes.psi.len()),
    );
    let [flow, bound, solvability] = ["Flow", "Scalar", "Solvability"].map(paths::support);
    let kind = match scheme.solvability {
        Solvability::Nonlinear => quote!(Nonlinear),
        Solvability::Affine => quote!(Affine),
        Solvability::Linear => quote!(Linear),
    };
    let autonomous = scheme.autonomous;
    let affine = scheme.affine.then(|| {
        quote!(
            const AFFINE: bool = true;
        )
    });
    let boundary = own_boundary(emission, region);
    let oriented = oriented(emission, region);
    let point = point_functions(functions, nodes, scalar);
    let step = step_functions(functions, &nodes.discrete, scalar);
    let series = series(functions, nodes);
    let other = &emission.other;
    let fields = functions.store.converted(scalar, other);
    let boundary_field = (emission.boundary.as_ref()).map(|_| {
        let trait_path = paths::support("Boundary");
        quote!(boundary: #trait_path::over(&self.boundary),)
    });
    quote! {
        #[automatically_derived]
        impl<#scalar: #bound> #flow<#scalar, #states, #conserved> for #name<#scalar> {
            const AUTONOMOUS: bool = #autonomous;
            #affine
            const SOLVABILITY: #solvability = #solvability::#kind;
            #boundary
            #oriented
            type Over<#other: #bound> = #name<#other>;
            #[inline]
            fn over<#other: #bound>(&self) -> #name<#other> {
                #name { #boundary_field #fields }
            }
            #point
            #step
            #series
        }
    }
}

/// The recurrences of the Taylor coefficients of the solution.
fn series(functions: &Functions<'_>, nodes: &Nodes) -> TokenStream {
    let Functions {
        lowered,
        store,
        scalar,
        states,
    } = *functions;
    let series = Series::new(
        lowered,
        store,
        scalar,
        states,
        States::Own,
        &nodes.field,
        states.len(),
    );
    let slots = paths::count(states.len() + series.slots());
    let unrolled = series.unrolled();
    let step = quote!(dmm::series::step::<#scalar, K>(k));
    let body = series.body(Some(&step), |values, later| {
        let states = values.iter().zip(later).enumerate();
        let statements = states.map(|(place, (value, later))| {
            let place = paths::count(place);
            match later {
                None => quote!(series[#place][at + 1] = #value;),
                Some(later) => quote! {
                    if at == 0 { series[#place][1] = #value; }
                    if at + 2 < P { series[#place][at + 2] = #later; }
                },
            }
        });
        quote!(#(#statements)*)
    });
    quote! {
        type Series<const P: usize> = [[#scalar; P]; #slots];
        type Unrolled = #unrolled;
        /// No coefficients yet.
        #[inline]
        fn series<const P: usize>() -> Self::Series<P> {
            [[#scalar::from_f64(0.0); P]; #slots]
        }
        /// The coefficients of order k + 1 of the solution, and those of order k of what it is
        /// made from.
        #[inline(always)]
        fn advance<K: dmm::series::Order, const P: usize>(
            &self, k: K, t: #scalar, series: &mut Self::Series<P>
        ) {
            #body
        }
    }
}

/// The type of a region's boundary.
fn boundary_type(emission: &Emission<'_>, boundary: &Ident, region: usize) -> TokenStream {
    let scalar = &emission.scalar;
    let sides = paths::count(boundary::count(emission.scheme, region));
    let region = paths::count(region);
    quote!(#boundary<#scalar, #region, #sides>)
}

/// The method that turns the guards of a region, if it has such as keep a sign.
fn oriented(emission: &Emission<'_>, region: usize) -> Option<TokenStream> {
    let guards = &emission.scheme.regions[region].guards;
    let keeps_sign = guards
        .iter()
        .any(|guard| guard.keeps_sign() && !guard.is_fixed);
    let (scalar, states) = (&emission.scalar, paths::count(emission.states.len()));
    let [boundary, vector] = ["Boundary", "Vector"].map(paths::support);
    keeps_sign.then(|| {
        quote! {
            const KEEPS_SIGNS: bool = true;
            fn oriented(&self, t: #scalar, state: &#vector<#scalar, #states>) -> Self {
                Self { boundary: #boundary::oriented(&self.boundary, t, state), ..*self }
            }
        }
    })
}

/// The region's boundary as a part of the flow.
fn own_boundary(emission: &Emission<'_>, region: usize) -> TokenStream {
    let (target, value) = match &emission.boundary {
        Some(boundary) => (
            boundary_type(emission, boundary, region),
            quote!(self.boundary),
        ),
        None => {
            let unbounded = paths::support("Unbounded");
            (unbounded.clone(), unbounded)
        }
    };
    quote! {
        type Boundary = #target;
        #[inline]
        fn boundary(&self) -> &Self::Boundary { &#value }
    }
}
