//! The recurrences of the Taylor coefficients: of a flow's solution, and of the switching
//! functions along it.
//!
//! Every node of the expressions is a power series in the time. What is linear in other nodes
//! is computed coefficient by coefficient like a number; the rest are recurrences of the
//! runtime's module `series` (Jorba & Zou, Experimental Mathematics 14, 2005). A node whose
//! lower coefficients a recurrence needs has a slot, an array of coefficients; the first slots
//! of a flow are the states.

mod recurrences;
mod writer;

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use self::writer::Writer;
use super::code::Block;
use super::lower::Lowered;
use super::names::Names;
use super::paths;
use super::readable::plain;
use super::store::Store;
use crate::algebra::{Function, Id, Math, Name};
use crate::model::Model;

/// Straight-line code up to so many recurrences a coefficient.
const MOST_STRAIGHT: usize = 24;

/// Where the coefficients of the states are.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum States {
    /// In the first slots, which the recurrences fill.
    Own,
    /// In the slice `states`.
    Given,
}

/// What a slot belongs to.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Slot {
    /// The node's own coefficients.
    Node(Id),
    /// h du/dh of the argument u of a function.
    Derivative(Id),
    /// h dw/dh of w = ∫ du/v.
    Slope(Id),
    /// v of w = ∫ v du or ∫ du/v: of a sine the cosine and the other way round. Of a power
    /// w = u^v those of ln u and of h d(v ln u)/dh.
    Partner(Function, Id),
    /// The reciprocal that a recurrence multiplies by, in the first place.
    Inverse(Id),
}

/// The recurrences of some roots.
pub(super) struct Series<'a> {
    lowered: &'a Lowered,
    store: &'a Store,
    scalar: &'a Ident,
    states: &'a [Name],
    place: States,
    roots: Vec<Id>,
    slots: BTreeMap<Slot, usize>,
    /// How many sums of products a coefficient takes.
    recurrences: usize,
}

impl<'a> Series<'a> {
    /// The recurrences of `roots`; `first` slots are in use already.
    pub(super) fn new(
        lowered: &'a Lowered,
        store: &'a Store,
        scalar: &'a Ident,
        states: &'a [Name],
        place: States,
        roots: &[Id],
        first: usize,
    ) -> Self {
        let mut series = Self {
            lowered,
            store,
            scalar,
            states,
            place,
            roots: roots.to_vec(),
            slots: BTreeMap::new(),
            recurrences: 0,
        };
        series.assign(first);
        series
    }

    /// Slots beyond the first ones.
    pub(super) fn slots(&self) -> usize {
        self.slots.len()
    }

