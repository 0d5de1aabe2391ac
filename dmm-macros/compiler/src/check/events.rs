//! Discrete states, and the events that change them and the states in an instant.

use proc_macro2::Ident;
use quote::format_ident;

use super::body::Body;
use super::names::{Kind, Meaning};
use super::{Allowed, Resolver, Value};
use crate::algebra::{Id, Name};
use crate::diagnostics::Extent;
use crate::diagnostics::catalogue::check as codes;
use crate::model::{Discrete, Event, Interface, Model};
use crate::syntax::{
    Assignment, Comparison, Declaration, Definition, Direction, EventItem, Expression, Item,
    Relation, Trigger,
};

/// The most discrete states.
const MOST_DISCRETE: usize = 15;

/// Where an assignment puts its value.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    State(usize),
    Discrete(usize),
}

impl<'d> Resolver<'d> {
    /// `discrete u = 1`
    pub(super) fn discrete(&mut self, item: &'d Definition) {
        let what = "the initial value of a discrete state";
        let initial = self.formula(&item.formula, Allowed::Constant(what));
        if !self.scope.names.is_first(&item.ident, Kind::Discrete) {
            return;
        }
        let name = Name::new(&item.ident.to_string());
        let id = self.evaluator.dag.variable(&name);
        let value = Value { id, number: None };
        self.scope.names.set(&item.ident, Meaning::Value(value));
        if self.regions.discrete.len() == MOST_DISCRETE {
            let message = format!("up to {MOST_DISCRETE} discrete states are supported");
            self.report(codes::EVENT_TARGET, &item.ident, message);
        }
        if let Some(initial) = initial {
            self.regions.discrete.push(Discrete {
                attributes: item.attributes.clone(),
                ident: item.ident.clone(),
                name,
                initial: initial.id,
                is_clock: false,
            });
        }
    }

    /// The events of the top level, which happen in every region.
    pub(super) fn events(&mut self, declaration: &'d Declaration) {
        for item in &declaration.items {
            if let Item::Event(event) = item {
                self.event(event, None);
            }
        }
    }

    /// An event, in one region or in all of them.
    pub(super) fn event(&mut self, item: &'d EventItem, region: Option<&Ident>) {
        let number = self.regions.events.len() + 1;
        let mut event = match &item.trigger {
            Trigger::On {
                interface,
                direction,
            } => self
                .interface_named(interface, "on name …")
                .map(|interface| Event {
                    rises: *direction != Direction::Falling,
                    falls: *direction != Direction::Rising,
                    ..Event::new(interface)
                }),
            Trigger::Every(period) => self.every(period, number, item.extent),
            Trigger::At(time) => self.at(time, number, item.extent),
        };
        let conditions = item.conditions.iter();
        let conditions: Vec<Option<Id>> = conditions.map(|one| self.comparison(one)).collect();
        let mut given: Vec<Place> = Vec::new();
        for assignment in &item.assignments {
            let Some((place, value)) = self.assignment(assignment) else {
                event = None;
                continue;
            };
            if given.contains(&place) {
                let message = format!(
                    "`{}` is given two values: an event has one formula for each, all of the values before",
                    assignment.target
                );
                self.report(codes::EVENT_TWICE, assignment.target.extent, message);
            }
            given.push(place);
            if let Some(event) = &mut event {
                match place {
                    Place::State(state) => event.states.push((state, value)),
                    Place::Discrete(discrete) => event.discrete.push((discrete, value)),
                }
            }
        }
        if let (Some(event), Some(conditions)) = (event, conditions.into_iter().collect()) {
            self.regions.events.push(Event {
                conditions,
                region: region.cloned(),
                conserved: item.conserved.clone(),
                span: item.extent,
                ..event
            });
        }
    }

