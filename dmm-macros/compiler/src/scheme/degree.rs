//! The degree of a function as a polynomial in its arguments, with coefficients that depend on
//! parameters alone: where the vector field is affine, u = A x + b, the flow of a region has a
//! closed form, the matrix exponential; and the Taylor coefficients of a polynomial along a
//! solution fall off like those of the solution.
//!
//! It is read off the form. That something else cancels would not be enough, because the
//! emitted code still computes what cancels, and A and b are read off that code.

use std::collections::HashMap;

use crate::algebra::{Dag, Id, Math, Name};

/// Whether each root is an affine function of `arguments`, by its form.
pub(super) fn is_affine(
    dag: &Dag,
    roots: impl IntoIterator<Item = Id> + Clone,
    arguments: &[Name],
) -> bool {
    degree(dag, roots, arguments).is_some_and(|degree| degree <= 1)
}

/// The largest degree of the roots as polynomials in `arguments`, by their form; nothing if one is
/// no polynomial.
pub(super) fn degree(
    dag: &Dag,
    roots: impl IntoIterator<Item = Id> + Clone,
    arguments: &[Name],
) -> Option<u32> {
    let mut degrees: HashMap<Id, Option<u32>> = HashMap::new();
    for id in dag.reachable(roots.clone()) {
        let of = |child: Id| degrees.get(&child).copied().flatten();
        let degree = degree_of_node(dag, &dag[id], arguments, of);
        degrees.insert(id, degree);
    }
    let mut roots = roots.into_iter();
    roots.try_fold(0, |largest, root| Some(largest.max(degrees[&root]?)))
}

/// The degree of a node from those of its children.
fn degree_of_node(
    dag: &Dag,
    node: &Math,
    arguments: &[Name],
    of: impl Fn(Id) -> Option<u32>,
) -> Option<u32> {
    let if_fixed = |children: &[Id]| {
        let fixed = children.iter().all(|&child| of(child) == Some(0));
        fixed.then_some(0)
    };
    match *node {
        Math::Pi | Math::Constant(_) => Some(0),
        Math::Variable(ref name) => Some(u32::from(arguments.contains(name))),
        Math::Add([a, b]) | Math::Sub([a, b]) => Some(of(a)?.max(of(b)?)),
        Math::Neg(a) => of(a),
        Math::Mul([a, b]) => of(a)?.checked_add(of(b)?),
        Math::Div([a, b]) => {
            if_fixed(&[b])?;
            of(a)
        }
        Math::Pow([a, n]) => if_fixed(&[a, n]).or_else(|| {
            let n = u32::try_from(dag.as_integer(n)?).ok()?;
            of(a)?.checked_mul(n)
        }),
        Math::Pair(_, ref children) => if_fixed(children),
        Math::Call(_, child) => if_fixed(&[child]),
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
        (
            scheme.regions[0].affine,
            scheme.interfaces[0]
                .degree
                .is_some_and(|degree| degree <= 1),
        )
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

    #[test]
    fn degrees_are_those_of_polynomials() {
        let degree = |interface: &str| {
            let text = format!(
                "system S {{ state x, y; param a = 2, c = 3; interface wall = {interface};
                    region left where wall < 0 {{ der(x) = y; der(y) = a*c; }}
                    region right where wall > 0 {{ der(x) = y; der(y) = a + c; }} }}"
            );
            let scheme = crate::read(text.parse().expect("tokens")).expect("a scheme");
            scheme.interfaces[0].degree
        };
        for (form, expected) in [
            ("x + exp(a)", Some(1)),
            ("x^2 + y^2/c - 1", Some(2)),
            ("(x - t)^3*y", Some(4)),
            ("x*y*(x + y^4)", Some(6)),
            ("x/y", None),
            ("1/(x - y) + c", None),
            ("sqrt(x^2) - 1", None),
            ("x^a - y", None),
            ("sin(x) - y", None),
            ("x - 2^t", None),
        ] {
            assert_eq!(degree(form), expected, "{form}");
        }
    }
}
