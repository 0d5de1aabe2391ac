//! What is proved, and what is said about what is false.

mod assumed;
mod domains;
mod events;

use proc_macro2::TokenStream;

use super::*;
use crate::algebra::to_text;
use crate::{check as names, syntax};
use domains::domain;

/// The proved model of a declaration, and the messages of the proofs.
fn proved(items: &str) -> (Option<Proved>, Vec<String>) {
    let text = format!("system S {{ {items} }}");
    let tokens: TokenStream = text.parse().expect("the test's text is made of tokens");
    let mut diagnostics = Diagnostics::new();
    let declaration = syntax::parse(tokens, &mut diagnostics).expect("a head");
    let model = names::resolve(declaration, &mut diagnostics);
    assert_eq!(diagnostics.messages(), Vec::<String>::new(), "{items}");
    let proved = prove(model.expect("a model"), &mut diagnostics);
    (proved, diagnostics.messages())
}

fn messages(items: &str) -> Vec<String> {
    proved(items).1
}

/// The proved model of a declaration without errors.
#[track_caller]
fn sound(items: &str) -> Proved {
    let (proved, messages) = proved(items);
    assert_eq!(messages, Vec::<String>::new(), "{items}");
    proved.expect("a proved model")
}

fn evidence(proved: &Proved) -> &Conservation {
    &proved.regions[0].evidence[0]
}

/// Where the gradients become dependent: factors; cofactors.
#[track_caller]
fn dependence(items: &str) -> [Vec<String>; 2] {
    let proved = sound(items);
    let Independence::Proved { factors, minors } = &proved.regions[0].independence else {
        panic!("{items}: {:?}", proved.regions[0].independence);
    };
    [factors, minors].map(|ids| {
        ids.iter()
            .map(|&id| to_text(&proved.model.dag, id))
            .collect()
    })
}

#[track_caller]
fn one(items: &str, parts: &[&str]) {
    let messages = messages(items);
    assert_eq!(messages.len(), 1, "{items}: {messages:?}");
    for part in parts {
        assert!(messages[0].contains(part), "{items}: {messages:?}");
    }
}

#[test]
fn conserved_quantities_are_proved() {
    for items in [
        "state x, y; param k = 2; der(x) = y; der(y) = -k*x; conserved e = (y^2 + k*x^2)/2;",
        "state q, p; der(q) = p; der(p) = -sin(q); conserved h = p^2/2 - cos(q);",
        "state x, y; param a = 1, b = 1, c = 1, d = 1;
         der(x) = x*(a - b*y); der(y) = y*(d*x - c);
         conserved v = d*x - c*ln(x) + b*y - a*ln(y);",
        "state x; der(x) = -x; conserved c = x*exp(t);",
        "state x, v; param m = 1, c = 0.1, k = 2;
         der(x) = v; der(v) = -(c*v + k*x)/m;
         conserved h = exp(c*t/m)*(m*v^2 + c*x*v + k*x^2)/2;",
        "state a, b, c; param i = 1, j = 2, k = 3;
         der(a) = (j - k)/(j*k)*b*c; der(b) = (k - i)/(k*i)*c*a; der(c) = (i - j)/(i*j)*a*b;
         conserved l = a^2 + b^2 + c^2; conserved e = a^2/i + b^2/j + c^2/k;",
        "state x, y; der(x) = 1; der(y) = 0;",
    ] {
        assert_eq!(messages(items), Vec::<String>::new(), "{items}");
    }
}

#[test]
fn what_is_not_conserved_is_refuted_with_its_residual_and_a_point() {
    one(
        "state x, y; param k = 2; der(x) = y; der(y) = -k*x; conserved e = (y^2 + x^2)/2;",
        &[
            "`e` is not conserved: d/dt e = ",
            ", which is ",
            " at ",
            "x = ",
        ],
    );
    one(
        "state x, y; interface g = y;
         region above where g > 0 { der(x) = y; der(y) = -x; conserved e = y^2 - x^2; }
         region below where g < 0 { der(x) = y; der(y) = -x; }",
        &["`e` is not conserved in the region `above`"],
    );
    one(
        "state x; der(x) = 1; conserved e = x - 2*t;",
        &["d/dt e = -1"],
    );
    one("state x; der(x) = 1; conserved e = t;", &["d/dt e = 1"]);
}

