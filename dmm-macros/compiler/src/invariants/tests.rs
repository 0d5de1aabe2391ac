//! What is found, and that it can be pasted into a declaration.

use proc_macro2::TokenStream;

use super::{find, read, report};
use crate::algebra::{differentiate, evaluate};
use crate::diagnostics::Diagnostics;
use crate::model::Model;
use crate::syntax;

fn model(items: &str) -> Model {
    let text = format!("system S {{ {items} }}");
    let tokens: TokenStream = text.parse().expect("the test's text is made of tokens");
    match read(tokens) {
        Ok(model) => model,
        Err(diagnostics) => panic!("{items}: {:?}", diagnostics.messages()),
    }
}

/// The lines that the report offers for a declaration.
#[track_caller]
fn offered(items: &str, degree: u32) -> Vec<String> {
    let text = report(&mut model(items), degree).expect("a report");
    let lines = text.lines().map(str::trim);
    let lines = lines.filter(|line| line.starts_with("conserved "));
    lines.map(str::to_owned).collect()
}

/// What is offered for a system without interfaces, and that the declaration with it is accepted.
#[track_caller]
fn accepted(items: &str, degree: u32, expected: &[&str]) {
    let offered = offered(items, degree);
    let formulas: Vec<&str> = offered
        .iter()
        .filter_map(|line| Some(line.split_once(" = ")?.1.trim_end_matches(';')))
        .collect();
    assert_eq!(formulas, expected, "{items}");
    // A system in which nothing is left to move is refused for that reason.
    let states = model(items).states.len();
    let pasted: String = offered.into_iter().take(states - 1).collect();
    let text = format!("system S {{ {items} {pasted} }}");
    let mut diagnostics = Diagnostics::new();
    let tokens = text.parse().expect("tokens");
    let declaration = syntax::parse(tokens, &mut diagnostics).expect("a head");
    let scheme = crate::derive(declaration, &mut diagnostics);
    assert_eq!(diagnostics.messages(), Vec::<String>::new(), "{text}");
    assert!(scheme.is_some(), "{text}");
}

#[test]
fn oscillators() {
    accepted(
        "state x, y; param k = 2; der(x) = y; der(y) = -k*x;",
        4,
        &["k*x^2 + y^2"],
    );
    accepted(
        "state x, y; param m = 1, c = 3, k = 0.25; der(x) = y/m; der(y) = -k*x - c*x^3;",
        4,
        &["2*k*m*x^2 + 2*y^2 + c*m*x^4"],
    );
    accepted(
        "state x, y; param a = 1; der(x) = 2*y; der(y) = 3*x^2 + a;",
        4,
        &["y^2 - a*x - x^3"],
    );
}

#[test]
fn henon_heiles_has_one_of_degree_3() {
    let items = "state x, y, px, py; param a = 1; der(x) = px; der(y) = py;
        der(px) = -x - 2*a*x*y; der(py) = -y - a*(x^2 - y^2);";
    assert_eq!(offered(items, 2), [""; 0]);
    accepted(
        items,
        4,
        &["3*x^2 + 3*y^2 + 3*px^2 + 3*py^2 + 6*a*x^2*y - 2*a*y^3"],
    );
}

#[test]
fn kepler_has_energy_and_two_more() {
    let items = "state x, y, u, v; param mu = 1; let r = sqrt(x^2 + y^2);
        der(x) = u; der(y) = v; der(u) = -mu*x/r^3; der(v) = -mu*y/r^3;";
    let offered = offered(items, 3);
    assert_eq!(offered.len(), 3, "{offered:?}");
    assert_eq!(offered[0], "conserved invariant_1 = x*v - y*u;");
    assert_eq!(
        offered[1],
        "conserved invariant_2 = u^2 + v^2 - 2*mu/sqrt(x^2 + y^2);"
    );
}

