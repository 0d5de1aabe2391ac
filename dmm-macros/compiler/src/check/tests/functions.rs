//! Functions that a declaration defines.

use super::{all, field, model, one};

#[test]
fn functions_are_substituted() {
    let model = model(
        "system S {
            state q[2], x;
            param k = 2;
            const c = 3;
            fn square(a) = a*a;
            fn V(a, j) = k*square(a - q[j])/c;
            fn total(n) = sum(i in 0..n, V(x, i)) + sum(i in n..2, i);
            const nine = square(c);
            for i in 0..2 { der(q[i]) = V(q[1 - i], i) + nine; }
            der(x) = total(1) + square(sqrt(2));
        }",
    );
    assert_eq!(
        field(&model, 0),
        [
            "k*(q[1] - q[0])^2/3 + 9",
            "k*(q[0] - q[1])^2/3 + 9",
            "k*(x - q[0])^2/3 + 1 + sqrt(2)^2",
        ]
    );
}

#[test]
fn a_function_sees_what_is_declared_before_it() {
    for (items, message) in [
        (
            "fn f(a) = f(a - 1); der(x) = f(x);",
            "`f` is used before it is declared: a function cannot call itself",
        ),
        (
            "fn f(a) = g(a); fn g(a) = a; der(x) = f(x) + g(x);",
            "`g` is used before it is declared; move its declaration up",
        ),
        (
            "fn f(a) = a*c; const c = 1; der(x) = f(x);",
            "`c` is used before it is declared",
        ),
        // neither the loop variables nor the `let`s around its call
        (
            "fn f(a) = a*i; der(x) = sum(i in 0..3, f(i));",
            "`i` is not declared",
        ),
        (
            "fn f(a) = sum(x in 0..3, a*x); der(x) = f(x);",
            "the loop variable `x` has the name of a state",
        ),
        (
            "fn f(a) = sum(a in 0..3, a); der(x) = f(x);",
            "the loop variable `a` has the name of an argument",
        ),
        (
            "fn f(a, a) = a; der(x) = f(x, x);",
            "the argument `a` is declared twice; rename one of the two",
        ),
        (
            "fn f(x, x) = x; der(x) = f(x, x);",
            "the argument `x` is declared twice",
        ),
        (
            "fn f(pi) = pi; der(x) = f(x);",
            "`pi` is the number π and cannot be an argument",
        ),
        (
            "fn f(sin) = sin; der(x) = f(x);",
            "`sin` is a built-in function and cannot be an argument",
        ),
        (
            "fn f(t) = t; der(x) = f(x);",
            "`t` is the time and cannot be an argument",
        ),
        (
            "fn f(a) = a; fn f(a) = 2*a; der(x) = f(x);",
            "the function `f` is declared twice",
        ),
        (
            "fn sin(a) = a; der(x) = sin(x);",
            "`sin` is a built-in function and cannot be declared as a function",
        ),
        (
            "let f = x; fn f(a) = a; der(x) = f;",
            "`f` is already declared as a `let`",
        ),
    ] {
        one(&format!("state x; {items}"), message);
    }
    one(
        "state x; interface wall = x; fn f(a) = a*stretch;
         region low where wall < 0 { let stretch = x; der(x) = f(stretch); }
         region high where wall > 0 { der(x) = 1; }",
        "a `let` of the region `low`",
    );
}

#[test]
fn an_argument_hides_what_is_outside() {
    let model = model(
        "system S {
            state q, x, z[2];
            param k = 2, m[2] = 1;
            const c = 3;
            let r = q + x;
            interface wall = x - q;
            fn V(q) = k*q^2/2;
            // the state q is seen where the argument is not called q
            fn W(a) = V(a)*q;
            // nested: the q of V is the k of U, the q of U is the state
            fn U(k) = V(k + 1) + V(V(q)) + k;
            // groups, constants, functions and interfaces are hidden as well
            fn G(z, m, c, r, wall, V) = z + m + c + r + wall + V;
            fn E(c) = z[c]*c;
            fn own(own) = 2*own;
            region above where wall > 0 { der(q) = V(x); der(x) = W(x); der(z[0]) = U(x); der(z[1]) = G(1, x, q, k, m[0], z[1]); }
            region below where wall < 0 { der(q) = V(q); der(x) = V(z[0] + c); der(z[0]) = E(1); der(z[1]) = own(r); }
        }",
    );
    assert_eq!(
        field(&model, 0),
        [
            "k*x^2/2",
            "k*x^2*q/2",
            "k*(x + 1)^2/2 + k*(k*q^2/2)^2/2 + x",
            "x + 1 + q + k + m[0] + z[1]",
        ]
    );
    assert_eq!(
        field(&model, 1),
        ["k*q^2/2", "k*(z[0] + 3)^2/2", "z[1]", "2*(q + x)"]
    );
}

