//! The states that `der(…)` and canonical pairs name.

use proc_macro2::Ident;

use super::Resolver;
use super::body::Body;
use super::groups::Integer;
use super::names::Kind;
use crate::diagnostics::catalogue::check as codes;
use crate::syntax::Target;

/// The states that a [`Target`] names.
pub(super) struct Found {
    /// Their indices; if something is wrong, those that may be meant.
    pub(super) states: Vec<usize>,
    /// Whether nothing was reported.
    pub(super) is_right: bool,
}

impl Found {
    fn right(states: impl IntoIterator<Item = usize>) -> Self {
        Self {
            states: states.into_iter().collect(),
            is_right: true,
        }
    }

    fn wrong(states: impl IntoIterator<Item = usize>) -> Self {
        Self {
            states: states.into_iter().collect(),
            is_right: false,
        }
    }
}

impl<'d> Resolver<'d> {
    /// The states that `target` names; `whole` if it may be a group.
    pub(super) fn target(&mut self, target: &'d Target, whole: bool, body: &mut Body) -> Found {
        let ident = &target.ident;
        let text = ident.to_string();
        let index = target
            .index
            .as_ref()
            .map(|index| (index, self.integer(index, "an index")));
        let Some(&(first, count)) = self.regions.state_groups.get(&text) else {
            let meant = self.not_a_state(ident, whole).and_then(|meant| {
                let &(first, count) = self.regions.state_groups.get(&meant)?;
                Some(first..first + count.unwrap_or(1))
            });
            body.has_unknown_state |= meant.is_none();
            return Found::wrong(meant.into_iter().flatten());
        };
        let all = first..first + count.unwrap_or(1);
        match (count, index) {
            (None, None) => Found::right(all),
            (Some(_), None) if whole => Found::right(all),
            (Some(count), None) => {
                let message = format!(
                    "`{ident}` is a group of {count} states: write `der({ident}[0])`, or `for i in 0..{count} {{ der({ident}[i]) = …; }}`"
                );
                self.report(codes::INDEX_MISSING, target.extent, message);
                Found::wrong(all)
            }
            (None, Some(_)) => {
                self.no_group(ident, Kind::State, target.extent);
                Found::wrong(all)
            }
            (Some(_), Some((_, None))) => Found::wrong(all),
            (Some(_), Some((_, Some(Integer::Unknown)))) => Found::right([]),
            (Some(count), Some((index, Some(Integer::Known(value))))) => {
                match self.element_place(&text, count, index, value) {
                    Some(place) => Found::right([first + place]),
                    None => Found::wrong(all),
                }
            }
        }
    }

    /// Reports that `ident` is no state, in a `pair` or a `der`; the name of the state that was
    /// probably meant.
    fn not_a_state(&mut self, ident: &Ident, pair: bool) -> Option<String> {
        let text = ident.to_string();
        if let Some(kind) = self.scope.names.get(&text).map(|symbol| symbol.kind) {
            if kind != Kind::State && !self.scope.names.is_refused(&text) {
                self.scope.names.mark_used(&text);
                let states = if pair {
                    "only states make canonical pairs"
                } else {
                    "only states have a `der`"
                };
                let message = format!("`{text}` is {}; {states}", kind.article());
                self.report(codes::NOT_A_STATE, ident, message);
            }
            return None;
        }
        if self.scope.names.is_refused(&text) {
            return None;
        }
        let closest = self.scope.names.closest(&text, &[Kind::State]);
        let message = match &closest {
            Some(state) => format!("there is no state `{text}`; did you mean `{state}`?"),
            None if text == "t" && pair => "`t` is the time, which is not a state".into(),
            None if text == "t" => "`t` is the time, which needs no `der`".into(),
            None => format!("there is no state `{text}`: declare `state {text};`"),
        };
        self.report(codes::NOT_A_STATE, ident, message);
        closest
    }
}
