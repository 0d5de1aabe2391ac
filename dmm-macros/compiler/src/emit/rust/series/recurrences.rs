//! The coefficients of what is not linear: squares, products, quotients, powers and functions.

use num_traits::ToPrimitive;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::writer::{Writer, factor, minus, product};
use crate::algebra::{Function, Id};
use crate::program::series::{Base, Place, Primitive, Recurrence, Sum};

impl Writer<'_, '_> {
    /// The coefficient of a node that is not linear in its operands; what is, the block writes.
    pub(super) fn recurrence(&mut self, id: Id, recurrence: &Recurrence) -> Option<TokenStream> {
        Some(match *recurrence {
            Recurrence::Linear => return None,
            Recurrence::Shifted(shifted) => {
                let ((minus_u, u), (minus_c, c)) = (shifted.moving, shifted.fixed);
                let (u, c) = (self.value(u), self.fixed(c));
                Self::call("plus", &[minus(minus_u, &u), minus(minus_c, &c)])
            }
            Recurrence::Square(of) => self.half_sum_of("square", of),
            Recurrence::Product(of) => self.product(of),
            Recurrence::Quotient {
                numerator,
                denominator,
                own,
                inverse,
                is_late,
            } => {
                let (u, v) = (self.value(numerator), self.newest(denominator));
                let inverse = self.inverse(inverse, &v);
                self.quotient((u, is_late), [denominator, own], inverse)
            }
            Recurrence::Power {
                base,
                exponent,
                own,
                inverse,
                derivative,
            } => {
                let multiple = self.multiples.get(&id).copied();
                let value = self.power([base, own, derivative], exponent, (inverse, multiple));
                self.block.define(id, &value);
                self.derivative(id, derivative);
                if let Some(multiple) = multiple {
                    let value = self.block.value(id);
                    self.block.set_value(multiple, value);
                }
                return None;
            }
            Recurrence::VariablePower {
                base,
                exponent,
                derivative,
                own,
            } => self.variable_power(base, exponent, derivative, own),
            _ => self.function(id, recurrence),
        })
    }

