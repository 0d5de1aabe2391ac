//! Sign patterns: on which sides of the interfaces a region is, and that each pattern is there
//! once.

use super::Resolver;
use super::names::Kind;
use crate::diagnostics::catalogue::check as codes;
use crate::model::{Interface, Side, Sign};
use crate::syntax::{Condition, Declaration, Item, RegionItem, Relation};

impl Resolver<'_> {
    /// The sign pattern, if every condition is in order.
    pub(super) fn sides(&mut self, region: &RegionItem) -> Option<Vec<Side>> {
        if region.conditions.is_empty() {
            let (code, message) = match self.regions.interfaces.first() {
                // what is wrong with the interface has been reported
                Some(None) => return None,
                Some(Some(Interface { ident: interface, .. })) => (
                    codes::REGION_WITHOUT_SIDE,
                    format!(
                        "on which side is the region `{}`? Write `region {} where {interface} > 0` (or `< 0`)",
                        region.ident, region.ident
                    ),
                ),
                None => (
                    codes::REGION_WITHOUT_INTERFACE,
                    "a region is bounded by an interface: declare `interface name = …;` and write `where name > 0`, or leave out the region and write its items at the top level".into(),
                ),
            };
            self.report(code, &region.ident, message);
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
                self.report(codes::SIDE_TWICE, &condition.interface, message);
                return None;
            }
        }
        Some(sides)
    }

    fn side(&mut self, condition: &Condition) -> Option<Side> {
        let ident = &condition.interface;
        let text = ident.to_string();
        let message = match self.scope.names.get(&text).map(|symbol| symbol.kind) {
            Some(Kind::Interface) => {
                let interface = (self.regions.interfaces.iter())
                    .position(|known| known.as_ref().is_some_and(|known| known.ident == *ident))?;
                let sign = match condition.relation {
                    Relation::Less => Sign::Negative,
                    Relation::Greater => Sign::Positive,
                };
                return Some(Side { interface, sign });
            }
            // an interface was meant to be declared under this name
            Some(_) if self.scope.names.is_refused(&text) => return None,
            Some(kind) => {
                self.scope.names.mark_used(&text);
                format!(
                    "`{text}` is {}, not an interface: declare `interface name = {text};` and write `name {} 0`",
                    kind.article(),
                    condition.relation.symbol()
                )
            }
            None => match self.scope.names.closest(&text, &[Kind::Interface]) {
                Some(candidate) => {
                    format!("there is no interface `{text}`; did you mean `{candidate}`?")
                }
                None => format!("there is no interface `{text}`: declare `interface {text} = …;`"),
            },
        };
        self.report(codes::NOT_AN_INTERFACE, ident, message);
        None
    }

    /// With one interface: the region g > 0 and the region g < 0, each once.
    pub(super) fn both_sides(&mut self, declaration: &Declaration, items: &[&RegionItem]) {
        let interface = declaration.items.iter().find_map(|item| match item {
            Item::Interface(item) => Some(&item.ident),
            _ => None,
        });
        let Some(interface) = interface else { return };
        if items.is_empty() {
            let message = format!(
                "the interface `{interface}` bounds no region: write `region … where {interface} > 0 {{ … }}` and `region … where {interface} < 0 {{ … }}`, with the `der` items in them"
            );
            self.report(codes::NO_REGION, interface, message);
            self.regions.lacks_region = true;
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
                    self.report(codes::REGIONS_OVERLAP, &item.ident, message);
                }
            } else {
                missing.push(relation.symbol());
            }
        }
        if !is_unclear {
            self.regions.lacks_region |= !missing.is_empty();
            for symbol in missing {
                let message = format!(
                    "there is no region where `{interface} {symbol} 0`: declare `region name where {interface} {symbol} 0 {{ … }}`"
                );
                self.report(codes::REGION_MISSING, interface, message);
            }
        }
    }
}
