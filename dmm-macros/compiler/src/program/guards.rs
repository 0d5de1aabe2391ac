//! The functions whose zeros end a region: g of the interfaces, and behind them the functions of
//! the checked conditions, which are positive where what is proved of a region holds.
//!
//! The functions are the same for every region; only the sides differ. Of a condition u ≠ 0 it is
//! ±u that is positive, with the sign that u has where the region is entered.

use super::function::{Functions, Quantity, Variables};
use super::inputs::{Table, at_point};
use super::lower::Lowered;
use super::optimise::Optimiser;
use super::results::Results;
use super::series::Series;
use super::size::rounding;
use crate::algebra::{Dag, Id, Name};
use crate::model::{Region, Sign};
use crate::proofs::Derivatives;
use crate::scheme::{CheckedCondition, Scheme, SwitchingScheme};

/// The program of the interfaces and the checked conditions of a system.
#[derive(Debug)]
pub struct Guards {
    /// How many functions g there are.
    pub count: usize,
    /// g, a bound of the rounding error of g, and (∂ₜg, ∇g) of each.
    pub functions: Functions,
    /// The recurrences of the Taylor coefficients of every g along a solution.
    pub series: Series,
    /// By region: the functions that bound it with the sign that they have there, interfaces
    /// before conditions.
    pub sides: Vec<Vec<(usize, GuardSide)>>,
    /// The conditions that are positive with either sign.
    pub oriented: Vec<usize>,
    /// The number of the first condition, if there is one.
    pub first_condition: Option<usize>,
    /// Whether no g depends on the time.
    pub autonomous: bool,
    /// The greatest degree of a g as a polynomial in t and x, if all are polynomials.
    pub degree: Option<u32>,
}

impl Guards {
    /// The functions of `scheme`; `dag` has the nodes of the scheme.
    pub(super) fn new(
        scheme: &Scheme,
        dag: &mut Dag,
        parameters: &[Name],
        optimiser: &mut Optimiser,
    ) -> Self {
        let mut written = Lowered::new(parameters.to_vec());
        let mut target = Lowered::new(parameters.to_vec());
        let nodes: Vec<Nodes> = switching(scheme)
            .map(|(function, switching)| {
                let derivatives = &switching.derivatives;
                let nodes = Nodes::lower(dag, &mut written, &mut target, function, derivatives);
                nodes.optimised(&written, &mut target, optimiser)
            })
            .collect();
        let roots: Vec<Id> = nodes.iter().map(|nodes| nodes.value).collect();
        let results = nodes.into_iter().enumerate();
        let results = results.flat_map(|(index, nodes)| nodes.results(index));
        let states = scheme.model.state_names();
        let variables = Variables {
            at_point: at_point(&states),
            over_step: Table::new(),
            solved: Table::new(),
        };
        let functions = Functions::new(target, results.collect(), &variables, parameters);
        let has_conditions = scheme.checked_conditions().next().is_some();
        Self {
            count: roots.len(),
            series: Series::along_solution(&functions, &states, &roots),
            functions,
            sides: sides(scheme),
            oriented: oriented(scheme),
            first_condition: has_conditions.then_some(scheme.interfaces.len()),
            autonomous: switching(scheme).all(|(_, derived)| derived.autonomous),
            degree: switching(scheme)
                .map(|(_, derived)| derived.degree)
                .reduce(|a, b| Some(a?.max(b?)))
                .flatten(),
        }
    }
}

/// The sign of a function in a region.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GuardSide {
    /// It is known.
    Fixed(Sign),
    /// It is positive where the parameter of this number is 1, and negative where it is 0.
    Free(usize),
}

/// The switching functions of the interfaces, then the functions of the conditions.
fn switching(scheme: &Scheme) -> impl Iterator<Item = (Id, &SwitchingScheme)> {
    let interfaces = scheme.model.interfaces.iter().zip(&scheme.interfaces);
    let interfaces = interfaces.map(|(interface, derived)| (interface.switching_function, derived));
    interfaces.chain(
        scheme
            .checked_conditions()
            .map(|condition| (condition.function, &condition.switching)),
    )
}

