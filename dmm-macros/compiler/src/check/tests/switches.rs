//! Switches within formulas.

use std::collections::BTreeMap;

use super::{field, messages, model, one};
use crate::algebra::{Name, evaluate};

#[test]
fn a_branch_is_a_formula_with_the_side_of_its_interface() {
    let model = model(
        "system S { state x, v; param b = 1; der(x) = v;
         der(v) = if v > b { -x } else if x < 0 { 1 } else { 2*x }; }",
    );
    assert_eq!(model.interfaces.len(), 2);
    let names: Vec<String> = model.interfaces.iter().map(|one| one.name()).collect();
    // in the order of the source: the outer branch waits for the inner one
    assert_eq!(names, ["-x", "v - b"]);
    assert_eq!(model.free_interfaces(), [0, 1]);
    assert!(
        field(&model, 0)[1].contains("side of switch_2"),
        "{:?}",
        field(&model, 0)
    );
}

#[test]
fn equal_formulas_switch_at_one_interface() {
    let model = model(
        "system S { state x; interface wall = x; fn f(u) = abs(u) + sign(u);
         region a where wall > 0 { der(x) = f(x); } region b where wall < 0 { der(x) = max(x, 0); } }",
    );
    assert_eq!(model.interfaces.len(), 1);
    assert!(model.interfaces[0].is_switch);
    // of numbers the value is known
    assert_eq!(
        messages("state x; const c = abs(-2) + min(1, 3) + sign(-1); der(x) = c;"),
        Vec::<String>::new()
    );
}

#[test]
fn a_branch_has_a_value_on_the_other_side() {
    let model = model("system S { state x; der(x) = if x > 1 { sqrt(x - 1)/x } else { x }; }");
    let values = |x: f64, side: f64| {
        let point = BTreeMap::from([
            (Name::new("x"), x),
            (model.interfaces[0].side.clone(), side),
        ]);
        evaluate(&model.dag, &model.regions[0].field, &point)[0]
    };
    assert_eq!(values(-3.0, 0.0), -3.0);
    assert_eq!(values(0.0, 0.0), 0.0);
    assert_eq!(values(5.0, 1.0), 0.4);
}

#[test]
fn what_cannot_switch_is_told() {
    for (formula, message) in [
        (
            "if k > 0 { x } else { 0 }",
            "depends neither on a state nor on `t`",
        ),
        ("abs(x, k)", "`abs` takes 1 argument, not 2"),
        ("floor(x)", "`floor` jumps without end"),
        ("heaviside(x)", "write `if x > 0 { 1 } else { 0 }`"),
    ] {
        one(
            &format!("state x; param k = 1; der(x) = k + {formula};"),
            message,
        );
    }
}
