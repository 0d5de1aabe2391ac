//! What is proved, and what is said about what is false.

use proc_macro2::TokenStream;

use super::*;
use crate::{check as names, syntax};

fn messages(items: &str) -> Vec<String> {
    let text = format!("system S {{ {items} }}");
    let tokens: TokenStream = text.parse().expect("the test's text is made of tokens");
    let mut diagnostics = Diagnostics::new();
    let declaration = syntax::parse(tokens, &mut diagnostics).expect("a head");
    let model = names::resolve(declaration, &mut diagnostics);
    assert_eq!(diagnostics.messages(), Vec::<String>::new(), "{items}");
    check(&mut model.expect("a model"), &mut diagnostics);
    diagnostics.messages()
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
        assert_eq!(rounded(value), text);
    }
}
