//! Optimisation: the lowered operations of some functions → fewer and cheaper operations with
//! the same values, and no worse rounding errors.
//!
//! Equality saturation ([`egg`], Willsey et al. 2021) by the table of rules finds equal forms;
//! the one with the least `cost` of each function is chosen by a hill-climb that starts from
//! the form as it came. A function is never more expensive than with plain sharing. Limits are
//! numbers of iterations and nodes and never a time, so that the same declaration gives the
//! same code on every machine.

mod cluster;
mod constants;
mod cost;
mod extract;
mod form;
mod graph;
mod operation;
mod pattern;
mod rules;
mod saturate;
mod selection;
mod snapshot;
mod table;

#[cfg(test)]
mod tests;

use std::collections::HashMap;

use egg::{Id, Language};
use rustc_hash::FxHashMap;

use constants::Constants;
use extract::cheapest;
use form::{Form, Results};
use operation::{Operation, Symbol};
use saturate::Saturation;
use selection::Selection;
use table::{Class, Node, Table};

use crate::algebra::{Dag, Math};
pub use cost::Count;

/// The functions to be optimised: lists of roots in one DAG of lowered operations.
pub struct Source<'a> {
    /// The operations.
    pub dag: &'a Dag,
    /// Whether a node depends on parameters and constants alone, and is stored.
    pub is_fixed: &'a dyn Fn(Id) -> bool,
    /// Whether a node has to stay as it is, with everything below it.
    pub is_atom: &'a dyn Fn(Id) -> bool,
    /// The results of every function. Operations are shared within a function only.
    pub functions: Vec<Vec<Id>>,
}

/// Optimises functions, and remembers them.
#[derive(Default)]
pub struct Optimiser {
    /// Whether operations are only copied.
    copies: bool,
    /// By the operations of a form: what is equal to them, and what was chosen of that.
    known: HashMap<Vec<Operation>, Vec<Saturated>>,
}

impl Optimiser {
    /// One that leaves operations as they are.
    pub fn without_rules() -> Self {
        Self {
            copies: true,
            ..Self::default()
        }
    }

    /// Optimises a source. Nodes of the result are made by `insert`, children before parents;
    /// the roots of every function are returned in their order.
    pub fn optimise(
        &mut self,
        source: &Source<'_>,
        insert: &mut dyn FnMut(Math) -> Id,
    ) -> Vec<Vec<Id>> {
        let mut made = FxHashMap::default();
        if self.copies {
            let mut images = |roots: &Vec<Id>| -> Vec<Id> {
                let roots = roots.iter();
                roots
                    .map(|&root| copy(source.dag, root, &mut made, insert))
                    .collect()
            };
            return source.functions.iter().map(&mut images).collect();
        }
        if source.size() <= cluster::LARGEST_WHOLE {
            return self.solve(source, &source.functions, true, &mut made, insert);
        }
        let functions = source.functions.iter().map(|roots| {
            made.clear();
            for results in cluster::clusters(source, roots) {
                let results: Vec<Id> = results.into_iter().collect();
                let images = self.solve(
                    source,
                    std::slice::from_ref(&results),
                    false,
                    &mut made,
                    insert,
                );
                made.extend(results.into_iter().zip(images.concat()));
            }
            roots.iter().map(|root| made[root]).collect()
        });
        functions.collect()
    }

    /// The images of the results of `functions`; those of some nodes are already `made`.
    fn solve(
        &mut self,
        source: &Source<'_>,
        functions: &[Vec<Id>],
        whole: bool,
        made: &mut FxHashMap<Id, Id>,
        insert: &mut dyn FnMut(Math) -> Id,
    ) -> Vec<Vec<Id>> {
        let (form, results, leaves) = Form::new(source, functions, made);
        let alike = self.known.entry(form.nodes.clone()).or_default();
        // forms differ in their constants
        let index = match alike.iter().position(|known| known.is_of(&form, whole)) {
            Some(index) => index,
            None => {
                alike.push(Saturated::new(form, whole));
                alike.len() - 1
            }
        };
        let saturated = &mut alike[index];
        let solution = saturated.solution(results);
        solution.write(source, &leaves, made, insert)
    }
}

impl Source<'_> {
    /// The number of operations.
    fn size(&self) -> usize {
        form::reachable(self, &self.functions, &FxHashMap::default()).len()
    }
}

/// A form with what is equal to it.
struct Saturated {
    form: Form,
    whole: bool,
    table: Table,
    /// By node of the form: its class.
    classes: Vec<Class>,
    /// By class: the first node of the form in it.
    first: Vec<Node>,
    constants: Constants,
    /// The choices by the results they are made for.
    solutions: Vec<(Results, Solution)>,
}

