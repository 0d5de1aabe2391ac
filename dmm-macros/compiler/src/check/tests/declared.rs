//! Declarations as a whole, names, and constants.

use super::formulas::one_in_formula;
use super::{messages, model, one};
use crate::algebra::{Math, Name};
use crate::model::Sign;

const HARMONIC: &str = "
    /// An oscillator.
    pub(crate) system Harmonic {
        state /** position */ x, y;
        param k_above = 1.0, k_below = 2*pi;
        const half = 1/2;
        let square = y^2;
        /// The spring's kink.
        interface spring = y;
        /// The upper half plane.
        region above where spring > 0 {
            der(x) = y;
            der(y) = -k_above * x;
            /// The energy.
            conserved energy = half * (square + k_above * x^2);
        }
        region below where spring < 0 {
            let stretch = k_below * x;
            der(y) = -stretch;
            der(x) = y;
        }
    }";

#[test]
fn a_declaration_becomes_a_model() {
    let model = model(HARMONIC);
    assert_eq!(model.name, "Harmonic");
    assert_eq!(model.attributes.len(), 1);
    let states: Vec<String> = model.states.iter().map(|s| s.ident.to_string()).collect();
    assert_eq!(states, ["x", "y"]);
    assert_eq!(model.states[0].attributes.len(), 1);
    let parameters: Vec<&str> = model.parameters.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(parameters, ["k_above", "k_below"]);
    assert_eq!(model.interfaces.len(), 1);
    assert_eq!(model.interfaces[0].attributes.len(), 1);
    let [above, below] = model.regions.as_slice() else {
        panic!("two regions")
    };
    assert_eq!(above.sides[0].sign, Sign::Positive);
    assert_eq!(below.sides[0].sign, Sign::Negative);
    assert_eq!(above.attributes.len(), 1);
    assert_eq!(above.conserved[0].attributes.len(), 1);
    assert_eq!(above.conserved[0].ident, "energy");
    assert!(below.conserved.is_empty());
    // der(y) comes first in the source, der(x) in the field
    let y = model.dag[below.field[0]].clone();
    assert_eq!(y, Math::Variable(Name::new("y")));
    assert!(model.dag.depends_on(below.field[1], &Name::new("k_below")));
    // const and let are gone
    let energy = above.conserved[0].psi;
    let names: Vec<String> = model
        .dag
        .variables([energy])
        .iter()
        .map(ToString::to_string)
        .collect();
    assert_eq!(names, ["k_above", "x", "y"]);
    assert!(model.source.contains("    param k_below = 2 * pi;\n"));
    assert!(model.source.contains("        /// The energy.\n"));
}

#[test]
fn a_smooth_system_has_one_region() {
    let model = model(
        "system Damped { state x, v; param c = 0.1; der(x) = v; der(v) = -x - c*v + 0*sin(t);
         conserved h = exp(c*t) * (v^2 + x^2 + c*x*v) / 2; }",
    );
    assert!(model.interfaces.is_empty());
    assert_eq!(model.regions.len(), 1);
    assert_eq!(model.regions[0].ident, "everywhere");
    assert!(model.regions[0].sides.is_empty());
    assert_eq!(model.regions[0].field.len(), 2);
}

#[test]
fn a_smooth_system_may_be_free_of_everything() {
    model("system S { state x; der(x) = 0; }");
    // a leading underscore says that a name is meant to be unused
    model("system S { state x; param _k = 1; der(x) = 1; }");
}

#[test]
fn names_are_declared_once() {
    one("state x, x; der(x) = 1;", "the state `x` is declared twice");
    one(
        "state x; param x = 1; der(x) = 1;",
        "`x` is already declared as a state",
    );
    one(
        "param x = 1; state x; der(x) = x;",
        "`x` is already declared as a parameter",
    );
    one(
        "state x; interface g = x; let g = 1;
         region a where g > 0 { der(x) = g; } region b where g < 0 { der(x) = 1; }",
        "`g` is already declared as an interface",
    );
    one(
        "interface g = x; state x;
         region a where g > 0 { der(x) = 1; } region b where g < 0 { der(x) = 1; }",
        "`x` is used before it is declared",
    );
    one(
        "state x, t; der(x) = t;",
        "`t` is the time and cannot be declared as a state",
    );
    one(
        "state x; param pi = 3; der(x) = pi;",
        "`pi` is the number π",
    );
    one(
        "state x; let sin = 3; der(x) = sin;",
        "`sin` is a built-in function",
    );
    one(
        "state x; interface g = x; let r = x;
         region a where g > 0 { let r = 2; der(x) = r; } region b where g < 0 { der(x) = 1; }",
        "`let` `r` is declared twice",
    );
    one(
        "state x; der(x) = 1; conserved a = t - x; conserved a = x - t;",
        "`a` is declared twice",
    );
}

