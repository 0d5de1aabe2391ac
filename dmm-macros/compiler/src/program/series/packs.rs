//! Nodes whose equations are equal up to their states and constants: their coefficients are computed
//! side by side, in the lanes of a vector. They come from loops and sums of a declaration, or from
//! equations that are alike by themselves.
//!
//! Two nodes are alike if their operations are the same and their operands are alike; all states are, and
//! all that is constant in time. The lanes follow the operands' lanes, so that most vectors are operands of
//! others as they are. In straight-line code two products that are alike are worth a vector of two.

use std::collections::{BTreeSet, HashMap};
use std::ops::Range;

use egg::Language;

use super::Sums;
use crate::algebra::{Equation, Id, Math, Name};
use crate::program::Lowered;

/// Lanes of a vector.
pub const LANES: usize = 4;
/// Fewer nodes are not worth one.
const LEAST: usize = 3;
/// Lanes of a vector for two products in straight-line code.
pub const PAIR: usize = 2;

/// Nodes that change with the time, operands before what is made of them.
pub(super) struct Packed {
    /// The nodes, those of a pack one after the other.
    pub(super) nodes: Vec<Id>,
    /// Where the packs are among them.
    pub(super) packs: Vec<Range<usize>>,
}

impl Packed {
    /// The nodes `moving`, children before parents, of which `depth` operations follow on each other;
    /// `uses` are how often each is an operand or a root. Products that are alike make `pairs`, if so
    /// wanted.
    pub(super) fn new(
        (lowered, sums, pairs): (&Lowered, Sums, bool),
        moving: &[Id],
        depth: impl Fn(Id) -> usize,
        uses: &HashMap<Id, usize>,
    ) -> Self {
        let runs = runs(lowered, moving, depth);
        let mut packing = Packing::new(lowered, &runs, absorbed(lowered, &runs, uses));
        for run in &runs {
            let is_moved = sums == Sums::Straight && moves_operands(lowered, run);
            if has_recurrence(lowered, run[0], sums) && !is_moved {
                packing.pack_in_order(run);
            }
        }
        packing.pack_operands();
        for run in runs.iter().filter(|run| is_linear(lowered, run[0])) {
            packing.pack_along_operands(run);
        }
        if pairs {
            packing.pair_products(&runs);
        }
        let variables = moving.iter().filter(|&&id| is_variable(lowered, id));
        packing.in_order(variables.copied().collect(), &runs)
    }
}

/// The packs so far.
struct Packing<'a> {
    lowered: &'a Lowered,
    /// By node, the number of its run.
    runs: HashMap<Id, usize>,
    packs: Vec<Vec<Id>>,
    /// The nodes that are in a pack.
    packed: BTreeSet<Id>,
    /// The nodes that are not to be.
    single: BTreeSet<Id>,
}

impl<'a> Packing<'a> {
    fn new(lowered: &'a Lowered, runs: &[Vec<Id>], single: BTreeSet<Id>) -> Self {
        let numbered = runs.iter().enumerate();
        let numbered = numbered.flat_map(|(number, run)| run.iter().map(move |&id| (id, number)));
        Self {
            lowered,
            runs: numbered.collect(),
            packs: Vec::new(),
            packed: BTreeSet::new(),
            single,
        }
    }

    /// The `first` nodes and those of all runs, the packs of a run before its other nodes.
    fn in_order(&self, first: Vec<Id>, runs: &[Vec<Id>]) -> Packed {
        let mut nodes = first;
        let mut packs = Vec::new();
        for (number, run) in runs.iter().enumerate() {
            let of_run = |pack: &&Vec<Id>| self.runs.get(&pack[0]) == Some(&number);
            for pack in self.packs.iter().filter(of_run) {
                packs.push(nodes.len()..nodes.len() + pack.len());
                nodes.extend(pack);
            }
            nodes.extend(run.iter().filter(|id| !self.packed.contains(id)));
        }
        Packed { nodes, packs }
    }

