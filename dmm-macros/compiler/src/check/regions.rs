//! Regions: on each of them a complete vector field.

use std::collections::BTreeMap;

use proc_macro2::Ident;
use syn::Attribute;

use super::Resolver;
use super::body::Body;
use crate::algebra::Id;
use crate::diagnostics::Extent;
use crate::diagnostics::catalogue::check as codes;
use crate::model::{Discrete, Event, Interface, Parameter, Region, Side, Sliding, State};
use crate::syntax::{Declaration, Item, RegionItem, SlidingItem};

/// The region of a system without interface.
const EVERYWHERE: &str = "everywhere";

/// What the model has besides formulas.
#[derive(Debug, Default)]
pub(super) struct Regions {
    pub(super) states: Vec<State>,
    /// By name: the index of the first element, and the number of elements of a group.
    pub(super) state_groups: BTreeMap<String, (usize, Option<usize>)>,
    pub(super) parameters: Vec<Parameter>,
    pub(super) discrete: Vec<Discrete>,
    pub(super) events: Vec<Event>,
    /// By interface; nothing where its formula is wrong.
    pub(super) interfaces: Vec<Option<Interface>>,
    pub(super) sliding: Vec<Sliding>,
    /// Whether a region is missing, and with it whatever it would use.
    pub(super) lacks_region: bool,
}

impl<'d> Resolver<'d> {
    /// The regions of the model.
    pub(super) fn regions(&mut self, declaration: &'d Declaration) -> Vec<Region> {
        let items: Vec<&RegionItem> = declaration
            .items
            .iter()
            .filter_map(|item| match item {
                Item::Region(region) => Some(region),
                _ => None,
            })
            .collect();
        self.region_names(&items);
        let shared = self.shared(declaration);
        let read: Vec<(Option<Vec<Side>>, Body)> = items
            .iter()
            .map(|item| (self.sides(item), self.region(item, &shared)))
            .collect();
        self.patterns(declaration, &items);
        for item in &declaration.items {
            if let Item::Sliding(item) = item {
                self.sliding(item);
            }
        }
        if items.is_empty() {
            return self.everywhere(declaration, shared).into_iter().collect();
        }
        let reported = self.missing_everywhere(&declaration.name, &read);
        let mut regions = Vec::new();
        for (item, (sides, body)) in items.iter().zip(read) {
            let field = self.complete(&body, &item.ident, &reported);
            if let (Some(sides), Some(field)) = (sides, field) {
                let attributes = item.attributes.clone();
                regions.push(finished(attributes, &item.ident, sides, field, body));
            }
        }
        self.drop_unused_interfaces(&mut regions);
        regions
    }

    /// What holds while a solution slides on an interface.
    fn sliding(&mut self, item: &'d SlidingItem) {
        let mut body = Body::new(self.regions.states.len()).in_region(&item.interface);
        let items: Vec<&Item> = item.items.iter().collect();
        self.items(&items, &mut body);
        let Some(interface) = self.interface_named(&item.interface, "sliding name { … }") else {
            return;
        };
        let known = self.regions.interfaces.get(interface);
        let known = known.and_then(Option::as_ref);
        if known.is_some_and(|known| !known.slides) {
            let message = format!(
                "nothing slides on `{0}`: declare `interface {0} = …, sliding;`",
                item.interface
            );
            self.report(codes::NO_SLIDING, &item.interface, message);
        }
        self.regions.sliding.push(Sliding {
            interface,
            conserved: body.conserved,
        });
    }

    /// Leaves out the interfaces that bound no region and have no event: nothing switches there.
    fn drop_unused_interfaces(&mut self, regions: &mut [Region]) {
        let interfaces = std::mem::take(&mut self.regions.interfaces);
        for (index, interface) in interfaces.into_iter().enumerate() {
            let number = self.regions.interfaces.len();
            let sides = regions.iter_mut().flat_map(|region| &mut region.sides);
            let mut is_used = false;
            for side in sides.filter(|side| side.interface == index) {
                is_used = true;
                side.interface = number;
            }
            is_used |= interface.as_ref().is_some_and(|one| one.is_switch);
            let sliding = self.regions.sliding.iter_mut();
            for sliding in sliding.filter(|sliding| sliding.interface == index) {
                sliding.interface = number;
            }
            let events = self.regions.events.iter_mut();
            for event in events.filter(|event| event.interface == index) {
                is_used = true;
                event.interface = number;
            }
            if is_used {
                self.regions.interfaces.push(interface);
            }
        }
    }

    /// What stands outside of regions: it holds in every one of them.
    fn shared(&mut self, declaration: &'d Declaration) -> Body {
        let mut body = Body::new(self.regions.states.len());
        for item in &declaration.items {
            match item {
                Item::Derivative(_) | Item::Conserved(_) | Item::Hamiltonian(_) | Item::For(_) => {
                    self.item(item, &mut body)
                }
                _ => {}
            }
        }
        body
    }

