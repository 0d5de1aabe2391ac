//! The motion: the vector field, where it ends, and what it conserves.

use std::collections::HashMap;

use num_traits::Signed;
use proc_macro2::Ident;
use quote::format_ident;

use super::mean::{Mean, Problem, Weight, WeightEnd, simplified};
use super::places::Place;
use super::weights::{Solution, System};
use crate::algebra::{Dag, Id, Math, Name, differentiate, gradient, is_proved_zero};
use crate::model::{Claim, Conserved, Interface, Model, Region, Side, Sign, Slide, SlideEnd};

/// A sliding motion.
pub(super) struct Motion {
    /// By state.
    field: Vec<Id>,
    /// What is positive as long as it lasts.
    ends: Vec<(Id, SlideEnd)>,
    /// The switches that it may slide on.
    pub(super) switches: Vec<usize>,
    /// The interfaces whose functions rounding errors would move off zero.
    kept: Vec<usize>,
}

/// The motion along a mean; nothing if there is none.
pub(super) fn motion(model: &mut Model, mean: &Mean) -> Result<Option<Motion>, Problem> {
    let system = System::of(model, mean);
    let solutions = match system.solve(model, mean)? {
        Some(solutions) => solutions,
        None => return Ok(None),
    };
    let field = field(&mut model.dag, mean, &solutions);
    let ends = ends(&mut model.dag, mean, &solutions);
    // a rate that is a negative number leads away
    let fails = ends.iter().any(|&(function, _)| {
        let value = model.dag.as_constant(function);
        value.is_some_and(|value| !value.is_positive())
    });
    if fails {
        return Ok(None);
    }
    let ends = ends.into_iter();
    let ends = ends.filter(|&(function, _)| model.dag.as_constant(function).is_none());
    let ends = ends.collect();
    let kept = (mean.weights.iter().zip(&solutions))
        .filter(|(weight, solution)| moves(model, weight, solution, &field))
        .map(|(weight, _)| weight.interface);
    let kept: Vec<usize> = kept.collect();
    let switches = mean.weights.iter().filter(|weight| weight.is_switch);
    Ok(Some(Motion {
        ends,
        switches: switches.map(|weight| weight.interface).collect(),
        kept,
        field,
    }))
}

/// f₀ + Σ wₖ Fₖ
fn field(dag: &mut Dag, mean: &Mean, solutions: &[Solution]) -> Vec<Id> {
    let mut field = Vec::new();
    for (state, &base) in mean.base.iter().enumerate() {
        let columns = mean.weights.iter().map(|weight| weight.column[state]);
        let terms = columns.zip(solutions);
        let mut terms: Vec<(Id, &Solution)> = terms.filter(|term| !dag.is_zero(term.0)).collect();
        // the last one with the rest, so that what cancels while it slides does so exactly
        let last = terms.pop();
        let mut sum = base;
        for (column, solution) in terms {
            let zero = dag.integer(0);
            let term = with_term(dag, zero, column, solution);
            sum = dag.add(sum, term);
        }
        let part = match last {
            Some((column, solution)) => with_term(dag, sum, column, solution),
            None => sum,
        };
        let is_fixed = solutions.iter().all(|solution| solution.switch.is_none());
        // what is zero is not to be rounding errors
        let is_zero = is_fixed && is_proved_zero(dag, part);
        field.push(if is_zero { dag.integer(0) } else { part });
    }
    field
}

