//! Operations as their recurrences are shortest. A quotient by a power that has roots in it is a
//! product with a power: u/(v √v) is u v^(−3/2), whose recurrence takes the place of those of the root,
//! of the product and of the quotient. Where products alone take a reciprocal, they are quotients:
//! u·(1/v) and w·(1/v) are u/v and w/v, without the recurrence of 1/v. Factors that are constant in time
//! are brought outside of products: u (c u) is c u², and a square has half the terms.

use std::collections::{BTreeSet, HashMap};

use egg::Language;
use num_traits::One;

use crate::algebra::{Function, Id, Math, Rational};
use crate::program::Lowered;

/// The roots with such quotients and products.
pub(in crate::program) fn for_series(lowered: &mut Lowered, roots: &[Id]) -> Vec<Id> {
    let mut image: HashMap<Id, Id> = HashMap::new();
    let reciprocals = factors_alone(lowered, roots);
    for id in lowered.order(roots, |_| false) {
        let own = lowered.dag()[id].clone();
        let node = own.clone().map_children(|child| image[&child]);
        let new = match (lowered.is_fixed(id), node) {
            (true, _) => id,
            (false, Math::Div([a, b])) => product_with_power(lowered, a, b)
                .unwrap_or_else(|| lowered.insert(Math::Div([a, b]))),
            (false, Math::Mul([a, b])) if !lowered.is_fixed(a) && !lowered.is_fixed(b) => match own
            {
                Math::Mul([_, one]) if reciprocals.contains(&one) => quotient(lowered, a, b),
                Math::Mul([one, _]) if reciprocals.contains(&one) => quotient(lowered, b, a),
                _ => product(lowered, a, b),
            },
            (false, node) => lowered.insert(node),
        };
        image.insert(id, new);
    }
    roots.iter().map(|root| image[root]).collect()
}

/// The reciprocals c/v, with c constant in time, that are factors of products with something else
/// that moves, and nothing else.
fn factors_alone(lowered: &Lowered, roots: &[Id]) -> BTreeSet<Id> {
    let moves = |id: Id| !lowered.is_fixed(id);
    let is_reciprocal = |id: Id| {
        let Math::Div([c, v]) = lowered.dag()[id] else {
            return false;
        };
        lowered.is_fixed(c) && moves(v) && !is_power_with_roots(lowered, v)
    };
    let order = lowered.order(roots, |_| false);
    let mut found: BTreeSet<Id> = order
        .iter()
        .copied()
        .filter(|&id| is_reciprocal(id))
        .collect();
    roots.iter().for_each(|root| _ = found.remove(root));
    for id in order {
        let node = &lowered.dag()[id];
        let both = matches!(*node, Math::Mul([a, b]) if found.contains(&a) && found.contains(&b));
        let is_product = matches!(*node, Math::Mul([a, b]) if moves(a) && moves(b)) && !both;
        if !is_product {
            node.for_each(|child| _ = found.remove(&child));
        }
    }
    found
}

/// a (c/v) as a quotient with factors that are constant in time outside, where `reciprocal` is c/v.
fn quotient(lowered: &mut Lowered, a: Id, reciprocal: Id) -> Id {
    let Math::Div([c, v]) = lowered.dag()[reciprocal] else {
        return product(lowered, a, reciprocal);
    };
    let (outer, a) = without_fixed(lowered, a);
    let quotient = lowered.insert(Math::Div([a, v]));
    let is_one = lowered.dag().as_constant(c).is_some_and(One::is_one);
    with_factors(lowered, quotient, [(!is_one).then_some(c), outer])
}

/// ab, with factors that are constant in time outside.
fn product(lowered: &mut Lowered, a: Id, b: Id) -> Id {
    let [(outer, a), (inner, b)] = [a, b].map(|id| without_fixed(lowered, id));
    let product = lowered.insert(Math::Mul([a, b]));
    with_factors(lowered, product, [inner, outer])
}

/// A node with factors that are constant in time outside, one after the other.
fn with_factors(lowered: &mut Lowered, node: Id, factors: [Option<Id>; 2]) -> Id {
    let factors = factors.into_iter().flatten();
    factors.fold(node, |node, c| lowered.insert(Math::Mul([c, node])))
}

/// A factor of a node that is constant in time, and the node without it.
fn without_fixed(lowered: &Lowered, id: Id) -> (Option<Id>, Id) {
    match lowered.dag()[id] {
        Math::Mul([c, u]) | Math::Mul([u, c]) if lowered.is_fixed(c) => (Some(c), u),
        _ => (None, id),
    }
}

