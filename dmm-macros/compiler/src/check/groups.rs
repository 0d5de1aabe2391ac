//! Groups `q[n]`: their elements are the variables `q[0]` … `q[n−1]`, and an index is a formula
//! of constants and loop variables whose value is an exact integer.

use proc_macro2::Ident;

use super::names::{Kind, Meaning};
use super::{Allowed, Resolver, Value};
use crate::algebra::{Id, Name};
use crate::diagnostics::Extent;
use crate::diagnostics::catalogue::check as codes;
use crate::model::{Parameter, State};
use crate::syntax::{Defaults, Expression, Group, ParameterItem};

/// More states than this make derived formulas too long to be of use.
pub(super) const MOST_STATES: usize = 128;
/// The most parameters.
const MOST_PARAMETERS: usize = 4096;

/// An integer known when the system is compiled, in the formula of a function perhaps not yet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Integer {
    /// Its value.
    Known(i64),
    /// It depends on an argument of the function that is being declared.
    Unknown,
}

impl<'d> Resolver<'d> {
    /// `state x`, `state q[3]`
    pub(super) fn state(&mut self, group: &'d Group) {
        let count = self.length(group, MOST_STATES);
        if !self.scope.names.is_first(&group.ident, Kind::State) {
            return;
        }
        let Some(count) = count else {
            return self.refuse(&group.ident);
        };
        let first = self.regions.states.len();
        self.regions
            .state_groups
            .insert(group.ident.to_string(), (first, count));
        let mut values = Vec::new();
        for (element, name) in elements(&group.ident, count) {
            let id = self.evaluator.dag.variable(&name);
            values.push(Value { id, number: None });
            self.regions.states.push(State {
                attributes: group.attributes.clone(),
                ident: group.ident.clone(),
                element,
                name,
            });
        }
        self.scope.names.set(&group.ident, meaning(count, values));
    }

    /// `param k = 1`, `param m[3] = 1`, `param m[3] = [1, 2, 3]`
    pub(super) fn parameter(&mut self, item: &'d ParameterItem) {
        let group = &item.group;
        let count = self.length(group, MOST_PARAMETERS);
        let defaults = self.defaults(item, count);
        if !self.scope.names.is_first(&group.ident, Kind::Parameter) {
            return;
        }
        let Some(count) = count else {
            return self.refuse(&group.ident);
        };
        let mut values = Vec::new();
        let mut defaults = defaults.into_iter().flatten();
        for (element, name) in elements(&group.ident, count) {
            let id = self.evaluator.dag.variable(&name);
            values.push(Value { id, number: None });
            if let Some(default) = defaults.next() {
                self.regions.parameters.push(Parameter {
                    attributes: group.attributes.clone(),
                    ident: group.ident.clone(),
                    element,
                    name,
                    default,
                });
            }
        }
        self.scope.names.set(&group.ident, meaning(count, values));
    }

    /// What follows from a group of unknown length is not reported.
    fn refuse(&mut self, ident: &Ident) {
        self.scope.names.set(ident, Meaning::Wrong);
        self.scope.names.refuse(&ident.to_string());
    }

    /// The number of elements, `Some(None)` of a scalar; nothing if it is wrong.
    fn length(&mut self, group: &'d Group, most: usize) -> Option<Option<usize>> {
        let Some(length) = &group.length else {
            return Some(None);
        };
        let value = self.formula(length, Allowed::Constant("the number of elements"))?;
        let name = &group.ident;
        let problem = match self.evaluator.dag.as_integer(value.id).map(usize::try_from) {
            Some(Ok(count)) if (1..=most).contains(&count) => return Some(Some(count)),
            Some(Ok(count)) if count > most => {
                let message = format!("`{name}` has {count} elements: up to {most} are supported");
                (codes::TOO_MANY_STATES, message)
            }
            Some(_) => {
                let message = format!(
                    "`{name}` has {} elements: a group has one at least",
                    number_of(value)
                );
                (codes::GROUP_LENGTH, message)
            }
            None => {
                let message = format!(
                    "the number of elements of `{name}` is an integer, {}",
                    not_integer(length, value)
                );
                (codes::GROUP_LENGTH, message)
            }
        };
        self.report(problem.0, length.extent, problem.1);
        None
    }

    /// The default of each element.
    fn defaults(
        &mut self,
        item: &'d ParameterItem,
        count: Option<Option<usize>>,
    ) -> Option<Vec<Id>> {
        let allowed = Allowed::Constant("the default of a parameter");
        match &item.defaults {
            Defaults::Same(formula) => {
                let value = self.formula(formula, allowed)?;
                Some(vec![value.id; count?.unwrap_or(1)])
            }
            Defaults::Each(formulas, extent) => {
                let values: Vec<Option<Value>> = formulas
                    .iter()
                    .map(|formula| self.formula(formula, allowed))
                    .collect();
                self.count_defaults(&item.group.ident, count?, values.len(), *extent)?;
                values
                    .into_iter()
                    .map(|value| value.map(|value| value.id))
                    .collect()
            }
        }
    }