/// c + wₖ Fₖ. Of a switch, what it is while it slides and what it is elsewhere are written apart where
/// the former has a value everywhere.
fn with_term(dag: &mut Dag, rest: Id, column: Id, solution: &Solution) -> Id {
    let anywhere = |dag: &mut Dag| {
        let term = dag.mul(column, solution.weight);
        dag.add(rest, term)
    };
    let Some((right, slope)) = solution.alone else {
        return anywhere(dag);
    };
    let quotient = dag.div(right, slope);
    let product = dag.mul(column, quotient);
    let sum = dag.add(rest, product);
    let sliding = simplified(dag, sum);
    let Some((slides, side)) = solution.switch else {
        return sliding;
    };
    let divides = |id: &Id| match dag[*id] {
        Math::Div([_, b]) => dag.as_constant(b).is_none(),
        Math::Pow([_, b]) => dag.as_integer(b).is_none_or(|n| n < 0),
        _ => false,
    };
    let known = dag.reachable([rest]);
    let sliding_nodes = dag.reachable([sliding]);
    let mut new = sliding_nodes.iter().filter(|id| !known.contains(id));
    if new.any(divides) {
        return anywhere(dag);
    }
    let elsewhere = dag.mul(side, column);
    let elsewhere = dag.add(rest, elsewhere);
    dag.blend(slides, sliding, elsewhere)
}

/// What is positive as long as the motion lasts; of a switch as long as it slides, and 1 elsewhere.
fn ends(dag: &mut Dag, mean: &Mean, solutions: &[Solution]) -> Vec<(Id, SlideEnd)> {
    let mut ends = Vec::new();
    for end in &mean.ends {
        let own = end.factors.iter().zip(solutions);
        let own: Vec<(i64, &Solution)> = (own.map(|(&factor, solution)| (factor, solution)))
            .filter(|(factor, _)| *factor != 0)
            .collect();
        let mut function = end_function(dag, end, &own);
        let mut switches = own.iter().filter_map(|(_, solution)| solution.switch);
        if let Some((slides, _)) = switches.next() {
            let one = dag.integer(1);
            function = dag.blend(slides, function, one);
        }
        let (interface, side) = (end.interface, Some(end.side));
        ends.push((function, SlideEnd { interface, side }));
    }
    ends
}

/// c + Σ cₖ wₖ, or in terms of rates where a weight depends on no other one: dg/dt of the field on the
/// side g < 0, and −dg/dt of that on the other side.
fn end_function(dag: &mut Dag, end: &WeightEnd, own: &[(i64, &Solution)]) -> Id {
    if let [(_, solution)] = own
        && let Some(alone) = solution.alone
    {
        return rate(dag, alone, end.side);
    }
    let mut sum = dag.integer(end.constant);
    for &(factor, solution) in own {
        let factor = dag.integer(factor);
        let term = dag.mul(factor, solution.weight);
        sum = dag.add(sum, term);
    }
    // the weights of switches that depend on one another are long
    if own.iter().any(|(_, solution)| solution.switch.is_some()) {
        sum
    } else {
        simplified(dag, sum)
    }
}

/// How fast the field on a side leads to the interface: with slope w = right and 0 ≤ w ≤ 1, the rate
/// is slope w − right.
fn rate(dag: &mut Dag, (right, slope): (Id, Id), side: Sign) -> Id {
    let rate = match side {
        Sign::Negative => dag.neg(right),
        Sign::Positive => dag.sub(right, slope),
    };
    simplified(dag, rate)
}

/// Whether the motion on an interface changes what its function depends on.
fn moves(model: &mut Model, weight: &Weight, solution: &Solution, field: &[Id]) -> bool {
    let states = model.state_names();
    let g = model.interfaces[weight.interface].switching_function;
    let slides = Model::slide_of(&model.interfaces[weight.interface]);
    let dag = &mut model.dag;
    let by_time = differentiate(dag, g, &Model::time());
    if solution.alone.is_none() || !is_proved_zero(dag, by_time) {
        return true;
    }
    let slopes = gradient(dag, g, &states);
    let one = dag.integer(1);
    let sliding = HashMap::from([(slides, one)]);
    slopes.into_iter().zip(field).any(|(slope, &part)| {
        let part = match solution.switch {
            Some(_) => dag.substitute(part, &sliding),
            None => part,
        };
        let part = simplified(dag, part);
        !dag.is_zero(slope) && !dag.is_zero(part)
    })
}

