//! The two sides of a rule, compiled: patterns of one operation on variables, numbers, or
//! operations on variables. Of these a match is found by a few comparisons of plain numbers,
//! which is what counts where nothing is inlined.

use egg::{ENodeOrVar, Id, Language, PatternAst};

use super::constants::Constants;
use super::graph::Graph;
use super::operation::{Operation, Symbol};
use super::snapshot::Snapshot;
use crate::algebra::Math;

/// The variables of a pattern, `?a`, `?b` and `?c`.
pub(super) type Variables = [Id; 3];

/// What a pattern was found in, and what its variables stand for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Match {
    pub(super) class: Id,
    pub(super) variables: Variables,
}

/// Marks a variable that stands for nothing so far.
const UNBOUND: usize = u32::MAX as usize;

/// The left side of a rule.
#[derive(Debug)]
pub(super) struct Search {
    /// The operation of the whole.
    pub(super) symbol: Symbol,
    arguments: Vec<Argument>,
    /// Whether the operands may come the other way round, and that makes a difference.
    turns: bool,
}

/// An operand in a pattern.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Argument {
    Variable(usize),
    Constant(u32),
    Unary(Symbol, usize),
    Binary(Symbol, [usize; 2]),
}

impl Search {
    /// The search for a pattern.
    pub(super) fn new(pattern: &PatternAst<Math>) -> Self {
        let nodes: &[ENodeOrVar<Math>] = pattern.as_ref();
        let root = node(nodes, nodes.len() - 1);
        let symbol = Symbol::of(root).expect("an operation");
        let arguments: Vec<Argument> = root
            .children()
            .iter()
            .map(|&child| Argument::new(nodes, usize::from(child)))
            .collect();
        let turns = match arguments.as_slice() {
            [a, b] => symbol.is_commutative() && a.shape() != b.shape(),
            _ => false,
        };
        Self {
            symbol,
            arguments,
            turns,
        }
    }

    /// Adds what `operation` in `class` matches to `found`.
    pub(super) fn find(
        &self,
        classes: &Snapshot,
        class: Id,
        operation: &Operation,
        found: &mut Vec<Match>,
    ) {
        if operation.symbol != self.symbol {
            return;
        }
        let start = Match {
            class,
            variables: [Id::from(UNBOUND); 3],
        };
        match (self.arguments.as_slice(), operation.children()) {
            ([argument], &[operand]) => argument.find(classes, operand, start, found),
            ([first, second], &[a, b]) => {
                find_both(classes, [(first, a), (second, b)], start, found);
                if self.turns && a != b {
                    find_both(classes, [(first, b), (second, a)], start, found);
                }
            }
            _ => {}
        }
    }
}

/// Adds what both arguments match in their classes to `found`.
fn find_both(
    classes: &Snapshot,
    [first, second]: [(&Argument, Id); 2],
    start: Match,
    found: &mut Vec<Match>,
) {
    if !second.0.may_match(classes, second.1) {
        return;
    }
    let begin = found.len();
    first.0.find(classes, first.1, start, found);
    let end = found.len();
    if end == begin {
        return;
    }
    for index in begin..end {
        let one = found[index];
        second.0.find(classes, second.1, one, found);
    }
    found.drain(begin..end);
}

impl Argument {
    fn new(nodes: &[ENodeOrVar<Math>], index: usize) -> Self {
        if let ENodeOrVar::Var(_) = nodes[index] {
            return Self::Variable(variable(nodes, index));
        }
        let own = node(nodes, index);
        let Some(symbol) = Symbol::of(own) else {
            return Self::Constant(constant(own));
        };
        match *own.children() {
            [a] => Self::Unary(symbol, variable(nodes, usize::from(a))),
            [a, b] => Self::Binary(symbol, [a, b].map(|id| variable(nodes, usize::from(id)))),
            _ => panic!("a pattern with a leaf"),
        }
    }

    fn shape(&self) -> Option<(Symbol, bool)> {
        match *self {
            Self::Variable(_) => None,
            Self::Constant(number) => Some((Symbol::Constant(number), true)),
            Self::Unary(symbol, _) | Self::Binary(symbol, _) => Some((symbol, false)),
        }
    }

