//! The coefficients of two products or squares that are alike, side by side, and of powers: straight-line
//! code by tables of two lanes.

use proc_macro2::TokenStream;
use quote::quote;

use super::writer::{Writer, arrays};
use crate::program::series::{Coefficient, PAIR, Place, Recurrence};

impl Writer<'_, '_> {
    /// The coefficients of order k of a pair.
    pub(super) fn of_pair(&mut self, pair: [&Coefficient; PAIR]) -> Option<TokenStream> {
        let [first, second] = pair.map(|one| one.recurrence.factors());
        let factors = first.into_iter().zip(second);
        let factors: Vec<TokenStream> = factors
            .map(|(a, b)| self.factor_of_pair([a, b]))
            .collect::<Option<_>>()?;
        let name = match pair[0].recurrence {
            Recurrence::Square(_) => "squares",
            _ => "products",
        };
        Some(Self::call(name, &factors))
    }

    /// The coefficients below order k of two series, and those of order k.
    fn factor_of_pair(&self, of: [Place; PAIR]) -> Option<TokenStream> {
        let newest = self.newest_of(of);
        let below = if of[0] == of[1] {
            let array = self.array(of[0]);
            quote!(dmm::series::Common(&#array))
        } else {
            let rows = self.rows(of)?;
            quote!(dmm::series::Rows(#rows))
        };
        Some(quote!((#below, #newest)))
    }

    /// The table of a pair.
    fn rows(&self, of: [Place; PAIR]) -> Option<TokenStream> {
        let (_, range) = self.tables.pairs().find(|(pair, _)| *pair == of)?;
        let table = arrays(&range);
        Some(quote!(&#table))
    }

    /// Coefficient k ≥ 1 of w = u^c by a table of w and h dw/dh, if there is one.
    pub(super) fn power_by_pairs(
        &self,
        [base, own, derivative]: [Place; 3],
        exponent: &TokenStream,
        inverse: &TokenStream,
    ) -> Option<TokenStream> {
        let (rows, u) = (self.rows([own, derivative])?, self.array(base));
        let arguments = [quote!(&#u), exponent.clone(), rows, inverse.clone()];
        Some(Self::call("power_by_pairs", &arguments))
    }

    /// Coefficients k ≥ 1 of ∫ v du for two v, from uₖ and h du/dh, if they have a table.
    pub(super) fn both_integrals(
        &mut self,
        u: &TokenStream,
        derivative: Place,
        of: [Place; PAIR],
    ) -> Option<[TokenStream; PAIR]> {
        let (rows, d) = (self.rows(of)?, self.array(derivative));
        let value = Self::call("integrals", &[u.clone(), quote!(&#d), rows]);
        self.elements(&value, PAIR).try_into().ok()
    }
}