impl Motion {
    /// Adds the motion to a model as a region.
    pub(super) fn add_to(self, model: &mut Model, place: &Place, ident: Ident) {
        let mut sides = place.sides.clone();
        sides.retain(|side| !self.switches.contains(&side.interface));
        let conserved = self.conserved(model, place);
        for (function, end) in self.ends {
            sides.push(Side {
                interface: model.interfaces.len(),
                sign: Sign::Positive,
            });
            add_end(model, function, end);
        }
        let mut switches = Vec::new();
        for interface in self.switches {
            // 1 while the motion slides there
            let of = &model.interfaces[interface];
            let (g, slides) = (of.switching_function, Model::slide_of(of));
            let dag = &mut model.dag;
            let slides = dag.variable(&slides);
            let one = dag.integer(1);
            let function = dag.blend(slides, one, g);
            switches.push((interface, model.interfaces.len()));
            let side = None;
            add_end(model, function, SlideEnd { interface, side });
        }
        let beside = &model.regions[place.regions[0]];
        model.regions.push(Region {
            attributes: Vec::new(),
            ident,
            sides,
            field: self.field,
            field_spans: beside.field_spans.clone(),
            conserved,
            canonical: Vec::new(),
            slide: Some(Slide {
                on: place.on.clone(),
                switches,
            }),
        });
    }

    /// The functions g that rounding errors would move, what every field around the place conserves, and
    /// what is declared of the motion; no more than there are states.
    fn conserved(&self, model: &mut Model, place: &Place) -> Vec<Conserved> {
        let mut conserved = Vec::new();
        for &interface in &self.kept {
            let known = &model.interfaces[interface];
            let (g, slides) = (known.switching_function, Model::slide_of(known));
            let psi = if self.switches.contains(&interface) {
                let slides = model.dag.variable(&slides);
                model.dag.mul(slides, g)
            } else {
                g
            };
            let known = &model.interfaces[interface];
            conserved.push(Conserved {
                attributes: Vec::new(),
                ident: known.ident.clone(),
                psi,
                span: known.span,
                claim: Claim::Mean,
            });
        }
        conserved.extend(self.shared(model, place));
        if self.switches.is_empty() && place.on.len() == 1 {
            let own = model.sliding.iter();
            let own = own.filter(|own| place.on.contains(&own.interface));
            conserved.extend(own.flat_map(|own| own.conserved.iter().cloned()));
        }
        conserved.truncate(model.states.len());
        conserved
    }

    /// What every field around the place conserves, and their means with it: what does not itself switch
    /// where the motion slides.
    fn shared(&self, model: &Model, place: &Place) -> Vec<Conserved> {
        let mut beside = place.regions.iter().map(|&one| &model.regions[one]);
        let Some(first) = beside.next() else {
            return Vec::new();
        };
        let slid = place.on.iter().chain(&self.switches);
        let sides: Vec<&Name> = slid.map(|&one| &model.interfaces[one].side).collect();
        let is_shared = |psi: &&Conserved| {
            let is_same = |other: &Conserved| other.ident == psi.ident && other.psi == psi.psi;
            let mut others = beside.clone();
            let switches = sides.iter().any(|side| model.dag.depends_on(psi.psi, side));
            !switches && others.all(|region| region.conserved.iter().any(is_same))
        };
        let shared = first.conserved.iter().filter(is_shared);
        let of_mean = |psi: &Conserved| Conserved {
            claim: Claim::Mean,
            ..psi.clone()
        };
        shared.map(of_mean).collect()
    }
}

/// Adds the end of a motion.
fn add_end(model: &mut Model, function: Id, end: SlideEnd) {
    let known = &model.interfaces[end.interface];
    let ident = format_ident!("end_{}", model.interfaces.len());
    let label = format!("end of sliding on {}", known.name());
    model.interfaces.push(Interface {
        attributes: Vec::new(),
        side: Model::side_of(&ident),
        ident,
        label: Some(label),
        is_switch: false,
        slides: false,
        end: Some(end),
        switching_function: function,
        span: known.span,
    });
}