#[test]
fn rigid_bodies_have_two() {
    let euler = "state a, b, c; param i = 1, j = 2, k = 3;
        der(a) = (j - k)/(j*k)*b*c; der(b) = (k - i)/(k*i)*c*a; der(c) = (i - j)/(i*j)*a*b;";
    let lines = offered(euler, 4);
    assert_eq!(lines.len(), 2, "{lines:?}");
    assert_eq!(lines[0], "conserved invariant_1 = a^2 + b^2 + c^2;");
    assert!(
        lines[1].contains("a^2") && lines[1].contains('k'),
        "{lines:?}"
    );
    accepted(
        "state x, y, z; der(x) = y*z; der(y) = -2*x*z; der(z) = x*y;",
        4,
        &["2*x^2 + y^2", "x^2 - z^2"],
    );
}

#[test]
fn toda_chain_has_momentum_energy_and_determinant() {
    accepted(
        "state q[3], p[3]; for i in 0..3 { der(q[i]) = p[i]; }
         der(p[0]) = -exp(q[0] - q[1]); der(p[1]) = exp(q[0] - q[1]) - exp(q[1] - q[2]);
         der(p[2]) = exp(q[1] - q[2]);",
        3,
        &[
            "p[0] + p[1] + p[2]",
            "2*exp(q[0] - q[1]) + 2*exp(q[1] - q[2]) + p[0]^2 + p[1]^2 + p[2]^2",
            "p[0]*exp(q[1] - q[2]) + p[2]*exp(q[0] - q[1]) - p[0]*p[1]*p[2]",
        ],
    );
}

#[test]
fn three_waves_have_their_momenta_and_energy() {
    // ȧ₁ = −i a₂* a₃, ȧ₂ = −i a₁* a₃, ȧ₃ = −i a₁ a₂
    let items = "state x[3], y[3];
        der(x[0]) = x[1]*y[2] - y[1]*x[2]; der(y[0]) = -(x[1]*x[2] + y[1]*y[2]);
        der(x[1]) = x[0]*y[2] - y[0]*x[2]; der(y[1]) = -(x[0]*x[2] + y[0]*y[2]);
        der(x[2]) = x[0]*y[1] + y[0]*x[1]; der(y[2]) = -(x[0]*x[1] - y[0]*y[1]);";
    accepted(
        items,
        3,
        &[
            "x[0]^2 + y[0]^2 - x[1]^2 - y[1]^2",
            "x[0]^2 + x[2]^2 + y[0]^2 + y[2]^2",
            "x[0]*x[1]*x[2] + x[0]*y[1]*y[2] + y[0]*x[1]*y[2] - y[0]*x[2]*y[1]",
        ],
    );
}

#[test]
fn populations_have_logarithms() {
    accepted(
        "state x, y; param a = 1, b = 1, c = 1, d = 1;
         der(x) = x*(a - b*y); der(y) = y*(d*x - c);",
        2,
        &["d*x + b*y - c*ln(x) - a*ln(y)"],
    );
    accepted(
        "state x, y, z; der(x) = x*(y - z); der(y) = y*(z - x); der(z) = z*(x - y);",
        3,
        &["x + y + z", "ln(x) + ln(y) + ln(z)"],
    );
}

#[test]
fn atoms_of_the_field_occur() {
    accepted(
        "state q, p; param w = 2; der(q) = p; der(p) = -w*sin(q);",
        3,
        &["p^2 - 2*w*cos(q)"],
    );
    accepted(
        "state x, y; param m = 1, k = 2; der(x) = y/m; der(y) = -k*sinh(x);",
        2,
        &["2*m*k*cosh(x) + y^2"],
    );
    accepted(
        "state x, y; der(x) = y/(1 + x^2); der(y) = x/(1 + x^2);",
        2,
        &["x^2 - y^2"],
    );
}

