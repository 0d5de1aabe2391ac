//! The sums over the coefficients of lower order, several in one loop: none of them waits for another,
//! and what a loop takes beside its products it takes once.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::writer::Writer;
use crate::program::Series;
use crate::program::series::{Place, Sum};

/// As many sums in a loop stay in the registers of a processor.
const MOST_TOGETHER: usize = 4;

impl Writer<'_, '_> {
    /// Computes the sums that the recurrences take.
    pub(super) fn joint_sums(&mut self, series: &Series) {
        let (mut inner, mut half) = (Vec::new(), Vec::new());
        let sums = series.joint_sums();
        for sum in &sums {
            match *sum {
                Sum::Inner([u, v]) => {
                    let (u, v) = (self.array(u), self.array(v));
                    inner.push((*sum, quote!([#u, #v])));
                }
                Sum::Half(u) => half.push((*sum, self.array(u))),
            }
        }
        self.joined("inner_sums", &inner);
        self.joined("half_sums", &half);
    }

    /// Sums of one kind.
    fn joined(&mut self, name: &str, sums: &[(Sum, TokenStream)]) {
        let groups = sums.len().div_ceil(MOST_TOGETHER).max(1);
        for group in sums.chunks(sums.len().div_ceil(groups).max(1)) {
            let of = group.iter().map(|(_, of)| of);
            let value = Self::call(name, &[quote!([#(#of),*])]);
            let names: Vec<Ident> = group.iter().map(|_| self.block.fresh("sum")).collect();
            self.block.push(quote!(let [#(#names),*] = #value;));
            self.sums
                .extend(group.iter().map(|(sum, _)| *sum).zip(names));
        }
    }

    /// A recurrence that takes a sum: from it where it is known.
    pub(super) fn with_sum(&self, name: &str, arguments: &[TokenStream], sum: Sum) -> TokenStream {
        match self.sums.get(&sum) {
            Some(sum) => {
                let arguments = [arguments, &[quote!(#sum)]].concat();
                Self::call(&format!("{name}_from"), &arguments)
            }
            None => Self::call(name, arguments),
        }
    }

    /// Coefficient k ≥ 1 of ∫ v du from d = h du/dh.
    pub(super) fn integral(&self, derivative: Place, of: Place) -> TokenStream {
        let arguments = [self.array(derivative), self.array(of)];
        self.with_sum("integral", &arguments, Sum::Inner([derivative, of]))
    }
}
