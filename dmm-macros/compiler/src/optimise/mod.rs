//! Optimisation: the lowered operations of some functions → fewer and cheaper operations with
//! the same values, and no worse rounding errors.
//!
//! Equality saturation ([`egg`], Willsey et al. 2021) by the table of rules finds equal forms;
//! the one with the least `cost` of each function is chosen by a hill-climb that starts from
//! the form as it came. A function is never more expensive than with plain sharing. Limits are
//! numbers of iterations and nodes and never a time, so that the same declaration gives the
//! same code on every machine.

mod cluster;
mod cost;
mod extract;
mod form;
mod graph;
mod rules;
mod saturate;
mod table;

#[cfg(test)]
mod tests;

use std::collections::HashMap;

use egg::{Id, Language};

use extract::{Selection, cheapest};
use form::Form;
use saturate::Saturation;
use table::{Class, Table};

use crate::algebra::{Dag, Math, Name};
pub use cost::Count;

/// Functions to be optimised: lists of roots in one DAG of lowered operations.
pub struct Program<'a> {
    /// The operations.
    pub dag: &'a Dag,
    /// Whether a node depends on parameters and constants alone: it is computed once a flow.
    pub is_fixed: &'a dyn Fn(Id) -> bool,
    /// Whether a node has to stay as it is, with everything below it.
    pub is_atom: &'a dyn Fn(Id) -> bool,
    /// The results of every function. Operations are shared within a function only.
    pub functions: Vec<Vec<Id>>,
}

/// Optimises programs, and remembers them.
#[derive(Default)]
pub struct Optimiser {
    known: HashMap<Form, Solution>,
}

impl Optimiser {
    /// Optimises a program. Nodes of the result are made by `insert`, children before parents;
    /// the roots of every function are returned in their order.
    pub fn optimise(
        &mut self,
        program: &Program<'_>,
        insert: &mut dyn FnMut(Math) -> Id,
    ) -> Vec<Vec<Id>> {
        let mut made = HashMap::new();
        if program.size() <= cluster::LARGEST_WHOLE {
            return self.solve(program, &program.functions, true, &mut made, insert);
        }
        let functions = program.functions.iter().map(|roots| {
            made.clear();
            for results in cluster::clusters(program, roots) {
                let results: Vec<Id> = results.into_iter().collect();
                let images = self.solve(
                    program,
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
        program: &Program<'_>,
        functions: &[Vec<Id>],
        whole: bool,
        made: &mut HashMap<Id, Id>,
        insert: &mut dyn FnMut(Math) -> Id,
    ) -> Vec<Vec<Id>> {
        let (form, leaves) = Form::new(program, functions, made);
        let solution = match self.known.get(&form) {
            Some(solution) => solution,
            None => {
                let solution = Solution::new(&form, whole);
                self.known.entry(form).or_insert(solution)
            }
        };
        solution.write(program, &leaves, made, insert)
    }
}

impl Program<'_> {
    /// The number of operations.
    fn size(&self) -> usize {
        form::reachable(self, &self.functions, &HashMap::new()).len()
    }
}

/// An optimised form.
struct Solution {
    /// The operations, children first.
    nodes: Vec<Math>,
    /// The results of every function.
    functions: Vec<Vec<Id>>,
}

impl Solution {
    fn new(form: &Form, whole: bool) -> Self {
        let saturation = Saturation::new(form, whole);
        let table = Table::new(&saturation.graph);
        let first = saturation.first(form, &table);
        let mut solution = Self {
            nodes: Vec::new(),
            functions: Vec::new(),
        };
        for roots in &form.functions {
            let classes: Vec<Class> = roots
                .iter()
                .map(|&root| table.class(&saturation.graph, saturation.image[usize::from(root)]))
                .collect();
            let selection = cheapest(&table, &classes, &first);
            let mut values = HashMap::new();
            let images = classes
                .iter()
                .map(|&class| solution.add(&selection, class, &mut values))
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
        values: &mut HashMap<Class, Id>,
    ) -> Id {
        if let Some(&value) = values.get(&class) {
            return value;
        }
        let (node, operands) = selection.operation(class);
        let operands: Vec<Id> = operands
            .iter()
            .map(|&operand| self.add(selection, operand, values))
            .collect();
        let mut operands = operands.into_iter();
        let node = node
            .clone()
            .map_children(|operand| operands.next().unwrap_or(operand));
        let value = Id::from(self.nodes.len());
        self.nodes.push(node);
        values.insert(class, value);
        value
    }

    /// Makes the nodes by `insert`, with what the leaves stand for in `program`.
    fn write(
        &self,
        program: &Program<'_>,
        leaves: &HashMap<Name, Id>,
        copies: &mut HashMap<Id, Id>,
        insert: &mut dyn FnMut(Math) -> Id,
    ) -> Vec<Vec<Id>> {
        let mut made: Vec<Id> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let leaf = match node {
                Math::Variable(name) => leaves.get(name),
                _ => None,
            };
            made.push(match leaf {
                Some(&leaf) => copy(program.dag, leaf, copies, insert),
                None => insert(node.clone().map_children(|child| made[usize::from(child)])),
            });
        }
        self.functions
            .iter()
            .map(|roots| roots.iter().map(|&root| made[usize::from(root)]).collect())
            .collect()
    }
}

/// Inserts `root` of `dag` as it is.
fn copy(
    dag: &Dag,
    root: Id,
    copies: &mut HashMap<Id, Id>,
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
