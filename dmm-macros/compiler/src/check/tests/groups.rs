//! Groups of states and parameters, and their elements.

use super::{all, field, model, one};

#[test]
fn elements_are_states_and_parameters() {
    let model = model(
        "system S {
            const n = 2;
            state x, /** positions */ q[n + 1];
            param k = 3, m[n] = [1, 2*pi], a[3] = k0;
            der(x) = m[0]*a[2] + k*m[1] + a[0]*a[1];
            der(q[0]) = q[2]; der(q[n]) = -q[0]; der(q[n - 1]) = x;
        }"
        .replace("k0", "7")
        .as_str(),
    );
    let states: Vec<&str> = model.states.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(states, ["x", "q[0]", "q[1]", "q[2]"]);
    let elements: Vec<Option<usize>> = model.states.iter().map(|s| s.element).collect();
    assert_eq!(elements, [None, Some(0), Some(1), Some(2)]);
    assert!(
        model
            .states
            .iter()
            .skip(1)
            .all(|s| s.ident == "q" && s.attributes.len() == 1)
    );
    let parameters: Vec<(&str, String)> = (model.parameters.iter())
        .map(|p| (p.name.as_str(), super::text(&model, p.default)))
        .collect();
    let expected = [
        ("k", "3"),
        ("m[0]", "1"),
        ("m[1]", "2*pi"),
        ("a[0]", "7"),
        ("a[1]", "7"),
        ("a[2]", "7"),
    ];
    assert_eq!(
        parameters,
        expected.map(|(name, default)| (name, default.to_owned()))
    );
    assert_eq!(
        field(&model, 0),
        ["m[0]*a[2] + k*m[1] + a[0]*a[1]", "q[2]", "x", "-q[0]"]
    );
}

#[test]
fn a_group_has_an_integer_number_of_elements() {
    for (items, message) in [
        (
            "state q[0]; der(q[0]) = 1;",
            "`q` has 0 elements: a group has one at least",
        ),
        (
            "state q[-1]; der(q[0]) = 1;",
            "`q` has -1 elements: a group has one at least",
        ),
        (
            "state q[1.5]; der(q[0]) = 1;",
            "the number of elements of `q` is an integer, not 1.5",
        ),
        (
            "const n = 3/2; state q[n]; der(q[0]) = q[1];",
            "the number of elements of `q` is an integer, but `n` is 1.5",
        ),
        (
            "param n = 3; state q[n]; der(q[0]) = q[1];",
            "the number of elements cannot depend on the parameter `n`",
        ),
        (
            "state q[n]; const n = 3; for i in 0..n { der(q[i]) = 1; }",
            "`n` is used before it is declared",
        ),
        (
            "state q[1000000000000]; der(q[0]) = 1;",
            "`q` has 1000000000000 elements: up to 128 are supported",
        ),
        ("state q[zz]; der(q[0]) = q[7] + q;", "`zz` is not declared"),
    ] {
        one(items, message);
    }
    // what was declared elsewhere is still of use
    one(
        "state x, q[100], p[100]; der(x) = 1;
        for i in 0..100 { der(q[i]) = 1; der(p[i]) = 1; }",
        "201 states are too many",
    );
}

#[test]
fn elements_exist() {
    for (formula, message) in [
        (
            "q[3]",
            "`q[3]` is beyond the end: `q` has 3 elements, `q[0]` to `q[2]`",
        ),
        (
            "q[-1]",
            "`q[-1]` is in front of the beginning: `q` has 3 elements, `q[0]` to `q[2]`",
        ),
        (
            "w[1]",
            "`w[1]` is beyond the end: `w` has 1 element, `w[0]`",
        ),
        (
            "q[n + 1]",
            "`q[n + 1]` is `q[4]`, beyond the end: `q` has 3 elements",
        ),
        ("q[1/2]", "an index is an integer, but `1/2` is 0.5"),
        ("q[0.5]", "an index is an integer, not 0.5"),
        ("q[pi]", "an index is an integer, but `pi` is 3.14159"),
        ("q[x]", "an index cannot depend on the state `x`"),
        ("q[k]", "an index cannot depend on the parameter `k`"),
        ("q[t]", "an index cannot depend on the time"),
        ("q[r]", "an index cannot depend on `r`, which varies"),
        ("q[zz]", "`zz` is not declared"),
        ("qq[0]", "`qq` is not declared"),
        ("wide[0]", "`wide` is not declared; did you mean `width`?"),
        (
            "x[0]",
            "`x` is one state, not a group: leave out the index, or declare `state x[n];`",
        ),
        (
            "k[0]",
            "`k` is one parameter, not a group: leave out the index, or declare `param k[n] = …;`",
        ),
        (
            "n[0]",
            "`n` is one constant, not a group: leave out the index",
        ),
        ("t[0]", "`t` is no group: leave out the index"),
        ("V[0]", "`V` is a function: write `V(a)`"),
        (
            "q",
            "`q` is a group of 3 elements: write one of them, as in `q[0]`, or `sum(i in 0..3, q[i])`",
        ),
        ("w + 1", "`w` is a group of one element: write `w[0]`"),
        ("q(0)", "`q` is a group of states: an element is `q[0]`"),
        ("V(q)", "`q` is a group of 3 elements"),
    ] {
        one(
            &format!(
                "const n = 3; state x, q[n], w[1]; param k = 1, width[2] = 1; let r = x + k;
                 fn V(a) = a + width[0]; for i in 0..n {{ der(q[i]) = V(r); }}
                 der(w[0]) = 1; der(x) = {formula};"
            ),
            message,
        );
    }
}

#[test]
fn defaults_are_one_or_one_an_element() {
    for (items, message) in [
        (
            "param m[3] = [1, 2]; der(x) = m[0];",
            "`m` has 3 elements, but 2 defaults are given",
        ),
        (
            "param m[2] = [1]; der(x) = m[0];",
            "but one default is given",
        ),
        (
            "param m[2] = [1, x]; der(x) = m[0];",
            "the default of a parameter cannot depend on the state `x`",
        ),
        (
            "const c = 1; param m[2] = c, l[2] = [c, m[0]]; der(x) = l[0];",
            "the default of a parameter cannot depend on the parameter `m`",
        ),
        (
            "param m[2] = 1; der(x) = 1;",
            "warning: the parameter `m` is never used",
        ),
    ] {
        one(&format!("state x; {items}"), message);
    }
}

#[test]
fn only_elements_have_derivatives() {
    all(
        "state q[3]; der(q) = 1;",
        &["`q` is a group of 3 states: write `der(q[0])`, or `for i in 0..3 { der(q[i]) = …; }`"],
    );
    all(
        "state q[3]; der(q[0]) = 1; der(q[3]) = 1;",
        &["`q[3]` is beyond the end: `q` has 3 elements, `q[0]` to `q[2]`"],
    );
    all(
        "state x; der(x[0]) = 1;",
        &["`x` is one state, not a group: leave out the index, or declare `state x[n];`"],
    );
    all(
        "state q[30]; der(q[0]) = 1; der(q[1]) = 1; der(q[5]) = 1;",
        &["the system has no `der(q[2])` to `der(q[4])`, `der(q[6])` to `der(q[29])`"],
    );
    all(
        "state momenta[2]; der(momenta[0]) = 1; der(momentum[1]) = 1;",
        &["there is no state `momentum`; did you mean `momenta`?"],
    );
    all(
        "state q[2]; der(q[0]) = 1; der(z[1]) = 1;",
        &["there is no state `z`: declare `state z;`"],
    );
}
