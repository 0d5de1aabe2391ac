//! Arguments that make no sense: one line, and exit status 2.

use super::refusal;

#[test]
fn unknown_names_get_a_suggestion() {
    assert!(refusal(&["run", "harmonc"]).contains("did you mean `harmonic`?"));
    assert!(refusal(&["show", "toad"]).contains("did you mean `toda`?"));
    assert!(
        refusal(&["run", "harmonic", "--param", "k_abov=2"]).contains("did you mean `k_above`?")
    );
    assert!(refusal(&["run", "harmonic", "--initial", "z=2"]).contains("there are x, y"));
    assert!(refusal(&["rnu", "harmonic"]).contains("run"));
    assert!(refusal(&["conserve", "harmonc"]).contains("did you mean `harmonic`?"));
    assert!(refusal(&["conserve", "nosuch"]).contains("`pws list` names those there are"));
    assert!(refusal(&["run", "toda_chain", "--initial", "z=2"]).contains("there are q[8], p[8]"));
    assert!(refusal(&["run", "toda_chain", "--initial", "q[8]=2"]).contains("did you mean `q["));
    assert!(refusal(&["run", "harmonic", "--stpe", "1"]).contains("--step"));
}

#[test]
fn senseless_values_are_refused() {
    for (option, value) in [
        ("--step", "0"),
        ("--step", "-1"),
        ("--step", "nan"),
        ("--step", "fast"),
        ("--end", "-1"),
        ("--every", "0"),
        ("--param", "k_above"),
        ("--param", "k_above=inf"),
        ("--initial", "x=one"),
        ("--scheme", "leapfrog"),
        ("--format", "gif"),
        ("--plane", "x"),
    ] {
        refusal(&["run", "harmonic", option, value]);
    }
    assert!(refusal(&["run", "harmonic", "--step", "-1"]).contains("must be positive"));
    let taylor = |option, value| refusal(&["run", "harmonic", "--scheme", "taylor", option, value]);
    assert!(taylor("--tolerance", "2").contains("must lie between"));
    assert!(taylor("--step", "0").contains("must be positive"));
    assert!(taylor("--step", "1e-300").contains("is below the rounding error"));
    let text = refusal(&[
        "run",
        "harmonic",
        "--scheme",
        "explicit-midpoint",
        "--tolerance=1e-6",
    ]);
    assert!(
        text.contains("takes a step size, not a tolerance"),
        "{text}"
    );
    refusal(&["converge", "harmonic", "--scheme", "taylor"]);
    assert!(refusal(&["bench", "elliptic", "--end", "-1"]).contains("must be positive"));
    refusal(&["bench", "elliptic", "--rounds", "0"]);
    refusal(&["bench", "elliptic", "--scheme", "taylor,leapfrog"]);
    assert!(refusal(&["bench", "elliptic", "--longest", "-1"]).contains("a time in seconds"));
    assert!(refusal(&["converge", "harmonic", "--after", "5000"]).contains("transitions"));
    refusal(&["converge", "harmonic", "--step=-1"]);
}

#[test]
fn what_is_given_twice_is_refused() {
    let parameters = ["--param", "k_above=2", "--param", "k_above=2"];
    let text = refusal(&[&["run", "harmonic"][..], &parameters].concat());
    assert!(
        text.contains("parameter `k_above` is given twice"),
        "{text}"
    );
    for command in ["run", "converge"] {
        let text = refusal(&[command, "harmonic", "--initial", "x=1,y=2, x=1"]);
        assert!(text.contains("state `x` is given twice"), "{text}");
    }
}

#[test]
fn numbers_in_messages_are_short() {
    let text = refusal(&["run", "harmonic", "--step", "1e-300"]);
    assert!(
        text.contains("1e-300 (is below the rounding error of the time)"),
        "{text}"
    );
    let text = refusal(&["run", "harmonic", "--every", "0"]);
    assert!(
        text.contains("must be a whole number, 1 at least"),
        "{text}"
    );
    assert!(!text.contains("18446744073709551615"), "{text}");
}
