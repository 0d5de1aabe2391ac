//! Vectors of coefficients: their names, and the rows of tables that hold them.

use std::array;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::writer::Writer;
use crate::algebra::Id;
use crate::emit::rust::paths;
use crate::program::series::{LANES, Place};

/// What each lane has.
pub(super) type Lanes<T> = [T; LANES];

impl Writer<'_, '_> {
    /// Gives a vector a name; its elements, as many as there are.
    pub(super) fn elements(&mut self, value: &TokenStream, count: usize) -> Vec<TokenStream> {
        let text = value.to_string();
        let known = self.vectors.values().find(|name| **name == text).cloned();
        let name = known.unwrap_or_else(|| {
            let name = self.block.unused_name("four");
            self.block.push(quote!(let #name = #value;));
            name
        });
        let elements: Vec<TokenStream> = (0..count)
            .map(|lane| {
                let lane = paths::count(lane);
                quote!(#name.0[#lane])
            })
            .collect();
        let lanes: Lanes<String> = array::from_fn(|lane| elements[lane % count].to_string());
        self.vectors.insert(lanes, name);
        elements
    }

    /// The vector of some values: one that has a name, if it has these, else what `new` makes.
    fn four_by(
        &self,
        values: &Lanes<TokenStream>,
        new: impl FnOnce(&Lanes<String>) -> TokenStream,
    ) -> TokenStream {
        let texts = values.each_ref().map(TokenStream::to_string);
        match self.vectors.get(&texts) {
            Some(name) => quote!(#name),
            None => new(&texts),
        }
    }

    /// The vector of some values.
    pub(super) fn four(&self, values: Lanes<TokenStream>) -> TokenStream {
        self.four_by(&values, |[first, rest @ ..]| {
            if rest.iter().all(|other| other == first) {
                let [value, ..] = &values;
                quote!(dmm::series::Four::all(#value))
            } else {
                quote!(dmm::series::Four([#(#values),*]))
            }
        })
    }

    pub(super) fn values(&mut self, ids: Lanes<Id>) -> TokenStream {
        let values = ids.map(|id| self.value(id));
        self.four(values)
    }

    pub(super) fn fixed_values(&mut self, ids: Lanes<Id>) -> TokenStream {
        let values = ids.map(|id| self.fixed(id));
        self.four(values)
    }

    /// The coefficients of order k of series.
    pub(super) fn newest_of(&self, places: Lanes<Place>) -> TokenStream {
        self.four(places.map(|place| self.newest(place)))
    }

    /// A sum of each, from a lane on.
    pub(super) fn sums_from(&self, names: Option<&Ident>, lane: usize) -> TokenStream {
        let lane = paths::count(lane);
        quote!(dmm::series::Four::of_lanes(&#names, #lane))
    }

    pub(super) fn inner_sums_from(&self, lane: usize) -> TokenStream {
        self.sums_from(self.names_of_sums[0].as_ref(), lane)
    }

    pub(super) fn half_sums_from(&self, lane: usize) -> TokenStream {
        self.sums_from(self.names_of_sums[1].as_ref(), lane)
    }

    /// The coefficients of an order in a table, of this number.
    pub(super) fn row_from(&self, table: usize, lane: usize, order: &TokenStream) -> TokenStream {
        let range = &self.tables.ranges()[table];
        let [from, to, lanes, lane] = [range.start, range.end, range.len(), lane].map(paths::count);
        quote!(dmm::series::four::<_, _, #lanes>(&series[#from..#to], #order, #lane))
    }

    /// The coefficients of order k of series, as one vector.
    fn row_of(&self, places: Lanes<Place>) -> TokenStream {
        let values = places.map(|place| self.newest(place));
        self.four_by(
            &values,
            |_| quote!(dmm::series::Four::joined([#(#values),*])),
        )
    }

    /// Keeps the coefficients of order k in the tables.
    pub(super) fn keep_rows(&mut self) {
        let tables = self.tables;
        for (column, range) in tables.columns().iter().zip(tables.ranges()) {
            let [from, to] = [range.start, range.end].map(paths::count);
            for (number, places) in column.chunks(LANES).enumerate() {
                let places = array::from_fn(|lane| places[lane % places.len()]);
                let (row, lane) = (self.row_of(places), paths::count(LANES * number));
                self.block.push(quote! {
                    let row = #row;
                    dmm::series::set_four(k, &mut series[#from..#to], #lane, row);
                });
            }
        }
    }
}
