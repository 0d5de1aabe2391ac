//! The quotients that define `sinc`, `ln_dd` and their like.

use std::collections::HashMap;

use egg::Language;

use super::super::functions::Difference;
use super::super::{Dag, Id, Math, PairFunction};

/// `root` with `sinc`, `ln_dd` and their like, which no declaration contains, replaced by the
/// quotients that define them.
pub(super) fn expand_divided_differences(dag: &mut Dag, root: Id) -> Id {
    let mut images: HashMap<Id, Id> = HashMap::new();
    for id in dag.reachable([root]) {
        let node = dag[id].clone();
        let node = node.map_children(|child| images.get(&child).copied().unwrap_or(child));
        let image = match node {
            Math::Call(function, u) => match function.properties().difference {
                Difference::Definition(definition) => definition(dag, u),
                _ => dag.rebuild(&node),
            },
            Math::Pair(function, [a, b]) => pair_quotient(dag, function, a, b),
            _ => dag.rebuild(&node),
        };
        images.insert(id, image);
    }
    images.get(&root).copied().unwrap_or(root)
}

/// h\[a, b\] = (h(b) − h(a))/(b − a), h\[a, b\]′ = (h′(b) − h\[a, b\])/(b − a).
fn pair_quotient(dag: &mut Dag, function: PairFunction, a: Id, b: Id) -> Id {
    let [at_a, at_b] = [a, b].map(|u| dag.call(function.of(), u));
    let difference = dag.sub(at_b, at_a);
    let distance = dag.sub(b, a);
    let quotient = dag.div(difference, distance);
    if function.prime().is_some() {
        return quotient;
    }
    let derivative = function.of().derivative(dag, b);
    let difference = dag.sub(derivative, quotient);
    dag.div(difference, distance)
}