    /// Makes a pack of some nodes, if they are alike and none is in one.
    fn add(&mut self, pack: Vec<Id>) {
        let run = self.runs.get(&pack[0]);
        let is_free = |id: &Id| {
            self.runs.get(id) == run && !self.packed.contains(id) && !self.single.contains(id)
        };
        let different: BTreeSet<Id> = pack.iter().copied().collect();
        let is_pack = run.is_some() && pack.iter().all(is_free) && different.len() == pack.len();
        if is_pack {
            self.packed.extend(&pack);
            self.packs.push(pack);
        }
    }

    /// Packs of nodes one after the other.
    fn pack_in_order(&mut self, run: &[Id]) {
        let mut rest = run;
        for size in sizes(run.len()) {
            let (pack, others) = rest.split_at(size);
            self.add(pack.to_vec());
            rest = others;
        }
    }

    /// Pairs of products that are in no pack, and of the squares of their factors: two more sums at once.
    /// (Squares by themselves gain nothing: 1.1 of the time of a series of Hénon–Heiles.)
    fn pair_products(&mut self, runs: &[Vec<Id>]) {
        let lowered = self.lowered;
        let mut factors = BTreeSet::new();
        let is_kind = |run: &[Id], is_square: bool| match lowered.dag()[run[0]] {
            Math::Mul([a, b]) => !is_linear(lowered, run[0]) && (a == b) == is_square,
            _ => false,
        };
        for run in runs.iter().filter(|run| is_kind(run, false)) {
            if moves_operands(lowered, run) {
                continue;
            }
            for pair in self.left(run).chunks_exact(PAIR) {
                factors.extend(operands(lowered, pair));
                self.add(pair.to_vec());
            }
        }
        for run in runs.iter().filter(|run| is_kind(run, true)) {
            for pair in self.left(run).chunks_exact(PAIR) {
                if factors.contains(&operands(lowered, pair)[0]) {
                    self.add(pair.to_vec());
                }
            }
        }
    }

    /// The nodes of a run that are in no pack.
    fn left(&self, run: &[Id]) -> Vec<Id> {
        let left = run.iter().filter(|id| !self.packed.contains(id));
        left.copied().collect()
    }

    /// Packs of what is linear and the operand of a pack, lane by lane.
    fn pack_operands(&mut self) {
        let mut number = 0;
        while let Some(pack) = self.packs.get(number) {
            for operand in operands(self.lowered, pack) {
                if is_linear(self.lowered, operand[0]) {
                    self.add(operand);
                }
            }
            number += 1;
        }
    }

    /// Packs of the nodes of a run that have a pack as an operand, lane by lane. What is linear gains
    /// nothing where all operands have to be gathered.
    fn pack_along_operands(&mut self, run: &[Id]) {
        let sides = self.lowered.dag()[run[0]].children().len();
        for side in 0..sides {
            let mut of_operand: HashMap<Id, Vec<Id>> = HashMap::new();
            for &id in run {
                let operand = self.lowered.dag()[id].children()[side];
                of_operand.entry(operand).or_default().push(id);
            }
            for number in 0..self.packs.len() {
                let users = self.packs[number].iter().map(|id| of_operand.get(id));
                let Some(users) = users.collect::<Option<Vec<&Vec<Id>>>>() else {
                    continue;
                };
                let most = users.iter().map(|of| of.len()).min().unwrap_or(0);
                for which in 0..most {
                    self.add(users.iter().map(|of| of[which]).collect());
                }
            }
        }
    }
}

/// The operands of a pack, by side.
fn operands(lowered: &Lowered, pack: &[Id]) -> Vec<Vec<Id>> {
    let sides = lowered.dag()[pack[0]].children().len();
    let operand = |id: Id, side: usize| lowered.dag()[id].children()[side];
    (0..sides)
        .map(|side| pack.iter().map(|&id| operand(id, side)).collect())
        .collect()
}

/// Whether a node is linear in what changes with the time.
fn is_linear(lowered: &Lowered, id: Id) -> bool {
    match lowered.dag()[id] {
        Math::Add(_) | Math::Sub(_) | Math::Neg(_) => true,
        Math::Mul([a, b]) => lowered.is_fixed(a) || lowered.is_fixed(b),
        _ => false,
    }
}

