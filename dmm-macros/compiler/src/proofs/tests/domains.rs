//! Where a proof holds.

use super::{Conservation, Proved, evidence, one, sound};

/// Where the first quantity is proved to be conserved.
#[track_caller]
pub(super) fn domain(items: &str) -> String {
    let proved = sound(items);
    conditions(&proved, evidence(&proved))
}

#[track_caller]
fn conditions(proved: &Proved, evidence: &Conservation) -> String {
    let Conservation::Proved(conditions) = evidence else {
        panic!("{evidence:?}");
    };
    let conditions = conditions.iter();
    let conditions: Vec<String> = conditions
        .map(|condition| condition.statement(&proved.model.dag))
        .collect();
    conditions.join(", ")
}

/// Where the first quantity of each region is proved to be conserved.
#[track_caller]
fn domains(items: &str) -> Vec<String> {
    let proved = sound(items);
    let regions = proved.regions.iter();
    regions
        .filter_map(|region| region.evidence.first())
        .map(|evidence| conditions(&proved, evidence))
        .collect()
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
            "x ≠ 0",
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

#[test]
fn a_proof_holds_in_its_region() {
    // √(x²) is x on the right and −x on the left
    assert_eq!(
        domains(
            "state x, v; interface wall = x; der(x) = v;
             region right where wall > 0 { der(v) = -1; conserved e = v^2/2 + sqrt(x^2); }
             region left where wall < 0 { der(v) = 1; conserved e = v^2/2 + sqrt(x^2); }"
        ),
        ["", ""]
    );
    // a side that is a polynomial of several variables
    assert_eq!(
        domains(
            "state x, y; interface wall = x - y; der(x) = 1; der(y) = -1;
             region right where wall > 0 { conserved e = sqrt((x - y)^2) - 2*t; }
             region left where wall < 0 { conserved e = sqrt((x - y)^2) + 2*t; }"
        ),
        ["", ""]
    );
    // x > 2, and so x > 0 and x − 1 ≠ 0
    assert_eq!(
        domains(
            "state x, v; interface wall = x - 2; der(x) = v;
             region right where wall > 0 { der(v) = -1/x; conserved e = v^2/2 + ln(x); }
             region left where wall < 0 { der(v) = -1/(x - 3); conserved e = v^2/2 + ln(3 - x); }"
        ),
        ["", ""]
    );
    assert_eq!(
        domains(
            "state x, v; interface wall = x + 2; der(x) = v;
             region right where wall > 0 { der(v) = -1/x; conserved e = v^2/2 + ln(x); }
             region left where wall < 0 { der(v) = 0; conserved e = v; }"
        ),
        ["x > 0", ""]
    );
}

#[test]
fn what_is_false_in_its_region_is_refuted_there() {
    one(
        "state x, v; interface wall = x - 50; der(x) = v;
         region right where wall > 0 { der(v) = -1; conserved e = v^2/2 - sqrt(x^2); }
         region left where wall < 0 { der(v) = 1; }",
        &[
            "`e` is not conserved in the region `right`",
            "x = 5",
            "PWS300",
        ],
    );
    one(
        "state x, v; interface wall = x; der(x) = v;
         region right where wall > 0 { der(v) = -1; }
         region left where wall < 0 { der(v) = -1; conserved e = v^2/2 + sqrt(x^2); }",
        &[
            "`e` is not conserved in the region `left`",
            "d/dt e = -2*v",
            "PWS300",
        ],
    );
}

#[test]
fn a_proof_holds_on_the_domain_of_the_whole_field() {
    // ẋ has a value where y > 0 alone
    let fall = "state x, y; der(x) = 1/sqrt(y); der(y) = -1;";
    assert_eq!(
        domain(&format!("{fall} conserved e = t + sqrt(y^2);")),
        "y > 0"
    );
    assert_eq!(domain(&format!("{fall} conserved e = t + y;")), "");
    one(
        &format!("{fall} conserved e = t - sqrt(y^2);"),
        &["`e` is not conserved: d/dt e = ", "PWS300"],
    );
    assert_eq!(
        domain("state x, y; der(x) = 1/sqrt(-y); der(y) = -1; conserved e = t - sqrt(y^2);"),
        "-y > 0"
    );
}

#[test]
fn a_domain_is_not_empty() {
    for (formula, parts) in [
        ("ln(x) + ln(-x)", "x > 0 and -x > 0"),
        ("sqrt(x - 1)*sqrt(-x)", "x - 1 > 0 and -x > 0"),
        ("sqrt(-1 - y^2)", "-1 - y^2 ≥ 0"),
        ("asin(2 + y^2)", "1 - (2 + y^2)^2 ≥ 0"),
        ("ln(x*y) + sqrt(-2*x*y)", "x*y > 0"),
    ] {
        one(
            &format!(
                "state x, y; der(x) = 1; der(y) = 0; conserved e = t - x + 0*y + y*({formula});"
            ),
            &["`e` and its rate have no value anywhere", parts, "PWS312"],
        );
    }
    one(
        "state x, v; interface wall = x; der(x) = v; der(v) = 0;
         region right where wall > 0 { conserved e = v + 0*x + v^2*ln(-x); }
         region left where wall < 0 { conserved e = v; }",
        &[
            "have no value anywhere in the region `right`",
            "-x > 0 and x > 0",
        ],
    );
    // roots of what is zero have a value
    assert_eq!(
        domain("state x; der(x) = 1; conserved e = x - t + sqrt(sin(t)^2 + cos(t)^2 - 1);"),
        "sin(t)^2 + cos(t)^2 - 1 ≥ 0"
    );
}

#[test]
fn a_power_with_a_parameter_is_proved_for_both_signs() {
    for (items, expected) in [
        (
            "state x, v; param k = 4; der(x) = v; der(v) = -k*x^(k - 1); conserved e = v^2/2 + x^k;",
            "x ≠ 0",
        ),
        (
            "state x, v; param k = 2; der(x) = v; der(v) = -x^(2*k - 1);
             conserved e = v^2/2 + (x^k)^2/(2*k);",
            "x ≠ 0, k ≠ 0",
        ),
        // |x| is −x on the left, where x^k has either sign
        (
            "state x, y; param k = 2; der(x) = y*x^k; der(y) = -sqrt(x^2)*x^k;
             conserved e = (x^2 + y^2)/2;",
            "x > 0",
        ),
        (
            "state x, y; param k = 2; der(x) = 1; der(y) = sqrt(x^2)*x^k/x^k*x;
             conserved e = y - x^3/3;",
            "x > 0",
        ),
        // (−x)^k is x^k for an even k, which is not all
        (
            "state x, y; param k = 2; der(x) = 1; der(y) = k*x^(k - 1);
             conserved e = y - (x^2)^(k/2);",
            "x > 0",
        ),
        // one base of two
        (
            "state x, y; param k = 2, m = 3; der(x) = x^k*y^m; der(y) = -x^k*y^(m + 1)/sqrt(x^2);
             conserved e = x*y;",
            "x > 0, y ≠ 0",
        ),
        // of two opposite bases one is negative: what they say together for k that is no integer
        // leaves no points
        (
            "state x, y; param k = 2; der(x) = (y - x)^k; der(y) = -(y - x)^k;
             conserved e = x + y + 0*(x - y)^k;",
            "y - x ≠ 0",
        ),
        (
            "state x, y; param k = 2; der(x) = (x - y)^k + (y - x)^k; der(y) = (x - y)^k + (y - x)^k;
             conserved e = (x - y)^k + (y - x)^k;",
            "x - y ≠ 0",
        ),
        // a logarithm needs a positive base anyway
        (
            "state x, v; param k = 4; der(x) = v; der(v) = -k*x^(k - 1) - 1/x;
             conserved e = v^2/2 + x^k + ln(x);",
            "x > 0",
        ),
    ] {
        assert_eq!(domain(items), expected, "{items}");
    }
}
