//! The mean: the field as a sum over weights that are to be solved for, f = f₀ + Σ wₖ Fₖ.

use std::collections::HashMap;

use super::places::{Place, sign};
use crate::algebra::{Dag, Id, Name, is_proved_zero, normalise};
use crate::model::{Model, Sign};

/// f₀ + Σ wₖ Fₖ with weights of interfaces, those of the place first.
#[derive(Clone)]
pub(super) struct Mean {
    /// f₀, by state.
    pub(super) base: Vec<Id>,
    /// The unknowns.
    pub(super) weights: Vec<Weight>,
    /// What has to stay positive.
    pub(super) ends: Vec<WeightEnd>,
}

/// A weight.
#[derive(Clone)]
pub(super) struct Weight {
    /// The interface whose g it keeps at zero.
    pub(super) interface: usize,
    /// Fₖ, by state.
    pub(super) column: Vec<Id>,
    /// Whether it is that of a switch, which may slide or not.
    pub(super) is_switch: bool,
}

/// c + Σ cₖ wₖ, where it becomes zero the motion leaves `interface` on a side.
#[derive(Clone)]
pub(super) struct WeightEnd {
    pub(super) constant: i64,
    /// By weight; those behind them are zero.
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
    let corners = 0..place.regions.len();
    let corners = corners.map(|corner| field_at(model, place, corner));
    let corners = Corners(corners.collect());
    let dag = &mut model.dag;
    match place.on[..] {
        [] => Some(corners.mean(0, Vec::new(), Vec::new())),
        [interface] => {
            let column = corners.difference(dag, 1, 0);
            let ends = both_sides(interface, 0);
            Some(corners.mean(0, vec![(interface, column)], ends.into()))
        }
        [first, second] => {
            let (by_first, by_second) =
                (corners.difference(dag, 1, 0), corners.difference(dag, 2, 0));
            if !corners.is_sum(dag, &by_first, &by_second) {
                return of_three(dag, place, &corners);
            }
            let ends = both_sides(first, 0)
                .into_iter()
                .chain(both_sides(second, 1));
            let columns = vec![(first, by_first), (second, by_second)];
            Some(corners.mean(0, columns, ends.collect()))
        }
        _ => None,
    }
}

/// The mean of three fields: A on one side of an interface a, B and C on its other side, where g of b
/// is positive and negative, f = f_C + θ_A (f_A − f_C) + θ_B (f_B − f_C).
fn of_three(dag: &mut Dag, place: &Place, corners: &Corners) -> Option<Mean> {
    let choices = [(0, 0), (0, 1), (1, 0), (1, 2)];
    let (bit, of_a) = choices.into_iter().find(|&(bit, corner)| {
        let across = corner ^ (1 << (1 - bit));
        place.regions[corner] == place.regions[across]
    })?;
    let (a, b) = (place.on[bit], place.on[1 - bit]);
    let of_c = (of_a ^ (1 << bit)) & !(1 << (1 - bit));
    let of_b = of_c | 1 << (1 - bit);
    let behind = sign(of_a, bit).opposite();
    let end = |constant, factors: [i64; 2], interface, side| WeightEnd {
        constant,
        factors: factors.into(),
        interface,
        side,
    };
    let ends = vec![
        end(0, [1, 0], a, behind),
        end(0, [0, 1], b, Sign::Negative),
        end(1, [-1, -1], b, Sign::Positive),
    ];
    let columns = vec![
        (a, corners.difference(dag, of_a, of_c)),
        (b, corners.difference(dag, of_b, of_c)),
    ];
    Some(corners.mean(of_c, columns, ends))
}

/// The ends of weight number `index`, which is 0 on the side g < 0 and 1 on the other.
fn both_sides(interface: usize, index: usize) -> [WeightEnd; 2] {
    let end = |constant, factor, side| {
        let mut factors = vec![0; index + 1];
        factors[index] = factor;
        WeightEnd {
            constant,
            factors,
            interface,
            side,
        }
    };
    [end(0, 1, Sign::Negative), end(1, -1, Sign::Positive)]
}

/// The fields around a place, by corner and state.
struct Corners(Vec<Vec<Id>>);

impl Corners {
    fn difference(&self, dag: &mut Dag, one: usize, other: usize) -> Vec<Id> {
        let parts = self.0[one].iter().zip(&self.0[other]);
        let parts = parts.map(|(&one, &other)| {
            let part = dag.sub(one, other);
            simplified(dag, part)
        });
        parts.collect()
    }

    /// Whether the field is the sum of what two interfaces switch.
    fn is_sum(&self, dag: &mut Dag, by_first: &[Id], by_second: &[Id]) -> bool {
        let by_both = self.difference(dag, 3, 0);
        let mut parts = by_both.iter().zip(by_first.iter().zip(by_second));
        parts.all(|(&both, (&first, &second))| {
            let sum = dag.add(first, second);
            let rest = dag.sub(both, sum);
            is_proved_zero(dag, rest)
        })
    }

    fn mean(&self, base: usize, columns: Vec<(usize, Vec<Id>)>, ends: Vec<WeightEnd>) -> Mean {
        let weight = |(interface, column)| Weight {
            interface,
            column,
            is_switch: false,
        };
        Mean {
            base: self.0[base].clone(),
            weights: columns.into_iter().map(weight).collect(),
            ends,
        }
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
    /// Takes the switches of formulas out of the base, as weights of their own; nothing where there are none, or they change what the interfaces of the place switch.
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
            self.ends.extend(both_sides(interface, self.weights.len()));
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
