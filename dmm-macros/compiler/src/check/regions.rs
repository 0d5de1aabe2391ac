//! Regions: on each of them a complete vector field, and each sign pattern once.

use std::collections::BTreeMap;

use proc_macro2::Ident;

use super::Resolver;
use super::names::Kind;
use crate::diagnostics::Diagnostics;
use crate::model::{Interface, Region, Side, Sign};
use crate::syntax::{Condition, Declaration, Item, RegionItem, Relation};

/// The region of a system without interface.
const EVERYWHERE: &str = "everywhere";

impl Resolver<'_> {
    /// The regions of the model.
    pub(super) fn regions(&mut self, declaration: &Declaration) -> Vec<Region> {
        let items: Vec<&RegionItem> = declaration
            .items
            .iter()
            .filter_map(|item| match item {
                Item::Region(region) => Some(region),
                _ => None,
            })
            .collect();
        self.region_names(&items);
        let regions: Vec<Region> = items.iter().filter_map(|item| self.region(item)).collect();
        let everywhere = self.outside_of_regions(declaration, !items.is_empty());
        if self.interfaces.len() == 1 {
            self.both_sides(declaration, &items);
        }
        everywhere.map_or(regions, |region| vec![region])
    }

    /// What stands outside of regions: the region of a smooth system.
    fn outside_of_regions(
        &mut self,
        declaration: &Declaration,
        has_regions: bool,
    ) -> Option<Region> {
        let items: Vec<&Item> = declaration
            .items
            .iter()
            .filter(|item| matches!(item, Item::Derivative(_) | Item::Conserved(_)))
            .collect();
        if has_regions {
            self.misplaced(&items);
            // names count as used, but the place is all that is wrong
            let mut unseen = Diagnostics::new();
            std::mem::swap(self.diagnostics, &mut unseen);
            self.body(&items, None);
            std::mem::swap(self.diagnostics, &mut unseen);
            return None;
        }
        let body = self.body(&items, None);
        if !self.interfaces.is_empty() {
            return None;
        }
        let ident = Ident::new(EVERYWHERE, declaration.name.span());
        let (field, field_spans) = self.complete(body.field, &declaration.name, None)?;
        Some(Region {
            attributes: Vec::new(),
            ident,
            sides: Vec::new(),
            field,
            field_spans,
            conserved: body.conserved,
        })
    }

    /// `der` and `conserved` at the top level of a system with regions.
    fn misplaced(&mut self, items: &[&Item]) {
        for item in items {
            match item {
                Item::Derivative(item) => self.error(
                    &item.state,
                    format!(
                        "in a system with regions, `der({})` belongs into each region",
                        item.state
                    ),
                ),
                Item::Conserved(item) => self.error(
                    &item.ident,
                    format!(
                        "in a system with regions, `conserved {}` belongs into the regions that conserve it",
                        item.ident
                    ),
                ),
                _ => {}
            }
        }
    }

    fn region(&mut self, item: &RegionItem) -> Option<Region> {
        let sides = self.sides(item);
        let items: Vec<&Item> = item.items.iter().collect();
        let body = self.body(&items, Some(&item.ident));
        let field = self.complete(body.field, &item.ident, Some(&item.ident));
        for (kind, ident) in self.names.leave_region() {
            self.error(
                &ident,
                format!("the {kind} `{ident}` is never used; remove it"),
            );
        }
        let (field, field_spans) = field?;
        Some(Region {
            attributes: item.attributes.clone(),
            ident: item.ident.clone(),
            sides: sides?,
            field,
            field_spans,
            conserved: body.conserved,
        })
    }

    /// The sign pattern, if every condition is in order.
    fn sides(&mut self, region: &RegionItem) -> Option<Vec<Side>> {
        if region.conditions.is_empty() {
            let message = match self.interfaces.first() {
                // what is wrong with the interface has been reported
                Some(None) => return None,
                Some(Some(Interface { ident: interface, .. })) => format!(
                    "on which side is the region `{}`? Write `region {} where {interface} > 0` (or `< 0`)",
                    region.ident, region.ident
                ),
                None => "a region is bounded by an interface: declare `interface name = …;` and write `where name > 0`, or leave out the region and write its items at the top level".into(),
            };
            self.error(&region.ident, message);
            return None;
        }
        let sides: Vec<Option<Side>> = region
            .conditions
            .iter()
            .map(|condition| self.side(condition))
            .collect();
        let sides: Vec<Side> = sides.into_iter().collect::<Option<_>>()?;
        for (index, side) in sides.iter().enumerate() {
            if let Some(condition) = region.conditions.get(index)
                && sides
                    .iter()
                    .take(index)
                    .any(|earlier| earlier.interface == side.interface)
            {
                let message = format!("`{}` stands twice in this pattern", condition.interface);
                self.error(&condition.interface, message);
                return None;
            }
        }
        Some(sides)
    }

    fn side(&mut self, condition: &Condition) -> Option<Side> {
        let ident = &condition.interface;
        let text = ident.to_string();
        let message = match self.names.get(&text).map(|symbol| symbol.kind) {
            Some(Kind::Interface) => {
                let interface = (self.interfaces.iter())
                    .position(|known| known.as_ref().is_some_and(|known| known.ident == *ident))?;
                let sign = match condition.relation {
                    Relation::Less => Sign::Negative,
                    Relation::Greater => Sign::Positive,
                };
                return Some(Side { interface, sign });
            }
            Some(kind) => {
                self.names.mark_used(&text);
                format!(
                    "`{text}` is a {kind}, not an interface: declare `interface name = {text};` and write `name {} 0`",
                    condition.relation.symbol()
                )
            }
            None => match self.names.closest(&text, &[Kind::Interface]) {
                Some(candidate) => {
                    format!("there is no interface `{text}`; did you mean `{candidate}`?")
                }
                None => format!("there is no interface `{text}`: declare `interface {text} = …;`"),
            },
        };
        self.error(ident, message);
        None
    }

    /// Region names that are the same, or become the same variant of the emitted enumeration.
    fn region_names(&mut self, items: &[&RegionItem]) {
        let mut variants: BTreeMap<String, &Ident> = BTreeMap::new();
        for item in items {
            let variant = crate::model::camel_case(&item.ident.to_string());
            match variants.get(&variant) {
                Some(earlier) if **earlier == item.ident => {
                    let message = format!("the region `{}` is declared twice", item.ident);
                    self.error(&item.ident, message);
                }
                Some(earlier) => {
                    let message = format!(
                        "the regions `{earlier}` and `{}` are both called `{variant}` in Rust; rename one",
                        item.ident
                    );
                    self.error(&item.ident, message);
                }
                None => {
                    variants.insert(variant, &item.ident);
                }
            }
        }
    }

    /// With one interface: the region g > 0 and the region g < 0, each once.
    fn both_sides(&mut self, declaration: &Declaration, items: &[&RegionItem]) {
        let interface = declaration.items.iter().find_map(|item| match item {
            Item::Interface(item) => Some(&item.ident),
            _ => None,
        });
        let Some(interface) = interface else { return };
        if items.is_empty() {
            let message = format!(
                "the interface `{interface}` bounds no region: write `region … where {interface} > 0 {{ … }}` and `region … where {interface} < 0 {{ … }}`, with the `der` items in them"
            );
            self.error(interface, message);
            self.lacks_region = true;
            return;
        }
        // with a wrong pattern it is not known which side was meant
        let mut is_unclear = items.iter().any(|item| {
            item.conditions.len() != 1
                || item
                    .conditions
                    .iter()
                    .any(|condition| condition.interface != *interface)
        });
        let mut missing = Vec::new();
        for relation in [Relation::Greater, Relation::Less] {
            let mut on_this_side = items.iter().filter(|item| {
                item.conditions.iter().any(|condition| {
                    condition.interface == *interface && condition.relation == relation
                })
            });
            let first = on_this_side.next();
            if let Some(first) = first {
                for item in on_this_side {
                    is_unclear = true;
                    let message = format!(
                        "the regions `{}` and `{}` overlap: both are where `{interface} {} 0`",
                        first.ident,
                        item.ident,
                        relation.symbol()
                    );
                    self.error(&item.ident, message);
                }
            } else {
                missing.push(relation.symbol());
            }
        }
        if !is_unclear {
            self.lacks_region |= !missing.is_empty();
            for symbol in missing {
                let message = format!("there is no region where `{interface} {symbol} 0`");
                self.error(interface, message);
            }
        }
    }
}
