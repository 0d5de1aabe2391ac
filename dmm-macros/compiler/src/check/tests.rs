//! What a correct declaration becomes, and what is said about a wrong one.

use proc_macro2::TokenStream;

use super::resolve;
use crate::algebra::{Math, Name};
use crate::diagnostics::Diagnostics;
use crate::model::{Model, Sign};
use crate::syntax;

fn read(text: &str) -> (Option<Model>, Vec<String>) {
    let tokens: TokenStream = text.parse().expect("the test's text is made of tokens");
    let mut diagnostics = Diagnostics::new();
    let declaration = syntax::parse(tokens, &mut diagnostics);
    assert_eq!(diagnostics.messages(), Vec::<String>::new(), "{text}");
    let declaration = declaration.expect("no error, so a declaration");
    let model = resolve(declaration, &mut diagnostics);
    assert_eq!(model.is_some(), diagnostics.is_empty());
    (model, diagnostics.messages())
}

fn model(text: &str) -> Model {
    let (model, messages) = read(text);
    assert_eq!(messages, Vec::<String>::new(), "{text}");
    model.expect("no error, so a model")
}

/// The messages on the items of a system.
fn messages(items: &str) -> Vec<String> {
    read(&format!("system S {{ {items} }}")).1
}

#[track_caller]
fn one(items: &str, message: &str) {
    let messages = messages(items);
    assert_eq!(messages.len(), 1, "{items}: {messages:?}");
    assert!(messages[0].contains(message), "{items}: {messages:?}");
}

