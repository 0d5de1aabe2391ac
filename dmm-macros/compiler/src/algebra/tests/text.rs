//! Expressions as text.

use super::formula::formula;
use crate::algebra::{Dag, Math, to_text};

fn text(source: &str) -> String {
    let mut dag = Dag::new();
    let root = formula(&mut dag, source);
    to_text(&dag, root)
}

#[test]
fn formulas_with_the_fewest_parentheses() {
    for (source, expected) in [
        ("1/2*u", "u/2"),
        ("-3/4*u", "-3*u/4"),
        ("k*(x + y)/2", "k*(x + y)/2"),
        ("-(k*(x + y)/2)", "-k*(x + y)/2"),
        ("(a - b) - (c - d)", "a - b - c + d"),
        ("a - (b + c)", "a - b - c"),
        ("-x + y", "y - x"),
        ("-(x + y)", "-(x + y)"),
        ("(-x)^2", "x^2"),
        ("-x^2", "-x^2"),
        ("(x^y)^z", "(x^y)^z"),
        ("x^(y^z)", "x^(y^z)"),
        ("x^(-2)", "1/x^2"),
        ("x^(3/2)", "x^(3/2)"),
        ("x^(1/2)", "sqrt(x)"),
        ("x^(y + 1)", "x^(y + 1)"),
        ("(x + y)^2", "(x + y)^2"),
        ("(2*x)^2", "(2*x)^2"),
        ("a/(b*c)", "a/(b*c)"),
        ("a/b/c", "a/(b*c)"),
        ("a/(b/c)", "a*c/b"),
        ("a/(b + c)", "a/(b + c)"),
        ("a*(b/c)", "a*b/c"),
        ("2/3", "2/3"),
        ("x - 2/3", "x - 2/3"),
        ("(2/3)^x", "(2/3)^x"),
        ("exp(-x)*sin(2*pi*t)", "exp(-x)*sin(2*pi*t)"),
        ("ln_dd(a, b + 1)", "ln_dd(a, b + 1)"),
        ("1/x", "1/x"),
        ("0", "0"),
    ] {
        assert_eq!(text(source), expected, "{source}");
    }
}

#[test]
fn text_is_read_back_as_the_same_value() {
    for source in [
        "x^(y^z)",
        "(x^y)^z",
        "a/(b*c)*d",
        "-(x + y)^2/3",
        "a - (b - c)*(d - a)",
        "x^(-3/2)/y",
    ] {
        let mut dag = Dag::new();
        let root = formula(&mut dag, source);
        let written = to_text(&dag, root);
        let again = formula(&mut dag, &written);
        let difference = dag.sub(root, again);
        assert_eq!(
            crate::algebra::decide_zero(&mut dag, difference),
            crate::algebra::Verdict::Proved,
            "{source} became {written}"
        );
    }
}

#[test]
fn division_by_zero_is_shown() {
    let mut dag = Dag::new();
    let x = formula(&mut dag, "x");
    let zero = dag.integer(0);
    let quotient = dag.insert(Math::Div([x, zero]));
    assert_eq!(to_text(&dag, quotient), "x/0");
}

#[test]
fn exponentially_large_trees_are_cut_off() {
    let mut dag = Dag::new();
    let mut root = formula(&mut dag, "x + sin(y)");
    for _ in 0..200 {
        let sine = dag.call(crate::algebra::Function::Sin, root);
        let product = dag.mul(root, sine);
        root = dag.add(product, sine);
    }
    let written = to_text(&dag, root);
    assert!(written.contains('…'));
    assert!(written.len() < 100_000);
}