    /// How the recurrences are run: the type of the runtime.
    pub(super) fn unrolled(&self) -> TokenStream {
        let kind = match self.recurrences {
            0..=MOST_STRAIGHT => format_ident!("Straight"),
            _ => format_ident!("Rolled"),
        };
        quote!(dmm::series::#kind)
    }

    /// The nodes under the roots that change with the time, children before parents.
    fn moving(&self) -> Vec<Id> {
        let nodes = self.lowered.dag().reachable(self.roots.iter().copied());
        let moving = nodes.into_iter().filter(|&id| !self.lowered.is_fixed(id));
        moving.collect::<BTreeSet<Id>>().into_iter().collect()
    }

    fn is_moving(&self, id: Id) -> bool {
        !self.lowered.is_fixed(id)
    }

    fn assign(&mut self, first: usize) {
        let mut slots = BTreeSet::new();
        for id in self.moving() {
            let node = &self.lowered.dag()[id];
            let needed = self.needed(id, node);
            self.recurrences += usize::from(!needed.is_empty());
            slots.extend(needed);
        }
        let is_state = |slot: &Slot| match slot {
            Slot::Node(id) => self.state(*id).is_some(),
            _ => false,
        };
        let others = slots.into_iter().filter(|slot| !is_state(slot));
        self.slots = others.zip(first..).collect();
    }

    /// The slots that the recurrence of a node needs.
    fn needed(&self, id: Id, node: &Math) -> Vec<Slot> {
        use Slot::{Derivative, Inverse, Node, Partner, Slope};
        match *node {
            Math::Mul([a, b]) if self.is_moving(a) && self.is_moving(b) => vec![Node(a), Node(b)],
            Math::Div([_, b]) if self.is_moving(b) => vec![Node(b), Node(id), Inverse(id)],
            Math::Pow([a, b]) if self.is_moving(a) && !self.is_moving(b) => {
                vec![Node(a), Node(id), Inverse(id)]
            }
            // u^v = e^(v ln u)
            Math::Pow([a, b]) if self.is_moving(b) => {
                let mut slots = vec![Node(id), Inverse(id), Partner(Function::Exp, id)];
                if self.is_moving(a) {
                    slots.extend([Node(a), Node(b), Slope(id), Partner(Function::Ln, id)]);
                }
                slots
            }
            Math::Call(function, a) => match function {
                Function::Sqrt => vec![Node(id), Inverse(id)],
                Function::Exp => vec![Node(id), Derivative(a)],
                Function::Ln => vec![Node(a), Slope(id), Inverse(id)],
                Function::Sin | Function::Cos => vec![
                    Derivative(a),
                    Partner(Function::Sin, a),
                    Partner(Function::Cos, a),
                ],
                Function::Sinh | Function::Cosh => vec![
                    Derivative(a),
                    Partner(Function::Sinh, a),
                    Partner(Function::Cosh, a),
                ],
                Function::Tan | Function::Tanh => {
                    vec![Node(id), Derivative(a), Partner(function, a)]
                }
                Function::Atan => {
                    vec![Node(a), Partner(function, a), Slope(id), Inverse(id)]
                }
                Function::Asin | Function::Acos => vec![
                    Node(a),
                    Partner(function, a),
                    Inverse(a),
                    Slope(id),
                    Inverse(id),
                ],
                _ => Vec::new(),
            },
            _ => Vec::new(),
        }
    }

    /// The index of a state.
    fn state(&self, id: Id) -> Option<usize> {
        match &self.lowered.dag()[id] {
            Math::Variable(name) => self.states.iter().position(|state| state == name),
            _ => None,
        }
    }

    /// A slot as a place.
    fn slot(&self, slot: Slot) -> TokenStream {
        if let Slot::Node(id) = slot
            && let Some(state) = self.state(id)
        {
            let state = paths::count(state);
            return match self.place {
                States::Own => quote!(series[#state]),
                States::Given => quote!(states[#state]),
            };
        }
        match self.slots.get(&slot) {
            Some(&index) => {
                let index = paths::count(index);
                quote!(series[#index])
            }
            None => quote!(compile_error!("a series without a slot")),
        }
    }

    /// The body of `advance`: coefficient k of every node, and what `finish` makes of the
    /// roots' values.
    ///
    /// With a `scale` the values are multiplied by it: together with the constant factors of
    /// the roots, so that it costs nothing. Then `finish` is also given, of every root that is a
    /// multiple of a state, ẋᵢ = c xⱼ, the coefficient of xᵢ that follows on the new one of xⱼ:
    /// from what that is made from, so that the chain of recurrences does not pass through xⱼ.
    pub(super) fn body(
        &self,
        scale: Option<&TokenStream>,
        finish: impl FnOnce(&[TokenStream], &[Option<TokenStream>]) -> TokenStream,
    ) -> TokenStream {
        let mut names = Names::reserving([
            "self", "k", "t", "at", "states", "series", "base", "sine", "cosine",
        ]);
        let mut known = self.store.known();
        let mut locals = TokenStream::new();
        let moving = self.moving();
        for &id in &moving {
            let Math::Variable(name) = &self.lowered.dag()[id] else {
                continue;
            };
            let local = names.take(&plain(name).to_lowercase());
            let value = match self.state(id) {
                Some(_) => {
                    let slot = self.slot(Slot::Node(id));
                    quote!(#slot[at])
                }
                None if *name == Model::time() => quote!(dmm::series::time(k, t)),
                None => quote!(compile_error!("a variable that is no state")),
            };
            locals.extend(quote!(let #local = #value;));
            known.insert(id, quote!(#local));
        }
        let scalar = self.scalar;
        let block = Block::new(self.lowered, quote!(#scalar), names, &known, &self.roots);
        let mut writer = Writer {
            series: self,
            block: block.fusing(),
            pairs: BTreeSet::new(),
            folded: BTreeSet::new(),
            halves: BTreeMap::new(),
        };
        if scale.is_some() {
            self.roots.iter().for_each(|&root| writer.fold(root));
        }
        for id in moving {
            writer.node(id);
        }
        let values: Vec<TokenStream> = (self.roots.iter())
            .map(|&root| match scale {
                Some(scale) => writer.scaled(root, scale.clone()),
                None => writer.coefficient(root),
            })
            .collect();
        let later: Vec<Option<TokenStream>> = match scale {
            Some(scale) => (self.roots.iter())
                .map(|&root| writer.a_step_later(root, scale))
                .collect(),
            None => Vec::new(),
        };
        let statements = writer.block.statements();
        let finish = finish(&values, &later);
        quote! {
            let at = k.get();
            #locals
            #statements
            #finish
        }
    }
}
