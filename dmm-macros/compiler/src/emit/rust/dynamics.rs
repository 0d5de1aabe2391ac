//! The dynamics of a region: an `impl Dynamics`, whose functions are
//!
//! ```text
//! f(t, x),   ψ(t, x),   Σ|terms of ψ|,   (ψ, Λ),   f^τ,   (f^τ, ∂f^τ/∂x₁),   ∂f^τ/∂t₁.
//! ```

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::emission::Emission;
use super::function::Scope;
use super::methods::method;
use super::paths;
use super::series::{self, States};
use super::store::{Store, constructor_impl};
use crate::program::{Dynamics, Series};
use crate::scheme::Solvability;

/// The struct of a region's dynamics with its `impl`s.
pub(super) fn dynamics(emission: &Emission<'_>, region: usize, program: &Dynamics) -> TokenStream {
    let store = Store::new(&program.functions, &["guards"]);
    let scope = Scope {
        lowered: &program.functions.lowered,
        store: &store,
        scalar: &emission.scalar,
        states: emission.program.states.len(),
    };
    let item = item(emission, region, &store);
    let implementation = implementation(emission, region, &scope, program);
    quote!(#item #implementation)
}

/// The struct and its constructor.
fn item(emission: &Emission<'_>, region: usize, store: &Store<'_>) -> TokenStream {
    let (name, scalar) = (&emission.dynamics_of[region], &emission.scalar);
    let fields = store.fields(scalar);
    let (statements, values) = store.constructor(scalar);
    let (guards_field, guards_value) = match &emission.guards {
        Some(guards) => {
            let target = guards_type(emission, guards, region);
            (
                quote!(guards: #target,),
                quote!(guards: #guards::new(parameters),),
            )
        }
        None => (TokenStream::new(), TokenStream::new()),
    };
    let ident = &emission.program.scheme.model.regions[region].ident;
    let doc = format!(
        " The dynamics of region `{ident}`: its parameters, and what depends on them alone."
    );
    let constructor = constructor_impl(
        scalar,
        &TokenStream::new(),
        &quote!(#name<#scalar>),
        emission.program.parameters.len(),
        &statements,
        &quote!(#guards_value #values),
    );
    let derived = paths::derive(&["Clone", "Copy", "Debug"]);
    quote! {
        #[doc = #doc]
        #derived
        struct #name<#scalar> { #guards_field #fields }
        #constructor
    }
}

/// `impl Dynamics`
fn implementation(
    emission: &Emission<'_>,
    region: usize,
    scope: &Scope<'_>,
    program: &Dynamics,
) -> TokenStream {
    let scheme = &emission.program.scheme.regions[region];
    let (name, scalar) = (&emission.dynamics_of[region], &emission.scalar);
    let conserved = scheme.proved.multiplier.len();
    let functions = program.functions.all.iter();
    let methods: TokenStream = functions
        .filter_map(|function| method(scope, function, conserved))
        .collect();
    let series = advance(emission, scope, &program.series);
    let (states, conserved) = (paths::count(scope.states), paths::count(conserved));
    let [dynamics, bound, solvability] = ["Dynamics", "Scalar", "Solvability"].map(paths::support);
    let kind = match scheme.solvability {
        Solvability::Nonlinear => quote!(Nonlinear),
        Solvability::Affine => quote!(Affine),
        Solvability::Linear => quote!(Linear),
    };
    let autonomous = scheme.autonomous;
    let affine = scheme.affine;
    let affine_quantities = affine_quantities(&scheme.affine_quantities);
    let guards = own_guards(emission, region);
    let oriented = oriented(emission, region);
    let other = &emission.other;
    let fields = scope.store.converted(scalar, other);
    let guards_field = (emission.guards.as_ref()).map(|_| {
        let trait_path = paths::support("Guards");
        quote!(guards: #trait_path::over(&self.guards),)
    });
    quote! {
        #[automatically_derived]
        impl<#scalar: #bound> #dynamics<#scalar, #states, #conserved> for #name<#scalar> {
            const AFFINE: ::core::option::Option<bool> = ::core::option::Option::Some(#affine);
            #[inline(always)]
            fn is_autonomous(&self) -> bool { #autonomous }
            #[inline(always)]
            fn solvability(&self) -> #solvability { #solvability::#kind }
            #[inline(always)]
            fn is_affine_quantity(&self, quantity: usize) -> bool { #affine_quantities }
            #guards
            #oriented
            type Over<#other: #bound> = #name<#other>;
            #[inline]
            fn over<#other: #bound>(&self) -> #name<#other> {
                #name { #guards_field #fields }
            }
            #methods
            #series
        }
    }
}

/// Whether the ψ number `quantity` is affine.
fn affine_quantities(affine: &[bool]) -> TokenStream {
    let numbers = (0..affine.len()).filter(|&number| affine[number]);
    let mut numbers = numbers.map(paths::count).peekable();
    match numbers.peek() {
        Some(_) => quote!(::core::matches!(quantity, #(#numbers)|*)),
        None => quote!(false),
    }
}

/// The recurrences of the Taylor coefficients of the solution.
fn advance(emission: &Emission<'_>, scope: &Scope<'_>, program: &Series) -> TokenStream {
    let Emission {
        order,
        coefficients: count,
        ..
    } = emission;
    let (scalar, slots) = (scope.scalar, series::arrays(program));
    let unrolled = series::unrolled(program);
    let body = series::body(scope, program, States::Own, |index, value| {
        let place = paths::count(index);
        quote!(series[#place][at + 1] = #value;)
    });
    quote! {
        type Series<const #count: usize> = [[#scalar; #count]; #slots];
        type Unrolled = #unrolled;
        /// No coefficients yet.
        #[inline]
        fn series<const #count: usize>(&self) -> Self::Series<{ #count }> {
            [[#scalar::from_f64(0.0); #count]; #slots]
        }
        /// The coefficients of order k + 1 of the solution, and those of order k of what it is
        /// made from.
        #[inline(always)]
        fn advance<#order: dmm::series::Order, const #count: usize>(
            &self, k: #order, t: #scalar, series: &mut Self::Series<{ #count }>
        ) {
            #body
        }
    }
}

/// The type of a region's guards.
fn guards_type(emission: &Emission<'_>, guards: &Ident, region: usize) -> TokenStream {
    let scalar = &emission.scalar;
    let program = emission.program.guards.iter();
    let sides = program.map(|program| program.sides[region].len()).sum();
    let (sides, region) = (paths::count(sides), paths::count(region));
    quote!(#guards<#scalar, #region, #sides>)
}

/// The method that turns the conditions of a region, if it has such as keep a sign.
fn oriented(emission: &Emission<'_>, region: usize) -> Option<TokenStream> {
    let program = emission.program.guards.as_ref()?;
    let mut sides = program.sides[region].iter();
    let keeps_sign = sides.any(|(number, _)| program.oriented.contains(number));
    let (scalar, states) = (
        &emission.scalar,
        paths::count(emission.program.states.len()),
    );
    let [guards, vector] = ["Guards", "Vector"].map(paths::support);
    keeps_sign.then(|| {
        quote! {
            #[inline(always)]
            fn keeps_signs(&self) -> bool { true }
            fn oriented(&self, t: #scalar, state: &#vector<#scalar, #states>) -> Self {
                Self { guards: #guards::oriented(&self.guards, t, state), ..*self }
            }
        }
    })
}

/// The guards of the region as a part of its dynamics.
fn own_guards(emission: &Emission<'_>, region: usize) -> TokenStream {
    let (target, value) = match &emission.guards {
        Some(guards) => (guards_type(emission, guards, region), quote!(self.guards)),
        None => {
            let unbounded = paths::support("NoGuards");
            (unbounded.clone(), unbounded)
        }
    };
    quote! {
        type Guards = #target;
        #[inline]
        fn guards(&self) -> &Self::Guards { &#value }
    }
}
