//! Whether a function is affine, u = A x + b with A and b depending on parameters alone: where
//! the vector field is, the flow of a region has a closed form, the matrix exponential.
//!
//! It is read off the form. That something else cancels would not be enough, because the
//! emitted code still computes what cancels, and A and b are read off that code.

use std::collections::HashMap;

use crate::algebra::{Dag, Id, Math, Name};

/// How a node depends on the arguments.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Degree {
    /// Not at all.
    Fixed,
    /// As a first-degree polynomial.
    Affine,
    /// In any other way.
    Curved,
}

/// Whether each root is an affine function of `arguments`, by its form.
pub(super) fn is_affine(
    dag: &Dag,
    roots: impl IntoIterator<Item = Id> + Clone,
    arguments: &[Name],
) -> bool {
    let mut degrees: HashMap<Id, Degree> = HashMap::new();
    for id in dag.reachable(roots.clone()) {
        let of = |child: Id| degrees.get(&child).copied().unwrap_or(Degree::Curved);
        let degree = degree(&dag[id], arguments, of);
        degrees.insert(id, degree);
    }
    roots
        .into_iter()
        .all(|root| degrees[&root] <= Degree::Affine)
}

/// The degree of a node from those of its children.
fn degree(node: &Math, arguments: &[Name], of: impl Fn(Id) -> Degree) -> Degree {
    let unless_fixed =
        |children: &[Id]| match children.iter().all(|&child| of(child) == Degree::Fixed) {
            true => Degree::Fixed,
            false => Degree::Curved,
        };
    match *node {
        Math::Pi | Math::Constant(_) => Degree::Fixed,
        Math::Variable(ref name) => match arguments.contains(name) {
            true => Degree::Affine,
            false => Degree::Fixed,
        },
        Math::Add([a, b]) | Math::Sub([a, b]) => of(a).max(of(b)),
        Math::Neg(a) => of(a),
        Math::Mul([a, b]) => match (of(a), of(b)) {
            (Degree::Fixed, other) | (other, Degree::Fixed) => other,
            _ => Degree::Curved,
        },
        Math::Div([a, b]) => match of(b) {
            Degree::Fixed => of(a),
            _ => Degree::Curved,
        },
        Math::Pow(ref children) | Math::Pair(_, ref children) => unless_fixed(children),
        Math::Call(_, child) => unless_fixed(&[child]),
    }
}

#[cfg(test)]
mod tests {
    /// Whether the field and the interface of a system in x, y are affine.
    fn affine(field: &str, interface: &str) -> (bool, bool) {
        let text = format!(
            "system S {{ state x, y; param a = 2, c = 3; interface wall = {interface};
                region left where wall < 0 {{ der(x) = {field}; der(y) = x; }}
                region right where wall > 0 {{ der(x) = y; der(y) = a + c; }} }}"
        );
        let scheme = crate::read(text.parse().expect("tokens")).expect("a scheme");
        (scheme.regions[0].affine, scheme.interfaces[0].affine)
    }

    #[test]
    fn affine_functions_are_found() {
        for form in [
            "y",
            "-x",
            "a*(x - c*y) + sin(c)",
            "(x + y)/a - 3",
            "exp(a)*y + 2^a",
            "1",
        ] {
            assert_eq!(affine(form, "x - y"), (true, true), "{form}");
        }
    }

    #[test]
    fn others_are_not() {
        for form in [
            "x*y",
            "x^2",
            "sin(x)",
            "1/(y^2 + 1)",
            "(x + 1)^2 - x^2",
            "a^x",
        ] {
            assert_eq!(affine(form, "x - y"), (false, true), "{form}");
        }
        assert_eq!(affine("y", "x^2 + y^2 - 1"), (true, false));
    }

    #[test]
    fn the_time_makes_a_flow_inexact_but_not_an_interface() {
        assert_eq!(affine("y + t", "x - a*t"), (false, true));
        assert_eq!(affine("t*y", "x - t^2"), (false, false));
    }
}