    /// `every period`: g = t − n period rises where n counts the events.
    fn every(&mut self, period: &'d Expression, number: usize, place: Extent) -> Option<Event> {
        let of_period = self.fixed(period, "the time between events")?;
        if of_period.number.is_some_and(|period| period <= 0.0) {
            let message = "the time between events is positive";
            self.report(codes::EVENT_TIME, period.extent, message);
            return None;
        }
        let ident = format_ident!("every_{number}");
        // no identifier of a declaration has a space
        let name = Name::new(&format!("n of {ident}"));
        let dag = &mut self.evaluator.dag;
        let (n, one) = (dag.variable(&name), dag.integer(1));
        let next = dag.mul(n, of_period.id);
        let interface = self.clock(ident.clone(), next, place);
        let discrete = self.regions.discrete.len();
        self.regions.discrete.push(Discrete {
            attributes: Vec::new(),
            ident,
            name,
            initial: one,
            is_clock: true,
        });
        let after = self.evaluator.dag.add(n, one);
        Some(Event {
            falls: false,
            discrete: vec![(discrete, after)],
            ..Event::new(interface)
        })
    }

    /// `at time`
    fn at(&mut self, time: &'d Expression, number: usize, place: Extent) -> Option<Event> {
        let time = self.fixed(time, "the time of an event")?;
        let interface = self.clock(format_ident!("at_{number}"), time.id, place);
        Some(Event {
            falls: false,
            ..Event::new(interface)
        })
    }

    /// The interface t = time.
    fn clock(&mut self, ident: Ident, time: Id, span: Extent) -> usize {
        let dag = &mut self.evaluator.dag;
        let t = dag.variable(&Model::time());
        let switching_function = dag.sub(t, time);
        self.regions.interfaces.push(Some(Interface {
            attributes: Vec::new(),
            label: None,
            side: Model::side_of(&ident),
            ident,
            is_switch: false,
            slides: false,
            end: None,
            switching_function,
            span,
        }));
        self.regions.interfaces.len() - 1
    }

    /// A formula that depends on neither states nor the time.
    fn fixed(&mut self, formula: &'d Expression, what: &str) -> Option<Value> {
        let value = self.formula(formula, Allowed::All)?;
        let depends_on = self.evaluator.dag.variables([value.id]);
        let parameters = &self.regions.parameters;
        let varies = depends_on
            .iter()
            .any(|name| parameters.iter().all(|one| one.name != *name));
        if varies {
            let message = format!("{what} depends on parameters and constants alone");
            self.report(codes::EVENT_TIME, formula.extent, message);
            return None;
        }
        Some(value)
    }

    /// What is positive where a comparison holds.
    fn comparison(&mut self, item: &'d Comparison) -> Option<Id> {
        // both, so that errors on both sides are found
        let left = self.formula(&item.left, Allowed::All);
        let right = self.formula(&item.right, Allowed::All);
        let (left, right) = (left?.id, right?.id);
        let dag = &mut self.evaluator.dag;
        Some(match item.relation {
            Relation::Greater => dag.sub(left, right),
            Relation::Less => dag.sub(right, left),
        })
    }

    fn assignment(&mut self, item: &'d Assignment) -> Option<(Place, Id)> {
        let value = self.formula(&item.formula, Allowed::All);
        let text = item.target.ident.to_string();
        let known = self
            .regions
            .discrete
            .iter()
            .position(|one| one.ident == text);
        if let (Some(discrete), None) = (known, &item.target.index) {
            return Some((Place::Discrete(discrete), value?.id));
        }
        if !self.regions.state_groups.contains_key(&text) {
            self.no_target(&item.target.ident);
            return None;
        }
        let mut body = Body::new(0);
        let found = self.target(&item.target, false, &mut body);
        match (&found.states[..], found.is_right) {
            (&[state], true) => Some((Place::State(state), value?.id)),
            _ => None,
        }
    }

    /// Reports an assignment to what is no state.
    fn no_target(&mut self, ident: &Ident) {
        let text = ident.to_string();
        let names = &self.scope.names;
        if names.is_refused(&text) {
            return;
        }
        let message = match names.get(&text).map(|symbol| symbol.kind) {
            // its initial value is wrong, which has been reported
            Some(Kind::Discrete) => return,
            Some(kind) => format!(
                "`{text}` is {}, and an event changes states and discrete states: what it changes is declared by `discrete {text} = …;`",
                kind.article()
            ),
            None => match names.closest(&text, &[Kind::State, Kind::Discrete]) {
                Some(candidate) => {
                    format!("there is no state `{text}`; did you mean `{candidate}`?")
                }
                None => format!(
                    "there is no state `{text}`: declare `discrete {text} = …;` if it is constant between events, or `state {text};`"
                ),
            },
        };
        self.report(codes::EVENT_TARGET, ident, message);
    }
}
