//! Canonical pairs and the fields that a Hamiltonian gives.

use super::{all, field, model, one, text};
use crate::model::Claim;

#[test]
fn a_hamiltonian_gives_the_field() {
    let model = model(
        "system S {
            state x, px, q[2], p[2], z;
            param k = 1;
            /// The energy.
            hamiltonian H = (px^2 + sum(i in 0..2, p[i]^2))/2 + k*x*q[0]*q[1]^2 in (x, px), (q, p);
            der(z) = x;
        }",
    );
    assert_eq!(
        field(&model, 0),
        [
            "px",
            "-k*q[0]*q[1]^2",
            "p[0]",
            "p[1]",
            "-k*x*q[1]^2",
            "-2*k*x*q[0]*q[1]",
            "x",
        ]
    );
    let region = &model.regions[0];
    assert_eq!(region.canonical, [(0, 1), (2, 4), (3, 5)]);
    let [energy] = region.conserved.as_slice() else {
        panic!("one quantity")
    };
    assert_eq!(energy.ident, "H");
    assert_eq!(energy.claim, Claim::Hamiltonian);
    assert_eq!(energy.attributes.len(), 1);
    assert_eq!(
        text(&model, energy.psi),
        "(px^2 + p[0]^2 + p[1]^2)/2 + k*x*q[0]*q[1]^2"
    );
}

#[test]
fn elements_may_be_paired_one_by_one() {
    let model = model(
        "system S { const n = 2; state q[n], p[n];
         hamiltonian H = (p[0]^2 + p[1]^2 + q[0]^2 + 2*q[1]^2)/2 in (q[n - 1], p[1]), (q[0], p[0]); }",
    );
    assert_eq!(model.regions[0].canonical, [(1, 3), (0, 2)]);
    assert_eq!(field(&model, 0), ["p[0]", "p[1]", "-q[0]", "-2*q[1]"]);
}

#[test]
fn a_hamiltonian_is_conserved_as_far_as_it_is_clear() {
    // with an explicit time only the field counts
    let driven = model(
        "system S { state q, p; param w = 1; hamiltonian H = p^2/2 + q*sin(w*t) in (q, p); }",
    );
    assert!(driven.regions[0].conserved.is_empty());
    assert_eq!(field(&driven, 0), ["p", "-sin(w*t)"]);
    // a state outside of the pairs may change it: it has to be proved
    let other =
        model("system S { state q, p, z; hamiltonian H = p^2/2 + z*q^2 in (q, p); der(z) = 0; }");
    assert_eq!(other.regions[0].conserved[0].claim, Claim::Conserved);
    // t in a part that is no part of H any more
    let same = model("system S { state q, p; hamiltonian H = p^2/2 + q + 0*t in (q, p); }");
    assert_eq!(same.regions[0].conserved[0].claim, Claim::Hamiltonian);
    // two systems side by side
    let two = model(
        "system S { state q, p, r, s; hamiltonian H = p^2 + q^2 in (q, p);
         hamiltonian G = r^2 + s^2 in (r, s); }",
    );
    assert_eq!(two.regions[0].canonical, [(0, 1), (2, 3)]);
    let claims: Vec<Claim> = two.regions[0]
        .conserved
        .iter()
        .map(|psi| psi.claim)
        .collect();
    assert_eq!(claims, [Claim::Hamiltonian, Claim::Hamiltonian]);
}

#[test]
fn each_state_has_one_rate() {
    for (items, message) in [
        (
            "hamiltonian H = p^2 + q^2 in (q, p); der(q) = p;",
            "`q` is in a pair of the hamiltonian `H`, which gives `der(q)`: remove one of them",
        ),
        (
            "der(p) = -q; hamiltonian H = p^2 + q^2 in (q, p);",
            "`p` is in a pair of the hamiltonian `H` and has a `der`: remove one of them",
        ),
        (
            "hamiltonian H = p^2 + q^2 in (q, p), (p, q);",
            "`p` stands twice in the pairs of `H`",
        ),
        (
            "hamiltonian H = p^2 + q^2 in (q, q);",
            "`q` is in a pair with itself",
        ),
        (
            "hamiltonian H = p^2 + q^2 in (q, p); hamiltonian G = p + q in (p, q);",
            "`p` is in a pair of `G` and in one of `H`",
        ),
        (
            "hamiltonian H = p^2 in (q, p); conserved H = p;",
            "`H` is declared twice",
        ),
    ] {
        one(&format!("state q, p; {items}"), message);
    }
    one(
        "state q, p, r; hamiltonian H = p^2 + q^2 in (q, p);",
        "the system has no `der(r)`",
    );
}

#[test]
fn pairs_are_of_states_that_fit() {
    for (items, message) in [
        (
            "state q[3], p[2]; hamiltonian H = p[0]^2 + q[1]^2 in (q, p);",
            "`q` has 3 elements and `p` has 2 elements: a coordinate and its momentum make a pair",
        ),
        (
            "state q[3], p; hamiltonian H = p^2 + q[1]^2 in (q, p);",
            "`q` has 3 elements and `p` has 1 element",
        ),
        (
            "state q, p; hamiltonian H = p^2 + q^2 in (r, p);",
            "there is no state `r`",
        ),
        (
            "state angle, p; hamiltonian H = p^2 + angle^2 in (angel, p);",
            "there is no state `angel`; did you mean `angle`?",
        ),
        (
            "state q, p; hamiltonian H = p^2 + q^2 in (t, p);",
            "`t` is the time, which is not a state",
        ),
        (
            "state q, p; param m = 1; hamiltonian H = p^2/m + q^2 in (m, p);",
            "`m` is a parameter; only states make canonical pairs",
        ),
        (
            "state q[2], p; hamiltonian H = p^2 in (q[2], p);",
            "`q[2]` is beyond the end",
        ),
        (
            "state q, p; hamiltonian H = p^2 + zz in (q, p);",
            "`zz` is not declared",
        ),
        (
            "state q, p; hamiltonian H = p^2 in (q, p); let r = H; conserved s = r;",
            "`H` is the energy of a `hamiltonian`",
        ),
    ] {
        one(items, message);
    }
    all(
        "state q[2], p[2]; hamiltonian H = p^2 + q[0] in (q, p);",
        &[
            "`p` is a group of 2 elements: write one of them, as in `p[0]`, or `sum(i in 0..2, p[i])`",
        ],
    );
}
