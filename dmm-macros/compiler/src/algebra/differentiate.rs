//! Derivatives: (expression, variable) → ∂(expression)/∂(variable), by structure, each node of
//! the DAG once.
//!
//! The chain rule needs two facts about a node: on which variables it depends and its *local*
//! derivative in each child. Derivatives of divided differences h\[a, b\] =
//! (h(b) − h(a))/(b − a) use their own functions h\[a, b\]′ = ∂h\[a, b\]/∂b; the derivatives of
//! those (second derivatives, which no scheme needs) are written by the defining quotients
//! ∂h′/∂b = (h″(b) − 2h\[a, b\]′)/(b − a) and ∂h′/∂a = (h\[a, b\]′ − h\[b, a\]′)/(b − a).

use std::collections::{BTreeSet, HashMap};

use egg::Language;

use super::{Dag, Function, Id, Math, Name, PairFunction};

/// ∂`root`/∂`variable`.
pub fn differentiate(dag: &mut Dag, root: Id, variable: &Name) -> Id {
    let mut derivative = Derivative::new(variable);
    derivative.of(dag, root)
}

/// ∇`root`, in the order of `variables`.
pub fn gradient(dag: &mut Dag, root: Id, variables: &[Name]) -> Vec<Id> {
    jacobian(dag, &[root], variables).pop().unwrap_or_default()
}

/// ∂`roots`/∂`variables`, a row a root.
pub fn jacobian(dag: &mut Dag, roots: &[Id], variables: &[Name]) -> Vec<Vec<Id>> {
    let dependence = Dependence::new(dag, roots, variables);
    let mut derivatives: Vec<Derivative<'_>> = variables.iter().map(Derivative::new).collect();
    roots
        .iter()
        .map(|&root| {
            derivatives
                .iter_mut()
                .enumerate()
                .map(|(index, derivative)| {
                    derivative.of_dependent(dag, root, |id| dependence.is_on(id, index))
                })
                .collect()
        })
        .collect()
}

/// Which nodes depend on which of several variables: most entries of a large Jacobian are
/// zero, and the others are made of few nodes.
struct Dependence {
    /// A set of variables a node, one bit each.
    sets: Vec<u64>,
    /// The words of a set.
    words: usize,
}

impl Dependence {
    fn new(dag: &Dag, roots: &[Id], variables: &[Name]) -> Self {
        let words = variables.len().div_ceil(64);
        let indices: HashMap<&Name, usize> = variables.iter().zip(0..).collect();
        let mut dependence = Self {
            sets: vec![0; dag.len() * words],
            words,
        };
        for id in dag.reachable(roots.iter().copied()) {
            let start = usize::from(id) * words;
            if let Math::Variable(name) = &dag[id]
                && let Some(index) = indices.get(name)
            {
                dependence.sets[start + index / 64] |= 1 << (index % 64);
            }
            for &child in dag[id].children() {
                let child = usize::from(child) * words;
                for word in 0..words {
                    dependence.sets[start + word] |= dependence.sets[child + word];
                }
            }
        }
        dependence
    }

    /// Whether the node depends on the variable with this index.
    fn is_on(&self, id: Id, index: usize) -> bool {
        let word = usize::from(id) * self.words + index / 64;
        (self.sets.get(word)).is_some_and(|word| word >> (index % 64) & 1 == 1)
    }
}

/// The derivatives in one variable that are known so far.
struct Derivative<'a> {
    variable: &'a Name,
    /// The derivative of a node; `None` where the node does not depend on the variable.
    memo: HashMap<Id, Option<Id>>,
}

impl<'a> Derivative<'a> {
    fn new(variable: &'a Name) -> Self {
        Self {
            variable,
            memo: HashMap::new(),
        }
    }

    fn of(&mut self, dag: &mut Dag, root: Id) -> Id {
        if !self.memo.contains_key(&root) {
            for id in dag.reachable([root]) {
                if !self.memo.contains_key(&id) {
                    let derivative = self.node(dag, id);
                    self.memo.insert(id, derivative);
                }
            }
        }
        match self.memo.get(&root) {
            Some(&Some(derivative)) => derivative,
            _ => dag.integer(0),
        }
    }

    /// The same, where it is known which nodes depend on the variable: only those are visited.
    fn of_dependent(&mut self, dag: &mut Dag, root: Id, depends: impl Fn(Id) -> bool) -> Id {
        if !depends(root) {
            return dag.integer(0);
        }
        let mut seen = BTreeSet::new();
        let mut stack = vec![root];
        while let Some(id) = stack.pop() {
            if !self.memo.contains_key(&id) && seen.insert(id) {
                let children = dag[id].children().iter().copied();
                stack.extend(children.filter(|&child| depends(child)));
            }
        }
        // children have smaller identifiers than their parents
        for id in seen {
            let derivative = self.node(dag, id);
            self.memo.insert(id, derivative);
        }
        match self.child(root) {
            Some(derivative) => derivative,
            None => dag.integer(0),
        }
    }

