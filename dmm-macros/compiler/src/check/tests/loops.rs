//! `sum`, `for`, and `%`.

use super::{all, field, model, one, text};

#[test]
fn loops_are_written_out() {
    let model = model(
        "system S {
            const n = 3;
            state q[n], p[n];
            param k[n] = 1;
            let far = sum(i in 0..n, sum(j in i + 1..n, i*j*(q[i] - q[j])^2));
            for i in 0..n {
                der(q[i]) = p[i];
                der(p[i]) = far*k[i] - q[(i + n - 1) % n] + sum(_j in 5..5, q[i]);
                for j in 0..i { conserved gap = q[i] - q[j]; }
            }
            conserved sum_p = sum(i in 0..n, p[i]) + sum(_i in -1..1, q[0]);
        }",
    );
    assert_eq!(
        field(&model, 0),
        [
            "p[0]",
            "p[1]",
            "p[2]",
            "2*(q[1] - q[2])^2*k[0] - q[2]",
            "2*(q[1] - q[2])^2*k[1] - q[0]",
            "2*(q[1] - q[2])^2*k[2] - q[1]",
        ]
    );
    let quantities: Vec<(String, String)> = (model.regions[0].conserved.iter())
        .map(|psi| (psi.ident.to_string(), text(&model, psi.psi)))
        .collect();
    let expected = [
        ("gap_1_0", "q[1] - q[0]"),
        ("gap_2_0", "q[2] - q[0]"),
        ("gap_2_1", "q[2] - q[1]"),
        ("sum_p", "p[0] + p[1] + p[2] + 2*q[0]"),
    ];
    assert_eq!(
        quantities,
        expected.map(|(name, psi)| (name.to_owned(), psi.to_owned()))
    );
}

#[test]
fn a_sum_of_constants_is_a_constant() {
    let model = model(
        "system S { const c = sum(i in 1..4, i^2), d = sum(i in 0..2, sqrt(i)); state q[c - 12];
         for i in 0..2 { der(q[i]) = c*(7 % 4 - (-7) % 4)^d; } }",
    );
    assert_eq!(model.states.len(), 2);
    assert_eq!(field(&model, 0), ["28", "28"]);
}

#[test]
fn what_is_wrong_in_every_turn_is_said_once() {
    for (items, message) in [
        (
            "for i in 0..3 { der(q[i]) = q[i + 1]; }",
            "`q[i + 1]` is `q[3]` with i = 2, beyond the end: `q` has 3 elements, `q[0]` to `q[2]`",
        ),
        (
            "for i in 0..3 { der(q[i]) = q[i - 1]; }",
            "`q[i - 1]` is `q[-1]` with i = 0, in front of the beginning",
        ),
        (
            "for i in 0..3 { der(q[i]) = sum(j in 0..3, q[i*j]); }",
            "`q[i * j]` is `q[4]` with i = 2, j = 2, beyond the end",
        ),
        (
            "for i in 0..4 { der(q[i]) = 1; }",
            "`q[i]` is `q[3]` with i = 3, beyond the end",
        ),
        (
            "for i in 0..3 { der(q[i]) = q[i/2]; }",
            "`i / 2` is 0.5 with i = 1",
        ),
        (
            "for i in 0..3 { der(q[i]) = zz + q[i]; }",
            "`zz` is not declared",
        ),
        (
            "for i in 0..3 { der(q[i]) = 1/(i - 1); }",
            "division by `i - 1`, which is zero, with i = 1",
        ),
        (
            "for i in 0..3 { der(q[i]) = ln(1 - i); }",
            "`ln` of 0 cannot be evaluated: its argument must be positive, with i = 1",
        ),
        (
            "for i in 0..3 { der(q[0]) = q[i]; }",
            "`der(q[0])` is given twice, with i = 1",
        ),
        (
            "for i in 0..3 { der(z[i]) = q[i]; }",
            "there is no state `z`",
        ),
        (
            "for i in 0..3 { der(q[i]) = 0; conserved c = i*zz; }",
            "`zz` is not declared",
        ),
        (
            "for i in 0..3 { der(q[i]) = 0; conserved c = q[i]; } conserved c_1 = q[1];",
            "the conserved quantity `c_1` is declared twice",
        ),
    ] {
        one(&format!("state q[3]; {items}"), message);
    }
}

