//! The statements of what is not linear: quotients, powers and functions.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::Slot;
use super::writer::{Writer, factor, minus, product};
use crate::algebra::{Function, Id};

impl Writer<'_, '_> {
    /// The reciprocal of `value`, taken at order zero.
    fn inverse(&mut self, of: Id, value: &TokenStream) -> TokenStream {
        let (slot, scalar) = (self.series.slot(Slot::Inverse(of)), self.series.scalar);
        let value = factor(value);
        self.block.push(quote! {
            if at == 0 { #slot[0] = #scalar::from_f64(1.0) / #value; }
        });
        quote!(#slot[0])
    }

    pub(super) fn quotient(&mut self, id: Id, a: Id, b: Id) -> TokenStream {
        let u = self.coefficient(a);
        let (v, w) = (
            self.series.slot(Slot::Node(b)),
            self.series.slot(Slot::Node(id)),
        );
        let inverse = self.inverse(id, &quote!(#v[0]));
        Self::call("quotient", &[u, quote!(&#v), quote!(&#w), inverse])
    }

    pub(super) fn power(&mut self, id: Id, a: Id, b: Id) -> TokenStream {
        let (exponent, scalar) = (self.fixed(b), self.series.scalar);
        let (u, w) = (
            self.series.slot(Slot::Node(a)),
            self.series.slot(Slot::Node(id)),
        );
        let inverse = self.inverse(id, &quote!(#u[0]));
        let rest = Self::call(
            "power",
            &[quote!(&#u), exponent.clone(), quote!(&#w), inverse],
        );
        let start = match self.series.lowered.dag().as_integer(b).map(i32::try_from) {
            Some(Ok(n)) => {
                let n = Literal::i32_unsuffixed(n);
                quote!(#scalar::powi(#u[0], #n))
            }
            _ => quote!(#scalar::powf(#u[0], #exponent)),
        };
        quote!(if at == 0 { #start } else { #rest })
    }

    /// u^v = e^(v ln u), v changing with the time.
    pub(super) fn variable_power(&mut self, id: Id, a: Id, b: Id) -> TokenStream {
        let (series, scalar) = (self.series, self.series.scalar);
        let d = series.slot(Slot::Partner(Function::Exp, id));
        let w = series.slot(Slot::Node(id));
        let exponent = self.coefficient(b);
        let (base, logarithm_times) = if series.is_moving(a) {
            let [u, v] = [a, b].map(|one| series.slot(Slot::Node(one)));
            let ln = series.slot(Slot::Partner(Function::Ln, id));
            let start = quote!(#scalar::ln(#u[0]));
            let value = self.primitive(id, a, &u, start, false);
            self.block.push(quote!(#ln[at] = #value;));
            (
                quote!(#u[0]),
                Self::call("product", &[quote!(&#v), quote!(&#ln)]),
            )
        } else {
            let (base, slot) = (self.fixed(a), series.slot(Slot::Inverse(id)));
            self.block
                .push(quote!(if at == 0 { #slot[0] = #scalar::ln(#base); }));
            (base, product(&exponent, &quote!(#slot[0])))
        };
        let value = Self::call("derivative", &[logarithm_times]);
        self.block.push(quote!(#d[at] = #value;));
        let later = Self::call("integral", &[quote!(&#d), quote!(&#w)]);
        quote!(if at == 0 { #scalar::powf(#base, #exponent) } else { #later })
    }

    /// h du/dh
    fn derivative(&mut self, a: Id) -> TokenStream {
        let u = self.coefficient(a);
        let slot = self.series.slot(Slot::Derivative(a));
        let value = Self::call("derivative", &[u]);
        self.block.push(quote!(#slot[at] = #value;));
        slot
    }

    pub(super) fn function(&mut self, id: Id, function: Function, a: Id) -> TokenStream {
        let (series, scalar) = (self.series, self.series.scalar);
        let method = format_ident!("{}", function.name());
        let value = self.coefficient(a);
        let start = match series.lowered.secular(a) {
            Some((negative, p, _)) if function == Function::Exp => {
                let p = self.fixed(p);
                let sign = negative.then(|| quote!(-));
                quote!(#scalar::exp_product(#sign #p, t))
            }
            _ => quote!(#scalar::#method(#value)),
        };
        let later = match function {
            Function::Sqrt => {
                let w = series.slot(Slot::Node(id));
                let root = quote!(#scalar::sqrt(#value));
                let inverse = self.inverse(id, &quote!(#scalar::from_f64(2.0) * #root));
                Self::call("square_root", &[value, quote!(&#w), inverse])
            }
            Function::Exp => {
                let (d, w) = (self.derivative(a), series.slot(Slot::Node(id)));
                Self::call("integral", &[quote!(&#d), quote!(&#w)])
            }
            Function::Sin | Function::Cos | Function::Sinh | Function::Cosh => {
                return self.pair(function, a);
            }
            Function::Tan | Function::Tanh => {
                let d = self.derivative(a);
                let (w, v) = (
                    series.slot(Slot::Node(id)),
                    series.slot(Slot::Partner(function, a)),
                );
                // v = 1 ± w², one order behind w
                let value = Self::call("integral", &[quote!(&#d), quote!(&#v)]);
                let square = Self::call("square", &[quote!(&#w)]);
                let one = quote!(#scalar::from_f64(1.0));
                let partner =
                    Self::call("plus", &[minus(function == Function::Tanh, &square), one]);
                self.block.push(quote! {
                    #w[at] = if at == 0 { #start } else { #value };
                    #v[at] = #partner;
                });
                return quote!(#w[at]);
            }
            Function::Ln => {
                let v = series.slot(Slot::Node(a));
                return self.primitive(id, a, &v, start, false);
            }
            Function::Atan => {
                let (u, v) = (
                    series.slot(Slot::Node(a)),
                    series.slot(Slot::Partner(function, a)),
                );
                let square = Self::call("square", &[quote!(&#u)]);
                let value = Self::call("plus", &[square, quote!(#scalar::from_f64(1.0))]);
                self.block.push(quote!(#v[at] = #value;));
                return self.primitive(id, a, &v, start, false);
            }
            Function::Asin | Function::Acos => {
                let (u, v) = (
                    series.slot(Slot::Node(a)),
                    series.slot(Slot::Partner(function, a)),
                );
                // v = √(1 − u²)
                let square = Self::call("square", &[quote!(&#u)]);
                let one = quote!(#scalar::from_f64(1.0));
                let base = Self::call("plus", &[minus(true, &square), one]);
                self.block.push(quote!(let base = #base;));
                let inverse =
                    self.inverse(a, &quote!(#scalar::from_f64(2.0) * #scalar::sqrt(base)));
                let later = Self::call("square_root", &[quote!(base), quote!(&#v), inverse]);
                self.block.push(quote! {
                    #v[at] = if at == 0 { #scalar::sqrt(base) } else { #later };
                });
                return self.primitive(id, a, &v, start, function == Function::Acos);
            }
            _ => return quote!(compile_error!("a function without a series")),
        };
        quote!(if at == 0 { #start } else { #later })
    }

    /// sin and cos, sinh and cosh: each the integral of the other.
    fn pair(&mut self, function: Function, a: Id) -> TokenStream {
        let series = self.series;
        let (odd, even) = match function {
            Function::Sin | Function::Cos => (Function::Sin, Function::Cos),
            _ => (Function::Sinh, Function::Cosh),
        };
        let [s, c] = [odd, even].map(|one| series.slot(Slot::Partner(one, a)));
        let wanted = if function == odd { &s } else { &c };
        if !self.pairs.insert((odd, a)) {
            return quote!(#wanted[at]);
        }
        let scalar = series.scalar;
        let value = self.coefficient(a);
        let d = self.derivative(a);
        let [sine, cosine] = [odd, even].map(|one| {
            let method = format_ident!("{}", one.name());
            quote!(#scalar::#method(#value))
        });
        let next_sine = Self::call("integral", &[quote!(&#d), quote!(&#c)]);
        let next_cosine = Self::call("integral", &[quote!(&#d), quote!(&#s)]);
        let next_cosine = minus(odd == Function::Sin, &next_cosine);
        self.block.push(quote! {
            let (sine, cosine) = if at == 0 {
                (#sine, #cosine)
            } else {
                (#next_sine, #next_cosine)
            };
            #s[at] = sine;
            #c[at] = cosine;
        });
        quote!(#wanted[at])
    }

    /// w = ±∫ du/v
    fn primitive(
        &mut self,
        id: Id,
        a: Id,
        v: &TokenStream,
        start: TokenStream,
        is_negative: bool,
    ) -> TokenStream {
        let scalar = self.series.scalar;
        let e = self.series.slot(Slot::Slope(id));
        let inverse = self.inverse(id, &quote!(#v[0]));
        let value = self.coefficient(a);
        let derivative = Self::call("derivative", &[minus(is_negative, &value)]);
        let slope = Self::call("slope", &[derivative, quote!(&#v), quote!(&#e), inverse]);
        self.block.push(quote! {
            #e[at] = if at == 0 { #scalar::from_f64(0.0) } else { #slope };
        });
        let value = Self::call("antiderivative", &[quote!(#e[at])]);
        quote!(if at == 0 { #start } else { #value })
    }
}