    /// The derivative of a node whose children are known.
    fn node(&self, dag: &mut Dag, id: Id) -> Option<Id> {
        let node = dag[id].clone();
        if let Math::Variable(name) = &node {
            return (name == self.variable).then(|| dag.integer(1));
        }
        if node
            .children()
            .iter()
            .all(|&child| self.child(child).is_none())
        {
            return None;
        }
        let derivative = match node {
            Math::Pi | Math::Constant(_) | Math::Variable(_) => return None,
            Math::Neg(u) => {
                let du = self.child(u)?;
                dag.neg(du)
            }
            Math::Add([u, v]) | Math::Sub([u, v]) => {
                let [du, dv] = [u, v].map(|child| self.child(child));
                let du = du.unwrap_or_else(|| dag.integer(0));
                let dv = dv.unwrap_or_else(|| dag.integer(0));
                match node {
                    Math::Add(_) => dag.add(du, dv),
                    _ => dag.sub(du, dv),
                }
            }
            Math::Mul([u, v]) => {
                let first = self.child(u).map(|du| dag.mul(du, v));
                let second = self.child(v).map(|dv| dag.mul(u, dv));
                sum(dag, first, second)
            }
            // (u′ − (u/v)·v′)/v shares the quotient u/v
            Math::Div([u, v]) => {
                let first = self.child(u).map(|du| dag.div(du, v));
                let second = self.child(v).map(|dv| {
                    let product = dag.mul(id, dv);
                    let quotient = dag.div(product, v);
                    dag.neg(quotient)
                });
                sum(dag, first, second)
            }
            Math::Pow([u, v]) => self.power(dag, id, u, v),
            Math::Call(function, u) => {
                let du = self.child(u)?;
                let outer = function.derivative(dag, u);
                dag.mul(outer, du)
            }
            Math::Pair(function, [a, b]) => {
                let [in_a, in_b] = pair_derivatives(dag, function, a, b);
                let first = self.child(a).map(|da| dag.mul(in_a, da));
                let second = self.child(b).map(|db| dag.mul(in_b, db));
                sum(dag, first, second)
            }
        };
        Some(derivative)
    }

    fn child(&self, id: Id) -> Option<Id> {
        self.memo.get(&id).copied().flatten()
    }

    /// (u^v)′ = v·u^(v−1)·u′ + u^v·ln(u)·v′
    fn power(&self, dag: &mut Dag, id: Id, u: Id, v: Id) -> Id {
        let first = self.child(u).map(|du| {
            let one = dag.integer(1);
            let exponent = dag.sub(v, one);
            let power = dag.pow(u, exponent);
            let outer = dag.mul(v, power);
            dag.mul(outer, du)
        });
        let second = self.child(v).map(|dv| {
            let logarithm = dag.call(Function::Ln, u);
            let outer = dag.mul(id, logarithm);
            dag.mul(outer, dv)
        });
        sum(dag, first, second)
    }
}

fn sum(dag: &mut Dag, first: Option<Id>, second: Option<Id>) -> Id {
    match (first, second) {
        (Some(first), Some(second)) => dag.add(first, second),
        (Some(only), None) | (None, Some(only)) => only,
        (None, None) => dag.integer(0),
    }
}

/// h″(u) = c·uᵏ·h′(u)ᵖ of the function h whose divided difference is `function`.
fn second_derivative(dag: &mut Dag, function: PairFunction, u: Id) -> Id {
    let (c, k, p) = function.properties().second;
    let first = function.of().derivative(dag, u);
    let [c, power, slopes] = [
        dag.integer(c),
        dag.powi(u, k.into()),
        dag.powi(first, p.into()),
    ];
    let product = dag.mul(c, power);
    dag.mul(product, slopes)
}

/// The derivatives of `function(a, b)` in a and in b.
fn pair_derivatives(dag: &mut Dag, function: PairFunction, a: Id, b: Id) -> [Id; 2] {
    if let Some(prime) = function.prime() {
        return [dag.pair(prime, b, a), dag.pair(prime, a, b)];
    }
    let difference = dag.sub(b, a);
    let [forward, backward] = [dag.pair(function, a, b), dag.pair(function, b, a)];
    let in_a = dag.sub(forward, backward);
    let second = second_derivative(dag, function, b);
    let two = dag.integer(2);
    let doubled = dag.mul(two, forward);
    let in_b = dag.sub(second, doubled);
    [dag.div(in_a, difference), dag.div(in_b, difference)]
}
