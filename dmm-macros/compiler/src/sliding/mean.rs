//! The mean: the field as a sum over weights that are to be solved for, f = f₀ + Σ wₖ Fₖ.

use std::collections::HashMap;

use super::places::{Place, sign};
use crate::algebra::{Dag, Id, Name, is_proved_zero, normalise};
use crate::model::{Model, Sign};

/// f₀ + Σ wₖ Fₖ with weights of interfaces, those of the place first.
pub(super) struct Mean {
    /// f₀, by state.
    pub(super) base: Vec<Id>,
    /// The unknowns.
    pub(super) weights: Vec<Weight>,
    /// What has to stay positive for the interfaces of the place, in terms of their weights.
    pub(super) ends: Vec<WeightEnd>,
}

/// A weight.
pub(super) struct Weight {
    /// The interface whose g it keeps at zero.
    pub(super) interface: usize,
    /// Fₖ, by state.
    pub(super) column: Vec<Id>,
    /// Whether it is that of a switch, which may slide or not.
    pub(super) is_switch: bool,
}

/// c + Σ cₖ wₖ, where it becomes zero the motion leaves `interface` on a side.
pub(super) struct WeightEnd {
    pub(super) constant: i64,
    pub(super) factors: Vec<i64>,
    pub(super) interface: usize,
    pub(super) side: Sign,
}

/// Why there is no mean.
#[derive(Debug)]
pub(super) struct Problem {
    pub(super) interface: usize,
    pub(super) message: String,
}

/// The mean of the fields around a place; nothing where it is not determined, because four fields
/// meet that are no sum of what two interfaces switch.
pub(super) fn of_place(model: &mut Model, place: &Place) -> Option<Mean> {
    let count = model.states.len();
    let corners: Vec<Vec<Id>> = (0..place.regions.len())
        .map(|corner| field_at(model, place, corner))
        .collect();
    let dag = &mut model.dag;
    let difference = |dag: &mut Dag, one: usize, other: usize| -> Vec<Id> {
        let parts = (0..count).map(|m| {
            let part = dag.sub(corners[one][m], corners[other][m]);
            simplified(dag, part)
        });
        parts.collect()
    };
    let weight = |interface: usize, column: Vec<Id>| Weight {
        interface,
        column,
        is_switch: false,
    };
    let both = |interface: usize, index: usize, all: usize| {
        let mut factors = vec![0; all];
        factors[index] = 1;
        let low = WeightEnd {
            constant: 0,
            factors: factors.clone(),
            interface,
            side: Sign::Negative,
        };
        factors[index] = -1;
        let high = WeightEnd {
            constant: 1,
            factors,
            interface,
            side: Sign::Positive,
        };
        [low, high]
    };
    match place.on[..] {
        [] => Some(Mean {
            base: corners[0].clone(),
            weights: Vec::new(),
            ends: Vec::new(),
        }),
        [interface] => Some(Mean {
            weights: vec![weight(interface, difference(dag, 1, 0))],
            base: corners[0].clone(),
            ends: both(interface, 0, 1).into(),
        }),
        [first, second] => {
            let (by_first, by_second) = (difference(dag, 1, 0), difference(dag, 2, 0));
            let is_sum = (0..count).all(|m| {
                let all = dag.sub(corners[3][m], corners[0][m]);
                let parts = dag.add(by_first[m], by_second[m]);
                let cross = dag.sub(all, parts);
                is_proved_zero(dag, cross)
            });
            if is_sum {
                let ends = both(first, 0, 2).into_iter().chain(both(second, 1, 2));
                return Some(Mean {
                    base: corners[0].clone(),
                    weights: vec![weight(first, by_first), weight(second, by_second)],
                    ends: ends.collect(),
                });
            }
            // three regions: one on one side of an interface a, two on its other side
            let (bit, corner) =
                [(0, 0), (0, 1), (1, 0), (1, 2)]
                    .into_iter()
                    .find_map(|(a, of)| {
                        let b = 1 - a;
                        let is_one = place.regions[of] == place.regions[of ^ (1 << b)];
                        is_one.then_some((a, of))
                    })?;
            let (a, b) = (place.on[bit], place.on[1 - bit]);
            // C and B lie behind a, where g of b is negative and positive
            let c = (corner ^ (1 << bit)) & !(1 << (1 - bit));
            let with_b = c | 1 << (1 - bit);
            let behind = sign(corner, bit).opposite();
            let end = |constant, factors: [i64; 2], interface, side| WeightEnd {
                constant,
                factors: factors.into(),
                interface,
                side,
            };
            Some(Mean {
                weights: vec![
                    weight(a, difference(dag, corner, c)),
                    weight(b, difference(dag, with_b, c)),
                ],
                base: corners[c].clone(),
                ends: vec![
                    end(0, [1, 0], a, behind),
                    end(0, [0, 1], b, Sign::Negative),
                    end(1, [-1, -1], b, Sign::Positive),
                ],
            })
        }
        _ => None,
    }
}