/// Energies have antiderivatives of what f is made of.
#[test]
fn antiderivatives_occur() {
    for (force, expected) in [
        ("tanh(x)", "2*ln(cosh(x)) + v^2"),
        ("tan(x)", "v^2 - 2*ln(cos(x))"),
        ("x/(1 + x^2)", "ln(1 + x^2) + v^2"),
        ("1/x", "2*ln(x) + v^2"),
        ("atan(x)", "2*x*atan(x) + v^2 - ln(1 + x^2)"),
        ("x/sqrt(1 + x^2)", "2*sqrt(1 + x^2) + v^2"),
        ("sinh(x)/cosh(x)^3", "v^2 - 1/cosh(x)^2"),
        ("x*exp(-x^2)", "v^2 - exp(-x^2)"),
    ] {
        accepted(
            &format!("state x, v; der(x) = v; der(v) = -({force});"),
            2,
            &[expected],
        );
    }
}

/// Of invariants that differ by others, one with few terms is shown.
#[test]
fn energies_are_not_mixed_with_squares_of_momenta() {
    accepted(
        "state x, y, u, v; param k = 1; der(x) = u; der(y) = v;
         der(u) = k*(y - x); der(v) = k*(x - y);",
        2,
        &["u + v", "k*x^2 + k*y^2 + u^2 + v^2 - 2*k*x*y"],
    );
}

#[test]
fn double_pendulum_has_its_energy() {
    let items = "state a, b, p, q; param g = 2;
        hamiltonian H = (p^2 + 2*q^2 - 2*p*q*cos(a - b))/(2*(1 + sin(a - b)^2))
            - 2*g*cos(a) - g*cos(b) in (a, p), (b, q);";
    let offered = offered(items, 4);
    assert_eq!(offered.len(), 1, "{offered:?}");
    assert_eq!(
        offered[0],
        "conserved invariant_1 = p^2/(1 + sin(a - b)^2) + 2*q^2/(1 + sin(a - b)^2) \
         - 4*g*cos(a) - 2*g*cos(b) - 2*p*q*cos(a - b)/(1 + sin(a - b)^2);"
    );
}

#[test]
fn parameters_that_divide_are_multiplied_out() {
    accepted(
        "state x, v; param m = 1, k = 2, g = 9.81; der(x) = v; der(v) = -k/m*x - g;",
        2,
        &["2*m*g*x + k*x^2 + m*v^2"],
    );
}

#[test]
fn what_is_not_there_is_not_found() {
    let lorenz = "state x, y, z; param s = 10, r = 28, b = 8/3;
        der(x) = s*(y - x); der(y) = x*(r - z) - y; der(z) = x*y - b*z;";
    let text = report(&mut model(lorenz), 5).expect("a report");
    assert!(text.contains("none up to degree 5"), "{text}");
    assert_eq!(offered(lorenz, 5), [""; 0]);
}

/// Invariants of all regions come first, and not again.
#[test]
fn regions_are_reported_one_by_one() {
    let items = "state x, y, z; interface g = y;
        region up where g > 0 { der(x) = y; der(y) = -x; der(z) = 0; }
        region down where g < 0 { der(x) = y; der(y) = -3*x; der(z) = 0; }";
    let text = report(&mut model(items), 2).expect("a report");
    let (_, after) = text.split_once("\n\n").expect("a heading");
    assert_eq!(
        after,
        "in all regions:\n    conserved invariant_1 = z;\n\n\
         in the region `up`:\n    conserved invariant_2 = x^2 + y^2;\n\n\
         in the region `down`:\n    conserved invariant_3 = 3*x^2 + y^2;\n"
    );
}

/// A domain is a comment above the line that it is about, so that both can be pasted.
#[test]
fn domains_are_reported() {
    let invariants = |items: &str| {
        let text = report(&mut model(items), 2).expect("a report");
        let (_, after) = text.split_once("\n\n").expect("a heading");
        after.to_owned()
    };
    assert_eq!(
        invariants("state x, y, z; der(x) = x*(1 - y); der(y) = y*(x - 1); der(z) = 0;"),
        "    conserved invariant_1 = z;\n    \
             // where x > 0, y > 0\n    \
             conserved invariant_2 = x + y - ln(x) - ln(y);\n"
    );
    assert_eq!(
        invariants("state x, v; param m = 1; der(x) = v/m; der(v) = -1/x/m;"),
        "    // where x > 0, m ≠ 0\n    conserved invariant_1 = 2*ln(x) + v^2;\n"
    );
    // of several regions, each has its own
    assert_eq!(
        invariants(
            "state x, v, z; interface g = v;
             region up where g > 0 { der(x) = v; der(v) = -1/x; der(z) = 0; }
             region down where g < 0 { der(x) = v; der(v) = -x; der(z) = 0; }"
        ),
        "in all regions:\n    conserved invariant_1 = z;\n\n\
         in the region `up`:\n    // where x > 0\n    conserved invariant_2 = 2*ln(x) + v^2;\n\n\
         in the region `down`:\n    conserved invariant_3 = x^2 + v^2;\n"
    );
}