/// One message on `der(x) = formula;` with a state x, a parameter k, a constant c and a let r.
#[track_caller]
fn one_in_formula(formula: &str, message: &str) {
    one(
        &format!(
            "state x; param k = 1; const c = 2; let r = x + k + c; \
             der(x) = {formula}; conserved keep = x + k + c + r;"
        ),
        message,
    );
}

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
fn every_function_is_there() {
    model(
        "system S { state x; der(x) = sqrt(x) + exp(x) + ln(x) + sin(x) + cos(x) + tan(x)
         + sinh(x) + cosh(x) + tanh(x) + asin(x) + acos(x) + atan(x) + x^(1/3) + x^0.37 + 2^x + pi + t; }",
    );
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
    one("state x; let sin = 3; der(x) = sin;", "`sin` is a function");
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
        "the parameter `k` is never used",
    );
    one(
        "state x; const c = 1; der(x) = 1;",
        "the constant `c` is never used",
    );
    one(
        "state x; let c = x; der(x) = 1;",
        "the `let` `c` is never used",
    );
    one(
        "state x; interface g = x;
         region a where g > 0 { let q = 1; der(x) = 1; } region b where g < 0 { der(x) = 1; }",
        "the `let` `q` is never used",
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
fn functions_are_known_and_called_with_one_argument() {
    for (formula, message) in [
        ("log(x)", "the natural logarithm is `ln(x)`"),
        ("abs(x)", "`abs` is not smooth"),
        ("max(x, 0)", "`max` is not smooth"),
        ("sign(x)", "`sign` is not smooth"),
        ("pow(x, 2)", "power is written `^`"),
        ("sine(x)", "did you mean `sin`?"),
        ("sqr(x)", "power is written `^`"),
        ("sqrrt(x)", "did you mean `sqrt`?"),
        ("gamma(x)", "there is no function `gamma`"),
        ("sinc(x)", "there is no function `sinc`"),
        ("sin(x, x)", "`sin` takes one argument, not 2"),
        ("sin()", "`sin` takes one argument, not none"),
        ("x(t)", "a state is written without its argument: `x`"),
        ("k(x + 1)", "`k` is a parameter, not a function"),
        ("der(x)", "with `let`"),
    ] {
        one_in_formula(formula, message);
    }
}

#[test]
fn formulas_can_be_evaluated() {
    for (formula, message) in [
        ("x / 0", "division by zero"),
        (
            "1 / (0.1 + 0.2 - 0.3)",
            "division by `0.1 + 0.2 - 0.3`, which is zero",
        ),
        ("1 / (x - x)", "which is zero"),
        ("x + ln(-1)", "`ln` of -1 cannot be evaluated"),
        ("ln(0)", "its argument must be positive"),
        ("sqrt(-2)", "its argument must not be negative"),
        ("sqrt(1 - c)", "`sqrt` of -1"),
        ("asin(2)", "in [-1, 1]"),
        ("exp(1000)", "beyond the range"),
        ("10^400", "beyond the range"),
        ("10^100000", "beyond the range"),
        ("1e300 * 1e300", "beyond the range"),
        ("1e300 * x * 1e300", "beyond the range"),
        ("x * 1e-400", "beyond the range"),
        ("0^-1", "divides by zero"),
        ("(-8)^(1/3)", "no real power with a fractional exponent"),
        ("(-2)^x", "the base must be positive"),
        ("x^1000", "up to the exponent 100"),
    ] {
        one_in_formula(formula, message);
    }
}

#[test]
fn every_state_has_one_derivative() {
    one("state x, y; der(x) = y;", "the system has no `der(y)`");
    one(
        "state x, y, z; der(x) = y;",
        "the system has no `der(y)`, `der(z)`",
    );
    one(
        "state x; der(x) = 1; der(x) = 2;",
        "`der(x)` is given twice",
    );
    one("state x; der(x) = 1; der(y) = 2;", "there is no state `y`");
    one(
        "state position; der(positon) = 2;",
        "did you mean `position`?",
    );
    one(
        "state x; param k = 1; der(x) = 1; der(k) = 2;",
        "`k` is a parameter; only states have a `der`",
    );
    one(
        "state x; der(x) = 1; der(t) = 1;",
        "`t` is the time, which needs no `der`",
    );
    one(
        "state x, y; interface g = x;
         region a where g > 0 { der(x) = y; } region b where g < 0 { der(x) = y; der(y) = 1; }",
        "the region `a` has no `der(y)`",
    );
    one(
        "state x; interface g = x; region a where g > 0 { der(x) = 1; der(x) = 2; }
         region b where g < 0 { der(x) = 1; }",
        "`der(x)` is given twice in the region `a`",
    );
    one(
        "param k = 1; const c = 1; let _a = k + c;",
        "at least one state",
    );
    let many: Vec<String> = (0..33)
        .map(|i| format!("state x{i}; der(x{i}) = 1;"))
        .collect();
    one(&many.join(" "), "33 states are too many");
}

/// A system with the interface g and these regions.
fn with_regions(regions: &str) -> String {
    format!("state x; interface wall = x; {regions}")
}

#[test]
fn regions_are_the_two_sides_of_the_interface() {
    let both = "region a where wall > 0 { der(x) = 1; } region b where wall < 0 { der(x) = 1; }";
    assert_eq!(messages(&with_regions(both)), Vec::<String>::new());
    for (regions, message) in [
        (
            "region a where wall > 0 { der(x) = 1; }",
            "there is no region where `wall < 0`",
        ),
        ("", "the interface `wall` bounds no region"),
        ("der(x) = 1;", "the interface `wall` bounds no region"),
        (
            "region a where wall > 0 { der(x) = 1; } region b where wall > 0 { der(x) = 1; }",
            "the regions `a` and `b` overlap: both are where `wall > 0`",
        ),
        (
            "region a where wall > 0 { der(x) = 1; } region a where wall < 0 { der(x) = 1; }",
            "the region `a` is declared twice",
        ),
        (
            "region low_y where wall > 0 { der(x) = 1; } region lowY where wall < 0 { der(x) = 1; }",
            "are both called `LowY`",
        ),
        (
            "region a { der(x) = 1; } region b where wall < 0 { der(x) = 1; }",
            "on which side is the region `a`?",
        ),
        (
            "region a where wal > 0 { der(x) = 1; } region b where wall < 0 { der(x) = 1; }",
            "did you mean `wall`?",
        ),
        (
            "region a where x > 0 { der(x) = 1; } region b where wall < 0 { der(x) = 1; }",
            "`x` is a state, not an interface",
        ),
        (
            "region a where wall > 0 and wall > 0 { der(x) = 1; } region b where wall < 0 { der(x) = 1; }",
            "`wall` stands twice",
        ),
        (
            "der(x) = 2; region a where wall > 0 { der(x) = 1; } region b where wall < 0 { der(x) = 1; }",
            "`der(x)` belongs into each region",
        ),
        (
            "conserved e = x; region a where wall > 0 { der(x) = 1; } region b where wall < 0 { der(x) = 1; }",
            "`conserved e` belongs into the regions",
        ),
    ] {
        one(&with_regions(regions), message);
    }
}

#[test]
fn regions_need_an_interface_that_can_be_crossed() {
    one(
        "state x; region a { der(x) = 1; }",
        "a region is bounded by an interface",
    );
    one(
        "state x; region a where wall > 0 { der(x) = 1; }",
        "there is no interface `wall`",
    );
    one(
        "state x; param k = 1; interface wall = k - 2;
         region a where wall > 0 { der(x) = 1; } region b where wall < 0 { der(x) = 1; }",
        "depends neither on a state nor on `t`",
    );
    one(
        "state x, y; interface left = x; interface low = y;
         region a where left > 0 and low > 0 { der(x) = 1; der(y) = 1; }
         region b where left < 0 and low > 0 { der(x) = 1; der(y) = 1; }",
        "several interfaces are not supported yet: `low` is the second",
    );
}

#[test]
fn a_missing_region_does_not_make_its_parameters_unused() {
    let messages = messages(
        "state x; param k_above = 1, k_below = 2; interface wall = x;
         region above where wall > 0 { der(x) = k_above; }",
    );
    assert_eq!(messages.len(), 1, "{messages:#?}");
    assert!(messages[0].contains("there is no region where `wall < 0`"));
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
        "the region `a` has no `der(y)`",
        "`sin` takes one argument",
        "`ln` of -1",
        "the parameter `unused` is never used",
    ];
    assert_eq!(messages.len(), expected.len(), "{messages:#?}");
    for (message, expected) in messages.iter().zip(expected) {
        assert!(message.contains(expected), "{message} / {expected}");
    }
}