/// The sizes of the packs of so many nodes: as many nodes as can be, in as few packs.
fn sizes(nodes: usize) -> Vec<usize> {
    let rest = nodes % LANES;
    let threes = match rest {
        LEAST => 1,
        1 | 2 if nodes > LANES + 1 => LANES - rest,
        _ => 0,
    };
    let fours = (nodes - LEAST * threes) / LANES;
    [vec![LANES; fours], vec![LEAST; threes]].concat()
}

/// Whether nodes have the operands of each other, from other lanes: moving them lengthens the chain of each
/// order. (The rigid body would take 1.12 of the time at 12 orders, and 0.86 at 22.)
fn moves_operands(lowered: &Lowered, run: &[Id]) -> bool {
    let mut lanes: HashMap<Id, usize> = HashMap::new();
    for &id in run {
        let operands: BTreeSet<Id> = lowered.dag()[id].children().iter().copied().collect();
        for operand in operands {
            *lanes.entry(operand).or_default() += 1;
        }
    }
    lanes.values().any(|&count| 1 < count && count < run.len())
}

/// The nodes that are alike, at least one in each run, in the order of their operands; operands first.
fn runs(lowered: &Lowered, moving: &[Id], depth: impl Fn(Id) -> usize) -> Vec<Vec<Id>> {
    let mut shapes = Shapes::default();
    let mut runs: HashMap<usize, Vec<Id>> = HashMap::new();
    let mut order: Vec<(usize, usize)> = Vec::new();
    for &id in moving {
        let shape = shapes.add(lowered, id);
        if !is_variable(lowered, id) {
            let run = runs.entry(shape).or_default();
            if run.is_empty() {
                order.push((depth(id), shape));
            }
            run.push(id);
        }
    }
    // by depth, and as they come
    order.sort_by_key(|&(depth, _)| depth);
    let variables = moving.iter().filter(|&&id| is_variable(lowered, id));
    let mut ranks: HashMap<Id, usize> = variables.copied().zip(1..).collect();
    let sorted = order.into_iter().map(|(_, shape)| {
        let mut run = runs.remove(&shape).unwrap_or_default();
        run.sort_by_cached_key(|&id| {
            let children = lowered.dag()[id].children().iter();
            let ranks = children.map(|child| ranks.get(child).copied().unwrap_or(0));
            ranks.collect::<Vec<usize>>()
        });
        for &id in &run {
            ranks.insert(id, ranks.len() + 1);
        }
        run
    });
    sorted.collect()
}

fn is_variable(lowered: &Lowered, id: Id) -> bool {
    matches!(lowered.dag()[id], Math::Variable(_))
}

/// The shapes of nodes: those that are alike have the same one.
#[derive(Default)]
struct Shapes {
    numbers: HashMap<(Math, bool), usize>,
    of_nodes: HashMap<Id, usize>,
}

impl Shapes {
    /// That of a node whose children have theirs. What is constant in time has number 0.
    fn add(&mut self, lowered: &Lowered, id: Id) -> usize {
        let node = &lowered.dag()[id];
        let is_square = matches!(node, Math::Mul([a, b]) if a == b);
        let node = match node {
            Math::Variable(_) => Math::Variable(Name::new("state")),
            node => node.clone().map_children(|child| {
                let shape = self.of_nodes.get(&child);
                Id::from(shape.copied().unwrap_or(0))
            }),
        };
        let next = self.numbers.len() + 1;
        let shape = *self.numbers.entry((node, is_square)).or_insert(next);
        self.of_nodes.insert(id, shape);
        shape
    }
}