/// a v^(−p), where b = v^p with p = 3/2, 5/2, …
fn product_with_power(lowered: &mut Lowered, a: Id, b: Id) -> Option<Id> {
    if !is_power_with_roots(lowered, b) {
        return None;
    }
    let (base, exponent) = power(lowered, b);
    let exponent = lowered.insert(Math::Constant(-exponent));
    let power = lowered.insert(Math::Pow([base, exponent]));
    let is_one = lowered.dag().as_constant(a).is_some_and(One::is_one);
    Some(if is_one {
        power
    } else {
        lowered.insert(Math::Mul([a, power]))
    })
}

/// Whether a node is v^p with p = 3/2, 5/2, …
fn is_power_with_roots(lowered: &Lowered, id: Id) -> bool {
    let (base, exponent) = power(lowered, id);
    let least = Rational::new(3.into(), 2.into());
    !exponent.is_integer() && exponent >= least && !lowered.is_fixed(base)
}

/// Base and exponent of a node as a power.
fn power(lowered: &Lowered, id: Id) -> (Id, Rational) {
    match lowered.dag()[id] {
        Math::Call(Function::Sqrt, a) => {
            let (base, exponent) = power(lowered, a);
            (base, exponent / Rational::from_integer(2.into()))
        }
        Math::Mul([a, b]) => {
            let ((base, p), (other, q)) = (power(lowered, a), power(lowered, b));
            if base == other {
                (base, p + q)
            } else {
                (id, Rational::one())
            }
        }
        _ => (id, Rational::one()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Name;

    /// y and x, the root of y/(x √x) and that of y/√x.
    fn quotients() -> (Lowered, [Id; 2], [Id; 2]) {
        let mut lowered = Lowered::new(Vec::new());
        let [x, y] = ["x", "y"].map(|name| lowered.insert(Math::Variable(Name::new(name))));
        let root = lowered.insert(Math::Call(Function::Sqrt, x));
        let power = lowered.insert(Math::Mul([x, root]));
        let roots = [power, root].map(|divisor| lowered.insert(Math::Div([y, divisor])));
        (lowered, [x, y], roots)
    }

    #[test]
    fn a_quotient_by_a_power_with_a_root_is_a_product() {
        let (mut lowered, [x, y], roots) = quotients();
        let [product, quotient] = for_series(&mut lowered, &roots)[..] else {
            panic!("two roots")
        };
        let Math::Mul([a, power]) = lowered.dag()[product] else {
            panic!("no product")
        };
        let Math::Pow([base, exponent]) = lowered.dag()[power] else {
            panic!("no power")
        };
        assert_eq!([a, base], [y, x]);
        let exponent = lowered.dag().as_constant(exponent);
        assert_eq!(exponent, Some(&Rational::new((-3).into(), 2.into())));
        // a root alone has a recurrence as short
        assert_eq!(quotient, roots[1]);
    }

    #[test]
    fn products_with_a_reciprocal_are_quotients() {
        let mut lowered = Lowered::new(vec![Name::new("c")]);
        let [c, x, y, v] =
            ["c", "x", "y", "v"].map(|name| lowered.insert(Math::Variable(Name::new(name))));
        let reciprocal = lowered.insert(Math::Div([c, v]));
        let products = [x, y].map(|factor| lowered.insert(Math::Mul([factor, reciprocal])));
        let quotients = [x, y].map(|factor| {
            let quotient = lowered.insert(Math::Div([factor, v]));
            lowered.insert(Math::Mul([c, quotient]))
        });
        assert_eq!(for_series(&mut lowered, &products), quotients);
        // where it is needed anyway, a product is as short
        let roots = [products[0], reciprocal];
        assert_eq!(for_series(&mut lowered, &roots), roots);
    }

    #[test]
    fn a_factor_that_is_constant_in_time_is_outside_of_a_product() {
        let mut lowered = Lowered::new(vec![Name::new("c")]);
        let [c, x] = ["c", "x"].map(|name| lowered.insert(Math::Variable(Name::new(name))));
        let multiple = lowered.insert(Math::Mul([c, x]));
        let product = lowered.insert(Math::Mul([x, multiple]));
        let [root] = for_series(&mut lowered, &[product])[..] else {
            panic!("one root")
        };
        let square = lowered.insert(Math::Mul([x, x]));
        assert_eq!(lowered.dag()[root], Math::Mul([c, square]));
    }
}
