//! Formulas: collected, with patterns, with shared parts, in LaTeX.

use std::collections::HashMap;

use super::formula::formula;
use crate::algebra::display::latex::{self, Style};
use crate::algebra::display::patterns::Patterns;
use crate::algebra::display::shared::Shared;
use crate::algebra::display::text::{self, Letters};
use crate::algebra::display::{Formulas, Position};
use crate::algebra::{Dag, Id, Name};

fn collected() -> Formulas {
    Formulas::collected(HashMap::new())
}

fn element(dag: &mut Dag, group: &str, index: usize) -> Id {
    dag.variable(&Name::new(&format!("{group}[{index}]")))
}

#[test]
fn equal_factors_and_like_terms_are_collected() {
    for (source, expected) in [
        ("x*y*x", "x^2*y"),
        ("sqrt(x)*sqrt(x)*y", "sqrt(x)^2*y"),
        ("x*y - z + y*x", "2*x*y - z"),
        ("x*y - z - 2*y*x", "-x*y - z"),
        ("-(z - x)", "x - z"),
        ("-(x + z)", "-(x + z)"),
        ("u/(u^2*w)", "1/(u*w)"),
        // nothing is lost of the condition u ≠ 0
        ("u*w/u", "u*w/u"),
    ] {
        let mut dag = Dag::new();
        let root = formula(&mut dag, source);
        let mut formulas = collected();
        let root = formulas.build(&dag, root);
        assert_eq!(text::write(&formulas, root), expected, "{source}");
    }
}

/// Σ (q[i+1] − q[i])²/2 over the bonds of a chain of five, the third with another factor.
fn chain(dag: &mut Dag, other: i64) -> Id {
    let terms: Vec<Id> = (0..5)
        .map(|bond| {
            let (a, b) = (element(dag, "q", bond), element(dag, "q", bond + 1));
            // the order in which a sum is written plays no part
            let difference = if bond == 1 {
                let a = dag.neg(a);
                dag.add(a, b)
            } else {
                dag.sub(b, a)
            };
            let square = dag.powi(difference, 2);
            let factor = dag.fraction(if bond == 4 { other } else { 1 }, 2);
            dag.mul(factor, square)
        })
        .collect();
    dag.sum(terms)
}

#[test]
fn terms_of_the_same_form_are_one() {
    for (other, expected) in [
        (1, "sum(j in 0..5, (q[j+1] - q[j])^2/2)"),
        (
            3,
            "sum(j in 0..4, (q[j+1] - q[j])^2/2) + 3*(q[5] - q[4])^2/2",
        ),
    ] {
        let mut dag = Dag::new();
        let root = chain(&mut dag, other);
        let mut formulas = collected();
        let root = formulas.build(&dag, root);
        let root = Patterns::default().collapsed(&mut formulas, root);
        assert_eq!(text::write(&formulas, root), expected);
    }
}

#[test]
fn indices_are_measured_from_the_row() {
    let mut dag = Dag::new();
    let root = chain(&mut dag, 1);
    let mut formulas = collected();
    let root = formulas.build(&dag, root);
    let mut patterns = Patterns::default();
    assert_eq!(patterns.least_index(&formulas, root), Some(0));
    let row = patterns.shifted(&mut formulas, root, 2, Position::InRow);
    let written = text::write(&formulas, row);
    assert!(written.starts_with("(q[i-1] - q[i-2])^2/2 + "), "{written}");
    assert!(written.ends_with("(q[i+3] - q[i+2])^2/2"), "{written}");
}

#[test]
fn parts_of_long_formulas_get_a_name() {
    let mut dag = Dag::new();
    let long = formula(
        &mut dag,
        "sin(sqrt(x^2 + y^2))*cos(sqrt(x^2 + y^2)) + exp(sqrt(x^2 + y^2))/sqrt(x^2 + y^2)",
    );
    let short = formula(&mut dag, "sqrt(x^2 + y^2)");
    let mut formulas = collected();
    let mut roots = [long, short].map(|root| formulas.build(&dag, root));
    let definitions = Shared::default().name(&mut formulas, &mut roots, 60);
    let [long, short] = roots.map(|root| text::write(&formulas, root));
    assert_eq!(long, "sin(u₁)*cos(u₁) + exp(u₁)/u₁");
    // what has a name is called by it
    assert_eq!(short, "u₁");
    let [only] = definitions.as_slice() else {
        panic!("{definitions:?}");
    };
    assert_eq!(only.number, 1);
    assert_eq!(text::write(&formulas, only.formula), "sqrt(x^2 + y^2)");
}

#[test]
fn nothing_is_named_where_everything_fits() {
    let mut dag = Dag::new();
    let root = formula(&mut dag, "sqrt(x^2 + y^2) + exp(sqrt(x^2 + y^2))");
    let mut formulas = collected();
    let root = formulas.build(&dag, root);
    let mut roots = [root];
    assert!(
        Shared::default()
            .name(&mut formulas, &mut roots, 60)
            .is_empty()
    );
    assert_eq!(roots, [root]);
}

fn in_latex(dag: &Dag, root: Id) -> String {
    let mut formulas = collected();
    let root = formulas.build(dag, root);
    let names = ["x", "x_1", "omega", "tau", "q", "ω"];
    let style = Style::new(Letters::default(), names);
    latex::write(&formulas, root, &style)
}

#[test]
fn formulas_in_latex() {
    for (source, expected) in [
        ("x/2", r"\frac{x}{2}"),
        ("(x + y)/2", r"\frac{x + y}{2}"),
        ("-3*x/4", r"-\frac{3 \, x}{4}"),
        ("sqrt(x)^3", r"\left(\sqrt{x}\right)^{3}"),
        ("sin(omega*t)", r"\sin\left(\omega \, t\right)"),
        ("tau + lambda", r"\mathit{tau} + \mathit{lambda}"),
        ("x_1^(3/2)", r"\mathit{x\_1}^{\frac{3}{2}}"),
        ("asin(x)", r"\arcsin\left(x\right)"),
        ("ln_dd(x, 2)", r"\operatorname{dd}_{\ln}\left(x, 2\right)"),
        ("x*2^y", r"x \cdot 2^{y}"),
    ] {
        let mut dag = Dag::new();
        let root = formula(&mut dag, source);
        assert_eq!(in_latex(&dag, root), expected, "{source}");
    }
}

#[test]
fn ends_elements_and_like_names_differ_in_latex() {
    let mut dag = Dag::new();
    let mut written = |name: Name| {
        let variable = dag.variable(&name);
        in_latex(&dag, variable)
    };
    assert_eq!(written(Name::new("x").at_end()), "x_{1}");
    assert_eq!(written(Name::new("x_1")), r"\mathit{x\_1}");
    assert_eq!(written(Name::new("q[2]").at_start()), "q_{[2],0}");
    assert_eq!(written(Name::new("omega")), r"\omega");
    assert_eq!(written(Name::new("ω")), r"\omega'");
}
