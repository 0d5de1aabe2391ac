//! The sums over the coefficients of lower order, in the lanes of tables: none of them waits for another,
//! and what a loop takes beside its products it takes once. What a recurrence takes beside its sum are
//! the first coefficients and those of order k.

use std::ops::Range;

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::writer::{Writer, arrays};
use crate::emit::rust::paths;
use crate::program::series::{Place, Sum};

/// The function of a quotient whose numerator is known last or not.
pub(super) fn quotient_from(is_late: bool) -> &'static str {
    if is_late {
        "late_quotient_from"
    } else {
        "quotient_from"
    }
}

impl Writer<'_, '_> {
    /// Computes the sums that the recurrences take.
    pub(super) fn sums(&mut self) {
        let tables = self.tables;
        let [first, second, half] = tables.ranges();
        let inner = tables.inner.iter().map(|&of| Sum::Inner(of));
        let range = first.start..second.end;
        self.sums_of(0, "inner_sums", range, first.len(), inner);
        let halves = tables.half.iter().map(|&of| Sum::Half(of));
        self.sums_of(1, "half_sums", half.clone(), half.len(), halves);
    }

    /// Sums of one kind, from the tables at `range`.
    fn sums_of(
        &mut self,
        kind: usize,
        name: &str,
        range: Range<usize>,
        lanes: usize,
        sums: impl Iterator<Item = Sum>,
    ) {
        if lanes == 0 {
            return;
        }
        let names = self.block.unused_name("sums");
        let (scalar, function) = (self.scope.scalar, format_ident!("{name}"));
        let (table, lanes) = (arrays(&range), paths::count(lanes));
        self.block.push(quote! {
            let #names: [#scalar; #lanes] = dmm::series::#function(k, &#table);
        });
        // those of packs are taken by lanes
        let single = sums.enumerate().skip(self.tables.first_single[kind]);
        self.sums.extend(single.map(|(lane, sum)| {
            let lane = paths::count(lane);
            (sum, quote!(#names[#lane]))
        }));
        self.names_of_sums[kind] = Some(names);
    }

    /// The first and the newest coefficient of a series.
    fn ends(&self, place: Place) -> TokenStream {
        let (first, newest) = (self.first(place), self.newest(place));
        quote!([#first, #newest])
    }

    /// Coefficient k of uv.
    pub(super) fn product(&self, of: [Place; 2]) -> TokenStream {
        match self.sums.get(&Sum::Inner(of)) {
            Some(sum) => {
                let [u, v] = of.map(|place| self.ends(place));
                Self::call("product_from", &[u, v, sum.clone()])
            }
            None => {
                let [u, v] = of.map(|place| self.array(place));
                Self::call("product", &[quote!(&#u), quote!(&#v)])
            }
        }
    }

    /// Coefficient k of u² or u²/2, by the function of this name.
    pub(super) fn half_sum_of(&self, name: &str, of: Place) -> TokenStream {
        match self.sums.get(&Sum::Half(of)) {
            Some(sum) => {
                let (ends, middle) = (self.ends(of), self.earlier(of, &quote!(at / 2)));
                Self::call(&format!("{name}_from"), &[ends, middle, sum.clone()])
            }
            None => {
                let u = self.array(of);
                Self::call(name, &[quote!(&#u)])
            }
        }
    }

    /// Coefficient k of w = u/v from uₖ, which may be known last.
    pub(super) fn quotient(
        &self,
        (numerator, is_late): (TokenStream, bool),
        [denominator, own]: [Place; 2],
        inverse: TokenStream,
    ) -> TokenStream {
        match self.sums.get(&Sum::Inner([denominator, own])) {
            Some(sum) => {
                let (v, w) = (self.newest(denominator), self.first(own));
                let arguments = [numerator, v, w, inverse, sum.clone()];
                Self::call(quotient_from(is_late), &arguments)
            }
            None => {
                let [v, w] = [denominator, own].map(|place| self.array(place));
                Self::call("quotient", &[numerator, quote!(&#v), quote!(&#w), inverse])
            }
        }
    }

    /// Coefficient k ≥ 1 of w = √u from uₖ.
    pub(super) fn root(&self, value: TokenStream, own: Place, inverse: TokenStream) -> TokenStream {
        match self.sums.get(&Sum::Half(own)) {
            Some(sum) => {
                let middle = self.earlier(own, &quote!(at / 2));
                Self::call("square_root_from", &[value, middle, inverse, sum.clone()])
            }
            None => {
                let w = self.array(own);
                Self::call("square_root", &[value, quote!(&#w), inverse])
            }
        }
    }

    /// Coefficient k ≥ 1 of ∫ v du from uₖ and h du/dh.
    pub(super) fn integral(&self, u: &TokenStream, derivative: Place, of: Place) -> TokenStream {
        match self.sums.get(&Sum::Inner([derivative, of])) {
            Some(sum) => {
                let v = self.first(of);
                Self::call("integral_from", &[u.clone(), v, sum.clone()])
            }
            None => {
                let [d, v] = [derivative, of].map(|place| self.array(place));
                Self::call("integral", &[u.clone(), quote!(&#d), quote!(&#v)])
            }
        }
    }
}
