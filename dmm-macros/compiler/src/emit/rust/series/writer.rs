//! The statements of one order, node by node, and the results.

use std::collections::BTreeMap;
use std::ops::Range;

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::{format_ident, quote};

use super::States;
use crate::algebra::{Id, Math};
use crate::emit::rust::code::Block;
use crate::emit::rust::function::Scope;
use crate::emit::rust::paths;
use crate::program::series::{
    Coefficient, Factor, Later, Place, Scaled, Series, Sum, Tables, multiple,
};

/// Writes the coefficient of one node after the other.
pub(super) struct Writer<'a, 'b> {
    pub(super) scope: &'b Scope<'a>,
    pub(super) block: Block<'b>,
    pub(super) tables: &'b Tables,
    states: States,
    /// By power, the multiple in whose place it is.
    pub(super) multiples: &'b BTreeMap<Id, Id>,
    /// How many operations follow on each other until the coefficients of nodes are known.
    depths: BTreeMap<Id, usize>,
    /// The coefficients of order k that are known.
    newest: BTreeMap<Place, TokenStream>,
    /// The names of the halves of squares.
    halves: BTreeMap<Id, Ident>,
    /// The sums that are known.
    pub(super) sums: BTreeMap<Sum, TokenStream>,
    /// The names of all sums of both kinds.
    pub(super) names_of_sums: [Option<Ident>; 2],
    /// The names of vectors, by their elements.
    pub(super) vectors: BTreeMap<Vec<String>, Ident>,
}

impl<'a, 'b> Writer<'a, 'b> {
    /// One that writes into `block`.
    pub(super) fn new(
        scope: &'b Scope<'a>,
        states: States,
        series: &'b Series,
        block: Block<'b>,
    ) -> Self {
        let depths = series.coefficients.iter().map(|one| (one.node, one.depth));
        Self {
            scope,
            block,
            tables: &series.tables,
            states,
            multiples: &series.multiples,
            depths: depths.collect(),
            newest: BTreeMap::new(),
            halves: BTreeMap::new(),
            sums: BTreeMap::new(),
            names_of_sums: [None, None],
            vectors: BTreeMap::new(),
        }
    }

