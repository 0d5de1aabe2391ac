//! The recurrences of the Taylor coefficients: of a solution, and of the switching functions
//! along it.
//!
//! Every node of the expressions is a power series in the time. What is linear in other nodes
//! is computed coefficient by coefficient like a number; the rest are recurrences (Jorba & Zou,
//! Experimental Mathematics 14, 2005). A node whose lower coefficients a recurrence needs has a
//! slot, an array of coefficients.
//!
//! Coefficients are those of (t − t₀)ᵏ for one k after the other, over all nodes. The result of
//! order k of a root ẋᵢ = f is the coefficient k + 1 of xᵢ: that of f divided by k + 1.

mod choice;
mod packs;
mod recurrence;
mod scaled;
mod shortest;
mod slots;
mod tables;

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::ops::Range;

use egg::Language;

use self::choice::Choice;
use self::packs::Packed;
use self::scaled::Scaling;
use self::slots::Slots;
use super::function::Functions;
use super::inputs::{Input, at_point, inputs};
use super::lower::Lowered;
use crate::algebra::{Id, Name};
pub use packs::{LANES, PAIR, fused_term};
pub use recurrence::{Base, Place, Primitive, Recurrence, Shifted, Sum};
pub use scaled::{Factor, Later, Scaled, multiple};
pub(super) use shortest::for_series;
pub use tables::Tables;

/// Straight-line code by arrays up to so many recurrences. Time of a step by a loop over it, at tolerances of
/// 10⁻⁴, 10⁻⁸ and 10⁻¹²: Hénon–Heiles (3 recurrences) 1.69, 1.75, 1.65; Toda ring of 3 masses, a pack, 1.16,
/// 1.13, 1.08; Pöschl–Teller (4) 1.29, 1.51, 1.21; Kepler (5) 1.28, 1.35, 1.30; double pendulum (11) 1.00, 0.59,
/// 0.53; three bodies (15) 0.89, 0.69, 0.61.
const MOST_STRAIGHT: usize = 5;

/// Straight-line code by tables for steps of 12 orders up to so many recurrences. Time of a step by it over
/// that by a loop: double pendulum 0.87, chain of 4 masses (10) 0.75, of 8 (18) 0.83, three bodies 0.89. More
/// of it comes near the size of the cache of instructions.
const MOST_WITH_12: usize = 20;

/// The same for 18 orders: double pendulum 0.91, chain of 4 masses 0.81, of 8 0.93, three bodies 0.99 but up to
/// 1.8 where it lies at other addresses.
const MOST_WITH_18: usize = 12;

/// The recurrences of some roots.
#[derive(Debug)]
pub struct Series {
    /// The states and the time, where they occur.
    pub inputs: Vec<Input>,
    /// How many arrays of coefficients there are: those of the states of a solution or of the
    /// values of functions along it come first.
    pub slots: usize,
    /// How the sums over the coefficients are run.
    pub sums: Sums,
    /// Where generated code has the coefficients.
    pub tables: Tables,
    /// All operations, in the order in which they are evaluated.
    pub operations: Vec<Id>,
    /// The roots.
    pub roots: Vec<Id>,
    /// The coefficients of the nodes that change with the time, in the order in which they are
    /// computed.
    pub coefficients: Vec<Coefficient>,
    /// By power, the multiple of it that is all that is made of it, if a recurrence needs that: a multiple
    /// of u^c has the same recurrence, so that the power itself is not computed.
    pub multiples: BTreeMap<Id, Id>,
    /// Those that are computed side by side, up to [`LANES`] of them, whose recurrences are alike.
    pub packs: Vec<Range<usize>>,
    /// What is made of the roots.
    pub results: Vec<SeriesResult>,
}

/// How the sums over the coefficients of lower order are run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sums {
    /// Each by itself or in pairs, written out for every order.
    Straight,
    /// Several together, in lanes of tables: written out for Taylor steps of orders up to this, if there are
    /// such, and by loops for others.
    Mixed(usize),
}

impl Sums {
    /// Of so many recurrences.
    fn of(recurrences: usize) -> Self {
        if recurrences <= MOST_STRAIGHT {
            Self::Straight
        } else if recurrences <= MOST_WITH_18 {
            Self::Mixed(18)
        } else if recurrences <= MOST_WITH_12 {
            Self::Mixed(12)
        } else {
            Self::Mixed(0)
        }
    }
}

/// Coefficient k of a node.
#[derive(Debug)]
pub struct Coefficient {
    /// The node.
    pub node: Id,
    /// How its coefficient is computed.
    pub recurrence: Recurrence,
    /// The slot that keeps its coefficients, if a recurrence needs them.
    pub kept: Option<usize>,
    /// How many operations follow on each other until it is known.
    pub depth: usize,
}

/// What is made of the coefficient of a root.
#[derive(Debug)]
pub enum SeriesResult {
    /// Coefficient k itself.
    Value(Id),
    /// Coefficient k + 1 of a state whose derivative the root is.
    Solution {
        /// The coefficient of the root, to be multiplied by 1/(k + 1).
        value: Scaled,
        /// Coefficient k + 2, where it can be computed at once.
        later: Option<Later>,
    },
}

impl SeriesResult {
    /// The sums that it takes of the orders below, beside those of recurrences.
    fn sums(&self) -> impl Iterator<Item = Sum> {
        let (value, later) = match self {
            Self::Value(_) => (None, None),
            Self::Solution { value, later } => (value.sum(), later.as_ref()),
        };
        value
            .into_iter()
            .chain(later.and_then(|later| later.value.sum()))
    }
}

