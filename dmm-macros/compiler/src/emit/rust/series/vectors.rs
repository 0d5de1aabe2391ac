//! Vectors of coefficients: their names, and the rows of tables that hold them.

use std::array;
use std::ops::Range;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::writer::{Writer, arrays};
use crate::algebra::Id;
use crate::emit::rust::paths;
use crate::program::series::{LANES, PAIR, Place};

/// What each lane has.
pub(super) type Lanes<T> = [T; LANES];

impl Writer<'_, '_> {
    /// Gives a vector a name; its elements, as many as there are.
    pub(super) fn elements(&mut self, value: &TokenStream, count: usize) -> Vec<TokenStream> {
        let text = value.to_string();
        let known = self.vectors.values().find(|name| **name == text).cloned();
        let name = known.unwrap_or_else(|| {
            let name = self
                .block
                .unused_name(if count == PAIR { "two" } else { "four" });
            self.block.push(quote!(let #name = #value;));
            name
        });
        let elements: Vec<TokenStream> = (0..count)
            .map(|lane| {
                let lane = paths::count(lane);
                quote!(#name.0[#lane])
            })
            .collect();
        let width = if count == PAIR { PAIR } else { LANES };
        let lanes = elements.iter().cycle().take(width);
        self.vectors
            .insert(lanes.map(ToString::to_string).collect(), name);
        elements
    }

    /// The vector of some values: one that has a name, if it has these, else what `new` makes.
    fn vector_by<const L: usize>(
        &self,
        values: &[TokenStream; L],
        new: impl FnOnce(&[String]) -> TokenStream,
    ) -> TokenStream {
        let texts: Vec<String> = values.iter().map(TokenStream::to_string).collect();
        match self.vectors.get(&texts) {
            Some(name) => quote!(#name),
            None => new(&texts),
        }
    }

    /// The vector of some values.
    pub(super) fn vector<const L: usize>(&self, values: [TokenStream; L]) -> TokenStream {
        self.vector_by(&values, |texts| {
            if texts.iter().all(|text| *text == texts[0]) {
                let value = &values[0];
                quote!(dmm::series::Pack::all(#value))
            } else {
                quote!(dmm::series::Pack([#(#values),*]))
            }
        })
    }

    pub(super) fn values<const L: usize>(&mut self, ids: [Id; L]) -> TokenStream {
        let values = ids.map(|id| self.value(id));
        self.vector(values)
    }

    pub(super) fn fixed_values<const L: usize>(&mut self, ids: [Id; L]) -> TokenStream {
        let values = ids.map(|id| self.fixed(id));
        self.vector(values)
    }

    /// The coefficients of order k of series.
    pub(super) fn newest_of<const L: usize>(&self, places: [Place; L]) -> TokenStream {
        self.vector(places.map(|place| self.newest(place)))
    }

    /// A sum of each, from a lane on.
    pub(super) fn sums_from(&self, names: Option<&Ident>, lane: usize) -> TokenStream {
        let [lane, width] = [lane, LANES].map(paths::count);
        quote!(dmm::series::Pack::<_, #width>::of_lanes(&#names, #lane))
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
        let [lane, width, lanes] = [lane, LANES, range.len()].map(paths::count);
        let table = arrays(range);
        quote!(dmm::series::pack::<_, _, #lanes, #width>(&#table, #order, #lane))
    }

    /// The coefficients of order k of series, as one vector.
    fn row_of<const L: usize>(&self, places: [Place; L]) -> TokenStream {
        let values = places.map(|place| self.newest(place));
        self.vector_by(
            &values,
            |_| quote!(dmm::series::Pack::joined([#(#values),*])),
        )
    }

    /// Keeps the coefficients of order k in the tables.
    pub(super) fn keep_rows(&mut self) {
        let tables = self.tables;
        for (column, range) in tables.shared() {
            for (number, places) in column.chunks(LANES).enumerate() {
                let lanes: Lanes<Place> = array::from_fn(|lane| places[lane % places.len()]);
                let row = self.row_of(lanes);
                self.keep(&range, LANES * number, &row);
            }
        }
        for (pair, range) in tables.pairs().filter(|(pair, _)| !is_of_states(pair)) {
            let row = self.row_of(pair);
            self.keep(&range, 0, &row);
        }
    }

    /// Keeps those of pairs of states, which are known first.
    pub(super) fn keep_states(&mut self) {
        for (pair, range) in self.tables.pairs().filter(|(pair, _)| is_of_states(pair)) {
            let row = self.newest_of(pair);
            let values = pair.map(|place| self.newest(place).to_string());
            let name = self.block.unused_name("two");
            self.block.push(quote!(let #name = #row;));
            self.vectors.insert(values.to_vec(), name.clone());
            self.keep(&range, 0, &quote!(#name));
        }
    }

    /// Keeps a vector in the lanes from `lane` on of the table at `range`.
    fn keep(&mut self, range: &Range<usize>, lane: usize, row: &TokenStream) {
        let (table, lane) = (arrays(range), paths::count(lane));
        self.block.push(quote! {
            let row = #row;
            dmm::series::set_pack(&mut #table, at, #lane, row);
        });
    }
}

/// Whether two series are those of states.
fn is_of_states(pair: &[Place; PAIR]) -> bool {
    pair.iter().all(|place| matches!(place, Place::State(_)))
}