    /// Whether there is anything of its kind in a class.
    fn may_match(&self, classes: &Snapshot, class: Id) -> bool {
        match *self {
            Self::Variable(_) => true,
            Self::Constant(number) => classes.known(class).constant == Some(number),
            Self::Unary(symbol, _) | Self::Binary(symbol, _) => classes.has(class, symbol),
        }
    }

    /// Adds what this can be in `class`, on top of what variables stand for already.
    fn find(&self, classes: &Snapshot, class: Id, start: Match, found: &mut Vec<Match>) {
        if !self.may_match(classes, class) {
            return;
        }
        match *self {
            Self::Variable(variable) => {
                let mut one = start;
                if one.bind(variable, class) {
                    found.push(one);
                }
            }
            Self::Constant(_) => found.push(start),
            Self::Unary(symbol, variable) => {
                for operation in classes.operations(class) {
                    if operation.symbol == symbol {
                        let mut one = start;
                        if one.bind(variable, operation.children()[0]) {
                            found.push(one);
                        }
                    }
                }
            }
            Self::Binary(symbol, [first, second]) => {
                for operation in classes.operations(class) {
                    if operation.symbol != symbol {
                        continue;
                    }
                    let &[a, b] = operation.children() else {
                        continue;
                    };
                    let mut one = start;
                    if one.bind(first, a) && one.bind(second, b) {
                        found.push(one);
                    }
                    if symbol.is_commutative() && a != b {
                        let mut one = start;
                        if one.bind(first, b) && one.bind(second, a) {
                            found.push(one);
                        }
                    }
                }
            }
        }
    }
}

impl Match {
    /// Lets a variable stand for a class; whether it can.
    fn bind(&mut self, variable: usize, class: Id) -> bool {
        if self.variables[variable] == Id::from(UNBOUND) {
            self.variables[variable] = class;
        }
        self.variables[variable] == class
    }
}

/// The right side of a rule: operations on variables and earlier ones.
#[derive(Debug)]
pub(super) struct Steps(Vec<Step>);

#[derive(Debug, Clone, Copy)]
enum Step {
    Variable(usize),
    Operation(Operation),
}

impl Steps {
    /// The steps that make what a pattern says.
    pub(super) fn new(pattern: &PatternAst<Math>) -> Self {
        let nodes: &[ENodeOrVar<Math>] = pattern.as_ref();
        let steps = (0..nodes.len()).map(|index| match &nodes[index] {
            ENodeOrVar::Var(_) => Step::Variable(variable(nodes, index)),
            ENodeOrVar::ENode(own) => Step::Operation(match Symbol::of(own) {
                Some(symbol) => Operation::new(symbol, own.children()),
                None => Operation::new(Symbol::Constant(constant(own)), &[]),
            }),
        });
        Self(steps.collect())
    }

    /// Adds it to `graph`.
    pub(super) fn add(&self, graph: &mut Graph, variables: &Variables) -> Id {
        let mut made = [Id::from(0); MOST_STEPS];
        let mut last = made[0];
        for (index, step) in self.0.iter().enumerate() {
            last = match step {
                Step::Variable(variable) => variables[*variable],
                Step::Operation(operation) => {
                    let operation = operation.map_children(|id| made[usize::from(id)]);
                    graph.add(operation)
                }
            };
            made[index] = last;
        }
        last
    }
}

/// The length of the longest right side.
const MOST_STEPS: usize = 8;

fn node(nodes: &[ENodeOrVar<Math>], index: usize) -> &Math {
    match &nodes[index] {
        ENodeOrVar::ENode(node) => node,
        ENodeOrVar::Var(_) => panic!("a variable instead of an operation"),
    }
}

/// The number of a variable by its name.
fn variable(nodes: &[ENodeOrVar<Math>], index: usize) -> usize {
    match &nodes[index] {
        ENodeOrVar::Var(var) => match var.to_string().as_str() {
            "?a" => 0,
            "?b" => 1,
            "?c" => 2,
            name => panic!("the variable {name}"),
        },
        ENodeOrVar::ENode(node) => panic!("{node} instead of a variable"),
    }
}

/// The number of a constant.
fn constant(node: &Math) -> u32 {
    match node {
        Math::Constant(value) => Constants::new().number(value),
        _ => panic!("{node} instead of a number"),
    }
}