/// The field of a corner, on its sides of the interfaces of the place.
fn field_at(model: &mut Model, place: &Place, corner: usize) -> Vec<Id> {
    let mut sides: HashMap<Name, Id> = HashMap::new();
    for (bit, &interface) in place.on.iter().enumerate() {
        let value = i64::from(sign(corner, bit) == Sign::Positive);
        let value = model.dag.integer(value);
        sides.insert(model.interfaces[interface].side.clone(), value);
    }
    let field = model.regions[place.regions[corner]].field.clone();
    let parts = field.into_iter();
    parts
        .map(|part| model.dag.substitute(part, &sides))
        .collect()
}

impl Mean {
    /// Takes the switches of formulas out of the base, as weights of their own.
    /// Nothing where there are none, or they change what the interfaces of the place switch.
    pub(super) fn with_switches(
        mut self,
        model: &mut Model,
        place: &Place,
    ) -> Result<Option<Self>, Problem> {
        let depends_on = model.dag.variables(self.base.iter().copied());
        let is_own = |index: usize| {
            let interface = &model.interfaces[index];
            let slides = interface.slides && interface.is_switch && !place.on.contains(&index);
            slides && depends_on.contains(&interface.side)
        };
        let own: Vec<usize> = (0..model.interfaces.len())
            .filter(|&one| is_own(one))
            .collect();
        let sides = own.iter().map(|&one| &model.interfaces[one].side);
        let sides: Vec<Name> = sides.cloned().collect();
        let mixes = |side: &Name| {
            let mut parts = self.weights.iter().flat_map(|weight| &weight.column);
            parts.any(|&part| model.dag.depends_on(part, side))
        };
        if own.is_empty() || sides.iter().any(mixes) {
            return Ok(None);
        }
        for interface in own {
            let side = model.interfaces[interface].side.clone();
            let dag = &mut model.dag;
            let [zero, one] = [0, 1].map(|value| {
                let value = dag.integer(value);
                HashMap::from([(side.clone(), value)])
            });
            let mut column = Vec::new();
            for part in &mut self.base {
                let above = dag.substitute(*part, &one);
                *part = dag.substitute(*part, &zero);
                let jump = dag.sub(above, *part);
                column.push(simplified(dag, jump));
            }
            self.weights.push(Weight {
                interface,
                column,
                is_switch: true,
            });
        }
        self.check_sum(model)?;
        Ok(Some(self))
    }

    /// Refuses switches that multiply one another.
    fn check_sum(&self, model: &Model) -> Result<(), Problem> {
        let sides: Vec<(usize, Name)> = (self.weights.iter())
            .filter(|weight| weight.is_switch)
            .map(|weight| {
                let side = model.interfaces[weight.interface].side.clone();
                (weight.interface, side)
            })
            .collect();
        for weight in &self.weights {
            for (other, side) in &sides {
                let g = model.interfaces[weight.interface].switching_function;
                let mut parts = weight.column.iter().chain([&g]);
                if !parts.any(|&part| model.dag.depends_on(part, side)) {
                    continue;
                }
                let names = [weight.interface, *other].map(|one| model.interfaces[one].name());
                return Err(Problem {
                    interface: *other,
                    message: format!(
                        "what switches at `{}` depends on what switches at `{}`, so that their mean is not determined where a solution slides on both: write them as terms of a sum, or declare interfaces and regions",
                        names[0], names[1]
                    ),
                });
            }
        }
        Ok(())
    }
}

/// The same, with fewer nodes if its normal form has fewer.
pub(super) fn simplified(dag: &mut Dag, id: Id) -> Id {
    if dag.as_constant(id).is_some() {
        return id;
    }
    match normalise(dag, id) {
        Some(normal) if dag.tree_size(normal) <= dag.tree_size(id) => normal,
        _ => id,
    }
}

/// s u + (1 − s) v
pub(super) fn blend(dag: &mut Dag, s: Id, u: Id, v: Id) -> Id {
    let one = dag.integer(1);
    let other = dag.sub(one, s);
    let (first, second) = (dag.mul(s, u), dag.mul(other, v));
    dag.add(first, second)
}