    /// The only region of a smooth system.
    fn everywhere(&mut self, declaration: &Declaration, body: Body) -> Option<Region> {
        let ident = Ident::new(EVERYWHERE, declaration.name.span());
        let field = self.complete(&body, &declaration.name, &[])?;
        Some(finished(Vec::new(), &ident, Vec::new(), field, body))
    }

    fn region(&mut self, item: &'d RegionItem, shared: &Body) -> Body {
        let mut body = shared.in_region(&item.ident);
        let items: Vec<&Item> = item.items.iter().collect();
        self.items(&items, &mut body);
        let unused = self.scope.names.leave_region();
        if !self.is_exhausted() {
            self.report_unused(unused);
        }
        body
    }

    /// Reports the states that have no rate in any of several regions; which they are.
    fn missing_everywhere(
        &mut self,
        place: &Ident,
        read: &[(Option<Vec<Side>>, Body)],
    ) -> Vec<usize> {
        let is_missing = |state: usize| {
            let mut fields = read.iter().map(|(_, body)| &body.field);
            fields.all(|field| matches!(field.get(state), Some(None)))
        };
        let missing: Vec<usize> = (0..self.regions.states.len())
            .filter(|&state| read.len() > 1 && is_missing(state))
            .collect();
        let has_unknown_state = read.iter().any(|(_, body)| body.has_unknown_state);
        if !missing.is_empty() && !has_unknown_state && !self.is_exhausted() {
            let message = format!(
                "no region has {}: give it in each of them, or at the top level for all",
                self.derivatives(&missing)
            );
            self.report(codes::DERIVATIVE_MISSING, place, message);
        }
        missing
    }

    /// The vector field, if every state has its rate. What is missing is reported, apart from
    /// what was `reported` before.
    fn complete(
        &mut self,
        body: &Body,
        place: &Ident,
        reported: &[usize],
    ) -> Option<(Vec<Id>, Vec<Extent>)> {
        let missing: Vec<usize> = (body.field.iter().enumerate())
            .filter(|(state, component)| component.is_none() && !reported.contains(state))
            .map(|(state, _)| state)
            .collect();
        if !missing.is_empty() && !body.has_unknown_state && !self.is_exhausted() {
            let missing = self.derivatives(&missing);
            let remedy = ": a state that does not change has the derivative 0";
            let message = match &body.region {
                Some(region) => format!("the region `{region}` has no {missing}{remedy}"),
                None => format!("the system has no {missing}{remedy}"),
            };
            self.report(codes::DERIVATIVE_MISSING, place, message);
        }
        let components: Vec<(Id, Extent)> = (body.field.iter())
            .map(|component| component.as_ref().and_then(|component| component.rate))
            .collect::<Option<_>>()?;
        Some(components.into_iter().unzip())
    }

    /// `` `der(x)`, `der(q[0])` to `der(q[7])` ``
    fn derivatives(&self, states: &[usize]) -> String {
        let name = |state: usize| {
            let name = self
                .regions
                .states
                .get(state)
                .map(|state| state.name.to_string());
            format!("`der({})`", name.unwrap_or_default())
        };
        let group = |state: usize| {
            let state = self.regions.states.get(state)?;
            state.element.map(|_| &state.ident)
        };
        let follows = |&one: &usize, &next: &usize| {
            next == one + 1 && group(one).is_some() && group(one) == group(next)
        };
        let runs = states.chunk_by(follows).flat_map(|run| match run {
            [first, _, .., last] => vec![format!("{} to {}", name(*first), name(*last))],
            few => few.iter().copied().map(name).collect(),
        });
        runs.collect::<Vec<String>>().join(", ")
    }

    /// Region names that are the same, or become the same variant of the emitted enumeration.
    fn region_names(&mut self, items: &[&RegionItem]) {
        let mut variants: BTreeMap<String, &Ident> = BTreeMap::new();
        for item in items {
            let variant = crate::model::camel_case(&item.ident.to_string());
            match variants.get(&variant) {
                Some(earlier) if **earlier == item.ident => {
                    let message = format!("the region `{}` is declared twice", item.ident);
                    self.report(codes::REGION_TWICE, &item.ident, message);
                }
                Some(earlier) => {
                    let message = format!(
                        "the regions `{earlier}` and `{}` are both called `{variant}` in Rust; rename one",
                        item.ident
                    );
                    self.report(codes::REGION_TWICE, &item.ident, message);
                }
                None => {
                    variants.insert(variant, &item.ident);
                }
            }
        }
    }
}

/// A region of the model.
fn finished(
    attributes: Vec<Attribute>,
    ident: &Ident,
    sides: Vec<Side>,
    (field, field_spans): (Vec<Id>, Vec<Extent>),
    body: Body,
) -> Region {
    Region {
        attributes,
        ident: ident.clone(),
        sides,
        field,
        field_spans,
        conserved: body.conserved,
        canonical: body.canonical,
        slide: None,
    }
}
