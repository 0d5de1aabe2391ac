//! What is accepted on the user's word, and what is not.

use super::{Conservation, evidence, messages, one, sound};

/// True, and beyond the normal form: roots of numbers nested in each other, and the odd
/// function arsinh written as a logarithm in two ways.
const UNDECIDED: [&str; 2] = [
    "state x, y; der(x) = y; der(y) = -(9*2^(1/3) - 9)^(1/3)*x;
     CLAIM e = (y^2 + (1 - 2^(1/3) + 4^(1/3))*x^2)/2;",
    "state x, v; der(x) = v; der(v) = ln(sqrt(1 + x^2) - x);
     CLAIM e = v^2/2 + x*ln(x + sqrt(1 + x^2)) - sqrt(1 + x^2);",
];

#[test]
fn what_is_undecided_can_be_assumed() {
    for items in UNDECIDED {
        one(
            &items.replace("CLAIM", "conserved"),
            &["could not be proved", "assume conserved e = …;", "PWS301"],
        );
        let proved = sound(&items.replace("CLAIM", "assume conserved"));
        let &Conservation::Assumed { points, largest } = evidence(&proved) else {
            panic!("{items}: {:?}", evidence(&proved));
        };
        assert!(
            points >= 64 && largest < 1e-12,
            "{points} points, {largest}"
        );
    }
}

#[test]
fn an_assumption_does_not_hide_what_is_known() {
    let harmonic = "state x, y; der(x) = y; der(y) = -x;";
    let proved = sound(&format!("{harmonic} assume conserved e = x^2 + y^2;"));
    assert_eq!(*evidence(&proved), Conservation::Proved(Vec::new()));
    one(
        &format!("{harmonic} assume conserved e = x^2 + 2*y^2;"),
        &["`e` is not conserved", "PWS300"],
    );
}

#[test]
fn an_assumption_without_points_is_refused() {
    // defined within 10⁻⁶ of x = 1000 only
    one(
        "state x, y; let s = sqrt(1/10^12 - (x - 1000)^2);
         der(x) = s*((9*2^(1/3) - 9)^(1/3) - 1 + 2^(1/3) - 4^(1/3)); der(y) = 1; assume conserved a = x;",
        &[
            "that can be checked at 0 of 2048 points only, and 64 are needed: its formulas have no value at 2048",
            "PWS302",
        ],
    );
}

#[test]
fn an_assumption_whose_terms_cancel_in_themselves_is_refused() {
    // √(3 + 2√2) = 1 + √2, so that the only term is what rounding leaves of zero
    one(
        "state x, y; der(x) = (9*2^(1/3) - 9)^(1/3) - 1 + 2^(1/3) - 4^(1/3); der(y) = 1; assume conserved a = x;",
        &[
            "checked at 0 of 2048 points only",
            "needed: the terms of d/dt a are zero up to rounding errors at 2048 [PWS302]",
        ],
    );
    // the same, and a root that is real for x > 4 only
    let [message] = &messages(
        "state x, y; der(x) = ((9*2^(1/3) - 9)^(1/3) - 1 + 2^(1/3) - 4^(1/3))*sqrt(x - 4); der(y) = 1; assume conserved a = x;",
    )[..] else {
        panic!("one message");
    };
    let counts: Vec<usize> = (message.split(" at ").skip(2))
        .filter_map(|part| {
            part.split(|c: char| !c.is_ascii_digit())
                .next()?
                .parse()
                .ok()
        })
        .collect();
    assert!(message.contains("have no value at"), "{message}");
    assert!(
        message.contains(", and the terms of d/dt a are zero"),
        "{message}"
    );
    assert_eq!(counts.iter().sum::<usize>(), 2048, "{message}");
}

#[test]
fn an_assumption_that_fails_at_a_point_is_refused() {
    // nowhere small where it is real, which no point of the proof's own search is
    one(
        "state x, y; der(x) = sqrt(x - 4); der(y) = 0; assume conserved a = x;",
        &[
            "`a` is assumed to be conserved, but d/dt a is ",
            " at x = ",
            ", where its terms are of size ",
            "PWS303",
        ],
    );
}
