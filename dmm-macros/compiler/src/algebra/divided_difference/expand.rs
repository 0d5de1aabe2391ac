//! The quotients that define `sinc`, `ln_dd` and their like.

use std::collections::HashMap;

use egg::Language;

use super::super::differentiate::arc_derivative;
use super::super::{Dag, Function, Id, Math, PairFunction};

/// `root` with `sinc`, `ln_dd` and their like, which no declaration contains, replaced by the
/// quotients that define them.
pub(super) fn expand_divided_differences(dag: &mut Dag, root: Id) -> Id {
    let mut images: HashMap<Id, Id> = HashMap::new();
    for id in dag.reachable([root]) {
        let node = dag[id].clone();
        let node = node.map_children(|child| images.get(&child).copied().unwrap_or(child));
        let image = match node {
            Math::Call(function, u) => match cardinal_quotient(dag, function, u) {
                Some(quotient) => quotient,
                None => dag.rebuild(&node),
            },
            Math::Pair(function, [a, b]) => pair_quotient(dag, function, a, b),
            _ => dag.rebuild(&node),
        };
        images.insert(id, image);
    }
    images.get(&root).copied().unwrap_or(root)
}

/// sinc u = sin(u)/u, sinc′ u = (cos u − sinc u)/u, and the same of sinh.
fn cardinal_quotient(dag: &mut Dag, function: Function, u: Id) -> Option<Id> {
    use Function::*;
    let (outer, derivative) = match function {
        Sinc | SincPrime => (Sin, Cos),
        Sinhc | SinhcPrime => (Sinh, Cosh),
        _ => return None,
    };
    let value = dag.call(outer, u);
    let quotient = dag.div(value, u);
    if matches!(function, Sinc | Sinhc) {
        return Some(quotient);
    }
    let derivative = dag.call(derivative, u);
    let difference = dag.sub(derivative, quotient);
    Some(dag.div(difference, u))
}

/// h\[a, b\] = (h(b) − h(a))/(b − a), h\[a, b\]′ = (h′(b) − h\[a, b\])/(b − a).
fn pair_quotient(dag: &mut Dag, function: PairFunction, a: Id, b: Id) -> Id {
    use PairFunction::*;
    let outer = match function {
        LnDd | LnDdPrime => Function::Ln,
        AsinDd | AsinDdPrime => Function::Asin,
        AtanDd | AtanDdPrime => Function::Atan,
    };
    let [at_a, at_b] = [a, b].map(|u| dag.call(outer, u));
    let difference = dag.sub(at_b, at_a);
    let distance = dag.sub(b, a);
    let quotient = dag.div(difference, distance);
    if matches!(function, LnDd | AsinDd | AtanDd) {
        return quotient;
    }
    let derivative = arc_derivative(dag, function, b);
    let difference = dag.sub(derivative, quotient);
    dag.div(difference, distance)
}