/// The conditions that a trajectory can come to, with their numbers behind the interfaces.
fn conditions(scheme: &Scheme) -> impl Iterator<Item = (usize, &CheckedCondition)> {
    let numbered = (scheme.model.interfaces.len()..).zip(scheme.checked_conditions());
    numbered.filter(|(_, condition)| !condition.is_fixed)
}

/// The sides of every region.
fn sides(scheme: &Scheme) -> Vec<Vec<(usize, GuardSide)>> {
    let model = &scheme.model;
    let free = model.free_interfaces();
    let first = model.parameters.len() + model.discrete.len();
    let of_region = |(index, region): (usize, &Region)| {
        let bounds = |interface: usize| region.sides.iter().any(|one| one.interface == interface);
        let fixed = region.sides.iter();
        let fixed = fixed.map(|one| (one.interface, GuardSide::Fixed(one.sign)));
        let slide = region.slide.as_ref();
        let slides = |one: usize| slide.is_some_and(|slide| slide.on.contains(&one));
        let in_place = |one: usize| {
            let mut switches = slide.iter().flat_map(|slide| &slide.switches);
            let masked = switches.find(|(interface, _)| *interface == one);
            masked.map_or(one, |&(_, masked)| masked)
        };
        let free = free.iter().enumerate();
        let free = free.filter(|(_, one)| !bounds(**one) && !slides(**one));
        let free = free.map(|(place, &one)| (in_place(one), GuardSide::Free(first + place)));
        let conditions = conditions(scheme)
            .filter(|(_, condition)| condition.region == index)
            .map(|(number, _)| (number, GuardSide::Fixed(Sign::Positive)));
        fixed.chain(free).chain(conditions).collect()
    };
    model.regions.iter().enumerate().map(of_region).collect()
}

/// The numbers of the conditions that keep a sign.
fn oriented(scheme: &Scheme) -> Vec<usize> {
    let oriented = conditions(scheme).filter(|(_, condition)| condition.keeps_sign());
    oriented.map(|(number, _)| number).collect()
}

/// The nodes of one function.
struct Nodes {
    /// g
    value: Id,
    /// A bound of the rounding error of g.
    size: Id,
    /// ∂ₜg
    time_derivative: Id,
    /// ∇g
    gradient: Vec<Id>,
}

impl Nodes {
    /// The operations as they are written; the bound stays so, and is in `target` already.
    fn lower(
        dag: &mut Dag,
        written: &mut Lowered,
        target: &mut Lowered,
        function: Id,
        derivatives: &Derivatives,
    ) -> Self {
        let size = rounding(dag, function);
        let size = written.lower(dag, size);
        Self {
            value: written.lower(dag, function),
            size: target.copy(written, size),
            time_derivative: written.lower(dag, derivatives.time_derivative),
            gradient: derivatives
                .gradient
                .iter()
                .map(|&entry| written.lower(dag, entry))
                .collect(),
        }
    }

    /// The same by fewer operations.
    fn optimised(
        mut self,
        written: &Lowered,
        target: &mut Lowered,
        optimiser: &mut Optimiser,
    ) -> Self {
        let mut gradient = vec![&mut self.time_derivative];
        gradient.extend(&mut self.gradient);
        target.optimise(written, vec![vec![&mut self.value], gradient], optimiser);
        self
    }

    /// The functions of number `index`.
    fn results(self, index: usize) -> [(Quantity, Results); 3] {
        let gradient = Results::ScalarAndColumn(self.time_derivative, self.gradient);
        [
            (
                Quantity::SwitchingFunction(index),
                Results::Scalar(self.value),
            ),
            (Quantity::SwitchingSize(index), Results::Scalar(self.size)),
            (Quantity::SwitchingGradient(index), gradient),
        ]
    }
}