/// Energy, momenta, angular momentum; and that of the centre of mass, whose coefficients are
/// not products of powers, may be there.
#[test]
fn three_bodies() {
    let items = "state x[3], y[3], u[3], v[3]; param m[3] = [1, 2, 3];
        hamiltonian H = sum(i in 0..3, (u[i]^2 + v[i]^2)/(2*m[i]))
            - sum(i in 0..3, m[i]*m[(i+1)%3]/sqrt((x[i] - x[(i+1)%3])^2 + (y[i] - y[(i+1)%3])^2))
            in (x, u), (y, v);";
    let offered = offered(items, 2);
    assert!(offered.len() >= 4, "{offered:?}");
    assert_eq!(offered[0], "conserved invariant_1 = u[0] + u[1] + u[2];");
    assert_eq!(offered[1], "conserved invariant_2 = v[0] + v[1] + v[2];");
    assert!(
        offered.iter().any(|line| line.contains("x[0]*v[0]")),
        "{offered:?}"
    );
    assert!(
        offered.iter().any(|line| line.contains("sqrt")),
        "{offered:?}"
    );
}

/// Names that are taken are left out, and `t` is mentioned.
#[test]
fn reports_fit_the_declaration() {
    let items = "state x, y, invariant_1; der(x) = y; der(y) = -x; der(invariant_1) = cos(t);";
    let text = report(&mut model(items), 2).expect("a report");
    assert!(text.contains("depends on `t`"), "{text}");
    assert!(
        text.contains("conserved invariant_2 = x^2 + y^2;"),
        "{text}"
    );
}

/// Their rates vanish at points, which does not use the normal form.
#[test]
fn rates_vanish_numerically() {
    let items = "state x, y, u, v; param mu = 1.5; let r = sqrt(x^2 + y^2);
        der(x) = u; der(y) = v; der(u) = -mu*x/r^3; der(v) = -mu*y/r^3;";
    let mut model = model(items);
    let found = find(&mut model, 3).expect("invariants");
    let names = model.state_names();
    let field = model.regions[0].field.clone();
    let mut point: std::collections::BTreeMap<_, _> =
        names.iter().cloned().zip([0.7, -0.4, 0.3, 1.1]).collect();
    point.insert(model.parameters[0].name.clone(), 1.5);
    for invariant in found.common {
        let dag = &mut model.dag;
        let mut rate = dag.integer(0);
        for (name, &component) in names.iter().zip(&field) {
            let derivative = differentiate(dag, invariant.psi, name);
            let term = dag.mul(derivative, component);
            rate = dag.add(rate, term);
        }
        let value = evaluate(dag, &[rate], &point)[0];
        assert!(value.abs() < 1e-13, "{value}");
    }
}

#[test]
fn what_is_too_large_is_refused() {
    let mut chain =
        model("state q[16], p[16]; for i in 0..16 { der(q[i]) = p[i]; der(p[i]) = -q[i]^3; }");
    let message = report(&mut chain, 4).expect_err("too large").to_string();
    assert_eq!(
        message,
        "polynomials of degree 4 in 32 quantities have more than 3000 monomials, which is the limit of this search; ask for a degree up to 2"
    );
    assert!(report(&mut chain, u32::MAX).is_err());
    let message = report(&mut chain, 0).expect_err("no degree").to_string();
    assert!(message.starts_with("the degree has to be at least 1"));
}
