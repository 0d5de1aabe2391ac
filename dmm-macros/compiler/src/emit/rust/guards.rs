//! The functions whose zeros end a region: an `impl Guards` with g, a bound of its rounding error,
//! ∂ₜg and ∇g.
//!
//! The functions are the same for every region; only the sides differ, and a region is a
//! constant of the type. A condition u ≠ 0 is that u keeps its sign; this sign is a field.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::emission::Emission;
use super::function::Scope;
use super::methods::body;
use super::paths;
use super::series::{self, States};
use super::store::{Store, constructor_impl};
use crate::model::Sign;
use crate::program::{Function, GuardSide, Guards, Quantity, Results};

/// The struct `name` of the guards with its `impl`s.
pub(super) fn guards(emission: &Emission<'_>, name: &Ident, program: &Guards) -> TokenStream {
    let store = Store::new(&program.functions, &["orientation", "sides"]);
    let scope = Scope {
        lowered: &program.functions.lowered,
        store: &store,
        scalar: &emission.scalar,
        states: emission.program.states.len(),
    };
    let scalar = &emission.scalar;
    let fields = store.fields(scalar);
    let (statements, mut values) = store.constructor(scalar);
    let signs = program.oriented.len();
    let orientation = (signs > 0).then(|| {
        let signs = paths::count(signs);
        values.extend(quote!(orientation: [1.0; #signs],));
        quote!(orientation: [f64; #signs],)
    });
    let [side, fixed] = ["Side", "sides"].map(paths::support);
    let sides = is_free(program).then(|| {
        let sides = program.sides.iter().enumerate().map(|(region, sides)| {
            let (region, sides) = (paths::count(region), sides.iter().map(free_side));
            quote!(#region => #fixed(&[#(#sides),*]),)
        });
        values.extend(quote! {
            sides: match REGION {
                #(#sides)*
                _ => #fixed(&[]),
            },
        });
        quote!(sides: [(usize, #side); COUNT],)
    });
    let constructor = constructor_impl(
        scalar,
        &quote!(const REGION: usize, const COUNT: usize),
        &quote!(#name<#scalar, REGION, COUNT>),
        emission.program.parameters.len(),
        &statements,
        &values,
    );
    let implementation = implementation(emission, name, &scope, program);
    let derived = paths::derive(&["Clone", "Copy", "Debug"]);
    quote! {
        /// The `COUNT` guards of region number `REGION`: its interfaces, and conditions of proofs.
        #derived
        struct #name<#scalar, const REGION: usize, const COUNT: usize> { #orientation #sides #fields }
        #constructor
        #implementation
    }
}

/// `impl Guards`
fn implementation(
    emission: &Emission<'_>,
    name: &Ident,
    scope: &Scope<'_>,
    program: &Guards,
) -> TokenStream {
    let (scalar, states) = (&emission.scalar, paths::count(scope.states));
    let [guards, bound, vector] = ["Guards", "Scalar", "Vector"].map(paths::support);
    let constants = constants(program);
    let turns = Turns {
        scalar: scalar.clone(),
        oriented: &program.oriented,
    };
    let functions = functions(scope, program, &turns);
    let series = advance(emission, scope, program, &turns);
    let (orientation, orient) = turns.orient(&vector, &quote!(#states));
    let other = &emission.other;
    let fields = scope.store.converted(scalar, other);
    let sides = is_free(program).then(|| quote!(sides: self.sides,));
    quote! {
        #[automatically_derived]
        impl<#scalar: #bound, const REGION: usize, const COUNT: usize>
            #guards<#scalar, #states> for #name<#scalar, REGION, COUNT>
        {
            #constants
            type Each<T: ::core::marker::Copy> = [T; COUNT];
            #[inline]
            fn each<T: ::core::marker::Copy>(&self, value: impl ::core::ops::FnMut(usize) -> T) -> [T; COUNT] {
                ::core::array::from_fn(value)
            }
            type Over<#other: #bound> = #name<#other, REGION, COUNT>;
            #[inline]
            fn over<#other: #bound>(&self) -> Self::Over<#other> {
                #name { #orientation #sides #fields }
            }
            #orient
            #functions
            #series
        }
    }
}

/// What the trait is told about the functions.
fn constants(program: &Guards) -> TokenStream {
    let side = paths::support("Side");
    let is_condition = program.first_condition.map(|first| {
        let first = paths::count(first);
        quote! {
            #[inline(always)]
            fn is_condition(&self, guard: usize) -> bool { guard >= #first }
        }
    });
    let sides = if is_free(program) {
        quote!(&self.sides)
    } else {
        let regions = paths::count(program.sides.len());
        let sides = program.sides.iter().map(|sides| {
            let sides = sides.iter().map(free_side);
            quote!(&[#(#sides),*])
        });
        quote! {
            const BY_REGION: [&[(usize, #side)]; #regions] = [#(#sides),*];
            const { BY_REGION[REGION] }
        }
    };
    let autonomous = program.autonomous;
    let is_affine = program.degree.is_some_and(|degree| degree <= 1);
    let degree = match program.degree {
        Some(degree) => {
            let degree = Literal::u32_unsuffixed(degree);
            quote!(::core::option::Option::Some(#degree))
        }
        None => quote!(::core::option::Option::None),
    };
    quote! {
        const MAY_END: bool = COUNT > 0;
        const AFFINE: ::core::option::Option<bool> = ::core::option::Option::Some(#is_affine);
        const MAY_LEAVE_STATE: bool =
            !::core::matches!(#degree, ::core::option::Option::Some(0..=dmm::LOW_DEGREE));
        #is_condition
        #[inline(always)]
        fn sides(&self) -> &[(usize, #side)] {
            #sides
        }
        #[inline(always)]
        fn is_autonomous(&self) -> bool { #autonomous }
        #[inline(always)]
        fn degree(&self) -> ::core::option::Option<u32> { #degree }
    }
}

/// Whether the side of a guard is a part of the mode.
fn is_free(program: &Guards) -> bool {
    let mut sides = program.sides.iter().flatten();
    sides.any(|(_, side)| matches!(side, GuardSide::Free(_)))
}

/// A guard with the side on which the mode lies, where `parameters` are at hand.
fn free_side(&(number, side_of): &(usize, GuardSide)) -> TokenStream {
    let (number, side) = (paths::count(number), paths::support("Side"));
    match side_of {
        GuardSide::Fixed(one) => {
            let sign = sign(one);
            quote!((#number, #side::#sign))
        }
        GuardSide::Free(parameter) => {
            let (parameter, bound) = (paths::count(parameter), paths::support("Scalar"));
            quote!((#number, #side::of(#bound::to_f64(parameters[#parameter]) - 0.5)))
        }
    }
}

/// g, the bound of its rounding error, and (∂ₜg, ∇g).
fn functions(scope: &Scope<'_>, program: &Guards, turns: &Turns<'_>) -> TokenStream {
    let (scalar, states) = (scope.scalar, paths::count(scope.states));
    let vector = paths::support("Vector");
    let each = |quantity: fn(usize) -> Quantity, unknown: TokenStream| {
        let arms = (0..program.count).map(|index| {
            let function = program.functions.get(quantity(index));
            function.map(|function| turns.body(scope, function))
        });
        select(arms.flatten().collect(), unknown)
    };
    let nan = quote!(#scalar::from_f64(f64::NAN));
    let value = each(Quantity::SwitchingFunction, nan.clone());
    let size = each(Quantity::SwitchingSize, nan);
    let unknown = quote! {(
        #scalar::from_f64(f64::NAN),
        #vector::<#scalar, #states>::from_element(#scalar::from_f64(f64::NAN)),
    )};
    let gradient = each(Quantity::SwitchingGradient, unknown);
    let point = quote!(interface: usize, t: #scalar, state: &#vector<#scalar, #states>);
    quote! {
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
    }
}

/// The signs of the conditions that keep theirs.
struct Turns<'a> {
    scalar: Ident,
    /// The numbers of these conditions, behind the interfaces.
    oriented: &'a [usize],
}

impl Turns<'_> {
    /// The body of a function, turned with its condition.
    fn body(&self, scope: &Scope<'_>, function: &Function) -> TokenStream {
        let (Quantity::SwitchingFunction(index) | Quantity::SwitchingGradient(index)) =
            function.quantity
        else {
            return body(scope, function);
        };
        match (self.sign(index), &function.results) {
            (Some(sign), &Results::Scalar(root)) => scope.body(function, |block| {
                let value = block.value(root);
                quote!(#sign * (#value))
            }),
            (Some(sign), Results::ScalarAndColumn(by_time, gradient)) => {
                scope.body(function, |block| {
                    let by_time = block.value(*by_time);
                    let gradient = scope.vector(block, gradient);
                    quote!((#sign * #by_time, #gradient * #sign))
                })
            }
            _ => body(scope, function),
        }
    }

    /// The sign of function number `index`, if it is a field.
    fn sign(&self, index: usize) -> Option<TokenStream> {
        let place = self.oriented.iter().position(|&number| number == index)?;
        let (scalar, place) = (&self.scalar, paths::count(place));
        Some(quote!(#scalar::from_f64(self.orientation[#place])))
    }

    /// The field over other scalars, and the method that turns conditions.
    fn orient(&self, vector: &TokenStream, states: &TokenStream) -> (TokenStream, TokenStream) {
        if self.oriented.is_empty() {
            return (TokenStream::new(), TokenStream::new());
        }
        let scalar = &self.scalar;
        let numbers = self.oriented.iter().map(|&number| paths::count(number));
        let places = (0..self.oriented.len()).map(paths::count);
        let method = quote! {
            /// With conditions that are positive at (t, x).
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
fn advance(
    emission: &Emission<'_>,
    scope: &Scope<'_>,
    program: &Guards,
    turns: &Turns<'_>,
) -> TokenStream {
    let Emission {
        order,
        coefficients: count,
        ..
    } = emission;
    let (scalar, slots) = (scope.scalar, series::arrays(&program.series));
    let unrolled = series::unrolled(&program.series);
    let body = series::body(scope, &program.series, States::Given, |index, value| {
        let place = paths::count(index);
        match turns.sign(index) {
            Some(sign) => quote!(series[#place][at] = #sign * (#value);),
            None => quote!(series[#place][at] = #value;),
        }
    });
    quote! {
        type Series<const #count: usize> = [[#scalar; #count]; #slots];
        type Unrolled = #unrolled;
        /// No coefficients yet.
        #[inline]
        fn series<const #count: usize>(&self) -> Self::Series<{ #count }> {
            [[#scalar::from_f64(0.0); #count]; #slots]
        }
        /// The coefficients of order k of every g along the series of the states.
        #[inline(always)]
        fn advance<#order: dmm::series::Order, const #count: usize>(
            &self, k: #order, t: #scalar, states: &[[#scalar; #count]], series: &mut Self::Series<{ #count }>
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