    fn count_defaults(
        &mut self,
        name: &Ident,
        count: Option<usize>,
        given: usize,
        place: Extent,
    ) -> Option<()> {
        let message = match count {
            Some(count) if count == given => return Some(()),
            Some(count) => format!(
                "`{name}` has {}, but {} given; `= 1` gives the same to all of them",
                counted(count, "element"),
                match given {
                    1 => "one default is".to_owned(),
                    _ => format!("{given} defaults are"),
                }
            ),
            None => format!(
                "`{name}` is one parameter: write `{name} = 1`, or `{name}[{given}] = …` for a group"
            ),
        };
        self.report(codes::DEFAULTS, place, message);
        None
    }

    /// `group[index]`
    pub(super) fn element(
        &mut self,
        formula: &'d Expression,
        group: &'d Ident,
        index: &'d Expression,
        allowed: Allowed,
    ) -> Option<Value> {
        let text = group.to_string();
        let integer = self.integer(index, "an index");
        if text == "t" || text == "pi" {
            let message = format!("`{text}` is no group: leave out the index");
            self.report(codes::INDEX_ON_SCALAR, formula.extent, message);
            return None;
        }
        let Meaning::Elements(elements) = self.meaning(group, &text, allowed)? else {
            let kind = self.scope.names.get(&text).map(|symbol| symbol.kind)?;
            self.no_group(group, kind, formula.extent);
            return None;
        };
        match integer? {
            Integer::Known(index_value) => {
                let place = self.element_place(&text, elements.len(), index, index_value)?;
                elements.get(place).copied()
            }
            Integer::Unknown => Some(self.evaluator.unknown()),
        }
    }

    /// Reports an index on what is no group.
    pub(super) fn no_group(&mut self, ident: &Ident, kind: Kind, place: Extent) {
        let remedy = match kind {
            Kind::State => format!("leave out the index, or declare `state {ident}[n];`"),
            Kind::Parameter => format!("leave out the index, or declare `param {ident}[n] = …;`"),
            Kind::Argument if self.scope.names.hides_group(&ident.to_string()) => {
                "leave out the index, or rename the argument, which hides the group".into()
            }
            _ => "leave out the index".into(),
        };
        let message = format!("`{ident}` is one {kind}, not a group: {remedy}");
        self.report(codes::INDEX_ON_SCALAR, place, message);
    }

    /// The integer that `formula` is, an index or a bound.
    pub(super) fn integer(
        &mut self,
        formula: &'d Expression,
        what: &'static str,
    ) -> Option<Integer> {
        let value = self.formula(formula, Allowed::Constant(what))?;
        if let Some(integer) = self.evaluator.dag.as_integer(value.id) {
            return Some(Integer::Known(integer));
        }
        if self.evaluator.is_unknown(value.id) {
            return Some(Integer::Unknown);
        }
        let message = format!(
            "{what} is an integer, {}{}",
            not_integer(formula, value),
            self.scope.turn(" with")
        );
        let code = match what {
            "an index" => codes::INDEX_NOT_INTEGER,
            _ => codes::LOOP_BOUND,
        };
        self.report(code, formula.extent, message);
        None
    }

    /// The place of the element with this index among the `length` elements of a group.
    pub(super) fn element_place(
        &mut self,
        group: &str,
        length: usize,
        index: &'d Expression,
        value: i64,
    ) -> Option<usize> {
        if let Ok(place) = usize::try_from(value)
            && place < length
        {
            return Some(place);
        }
        let written = format!("{group}[{index}]");
        let meant = format!("{group}[{value}]");
        let is = if written == meant {
            format!("`{written}` is")
        } else {
            format!("`{written}` is `{meant}`{},", self.scope.turn(" with"))
        };
        let side = if value < 0 {
            "in front of the beginning"
        } else {
            "beyond the end"
        };
        let elements = match length {
            1 => format!("1 element, `{group}[0]`"),
            _ => format!(
                "{length} elements, `{group}[0]` to `{group}[{}]`",
                length - 1
            ),
        };
        let message = format!("{is} {side}: `{group}` has {elements}");
        self.report(codes::INDEX_BEYOND, index.extent, message);
        None
    }
}

/// `3 elements`
pub(super) fn counted(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    }
}

/// What `formula` is instead of an integer.
fn not_integer(formula: &Expression, value: Value) -> String {
    let (written, number) = (formula.to_string(), number_of(value));
    if written == number {
        format!("not {number}")
    } else {
        format!("but `{written}` is {number}")
    }
}

fn number_of(value: Value) -> String {
    value
        .number
        .map_or_else(|| "not a number".into(), |number| number.to_string())
}

/// The indices and variables of a group, or the one of a scalar.
fn elements(ident: &Ident, length: Option<usize>) -> Vec<(Option<usize>, Name)> {
    match length {
        None => vec![(None, Name::new(&ident.to_string()))],
        Some(length) => (0..length)
            .map(|index| (Some(index), Name::new(&format!("{ident}[{index}]"))))
            .collect(),
    }
}

fn meaning(length: Option<usize>, values: Vec<Value>) -> Meaning {
    match (length, values.first()) {
        (None, Some(&value)) => Meaning::Value(value),
        _ => Meaning::Elements(values.into()),
    }
}