    /// The reciprocal of `value`, taken at order zero.
    pub(super) fn inverse(&mut self, place: Place, value: &TokenStream) -> TokenStream {
        let (slot, scalar) = (self.array(place), self.scope.scalar);
        let value = factor(value);
        self.block.push(quote! {
            if at == 0 { #slot[0] = #scalar::from_f64(1.0) / #value; }
        });
        quote!(#slot[0])
    }

    /// u^c, or a multiple of it.
    fn power(
        &mut self,
        [base, own, derivative]: [Place; 3],
        exponent: Id,
        (inverse, multiple): (Place, Option<Id>),
    ) -> TokenStream {
        let u = self.newest(base);
        let mut start = self.power_at_start(&u, exponent);
        if let Some(multiple) = multiple {
            (_, start) = self.multiple(multiple, start);
        }
        let inverse = self.inverse(inverse, &u);
        let exponent = self.fixed(exponent);
        let by_pairs = self.power_by_pairs([base, own, derivative], &exponent, &inverse);
        let later = by_pairs.unwrap_or_else(|| {
            let [first, second] = [own, derivative]
                .map(|of| self.sums.get(&Sum::Inner([of, base])).cloned())
                .map(Option::unwrap_or_default);
            let sums = quote!([#first, #second]);
            Self::call("power_from", &[u, exponent, self.first(own), inverse, sums])
        });
        quote!(if at == 0 { #start } else { #later })
    }

    /// u^c at order zero: by products and a root where c is a half of an integer.
    pub(super) fn power_at_start(&mut self, u: &TokenStream, exponent: Id) -> TokenStream {
        let scalar = self.scope.scalar;
        let value = self.scope.lowered.dag().as_constant(exponent);
        let halves = value.and_then(|value| (value * value.denom()).to_integer().to_i32());
        let is_half = value.is_some_and(|value| value.denom().to_i32() == Some(2));
        match (halves, value.is_some_and(|value| value.is_integer())) {
            (Some(n), true) => {
                let n = Literal::i32_unsuffixed(n);
                quote!(#scalar::powi(#u, #n))
            }
            (Some(n), false) if is_half => {
                let whole = Literal::i32_unsuffixed(n.abs() / 2);
                let power = quote!(#scalar::powi(#u, #whole) * #scalar::sqrt(#u));
                if n < 0 {
                    quote!(#scalar::from_f64(1.0) / (#power))
                } else {
                    power
                }
            }
            _ => {
                let exponent = self.fixed(exponent);
                quote!(#scalar::powf(#u, #exponent))
            }
        }
    }

    /// u^v = e^(v ln u), v changing with the time.
    fn variable_power(
        &mut self,
        base: Base,
        exponent: Id,
        derivative: Place,
        own: Place,
    ) -> TokenStream {
        let (scalar, d) = (self.scope.scalar, self.array(derivative));
        let exponent = self.value(exponent);
        let (base, logarithm_times) = match base {
            Base::Moving {
                base,
                exponent,
                logarithm,
                primitive,
            } => {
                let (u, ln) = (self.array(base), self.array(logarithm));
                let value = self.primitive(&primitive, &quote!(#scalar::ln(#u[0])));
                self.block.push(quote!(#ln[at] = #value;));
                (quote!(#u[0]), self.product([exponent, logarithm]))
            }
            Base::Fixed { base, logarithm } => {
                let (base, slot) = (self.fixed(base), self.array(logarithm));
                self.block
                    .push(quote!(if at == 0 { #slot[0] = #scalar::ln(#base); }));
                (base, product(&exponent, &quote!(#slot[0])))
            }
        };
        let product = self.block.unused_name("product");
        let value = Self::call("derivative", &[quote!(#product)]);
        self.block.push(quote! {
            let #product = #logarithm_times;
            #d[at] = #value;
        });
        let later = self.integral(&quote!(#product), derivative, own);
        quote!(if at == 0 { #scalar::powf(#base, #exponent) } else { #later })
    }

    /// uₖ, and h du/dh
    fn derivative(&mut self, argument: Id, place: Place) -> TokenStream {
        let u = self.value(argument);
        let value = Self::call("derivative", std::slice::from_ref(&u));
        self.set(place, &value);
        u
    }

    /// The recurrence of a function.
    fn function(&mut self, id: Id, recurrence: &Recurrence) -> TokenStream {
        match *recurrence {
            Recurrence::SquareRoot {
                argument,
                own,
                inverse,
            } => self.square_root(argument, own, inverse),
            Recurrence::Exponential {
                argument,
                derivative,
                own,
            } => self.exponential(argument, derivative, own),
            Recurrence::Pair {
                functions,
                is_negative,
                argument,
                derivative,
                places,
                own,
            } => {
                self.pair((functions, is_negative), argument, derivative, places);
                self.newest(own)
            }
            Recurrence::Computed(own) => self.newest(own),
            Recurrence::Tangent {
                function,
                is_negative,
                argument,
                derivative,
                own,
                partner,
            } => self.tangent(
                (function, is_negative),
                argument,
                derivative,
                [own, partner],
            ),
            Recurrence::Logarithm(primitive) => {
                let start = self.start(Function::Ln, primitive.argument);
                self.primitive(&primitive, &start)
            }
            Recurrence::ArcTangent {
                argument,
                primitive,
            } => self.arc_tangent(argument, &primitive),
            Recurrence::ArcSine {
                function,
                argument,
                inverse,
                primitive,
            } => self.arc_sine(function, argument, inverse, &primitive),
            _ => {
                let message = format!("no series of node {id}");
                quote!(compile_error!(#message))
            }
        }
    }

    /// The value of a function at order zero.
    pub(super) fn start(&mut self, function: Function, argument: Id) -> TokenStream {
        let (scalar, method) = (self.scope.scalar, format_ident!("{}", function.name()));
        let value = self.value(argument);
        quote!(#scalar::#method(#value))
    }

    /// √u
    fn square_root(&mut self, argument: Id, own: Place, inverse: Place) -> TokenStream {
        let scalar = self.scope.scalar;
        let value = self.value(argument);
        let root = quote!(#scalar::sqrt(#value));
        let inverse = self.inverse(inverse, &quote!(#scalar::from_f64(2.0) * #root));
        let later = self.root(value, own, inverse);
        quote!(if at == 0 { #root } else { #later })
    }

    /// eᵘ at order zero; of u = ±p t the product is rounded once.
    pub(super) fn exponential_at_start(&mut self, argument: Id) -> TokenStream {
        let scalar = self.scope.scalar;
        match self.scope.lowered.secular(argument) {
            Some((negative, p, _)) => {
                let p = self.fixed(p);
                let sign = negative.then(|| quote!(-));
                quote!(#scalar::exp_product(#sign #p, t))
            }
            None => self.start(Function::Exp, argument),
        }
    }

    /// eᵘ
    fn exponential(&mut self, argument: Id, derivative: Place, own: Place) -> TokenStream {
        let start = self.exponential_at_start(argument);
        let u = self.derivative(argument, derivative);
        let later = self.integral(&u, derivative, own);
        quote!(if at == 0 { #start } else { #later })
    }

    /// w = tan u or tanh u, and v = 1 ± w², one order behind w.
    fn tangent(
        &mut self,
        (function, is_negative): (Function, bool),
        argument: Id,
        derivative: Place,
        [own, partner]: [Place; 2],
    ) -> TokenStream {
        let scalar = self.scope.scalar;
        let start = self.start(function, argument);
        let u = self.derivative(argument, derivative);
        let (w, v) = (self.array(own), self.array(partner));
        let value = self.integral(&u, derivative, partner);
        let square = self.half_sum_of("square", own);
        let one = quote!(#scalar::from_f64(1.0));
        let partner = Self::call("plus", &[minus(is_negative, &square), one]);
        self.block.push(quote! {
            #w[at] = if at == 0 { #start } else { #value };
            #v[at] = #partner;
        });
        quote!(#w[at])
    }

    /// ∫ du/v with v = 1 + u²
    fn arc_tangent(&mut self, argument: Place, primitive: &Primitive) -> TokenStream {
        let scalar = self.scope.scalar;
        let start = self.start(Function::Atan, primitive.argument);
        let v = self.array(primitive.divisor);
        let square = self.half_sum_of("square", argument);
        let value = Self::call("plus", &[square, quote!(#scalar::from_f64(1.0))]);
        self.block.push(quote!(#v[at] = #value;));
        self.primitive(primitive, &start)
    }

    /// ±∫ du/v with v = √(1 − u²)
    fn arc_sine(
        &mut self,
        function: Function,
        argument: Place,
        inverse: Place,
        primitive: &Primitive,
    ) -> TokenStream {
        let scalar = self.scope.scalar;
        let start = self.start(function, primitive.argument);
        let v = self.array(primitive.divisor);
        let square = self.half_sum_of("square", argument);
        let one = quote!(#scalar::from_f64(1.0));
        let base = Self::call("plus", &[minus(true, &square), one]);
        self.block.push(quote!(let base = #base;));
        let twice = quote!(#scalar::from_f64(2.0) * #scalar::sqrt(base));
        let inverse = self.inverse(inverse, &twice);
        let later = self.root(quote!(base), primitive.divisor, inverse);
        self.block.push(quote! {
            #v[at] = if at == 0 { #scalar::sqrt(base) } else { #later };
        });
        self.primitive(primitive, &start)
    }

    /// sin and cos, sinh and cosh: each the integral of the other.
    fn pair(
        &mut self,
        (functions, is_negative): ([Function; 2], bool),
        argument: Id,
        derivative: Place,
        places: [Place; 2],
    ) {
        let [sine, cosine] = functions.map(|one| self.start(one, argument));
        let u = self.derivative(argument, derivative);
        let [next_cosine, next_sine] = match self.both_integrals(&u, derivative, places) {
            Some(both) => both,
            None => places.map(|place| self.integral(&u, derivative, place)),
        };
        let next_cosine = minus(is_negative, &next_cosine);
        let names = functions.map(|one| self.block.unused_name(one.name()));
        let [s, c] = &names;
        self.block.push(quote! {
            let (#s, #c) = if at == 0 { (#sine, #cosine) } else { (#next_sine, #next_cosine) };
        });
        for (place, name) in places.into_iter().zip(names) {
            self.set(place, &quote!(#name));
        }
    }

    /// w = ±∫ du/v
    fn primitive(&mut self, primitive: &Primitive, start: &TokenStream) -> TokenStream {
        let (e, v) = (self.array(primitive.slope), self.array(primitive.divisor));
        let inverse = self.inverse(primitive.inverse, &quote!(#v[0]));
        let u = minus(primitive.is_negative, &self.value(primitive.argument));
        let later = Self::call("primitive", &[u, quote!(&#v), quote!(&#e), inverse]);
        let value = self.block.unused_name("primitive");
        let derivative = Self::call("derivative", &[quote!(#value)]);
        self.block.push(quote! {
            let #value = if at == 0 { #start } else { #later };
            #e[at] = #derivative;
        });
        quote!(#value)
    }
}
