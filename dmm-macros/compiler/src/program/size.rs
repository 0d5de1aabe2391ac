//! The sizes that rounding errors are measured against, as expressions of their own.

use std::collections::HashMap;

use crate::algebra::{Dag, Function, Id, Math};

/// Σ|terms| of `root`: what its rounding error is measured against.
pub(super) fn size(dag: &mut Dag, root: Id) -> Id {
    let mut sizes: HashMap<Id, Id> = HashMap::new();
    for id in dag.reachable([root]) {
        let size = match dag[id].clone() {
            Math::Add([a, b]) | Math::Sub([a, b]) => dag.add(sizes[&a], sizes[&b]),
            Math::Mul([a, b]) => dag.mul(sizes[&a], sizes[&b]),
            Math::Div([a, b]) => {
                let b = absolute(dag, b);
                dag.div(sizes[&a], b)
            }
            Math::Neg(a) => sizes[&a],
            Math::Pow([a, n]) if dag.as_integer(n).is_some_and(|n| n > 0) => {
                let even = dag.as_integer(n).is_some_and(|n| n % 2 == 0);
                match dag[sizes[&a]] {
                    // |u|² is u²
                    Math::Call(Function::Abs, u) if even => dag.pow(u, n),
                    _ => dag.pow(sizes[&a], n),
                }
            }
            _ => absolute(dag, id),
        };
        sizes.insert(id, size);
    }
    sizes[&root]
}

/// A bound of the rounding error of `root`, in units of the rounding error of 1, to first order:
/// of its operations and of its variables. In a product each factor's error counts as often as the
/// other factor is large, so that it is small where the product is, but for sums that cancel.
pub(super) fn rounding(dag: &mut Dag, root: Id) -> Id {
    let mut errors: HashMap<Id, Id> = HashMap::new();
    for id in dag.reachable([root]) {
        let error = match dag[id].clone() {
            Math::Add([a, b]) | Math::Sub([a, b]) => dag.add(errors[&a], errors[&b]),
            Math::Mul([a, b]) => match (dag.as_constant(a), dag.as_constant(b)) {
                (None, None) => {
                    let (size_a, size_b) = (absolute(dag, a), absolute(dag, b));
                    let of_a = dag.mul(size_b, errors[&a]);
                    let of_b = dag.mul(size_a, errors[&b]);
                    dag.add(of_a, of_b)
                }
                _ => dag.mul(errors[&a], errors[&b]),
            },
            Math::Div([a, b]) => {
                let (size, divisor) = (absolute(dag, id), absolute(dag, b));
                let of_a = dag.div(errors[&a], divisor);
                match dag.as_constant(b) {
                    Some(_) => of_a,
                    None => {
                        let part = dag.div(errors[&b], divisor);
                        let of_b = dag.mul(size, part);
                        dag.add(of_a, of_b)
                    }
                }
            }
            Math::Neg(a) => errors[&a],
            Math::Pow([a, n]) if dag.as_integer(n).is_some_and(|n| n > 1) => {
                let size = absolute(dag, a);
                let one = dag.integer(1);
                let less = dag.sub(n, one);
                let power = dag.pow(size, less);
                let part = dag.mul(power, errors[&a]);
                dag.mul(n, part)
            }
            _ => absolute(dag, id),
        };
        errors.insert(id, error);
    }
    errors[&root]
}

/// |u|, without the bars where u cannot be negative.
fn absolute(dag: &mut Dag, root: Id) -> Id {
    match dag[root].clone() {
        Math::Constant(value) => dag.constant(num_traits::Signed::abs(&value)),
        Math::Pi => root,
        Math::Call(function, _) if function.properties().is_not_negative => root,
        Math::Pow([_, n]) if dag.as_integer(n).is_some_and(|n| n % 2 == 0) => root,
        _ => dag.call(Function::Abs, root),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Name, to_text};

    #[test]
    fn the_size_of_a_sum_is_that_of_its_terms() {
        let text = |formula: fn(&mut Dag, [Id; 3]) -> Id| {
            let mut dag = Dag::new();
            let variables = ["x", "y", "k"].map(|name| dag.variable(&Name::new(name)));
            let root = formula(&mut dag, variables);
            let size = size(&mut dag, root);
            to_text(&dag, size)
        };
        assert_eq!(text(|dag, [x, y, _]| dag.sub(x, y)), "abs(x) + abs(y)");
        let difference_of_powers = text(|dag, [x, y, _]| {
            let (square, cube) = (dag.powi(x, 2), dag.powi(y, 3));
            dag.sub(square, cube)
        });
        assert_eq!(difference_of_powers, "x^2 + abs(y)^3");
        let quotient = text(|dag, [x, y, k]| {
            let numerator = dag.sub(x, y);
            dag.div(numerator, k)
        });
        assert_eq!(quotient, "(abs(x) + abs(y))/abs(k)");
    }
}
