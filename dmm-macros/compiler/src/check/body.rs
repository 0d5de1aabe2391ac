//! The contents of a region: a complete vector field and conserved quantities.

use std::collections::BTreeSet;

use proc_macro2::Ident;

use super::names::Kind;
use super::{Resolver, Scope};
use crate::algebra::Id;
use crate::diagnostics::Extent;
use crate::model::Conserved;
use crate::syntax::{Definition, Derivative, Item};

/// A vector field and its conserved quantities while they are read.
pub(super) struct Body {
    /// By state: whether there is a `der`, and its formula if it is in order.
    pub(super) field: Vec<Option<Option<(Id, Extent)>>>,
    pub(super) conserved: Vec<Conserved>,
    seen: BTreeSet<String>,
}

impl Resolver<'_> {
    /// The `let`, `der` and `conserved` items of a block.
    pub(super) fn body(&mut self, items: &[&Item], region: Option<&Ident>) -> Body {
        let mut body = Body {
            field: vec![None; self.states.len()],
            conserved: Vec::new(),
            seen: BTreeSet::new(),
        };
        for item in items {
            if let Item::Let(definition) = item {
                self.names
                    .declare_in_region(&definition.ident, self.diagnostics);
            }
        }
        for item in items {
            match item {
                Item::Let(definition) => self.define(definition, Kind::Let, Scope::All),
                Item::Derivative(item) => self.derivative(item, region, &mut body),
                Item::Conserved(item) => self.conserved(item, region, &mut body),
                _ => {}
            }
        }
        body
    }

    fn derivative(&mut self, item: &Derivative, region: Option<&Ident>, body: &mut Body) {
        let formula = self.formula(&item.formula, Scope::All);
        let entry = formula.map(|formula| (formula.id, item.formula.extent));
        let Some(index) = self.state_index(&item.state) else {
            if let Some(meant) = self.not_a_state(&item.state)
                && let Some(slot) = body.field.get_mut(meant)
            {
                slot.get_or_insert(None);
            }
            return;
        };
        match body.field.get_mut(index) {
            Some(Some(_)) => {
                let message = format!("`der({})` is given twice{}", item.state, within(region));
                self.error(&item.state, message);
            }
            Some(slot) => *slot = Some(entry),
            None => {}
        }
    }

    /// Reports that `ident` is no state; the index of the state that was probably meant.
    fn not_a_state(&mut self, ident: &Ident) -> Option<usize> {
        let text = ident.to_string();
        if let Some(kind) = self.names.get(&text).map(|symbol| symbol.kind) {
            if kind != Kind::State && !self.names.is_refused(&text) {
                self.names.mark_used(&text);
                self.error(
                    ident,
                    format!("`{text}` is a {kind}; only states have a `der`"),
                );
            }
            return None;
        }
        if self.names.is_refused(&text) {
            return None;
        }
        let closest = self.names.closest(&text, &[Kind::State]);
        let message = match &closest {
            Some(state) => format!("there is no state `{text}`; did you mean `{state}`?"),
            None if text == "t" => "`t` is the time, which needs no `der`".into(),
            None => format!("there is no state `{text}`: declare `state {text};`"),
        };
        self.error(ident, message);
        closest.and_then(|state| self.states.iter().position(|known| known.ident == state))
    }

    fn conserved(&mut self, item: &Definition, region: Option<&Ident>, body: &mut Body) {
        let formula = self.formula(&item.formula, Scope::All);
        if !body.seen.insert(item.ident.to_string()) {
            let message = format!(
                "the conserved quantity `{}` is declared twice{}",
                item.ident,
                within(region)
            );
            self.error(&item.ident, message);
        } else if let Some(formula) = formula {
            body.conserved.push(Conserved {
                attributes: item.attributes.clone(),
                ident: item.ident.clone(),
                psi: formula.id,
                span: item.formula.extent,
            });
        }
    }

    /// The vector field, if every state has its `der`.
    pub(super) fn complete(
        &mut self,
        field: Vec<Option<Option<(Id, Extent)>>>,
        place: &Ident,
        region: Option<&Ident>,
    ) -> Option<(Vec<Id>, Vec<Extent>)> {
        let missing: Vec<String> = self
            .states
            .iter()
            .zip(&field)
            .filter(|(_, component)| component.is_none())
            .map(|(state, _)| format!("`der({})`", state.ident))
            .collect();
        if !missing.is_empty() {
            let message = match region {
                Some(region) => format!("the region `{region}` has no {}", missing.join(", ")),
                None => format!("the system has no {}", missing.join(", ")),
            };
            self.error(place, message);
        }
        let components: Vec<(Id, Extent)> = field
            .into_iter()
            .map(Option::flatten)
            .collect::<Option<_>>()?;
        Some(components.into_iter().unzip())
    }
}

fn within(region: Option<&Ident>) -> String {
    region.map_or(String::new(), |region| format!(" in the region `{region}`"))
}
