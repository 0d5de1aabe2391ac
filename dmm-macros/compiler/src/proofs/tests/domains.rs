//! Where a proof holds.

use super::{evidence, sound};
use crate::model::Conservation;

/// Where the first quantity is proved to be conserved.
#[track_caller]
pub(super) fn domain(items: &str) -> String {
    let model = sound(items);
    let Conservation::Proved(conditions) = evidence(&model) else {
        panic!("{items}: {:?}", evidence(&model));
    };
    let dag = &model.dag;
    let conditions: Vec<String> = conditions
        .iter()
        .map(|condition| condition.statement(dag))
        .collect();
    conditions.join(", ")
}

#[test]
fn a_proof_says_where_it_holds() {
    for (items, expected) in [
        (
            "state x, y; param k = 2; der(x) = y; der(y) = -k*x; conserved e = (y^2 + k*x^2)/2;",
            "",
        ),
        // ψ is differentiable where x > 0; f alone would be content with x ≥ 0
        (
            "state x, y; der(x) = y; der(y) = -1/(2*sqrt(x)); conserved e = y^2/2 + sqrt(x);",
            "x > 0",
        ),
        (
            "state x, y; der(x) = y; der(y) = -sqrt(x); conserved e = y^2/2 + 2*x^(3/2)/3;",
            "x ≥ 0",
        ),
        (
            "state x, y; param a = 1, b = 1, c = 1, d = 1;
             der(x) = x*(a - b*y); der(y) = y*(d*x - c);
             conserved v = d*x - c*ln(x) + b*y - a*ln(y);",
            "x > 0, y > 0",
        ),
        // |x| is not x: √(x²) has no derivative at 0
        (
            "state x, y; der(x) = y; der(y) = -x/sqrt(x^2); conserved e = y^2/2 + sqrt(x^2);",
            "x ≠ 0",
        ),
        (
            "state x, v; der(x) = v; der(v) = -asin(x);
             conserved e = v^2/2 + x*asin(x) + sqrt(1 - x^2);",
            "1 - x^2 > 0",
        ),
        (
            "state x, v; der(x) = v; der(v) = -x/(1 + x^2); conserved e = v^2/2 + ln(1 + x^2)/2;",
            "",
        ),
        (
            "state x, v; param r = 1/2; der(x) = v; der(v) = -r*x^(r - 1);
             conserved e = v^2/2 + x^r;",
            "x > 0",
        ),
        (
            "state x, v; der(x) = v; der(v) = -1 - tan(x)^2; conserved e = v^2/2 + tan(x);",
            "cos(x) ≠ 0",
        ),
        (
            "state x, y, u, v; param m = 1; let r = sqrt(x^2 + y^2);
             der(x) = u; der(y) = v; der(u) = -m*x/r^3; der(v) = -m*y/r^3;
             conserved e = (u^2 + v^2)/2 - m/r;",
            "x^2 + y^2 ≠ 0",
        ),
        // ln(xy) needs both signs where it stands alone, and is split where ln x says x > 0
        (
            "state x, y; der(x) = x; der(y) = -y; conserved a = ln(x*y);",
            "x*y > 0",
        ),
        (
            "state x, y; der(x) = ln(x*y) - ln(x) - ln(y); der(y) = 1; conserved a = x;",
            "x > 0, y > 0",
        ),
    ] {
        assert_eq!(domain(items), expected, "{items}");
    }
}

#[test]
fn one_of_equivalent_conditions_is_kept() {
    // m²c⁴ + p²c² = c⁴ (m² + p²/c²), and c is not zero
    assert_eq!(
        domain(
            "state x, p; param m = 1, c = 2; der(x) = p/sqrt(m^2 + p^2/c^2); der(p) = -x;
             conserved e = sqrt(m^2*c^4 + p^2*c^2) + x^2/2;"
        ),
        "c ≠ 0, m^2 + p^2/c^2 ≠ 0"
    );
    for (formula, expected) in [
        // the shorter one is kept also if it comes last
        (
            "1/(c*x + c*y + c) + 1/(x + y + 1)/c",
            "c ≠ 0, x + y + 1 ≠ 0",
        ),
        // c may be zero
        ("1/(c*x + c*y) + 1/(x + y)", "c*x + c*y ≠ 0, x + y ≠ 0"),
        // the unit has a condition of its own
        (
            "1/(x*z + y*z + x*c + y*c) + 1/(x + y) + 1/(z + c)",
            "x + y ≠ 0, z + c ≠ 0",
        ),
        // each of the two is what makes the other one superfluous
        ("1/(x - y*c) + 1/(y*c - x)", "x - y*c ≠ 0"),
        // a sign is kept by what is positive alone
        (
            "sqrt(x + y) + sqrt(c*x + c*y) + 1/c",
            "c ≠ 0, x + y ≥ 0, c*x + c*y ≥ 0",
        ),
        ("sqrt(x + y) + sqrt(c*x + c*y) + ln(c)", "c > 0, x + y ≥ 0"),
        (
            "sqrt(x + y) + sqrt(c^2*x + c^2*y) + 1/c",
            "c ≠ 0, x + y ≥ 0",
        ),
        ("ln(x + y) + 1/(c*x + c*y) + 1/c", "c ≠ 0, x + y > 0"),
        // ≥ says less than ≠
        (
            "sqrt(x + y) + 1/(c*x + c*y) + 1/c",
            "c ≠ 0, x + y ≥ 0, c*x + c*y ≠ 0",
        ),
    ] {
        let items = format!(
            "state x, y, z; param c = 2; let f = {formula}; der(x) = f; der(y) = f; der(z) = 0;
             conserved e = x - y;"
        );
        assert_eq!(domain(&items), expected, "{items}");
    }
}