#[test]
fn a_constant_is_not_conserved_but_constant() {
    one(
        "state x; der(x) = 0; conserved e = 1;",
        &["`e` depends neither on"],
    );
    one(
        "state x; der(x) = x; conserved e = sin(x)^2 + cos(x)^2;",
        &["`e` depends neither on"],
    );
}

#[test]
fn conserved_quantities_are_independent_and_few() {
    let harmonic = "state x, y; der(x) = y; der(y) = -x; conserved a = x^2 + y^2;";
    one(
        &format!("{harmonic} conserved b = 3*x^2 + 3*y^2 + 1;"),
        &["`b` depends on `a`: their gradients are linearly dependent"],
    );
    one(
        &format!("{harmonic} conserved b = exp(-x^2 - y^2);"),
        &["`b` depends on `a`"],
    );
    one(
        &format!("{harmonic} conserved b = (x^2 + y^2)^2; conserved c = ln(x^2 + y^2);"),
        &["3 conserved quantities of 2 states depend on one another: leave out 1"],
    );
    one(
        "state x, y, z; der(x) = y; der(y) = -x; der(z) = 0;
         conserved a = z; conserved b = x^2 + y^2; conserved c = z + x^2 + y^2;",
        &["`c` depends on `a`, `b`"],
    );
    one(
        "state x, y; der(x) = 0; der(y) = 0; conserved a = x + y; conserved b = x - y;",
        &["leave nothing to move"],
    );
    // time-dependent quantities may be as many as states
    assert_eq!(
        messages(
            "state x, y; der(x) = x; der(y) = 1; conserved a = x*exp(-t); conserved b = y - t;"
        ),
        Vec::<String>::new()
    );
}

#[test]
fn interfaces_can_be_crossed() {
    one(
        "state x; interface g = sin(x)^2 + cos(x)^2 - 1/2;
         region a where g > 0 { der(x) = 1; } region b where g < 0 { der(x) = 2; }",
        &["the interface `g` is constant"],
    );
    one(
        "state x, y; interface g = x^2 + y^2 - 1;
         region a where g > 0 { der(x) = y; der(y) = -x; }
         region b where g < 0 { der(x) = -y; der(y) = x; }",
        &["the interface `g` is never crossed"],
    );
}

#[test]
fn numbers_are_short() {
    for (value, text) in [
        (0.123456, "0.1235"),
        (-2.0, "-2"),
        (123456.0, "1.235e5"),
        (1.23456e-7, "1.235e-7"),
        (0.0, "0"),
    ] {
        assert_eq!(message::rounded(value), text);
    }
}

#[test]
fn a_hamiltonian_is_conserved_by_construction() {
    let proved = sound("state q, p; hamiltonian H = p^2/2 - cos(q) in (q, p);");
    assert_eq!(*evidence(&proved), Conservation::ByConstruction);
    // another state in H has to be proved not to move it
    let pendulum = "state q, p, w; hamiltonian H = p^2/2 - w*cos(q) in (q, p);";
    assert_eq!(domain(&format!("{pendulum} der(w) = 0;")), "");
    one(
        &format!("{pendulum} der(w) = 1;"),
        &["`H` is not conserved", "PWS300"],
    );
}

#[test]
fn a_coefficient_that_is_almost_right_is_refuted() {
    one(
        "state x, y; der(x) = y; der(y) = -x; conserved e = x^2 + y^2 + x^2/10^20;",
        &["d/dt e = y*x/50000000000000000000, which is 2e-20 at x = 1, y = 1"],
    );
}