#[test]
fn what_an_argument_hides_is_not_used() {
    all(
        "state q; param k = 1; fn f(k) = 2*k; der(q) = f(q);",
        &["warning: the parameter `k` is never used: remove it, or call it `_k`"],
    );
    one(
        "state q; fn f(q) = 1; der(q) = f(q) + q;",
        "warning: the argument `q` of `f` is never used: remove it, or call it `_q`",
    );
    one(
        "state q[2]; fn f(q) = q[0]; der(q[0]) = f(q[1]); der(q[1]) = 1;",
        "`q` is one argument, not a group: leave out the index, or rename the argument, which hides the group",
    );
    one(
        "state q; fn f(q) = q[0]; der(q) = f(q);",
        "`q` is one argument, not a group: leave out the index [PWS233]",
    );
    one(
        "state q; fn V(q) = q^2; fn f(V) = V(q); der(q) = f(q) + V(q);",
        "`V` is an argument, not a function",
    );
    one(
        "state q[2]; fn f(q) = sum(i in 0..2, i*q); der(q[0]) = f(q); der(q[1]) = 1;",
        "`q` is a group of 2 elements",
    );
    one(
        "state q; fn f(q) = 1/q; der(q) = f(0) + f(q);",
        "in `f(0)`: division by `q`, which is zero",
    );
    one(
        "state q, z[2]; fn f(q) = z[q]; der(q) = f(1) + f(q); der(z[0]) = 1; der(z[1]) = 1;",
        "in `f(q)`: the argument `q` is part of an index, so that it has to be a constant",
    );
}

#[test]
fn functions_are_called_with_their_arguments() {
    for (formula, message) in [
        ("f(x)", "`f` takes 2 arguments, as in `f(a, b)`, not 1"),
        ("f()", "`f` takes 2 arguments"),
        (
            "f(x, x, x)",
            "`f` takes 2 arguments, as in `f(a, b)`, not 3",
        ),
        ("f", "`f` is a function: write `f(a, b)`"),
        ("f[0]", "`f` is a function: write `f(a, b)`"),
        (
            "energi(x)",
            "there is no function `energi`; did you mean `energy`?",
        ),
        (
            "gamma(x)",
            "there is no function `gamma`; there are energy, f, sqrt",
        ),
    ] {
        one(
            &format!(
                "state x; fn f(a, b) = a*b; fn energy(a) = a; let _use = f(x, energy(x)); der(x) = {formula};"
            ),
            message,
        );
    }
}

#[test]
fn functions_and_arguments_are_used() {
    all(
        "state x; fn f(a, b, _c) = a; der(x) = f(x, x, x);",
        &["warning: the argument `b` of `f` is never used: remove it"],
    );
    all(
        "state x; fn f(a) = a; der(x) = 1;",
        &["warning: the function `f` is never used: remove it"],
    );
    model("system S { state x; fn _f(a) = a; der(x) = 1; }");
    // a misspelt call is a use
    all(
        "state x; fn energy(a) = a; der(x) = enrgy(x);",
        &["there is no function `enrgy`; did you mean `energy`?"],
    );
}

#[test]
fn what_is_wrong_with_a_function_is_said_once() {
    all(
        "state x; fn f(a) = a + zz; der(x) = f(x) + f(1) + f(2);",
        &["`zz` is not declared: declare it as a `state`, a `param`, a `const` or a `let`"],
    );
    all(
        "state x; fn f(a) = a/0; der(x) = f(x);",
        &["division by zero"],
    );
}

#[test]
fn what_is_wrong_with_an_argument_is_said_at_the_call() {
    for (formula, message) in [
        (
            "inverse(0)",
            "in `inverse(0)`: division by `a`, which is zero",
        ),
        ("inverse(x - x)", "in `inverse(x - x)`: division by `a`"),
        (
            "logarithm(-1)",
            "in `logarithm(-1)`: `ln` of -1 cannot be evaluated",
        ),
        ("twice(0)", "in `twice(0)`: division by `a`"),
        (
            "element(2)",
            "in `element(2)`: `q[i]` is `q[2]`, beyond the end",
        ),
        (
            "element(x)",
            "in `element(x)`: the argument `i` is part of an index, so that it has to be a constant",
        ),
        (
            "through(x)",
            "in `through(x)`: the argument `i` is part of an index",
        ),
        (
            "turns(x)",
            "in `turns(x)`: the argument `n` is part of the bound of a loop",
        ),
        ("power(0)", "in `power(0)`: a varying power of 0"),
        ("odd(x)", "in `odd(x)`: `%` is for integers"),
        (
            "sum(j in 0..3, element(j))",
            "in `element(j)`: `q[i]` is `q[2]` with j = 2, beyond the end",
        ),
    ] {
        one(
            &format!(
                "state x, q[2]; fn inverse(a) = 1/a; fn logarithm(a) = ln(a);
                 fn twice(a) = inverse(a) + inverse(a); fn element(i) = q[i];
                 fn through(a) = element(a + 1); fn turns(n) = sum(j in 0..n, q[j]);
                 fn power(a) = a^x; fn odd(a) = a % 2;
                 let _use = twice(x) + logarithm(x) + through(0) + turns(1) + power(2) + odd(1);
                 der(q[0]) = 1; der(q[1]) = 1; der(x) = {formula};"
            ),
            message,
        );
    }
}

#[test]
fn constants_may_call_functions() {
    one(
        "state x; fn f(a) = a*x; const c = f(2); der(x) = c;",
        "a constant cannot depend on `f(2)`, which varies",
    );
    one(
        "state x; fn f(a) = a; const c = f(x); der(x) = c;",
        "a constant cannot depend on the state `x`",
    );
}