impl Series {
    /// The recurrences of the solution of ẋ = f(t, x).
    pub(super) fn of_solution(functions: &Functions, states: &[Name], field: &[Id]) -> Self {
        let parts = Parts::new(functions, states, field, states.len());
        let scaling = Scaling::new(&parts.choice, parts.uses(), field);
        let results = field.iter().map(|&root| SeriesResult::Solution {
            value: scaling.scaled(root),
            later: scaling.a_step_later(root),
        });
        let results = results.collect();
        let folded = scaling.folded;
        let pairs = parts.choice.slots.sums == Sums::Straight;
        parts.series(results, &folded, pairs)
    }

    /// The recurrences of some functions along a solution whose coefficients are given.
    pub(super) fn along_solution(functions: &Functions, states: &[Name], roots: &[Id]) -> Self {
        let parts = Parts::new(functions, states, roots, roots.len());
        let results = roots.iter().map(|&root| SeriesResult::Value(root));
        let results = results.collect();
        parts.series(results, &BTreeSet::new(), false)
    }
}

/// What a series is made from.
struct Parts<'a> {
    inputs: Vec<Input>,
    operations: Vec<Id>,
    choice: Choice<'a>,
    roots: Vec<Id>,
    /// Slots for the states or the values.
    first: usize,
}

impl<'a> Parts<'a> {
    fn new(functions: &'a Functions, states: &[Name], roots: &[Id], first: usize) -> Self {
        let lowered = &functions.lowered;
        let mut inputs = inputs(lowered, roots, &at_point(states));
        inputs.sort_by_key(|input| input.node);
        let stored = functions.stored.nodes();
        let given = inputs.iter().map(|input| input.node);
        let known: BTreeSet<Id> = stored.chain(given).collect();
        let moving = moving(lowered, roots);
        let slots = Slots::new(lowered, &inputs, &moving, first);
        Self {
            operations: lowered.order(roots, |id| known.contains(&id)),
            choice: Choice::new(lowered, slots, &moving),
            inputs,
            roots: roots.to_vec(),
            first,
        }
    }

    /// How often a node is an operand or a root.
    fn uses(&self) -> HashMap<Id, usize> {
        let dag = self.choice.lowered.dag();
        let mut uses: HashMap<Id, usize> = HashMap::new();
        for &id in &self.operations {
            dag[id].for_each(|child| *uses.entry(child).or_default() += 1);
        }
        for &root in &self.roots {
            *uses.entry(root).or_default() += 1;
        }
        uses
    }

    /// The series with the coefficients of the nodes that are not `folded`, of products in `pairs` if so
    /// wanted.
    fn series(self, results: Vec<SeriesResult>, folded: &BTreeSet<Id>, pairs: bool) -> Series {
        let lowered = self.choice.lowered;
        let mut moving = moving(lowered, &self.roots);
        moving.retain(|id| !folded.contains(id));
        let slots = &self.choice.slots;
        let sums = slots.sums;
        let end = self.first + slots.count();
        let depth = |id: Id| self.choice.depth(id);
        let uses = self.uses();
        let Packed { nodes, mut packs } =
            Packed::new((lowered, sums, pairs), &moving, depth, &uses);
        let coefficients = self.choice.coefficients(nodes.into_iter());
        packs.retain(|pack| {
            let mut recurrences = coefficients[pack.clone()].iter().map(|one| one.recurrence);
            recurrences.next().is_some_and(|first| {
                let kind = std::mem::discriminant(&first);
                recurrences.all(|other| std::mem::discriminant(&other) == kind)
                    && !matches!(first, Recurrence::Computed(_))
            })
        });
        let multiples = multiples_of_powers(lowered, (&coefficients, &packs), &uses);
        let tables = Tables::new((&coefficients, &packs), &results, self.first..end, sums);
        Series {
            slots: end,
            sums,
            tables,
            coefficients,
            multiples,
            packs,
            inputs: self.inputs,
            operations: self.operations,
            roots: self.roots,
            results,
        }
    }
}

/// The powers of which one multiple alone is used, which has a slot; none that is in a pack.
fn multiples_of_powers(
    lowered: &Lowered,
    (coefficients, packs): (&[Coefficient], &[Range<usize>]),
    uses: &HashMap<Id, usize>,
) -> BTreeMap<Id, Id> {
    let in_packs: BTreeSet<usize> = packs.iter().cloned().flatten().collect();
    let single = coefficients.iter().enumerate();
    let single = single.filter(|(index, _)| !in_packs.contains(index));
    let single: BTreeMap<Id, &Coefficient> = single.map(|(_, one)| (one.node, one)).collect();
    let mut multiples = BTreeMap::new();
    for (&top, _) in single.iter().filter(|(_, one)| one.kept.is_some()) {
        let mut id = top;
        while let Some((of, _)) = multiple(lowered, id).filter(|(of, _)| uses.get(of) == Some(&1)) {
            id = of;
        }
        let recurrence = single.get(&id).map(|one| one.recurrence);
        if id != top && matches!(recurrence, Some(Recurrence::Power { .. })) {
            multiples.insert(id, top);
        }
    }
    multiples
}

/// The nodes under the roots that change with the time, children before parents.
fn moving(lowered: &Lowered, roots: &[Id]) -> Vec<Id> {
    let mut nodes = lowered.dag().reachable(roots.iter().copied());
    nodes.retain(|&id| !lowered.is_fixed(id));
    nodes
}