#[test]
fn a_long_residual_names_few_coordinates() {
    let states: Vec<String> = (0..12).map(|i| format!("x{i}")).collect();
    let rates: String = (0..12)
        .map(|i| format!("der(x{i}) = x{};", (i + 1) % 12))
        .collect();
    one(
        &format!(
            "state {}; {rates} conserved s = {};",
            states.join(", "),
            states.join(" + ")
        ),
        &[" = 1, everything else 0"],
    );
}

#[test]
fn the_set_of_dependence_is_found() {
    assert_eq!(
        dependence("state x, y; der(x) = y; der(y) = -x; conserved e = x^2 + y^2;"),
        [vec![], vec!["x", "y"]]
    );
    let none: [Vec<String>; 2] = [vec![], vec![]];
    assert_eq!(
        dependence("state x, y; der(x) = 1; der(y) = 2*x; conserved e = y - x^2;"),
        none
    );
    assert_eq!(
        dependence(
            "state x, y, z; param a = 1, b = 2, c = 3;
             der(x) = (1/c - 1/b)*y*z; der(y) = (1/a - 1/c)*z*x; der(z) = (1/b - 1/a)*x*y;
             conserved m = x^2 + y^2 + z^2; conserved e = x^2/a + y^2/b + z^2/c;"
        ),
        [vec![], vec!["x*y*(a - b)", "x*z*(a - c)", "y*z*(b - c)"]]
    );
    // energy, angular momentum and a component of the Laplace vector depend on one another
    // where its other component −u(xv − yu) − my/r is zero, and where the field vanishes
    let [factors, minors] = dependence(
        "state x, y, u, v; param m = 1; let r = sqrt(x^2 + y^2);
         der(x) = u; der(y) = v; der(u) = -m*x/r^3; der(v) = -m*y/r^3;
         conserved e = (u^2 + v^2)/2 - m/r; conserved l = x*v - y*u;
         conserved a = v*(x*v - y*u) - m*x/r;",
    );
    assert_eq!(
        factors,
        ["v*u*x*sqrt(x^2 + y^2) - u^2*y*sqrt(x^2 + y^2) + m*y"]
    );
    assert_eq!(minors.len(), 4);
}

#[test]
fn a_dependence_is_an_error_only_if_it_is_proved() {
    // x(1 + √2) and x√(3 + 2√2) are the same, which the normal form does not see
    let proved = sound(
        "state x, y; der(x) = 0; der(y) = 1;
         conserved a = (1 - 2^(1/3) + 4^(1/3))*x; conserved b = (9*2^(1/3) - 9)^(1/3)*x + y - t;",
    );
    assert!(matches!(
        proved.regions[0].independence,
        Independence::Proved { .. }
    ));
    let proved = sound(
        "state x, y, z; der(x) = 0; der(y) = 0; der(z) = 1;
         conserved a = (1 - 2^(1/3) + 4^(1/3))*x + y; conserved b = (9*2^(1/3) - 9)^(1/3)*x + y;",
    );
    assert_eq!(proved.regions[0].independence, Independence::Undecided);
}

#[test]
fn interfaces_that_no_trajectory_crosses_are_reported() {
    one(
        "state x, y; interface g = x;
         region a where g > 0 { der(x) = -1 - y^2; der(y) = 1; }
         region b where g < 0 { der(x) = exp(y); der(y) = 2; }",
        &["both sides push towards it", "PWS310"],
    );
    one(
        "state x, y; interface g = x;
         region a where g > 0 { der(x) = 1; der(y) = 1; }
         region b where g < 0 { der(x) = -y^2; der(y) = 2; }",
        &["both sides lead away from it", "PWS311"],
    );
    // one side alone is no error
    sound(
        "state x, y; interface g = x;
         region a where g > 0 { der(x) = -1; der(y) = 1; }
         region b where g < 0 { der(x) = y; der(y) = 2; }",
    );
}