#[test]
fn loops_without_turns_are_checked_as_well() {
    let rest = "for i in 0..2 { der(q[i]) = 1; }";
    one(
        &format!("state q[2]; {rest} for i in 1..1 {{ der(q[i]) = zz; }}"),
        "`zz` is not declared",
    );
    one(
        "state q[2]; for i in 0..2 { der(q[i]) = sum(j in i..i, qq[j + 7]); }",
        "`qq` is not declared",
    );
    // nothing is given, nothing is conserved, and what is used there is used
    let model = model(&format!(
        "system S {{ state q[2]; param k = 1; {rest}
         for i in 2..2 {{ der(q[i]) = k; conserved c = k*q[i]; }} }}"
    ));
    assert!(model.regions[0].conserved.is_empty());
    one(
        "state q[2]; for i in 2..2 { der(q[i]) = 1; }",
        "the system has no `der(q[0])`, `der(q[1])`",
    );
}

#[test]
fn loop_variables_have_names_of_their_own() {
    for (items, message) in [
        (
            "for q in 0..3 { der(q[q]) = 1; }",
            "the loop variable `q` has the name of a state; choose another name",
        ),
        (
            "for i in 0..3 { for i in 0..3 { der(q[i]) = i; } }",
            "the loop variable `i` is there already",
        ),
        (
            "for i in 0..3 { der(q[i]) = sum(i in 0..3, q[i]); }",
            "the loop variable `i` is there already",
        ),
        (
            "const i = 1; for i in 0..3 { der(q[i]) = 1; } let _use = i;",
            "the loop variable `i` has the name of a constant",
        ),
        (
            "for t in 0..3 { der(q[t]) = 1; }",
            "`t` is the time and cannot be a loop variable",
        ),
        (
            "for sin in 0..3 { der(q[sin]) = 1; }",
            "`sin` is a built-in function and cannot be a loop variable",
        ),
        (
            "for i in 0..3 { der(q[i]) = sum(j in 0..3, q[i]); }",
            "warning: the loop variable `j` is never used: every turn is the same; call it `_j` if that is meant",
        ),
        (
            "for i in 0..3 { der(q[i]) = 1; } let _use = i;",
            "`i` is not declared",
        ),
    ] {
        one(&format!("state q[3]; {items}"), message);
    }
    // one after the other they may be the same
    model(
        "system S { state q[3]; let s = sum(i in 0..3, q[i]); for i in 0..2 { der(q[i]) = s; } for i in 2..3 { der(q[i]) = i; } }",
    );
}

#[test]
fn bounds_are_integers() {
    for (range, message) in [
        ("0..1.5", "the bound of a loop is an integer, not 1.5"),
        (
            "0..3/2",
            "the bound of a loop is an integer, but `3/2` is 1.5",
        ),
        (
            "0..q[0]",
            "the bound of a loop cannot depend on the state `q`",
        ),
        (
            "k..3",
            "the bound of a loop cannot depend on the parameter `k`",
        ),
        ("0..zz", "`zz` is not declared"),
        ("3..0", "the range `3..0` runs backwards"),
        ("-1..-3", "runs backwards"),
    ] {
        one(
            &format!(
                "state q[3]; param k = 1; let _use = k; for i in {range} {{ der(q[i]) = 1; }}"
            ),
            message,
        );
    }
    // the second sum has no turns for i = 2, and would run backwards
    model("system S { state q[3]; for i in 0..3 { der(q[i]) = sum(j in i + 2..3, q[j]); } }");
}

#[test]
fn remainders_are_of_integers() {
    let message = "`%` is for integers that are known when the system is compiled";
    for formula in ["q[0] % 3", "2.5 % 2", "3 % k", "t % 2", "pi % 2"] {
        one(
            &format!("state q[1]; param k = 1; let _use = k; der(q[0]) = {formula};"),
            message,
        );
    }
    all("state x; der(x) = 3 % 0;", &["`3 % 0` divides by zero"]);
}