impl Saturated {
    fn new(form: Form, whole: bool) -> Self {
        let saturation = Saturation::new(&form, whole);
        let table = Table::new(&saturation.graph);
        let classes = saturation.image.iter();
        Self {
            classes: classes
                .map(|&id| table.class(&saturation.graph, id))
                .collect(),
            first: saturation.first(&form, &table),
            form,
            whole,
            table,
            constants: saturation.graph.analysis.constants,
            solutions: Vec::new(),
        }
    }

    fn is_of(&self, form: &Form, whole: bool) -> bool {
        self.whole == whole && self.form == *form
    }

    /// The cheapest operations found for the `results` of functions.
    fn solution(&mut self, results: Results) -> &Solution {
        let known = self
            .solutions
            .iter()
            .position(|(known, _)| *known == results);
        let index = known.unwrap_or_else(|| {
            let solution = Solution::new(self, &results);
            self.solutions.push((results, solution));
            self.solutions.len() - 1
        });
        &self.solutions[index].1
    }
}

/// An optimised form.
struct Solution {
    /// The operations, children first.
    nodes: Vec<Operation>,
    /// The constants in them.
    constants: Constants,
    /// The results of every function.
    functions: Results,
}

impl Solution {
    fn new(of: &Saturated, results: &Results) -> Self {
        let mut solution = Self {
            nodes: Vec::new(),
            constants: of.constants.clone(),
            functions: Vec::new(),
        };
        let class = |root: &Id| of.classes[usize::from(*root)];
        let functions: Vec<Vec<Class>> = results
            .iter()
            .map(|roots| roots.iter().map(class).collect())
            .collect();
        let selections = cheapest(&of.table, &functions, &of.first);
        for (classes, selection) in functions.into_iter().zip(&selections) {
            let mut values = FxHashMap::default();
            let images = classes
                .into_iter()
                .map(|class| solution.add(selection, class, &mut values))
                .collect();
            solution.functions.push(images);
        }
        solution
    }

    /// Adds the node chosen for `class`, after those of its operands.
    fn add(
        &mut self,
        selection: &Selection<'_>,
        class: Class,
        values: &mut FxHashMap<Class, Id>,
    ) -> Id {
        if let Some(&value) = values.get(&class) {
            return value;
        }
        let (node, operands) = selection.operation(class);
        let operands: Vec<Id> = operands
            .map(|operand| self.add(selection, operand, values))
            .collect();
        let value = Id::from(self.nodes.len());
        self.nodes.push(Operation::new(node.symbol, &operands));
        values.insert(class, value);
        value
    }

    /// Makes the nodes by `insert`, with what the leaves stand for in `source`.
    fn write(
        &self,
        source: &Source<'_>,
        leaves: &[Id],
        copies: &mut FxHashMap<Id, Id>,
        insert: &mut dyn FnMut(Math) -> Id,
    ) -> Vec<Vec<Id>> {
        let mut made: Vec<Id> = Vec::with_capacity(self.nodes.len());
        for operation in &self.nodes {
            let mut operands: Vec<Id> = operation.children().to_vec();
            if operation.symbol.is_commutative() {
                self.arrange(operation.symbol, &mut operands);
            }
            for operand in &mut operands {
                *operand = made[usize::from(*operand)];
            }
            made.push(match operation.symbol {
                Symbol::Fixed(leaf) | Symbol::Varying(leaf) => {
                    copy(source.dag, leaves[leaf as usize], copies, insert)
                }
                Symbol::Constant(number) => {
                    insert(Math::Constant(self.constants.value(number).clone()))
                }
                symbol => match symbol.node(&operands) {
                    Some(node) => insert(node),
                    None => unreachable!("an operation has its operands"),
                },
            });
        }
        self.functions
            .iter()
            .map(|roots| roots.iter().map(|&root| made[usize::from(root)]).collect())
            .collect()
    }

    /// The operands of a sum or product in the order in which one writes them: a constant is
    /// the first factor, and the last term.
    fn arrange(&self, symbol: Symbol, operands: &mut [Id]) {
        let is_constant =
            |id: Id| matches!(self.nodes[usize::from(id)].symbol, Symbol::Constant(_));
        if let [a, b] = operands
            && is_constant(*a) != is_constant(*b)
            && is_constant(*a) == (symbol == Symbol::Add)
        {
            operands.swap(0, 1);
        }
    }
}

/// Inserts `root` of `dag` as it is.
fn copy(
    dag: &Dag,
    root: Id,
    copies: &mut FxHashMap<Id, Id>,
    insert: &mut dyn FnMut(Math) -> Id,
) -> Id {
    if let Some(&copy) = copies.get(&root) {
        return copy;
    }
    for id in dag.reachable([root]) {
        if !copies.contains_key(&id) {
            let node = dag[id].clone().map_children(|child| copies[&child]);
            copies.insert(id, insert(node));
        }
    }
    copies[&root]
}