#[test]
fn names_are_declared_before_their_use() {
    one(
        "state x; let a = b; let b = x; der(x) = a + b;",
        "`b` is used before it is declared",
    );
    one(
        "state x; let a = a + x; der(x) = a;",
        "`a` is used before it is declared",
    );
    one(
        "state x; let a = b; let b = a; der(x) = a + b;",
        "`b` is used before it is declared",
    );
    one_in_formula("z + z", "`z` is not declared: declare it");
    one(
        "state velocity; der(velocity) = velocty;",
        "`velocty` is not declared; did you mean `velocity`?",
    );
    one(
        "state x; param k_above = 1; der(x) = k_abov;",
        "did you mean `k_above`?",
    );
    one_in_formula("time", "the time is `t`");
    one_in_formula("2*PI", "the number π is `pi`");
    one_in_formula("e^x", "Euler's number is `exp(1)`");
    one_in_formula("sin", "write `sin(x)`");
    one_in_formula("keep", "`keep` is a conserved quantity");
    one(
        "state x; interface g = x;
         region a where g > 0 { let stretch = 2; der(x) = stretch; }
         region b where g < 0 { der(x) = stretch; }",
        "a `let` of the region `a`",
    );
    one(
        "state x; interface wall = x;
         region a where wall > 0 { der(x) = wall; } region b where wall < 0 { der(x) = 1; }",
        "`wall` is an interface",
    );
}

#[test]
fn what_is_declared_is_used() {
    one(
        "state x; param k = 1; der(x) = 1;",
        "warning: the parameter `k` is never used",
    );
    one(
        "state x; const c = 1; der(x) = 1;",
        "warning: the constant `c` is never used",
    );
    one(
        "state x; let c = x; der(x) = 1;",
        "warning: the `let` `c` is never used",
    );
    one(
        "state x; interface g = x;
         region a where g > 0 { let q = 1; der(x) = 1; } region b where g < 0 { der(x) = 1; }",
        "warning: the `let` `q` is never used",
    );
}

#[test]
fn constants_are_constant() {
    one(
        "state x; const c = x; der(x) = c;",
        "a constant cannot depend on the state `x`",
    );
    one(
        "state x; const c = t; der(x) = c;",
        "a constant cannot depend on the time",
    );
    one(
        "state x; param k = x; der(x) = k;",
        "the default of a parameter cannot depend on the state `x`",
    );
    one(
        "state x; param k = 1, m = k; der(x) = m + k;",
        "cannot depend on the parameter `k`",
    );
    one(
        "state x; let a = x; param m = a; der(x) = m;",
        "cannot depend on `a`, which varies",
    );
    model("system S { state x; const c = 2*pi; let d = c/2; param k = d^2; der(x) = k; }");
}

#[test]
fn all_errors_are_reported_together() {
    let messages = messages(
        "state x, y; param k = 1, unused = 2; const c = 1/0; interface wall = zz;
         region a where wall > 0 { der(x) = log(y) + qq; der(x) = 1; }
         region b where wall < 0 { der(x) = sin(x, y); der(y) = k * c; conserved e = ln(-1); }",
    );
    let expected = [
        "division by zero",
        "`zz` is not declared",
        "the natural logarithm",
        "`qq` is not declared",
        "`der(x)` is given twice in the region `a`",
        "`sin` takes one argument",
        "`ln` of -1",
        "the region `a` has no `der(y)`",
    ];
    assert_eq!(messages.len(), expected.len(), "{messages:#?}");
    for (message, expected) in messages.iter().zip(expected) {
        assert!(message.contains(expected), "{message} / {expected}");
    }
}