    pub(super) fn call(name: &str, arguments: &[TokenStream]) -> TokenStream {
        let name = format_ident!("{name}");
        quote!(dmm::series::#name(k, #(#arguments),*))
    }

    /// The array of the coefficients of a series that has one.
    pub(super) fn array(&self, place: Place) -> TokenStream {
        match place {
            Place::State(state) => self.states.array(state),
            Place::Slot(slot) => match self.tables.array(place) {
                Some(array) => {
                    let array = paths::count(array);
                    quote!(series[#array])
                }
                None => {
                    let message = format!("no array of series {slot}");
                    quote!(compile_error!(#message))
                }
            },
        }
    }

    /// A coefficient below order k.
    pub(super) fn earlier(&self, place: Place, order: &TokenStream) -> TokenStream {
        match self.tables.lane(place) {
            Some(lane) => {
                let table = arrays(&lane.table);
                let [lanes, number] = [lane.table.len(), lane.number].map(paths::count);
                quote!(dmm::series::row::<_, _, #lanes>(&#table, #order)[#number])
            }
            None => {
                let array = self.array(place);
                quote!(#array[#order])
            }
        }
    }

    /// The first coefficient of a series, where k is not zero.
    pub(super) fn first(&self, place: Place) -> TokenStream {
        self.earlier(place, &quote!(0))
    }

    /// The coefficient of order k of a series.
    pub(super) fn newest(&self, place: Place) -> TokenStream {
        match self.newest.get(&place) {
            Some(value) => value.clone(),
            None => self.earlier(place, &quote!(at)),
        }
    }

    /// Sets the coefficient of order k of a slot.
    pub(super) fn set(&mut self, place: Place, value: &TokenStream) {
        let mut value = value.clone();
        if self.tables.array(place).is_some() {
            let array = self.array(place);
            self.block.push(quote!(#array[at] = #value;));
            value = quote!(#array[at]);
        } else if !is_place(&value) {
            let name = self.block.unused_name("c");
            self.block.push(quote!(let #name = #value;));
            value = quote!(#name);
        }
        self.newest.insert(place, value);
    }

    /// The coefficient of a node, a constant's too.
    pub(super) fn value(&mut self, id: Id) -> TokenStream {
        let value = self.fixed(id);
        if self.scope.lowered.is_fixed(id) {
            Self::call("constant", &[value])
        } else {
            value
        }
    }

    /// The value of something that is constant in time.
    pub(super) fn fixed(&mut self, id: Id) -> TokenStream {
        self.block.require(id);
        self.block.value(id)
    }

    /// Coefficient k of a node, kept in its slot if it has one.
    pub(super) fn coefficient(&mut self, coefficient: &Coefficient) {
        let id = coefficient.node;
        if let Some(value) = self.recurrence(id, &coefficient.recurrence) {
            self.block.define(id, &value);
        }
        if let Some(slot) = coefficient.kept {
            self.block.name_value(id);
            let value = self.block.value(id);
            self.set(Place::Slot(slot), &value);
        }
    }

    /// Gives what is scaled more than once a name.
    pub(super) fn name(&mut self, scaled: &Scaled) {
        match scaled {
            Scaled::Node(id) => self.block.name_value(*id),
            Scaled::Multiple(_, of) | Scaled::Shifted { moving: of, .. } => self.name(of),
            Scaled::Constant(_) | Scaled::Square { .. } => {}
        }
    }

    /// The coefficient of a node times `scale`.
    pub(super) fn scaled(&mut self, scaled: &Scaled, scale: TokenStream) -> TokenStream {
        match scaled {
            Scaled::Constant(id) => {
                let value = self.fixed(*id);
                Self::call("constant", &[product(&value, &scale)])
            }
            Scaled::Node(id) => match self.terms(*id) {
                Some(terms) => self.scaled_sum(terms, &scale),
                None => {
                    let (id, scale) = self.multiple(*id, scale);
                    let value = self.value(id);
                    product(&value, &scale)
                }
            },
            Scaled::Multiple(factor, of) => {
                let scale = self.multiplied(*factor, &scale);
                self.scaled(of, scale)
            }
            Scaled::Shifted {
                is_negative,
                moving,
                fixed: (is_subtracted, fixed),
            } => {
                let c = self.fixed(*fixed);
                let u = self.scaled(moving, minus(*is_negative, &scale));
                let c = minus(*is_subtracted, &product(&c, &scale));
                Self::call("plus", &[u, c])
            }
            Scaled::Square { node, of } => {
                let (half, scalar) = (self.half(*node, *of), self.scope.scalar);
                let scale = product(&quote!(#scalar::from_f64(2.0)), &scale);
                product(&quote!(#half), &scale)
            }
        }
    }

    /// The terms of a sum that has no value yet, and whether they are subtracted.
    fn terms(&self, id: Id) -> Option<[(bool, Id); 2]> {
        match self.scope.lowered.dag()[id] {
            _ if self.block.has_value(id) => None,
            Math::Add([a, b]) => Some([(false, a), (false, b)]),
            Math::Sub([a, b]) => Some([(false, a), (true, b)]),
            _ => None,
        }
    }

    /// A sum times a scale: the term that is known last enters by one operation.
    fn scaled_sum(&mut self, terms: [(bool, Id); 2], scale: &TokenStream) -> TokenStream {
        let scalar = self.scope.scalar;
        let mut terms = terms.map(|(is_negative, id)| self.multiple(id, minus(is_negative, scale)));
        terms.sort_by_key(|(id, _)| self.depths.get(id).copied());
        let [(first, scale), (last, factor)] = terms;
        let first = product(&self.value(first), &scale);
        let last = self.value(last);
        quote!(#scalar::fused(#factor, #last, #first))
    }

    /// The node that a node times a scale is a multiple of, and the factor, which nothing of order k is
    /// needed for.
    pub(super) fn multiple(&mut self, mut id: Id, mut scale: TokenStream) -> (Id, TokenStream) {
        let mut factors = Vec::new();
        while let Some((of, factor)) = multiple(self.scope.lowered, id) {
            match factor {
                Factor::Minus => scale = minus(true, &scale),
                Factor::Node(c) => factors.push(self.fixed(c)),
            }
            id = of;
        }
        let factors = factors.into_iter().reduce(|all, one| product(&all, &one));
        let scale = match factors {
            Some(factors) => product(&factors, &scale),
            None => scale,
        };
        (id, scale)
    }

    /// Half of the square `node` of the series at `of`, under a name.
    fn half(&mut self, node: Id, of: Place) -> Ident {
        if let Some(half) = self.halves.get(&node) {
            return half.clone();
        }
        let value = self.half_sum_of("half_square", of);
        let half = self.block.unused_name("half");
        self.block.push(quote!(let #half = #value;));
        self.halves.insert(node, half.clone());
        half
    }

    /// A scale with one more factor.
    fn multiplied(&mut self, factor: Factor, scale: &TokenStream) -> TokenStream {
        match factor {
            Factor::Minus => minus(true, scale),
            Factor::Node(c) => {
                let c = self.fixed(c);
                product(&c, scale)
            }
        }
    }

    /// The scale of coefficient k + 2 of a state.
    pub(super) fn scale_of_later(&mut self, later: &Later, scale: &TokenStream) -> TokenStream {
        let scalar = self.scope.scalar;
        let scale = product(scale, &quote!(dmm::series::next_step::<#scalar, _>(k)));
        match later.factor {
            Some(factor) => self.multiplied(factor, &scale),
            None => scale,
        }
    }
}

/// Whether it is a name, or an element of what has one.
fn is_place(tokens: &TokenStream) -> bool {
    tokens.clone().into_iter().all(|tree| match tree {
        TokenTree::Ident(ident) => ident != "if",
        TokenTree::Punct(sign) => sign.as_char() == '.',
        TokenTree::Literal(_) | TokenTree::Group(_) => true,
    })
}

/// The arrays of a table.
pub(super) fn arrays(table: &Range<usize>) -> TokenStream {
    let [from, to] = [table.start, table.end].map(paths::count);
    quote!(series[#from..#to])
}

/// In parentheses if it is no single factor.
pub(super) fn factor(tokens: &TokenStream) -> TokenStream {
    let is_operator = |tree: TokenTree| match tree {
        TokenTree::Punct(sign) => matches!(sign.as_char(), '+' | '-' | '*' | '/'),
        TokenTree::Ident(ident) => ident == "if",
        _ => false,
    };
    if tokens.clone().into_iter().any(is_operator) {
        quote!((#tokens))
    } else {
        tokens.clone()
    }
}

/// a·b, computed in this order.
pub(super) fn product(a: &TokenStream, b: &TokenStream) -> TokenStream {
    let (a, b) = (factor(a), factor(b));
    quote!(#a * #b)
}

/// ±u
pub(super) fn minus(negative: bool, u: &TokenStream) -> TokenStream {
    if !negative {
        return u.clone();
    }
    let u = factor(u);
    quote!(-#u)
}
