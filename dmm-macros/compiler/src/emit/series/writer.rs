//! The statements of one order: what is linear node by node, with the constant factors of a root
//! brought together.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::{format_ident, quote};

use super::{Series, Slot};
use crate::algebra::{Function, Id, Math};
use crate::emit::code::Block;

/// What a node is multiplied by.
#[derive(Clone, Copy)]
enum Factor {
    Minus,
    Node(Id),
}

/// Writes the coefficient of one node after the other.
pub(super) struct Writer<'a, 'b> {
    pub(super) series: &'b Series<'a>,
    pub(super) block: Block<'b>,
    /// The arguments whose sine and cosine there are already.
    pub(super) pairs: BTreeSet<(Function, Id)>,
    /// The nodes that exist only as factors of a root's scale.
    pub(super) folded: BTreeSet<Id>,
    /// The halves of the squares among them that there are already.
    pub(super) halves: BTreeMap<Id, Ident>,
}

impl Writer<'_, '_> {
    pub(super) fn call(name: &str, arguments: &[TokenStream]) -> TokenStream {
        let name = format_ident!("{name}");
        quote!(dmm::series::#name(k, #(#arguments),*))
    }

    /// The coefficient of a node, a constant's too.
    pub(super) fn coefficient(&mut self, id: Id) -> TokenStream {
        self.block.compute(&[id]);
        let value = self.block.value(id);
        match self.series.is_moving(id) {
            true => value,
            false => Self::call("constant", &[value]),
        }
    }

    /// The value of something that does not move.
    pub(super) fn fixed(&mut self, id: Id) -> TokenStream {
        self.block.compute(&[id]);
        self.block.value(id)
    }

    /// The operand and the factor of a node that is a multiple of another one.
    fn multiple(&self, id: Id) -> Option<(Id, Factor)> {
        let series = self.series;
        match series.lowered.dag()[id] {
            Math::Mul([c, u]) if !series.is_moving(c) && series.is_moving(u) => {
                Some((u, Factor::Node(c)))
            }
            Math::Mul([u, c]) if !series.is_moving(c) && series.is_moving(u) => {
                Some((u, Factor::Node(c)))
            }
            Math::Neg(u) if series.is_moving(u) => Some((u, Factor::Minus)),
            _ => None,
        }
    }

    /// The moving and the fixed term of a node, with their signs.
    fn shifted(&self, id: Id) -> Option<((bool, Id), (bool, Id))> {
        let series = self.series;
        let (a, b, minus) = match series.lowered.dag()[id] {
            Math::Add([a, b]) => (a, b, false),
            Math::Sub([a, b]) => (a, b, true),
            _ => return None,
        };
        match (series.is_moving(a), series.is_moving(b)) {
            (true, false) => Some(((false, a), (minus, b))),
            (false, true) => Some(((minus, b), (false, a))),
            _ => None,
        }
    }

    /// Marks what [`Writer::scaled`] takes apart.
    pub(super) fn fold(&mut self, id: Id) {
        let has_slot = self.series.slots.contains_key(&Slot::Node(id));
        if has_slot || self.block.is_shared(id) || !self.series.is_moving(id) {
            return;
        }
        let inner = match (self.multiple(id), self.shifted(id)) {
            (Some((u, _)), _) | (None, Some(((_, u), _))) => Some(u),
            _ => None,
        };
        let is_square = matches!(self.series.lowered.dag()[id], Math::Mul([a, b]) if a == b);
        if inner.is_some() || is_square {
            self.folded.insert(id);
        }
        if let Some(inner) = inner {
            self.fold(inner);
        }
    }

    /// The coefficient of a node times `scale`.
    pub(super) fn scaled(&mut self, id: Id, scale: TokenStream) -> TokenStream {
        let scalar = self.series.scalar;
        if !self.series.is_moving(id) {
            let value = self.fixed(id);
            return Self::call("constant", &[product(&value, &scale)]);
        }
        if !self.folded.contains(&id) {
            let value = self.coefficient(id);
            return Self::call("scaled", &[value, scale]);
        }
        if let Some((u, factor)) = self.multiple(id) {
            let scale = match factor {
                Factor::Minus => minus(true, &scale),
                Factor::Node(c) => {
                    let c = self.fixed(c);
                    product(&c, &scale)
                }
            };
            return self.scaled(u, scale);
        }
        if let Some(((minus_u, u), (minus_c, c))) = self.shifted(id) {
            let c = self.fixed(c);
            let u = self.scaled(u, minus(minus_u, &scale));
            let c = minus(minus_c, &product(&c, &scale));
            return Self::call("plus", &[u, c]);
        }
        let Math::Mul([a, _]) = self.series.lowered.dag()[id] else {
            return quote!(compile_error!("no square"));
        };
        let half = match self.halves.get(&id) {
            Some(half) => quote!(#half),
            None => {
                let slot = self.series.slot(Slot::Node(a));
                let value = Self::call("half_square", &[quote!(&#slot)]);
                let half = self.block.fresh("half");
                self.block.push(quote!(let #half = #value;));
                self.halves.insert(id, half.clone());
                quote!(#half)
            }
        };
        let scale = product(&quote!(#scalar::from_f64(2.0)), &scale);
        Self::call("scaled", &[half, scale])
    }

    /// Of a root ẋᵢ = c xⱼ the coefficient k + 2 of xᵢ, from the root of xⱼ.
    pub(super) fn a_step_later(&mut self, root: Id, scale: &TokenStream) -> Option<TokenStream> {
        let (state, factor) = match self.multiple(root) {
            Some((u, factor)) => (self.series.state(u)?, Some(factor)),
            None => (self.series.state(root)?, None),
        };
        let source = *self.series.roots.get(state)?;
        if !self.series.is_moving(source) {
            return None;
        }
        let scalar = self.series.scalar;
        let mut scale = product(scale, &quote!(dmm::series::next_step::<#scalar, K>(k)));
        match factor {
            Some(Factor::Minus) => scale = minus(true, &scale),
            Some(Factor::Node(c)) => {
                let c = self.fixed(c);
                scale = product(&c, &scale);
            }
            None => {}
        }
        Some(self.scaled(source, scale))
    }

    /// Coefficient k of a node, kept in its slot if it has one.
    pub(super) fn node(&mut self, id: Id) {
        if self.folded.contains(&id) {
            return;
        }
        if let Some(value) = self.recurrence(id) {
            self.block.define(id, &value);
        }
        let slot = Slot::Node(id);
        if self.series.slots.contains_key(&slot) {
            let place = self.series.slot(slot);
            self.block.name_value(id);
            let value = self.block.value(id);
            self.block.push(quote!(#place[at] = #value;));
        }
    }

    /// The coefficient of a node that is not linear in its operands; what is, [`Block`] writes.
    fn recurrence(&mut self, id: Id) -> Option<TokenStream> {
        let series = self.series;
        let moving = |id: Id| series.is_moving(id);
        let node = |id: Id| {
            let slot = series.slot(Slot::Node(id));
            quote!(&#slot)
        };
        let value = match series.lowered.dag()[id].clone() {
            Math::Add(_) | Math::Sub(_) => {
                let ((minus_u, u), (minus_c, c)) = self.shifted(id)?;
                let (u, c) = (self.coefficient(u), self.fixed(c));
                Self::call("plus", &[minus(minus_u, &u), minus(minus_c, &c)])
            }
            Math::Mul([a, b]) if a == b => Self::call("square", &[node(a)]),
            Math::Mul([a, b]) if moving(a) && moving(b) => {
                Self::call("product", &[node(a), node(b)])
            }
            Math::Div([a, b]) if moving(b) => self.quotient(id, a, b),
            Math::Pow([a, b]) if !moving(b) => self.power(id, a, b),
            Math::Pow([a, b]) => self.variable_power(id, a, b),
            Math::Call(function, a) => self.function(id, function, a),
            Math::Pair(..) | Math::Pi | Math::Constant(_) => {
                quote!(compile_error!("an operation without a series"))
            }
            _ => return None,
        };
        Some(value)
    }
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
