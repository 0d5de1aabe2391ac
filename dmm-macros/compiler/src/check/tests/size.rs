//! Declarations that become long: what is supported, and that nothing hangs.

use std::time::{Duration, Instant};

use super::{all, messages, model};

/// Chains of `base` and of functions that call the one before in this way, sixty of them.
fn tower(base: &str, step: &str, formula: &str) -> String {
    let functions: Vec<String> = (1..60)
        .map(|k| {
            format!(
                "fn f{k}(a) = {};",
                step.replace('f', &format!("f{}", k - 1))
            )
        })
        .collect();
    format!(
        "state x; fn f0(a) = {base}; {} der(x) = {formula};",
        functions.join(" ")
    )
}

#[test]
fn a_chain_of_32_masses_is_short() {
    for energy in [
        "(q[i + 1] - q[i])^2/2 + beta*(q[i + 1] - q[i])^4/4",
        "exp(q[i] - q[i + 1])*beta",
    ] {
        let start = Instant::now();
        let model = model(&format!(
            "system S {{ const n = 32; state q[n], p[n]; param beta = 1;
             hamiltonian H = sum(i in 0..n, p[i]^2/2) + sum(i in 0..n - 1, {energy}) in (q, p); }}"
        ));
        assert_eq!(model.states.len(), 64);
        assert_eq!(model.regions[0].canonical.len(), 32);
        assert!(model.dag.len() < 1_500, "{}", model.dag.len());
        // 0.03 s on one idle core of a laptop
        assert!(
            start.elapsed() < Duration::from_secs(2),
            "{:?}",
            start.elapsed()
        );
    }
}

#[test]
fn thirty_two_bodies_in_a_plane_are_read() {
    let model = model(
        "system S {
            const n = 32;
            state x[n], y[n], px[n], py[n];
            param m[n] = 1;
            fn distance(i, j) = sqrt((x[i] - x[j])^2 + (y[i] - y[j])^2);
            hamiltonian H = sum(i in 0..n, (px[i]^2 + py[i]^2)/(2*m[i]))
                - sum(i in 0..n, sum(j in i + 1..n, m[i]*m[j]/distance(i, j))) in (x, px), (y, py);
        }",
    );
    assert_eq!(model.states.len(), 128);
}

#[test]
fn shared_calls_are_written_out_once() {
    // as trees, 2⁶⁰ times `sin(a)` each
    model(&format!(
        "system S {{ {} }}",
        tower("sin(a)", "f(a) + f(a)", "f59(x)")
    ));
    model(&format!(
        "system S {{ {} }}",
        tower("sin(a)", "f(a)*cos(f(a))", "f59(x)")
    ));
}

#[test]
fn nothing_hangs() {
    let long =
        "this declaration is too long: written out, its loops and functions have too many parts";
    let deep = "a formula is nested more than 160 deep";
    for (items, message) in [
        (tower("a*(a + 1)", "f(f(a))", "f59(x)"), deep),
        (tower("sin(a)", "f(a + 1)*f(a - 1.5)", "f59(x)"), long),
        (tower("a*a", "f(f(a))", "f59(x)"), "integer powers are supported up to the exponent 100"),
        (tower("a + a", "f(f(a))", "f59(x)"), "beyond the range of floating-point numbers"),
        (
            "state x; der(x) = sum(i in 0..4000, sum(j in 0..4000, i*j*x));".into(),
            long,
        ),
        (
            "state x; for i in 0..4000 { for j in 0..4000 { for k in 0..j { conserved c = i*k*x; } } } der(x) = 0;".into(),
            long,
        ),
        ("state x; der(x) = x*sum(i in 0..4000, 1/(i + 1));".into(), long),
        (
            "state x; der(x) = sum(i in 0..1000000000000, x*i);".into(),
            "the range `0..1000000000000` has 1000000000000 turns: up to 4096 are supported",
        ),
        (
            "state x; der(x) = sum(i in -9223372036854775807..9223372036854775807, x*i);".into(),
            "turns: up to 4096 are supported",
        ),
    ] {
        let start = Instant::now();
        let messages = messages(&items);
        assert_eq!(messages.len(), 1, "{items}: {messages:?}");
        assert!(messages[0].contains(message), "{items}: {messages:?}");
        // a second at most on one idle core, unoptimised
        assert!(start.elapsed() < Duration::from_secs(10), "{:?}: {items}", start.elapsed());
    }
}

#[test]
fn deep_formulas_do_not_overflow_the_stack() {
    let long = format!("f(a){}", " + a".repeat(350));
    let functions: Vec<String> = (1..5)
        .map(|k| {
            format!(
                "fn f{k}(a) = {};",
                long.replace('f', &format!("f{}", k - 1))
            )
        })
        .collect();
    all(
        &format!(
            "state x; fn f0(a) = a; {} der(x) = f4(x);",
            functions.join(" ")
        ),
        &["in `f1(a)`: this declaration is too long: its functions and sums are nested too deeply"],
    );
}

#[test]
fn what_names_stand_for_is_not_nested_too_deeply() {
    let nested = |of: &str, levels: usize| {
        let names: Vec<String> = (0..levels)
            .map(|k| format!("let l{} = {};", k + 1, of.replace('x', &format!("l{k}"))))
            .collect();
        format!(
            "state y; let l0 = y; {} der(y) = l{levels};",
            names.join(" ")
        )
    };
    for of in ["sin(x)", "1/(1 + x)", "(1 + x)^2"] {
        let messages = messages(&nested(of, 3_000));
        assert_eq!(messages.len(), 1, "{of}: {messages:?}");
        assert!(
            messages[0].contains("nested more than 160 deep"),
            "{of}: {messages:?}"
        );
    }
    // sums of sums are of one level
    for (of, levels) in [("sin(x)", 150), ("x + 2*y", 3_000)] {
        assert_eq!(messages(&nested(of, levels)), Vec::<String>::new(), "{of}");
    }
}

#[test]
fn long_constants_are_refused() {
    all(
        "state x; const a = 0.123456789^60; const b = a*a; const c = b*b; der(x) = c*c;",
        &["the exact value of this constant has too many digits"],
    );
}