/// Whether nodes like this one have a recurrence that is computed side by side.
fn has_recurrence(lowered: &Lowered, id: Id, sums: Sums) -> bool {
    let is_moving = |id: Id| !lowered.is_fixed(id);
    match lowered.dag()[id] {
        Math::Mul([a, b]) => is_moving(a) && is_moving(b),
        Math::Div([_, b]) => is_moving(b),
        // by a sum of its own in straight-line code
        Math::Pow([a, b]) => sums != Sums::Straight && is_moving(a) && !is_moving(b),
        Math::Call(function, _) => matches!(
            function.properties().equation,
            Equation::Root | Equation::Exponential | Equation::Pair { .. }
        ),
        _ => false,
    }
}

/// Products with constants that enter sums of packs alone, by a fused operation there.
fn absorbed(lowered: &Lowered, runs: &[Vec<Id>], uses: &HashMap<Id, usize>) -> BTreeSet<Id> {
    let mut products = BTreeSet::new();
    for run in runs.iter().filter(|run| run.len() >= LEAST) {
        let terms: Vec<Id> = run
            .iter()
            .filter_map(|&id| fused_term(lowered, id))
            .collect();
        let is_free = |id: &Id| uses.get(id) == Some(&1);
        if terms.len() == run.len() && terms.iter().all(is_free) {
            products.extend(terms);
        }
    }
    products
}

/// The operand of a sum that is a product with a constant and may be computed with the sum. The difference
/// of two products stays as it is: it is zero where they are equal.
pub fn fused_term(lowered: &Lowered, id: Id) -> Option<Id> {
    let is_multiple = |id: &Id| match lowered.dag()[*id] {
        Math::Mul([a, b]) => lowered.is_fixed(a) != lowered.is_fixed(b),
        _ => false,
    };
    match lowered.dag()[id] {
        Math::Add([a, b]) => [b, a].into_iter().find(is_multiple),
        Math::Sub([a, b]) if !(is_multiple(&a) && is_multiple(&b)) => {
            [b, a].into_iter().find(is_multiple)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packs_hold_as_many_nodes_as_can_be() {
        let of = |nodes: usize| sizes(nodes);
        assert_eq!([of(2), of(3), of(4)], [vec![], vec![3], vec![4]]);
        assert_eq!([of(5), of(6)], [vec![4], vec![3, 3]]);
        assert_eq!([of(7), of(9)], [vec![4, 3], vec![3, 3, 3]]);
        assert_eq!([of(10), of(11)], [vec![4, 3, 3], vec![4, 4, 3]]);
        for nodes in 6..100 {
            assert_eq!(of(nodes).iter().sum::<usize>(), nodes);
        }
    }

    /// The series of a system without interfaces.
    fn series(declaration: &str) -> crate::program::Series {
        let tokens = declaration.parse().expect("tokens");
        let scheme = crate::read(tokens).expect("the declaration holds");
        let mut program = crate::program::Program::new(&scheme);
        program.dynamics.remove(0).series
    }

    #[test]
    fn products_that_are_alike_make_pairs_with_the_squares_of_their_factors() {
        let planet = series(
            "system Planet {
                state x, y, u, v;
                param mu = 1;
                der(x) = u;
                der(y) = v;
                der(u) = -mu * x / sqrt(x^2 + y^2)^3;
                der(v) = -mu * y / sqrt(x^2 + y^2)^3;
                conserved momentum = x * v - y * u;
            }",
        );
        assert_eq!(planet.sums, Sums::Straight);
        let sizes: Vec<usize> = planet.packs.iter().map(ExactSizeIterator::len).collect();
        assert_eq!(sizes, [PAIR, PAIR]);
        // -mu r⁻³ is computed in place of r⁻³
        assert_eq!(planet.multiples.len(), 1);
        // x and y, r⁻³ and its derivative
        assert_eq!(planet.tables.pairs().count(), 2);
    }

    #[test]
    fn squares_alone_make_no_pair() {
        let star = series(
            "system Star {
                state x, y, u, v;
                hamiltonian energy = (u^2 + v^2) / 2 + (x^2 + y^2) / 2 + x^2 * y - y^3 / 3
                    in (x, u), (y, v);
            }",
        );
        assert!(star.packs.is_empty());
        assert_eq!(star.tables.pairs().count(), 0);
    }
}
