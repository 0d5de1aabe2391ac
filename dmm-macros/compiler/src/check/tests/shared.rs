//! What stands outside of regions holds in each of them.

use super::{all, field, messages, model};
use crate::model::Claim;

#[test]
fn regions_share_what_stands_outside() {
    let model = model(
        "system S {
            state q[2], p[2], z;
            interface wall = q[0];
            for i in 0..2 { der(q[i]) = p[i]; }
            conserved height = z;
            region low where wall < 0 {
                let force = -q[0];
                conserved energy = p[0]^2 + q[0]^2;
                der(p[0]) = force; der(p[1]) = 0; der(z) = 0;
            }
            region high where wall > 0 {
                for i in 0..2 { der(p[i]) = -q[i]; }
                assume conserved energy = p[0]^2 + q[0]^2;
                der(z) = 1;
            }
        }",
    );
    assert_eq!(field(&model, 0), ["p[0]", "p[1]", "-q[0]", "0", "0"]);
    assert_eq!(field(&model, 1), ["p[0]", "p[1]", "-q[0]", "-q[1]", "1"]);
    let quantities = |region: usize| -> Vec<(String, Claim)> {
        let conserved = model.regions[region].conserved.iter();
        conserved
            .map(|psi| (psi.ident.to_string(), psi.claim))
            .collect()
    };
    let height = ("height".to_owned(), Claim::Conserved);
    assert_eq!(
        quantities(0),
        [height.clone(), ("energy".into(), Claim::Conserved)]
    );
    assert_eq!(quantities(1), [height, ("energy".into(), Claim::Assumed)]);
}

#[test]
fn regions_share_a_hamiltonian() {
    let model = model(
        "system S { state q, p, z; interface wall = q; hamiltonian H = p^2/2 + q^2/2 in (q, p);
         region low where wall < 0 { der(z) = 1; } region high where wall > 0 { der(z) = 2; } }",
    );
    for (region, rate) in [(0, "1"), (1, "2")] {
        assert_eq!(field(&model, region), ["p", "-q", rate]);
        assert_eq!(model.regions[region].canonical, [(0, 1)]);
        assert_eq!(model.regions[region].conserved[0].claim, Claim::Hamiltonian);
    }
}

/// The messages on regions with these items, each region with `der(p)` of its own.
#[track_caller]
fn with(shared: &str, low: &str, high: &str, expected: &[&str]) {
    all(
        &format!(
            "state q, p; interface wall = q; {shared}
             region low where wall < 0 {{ {low} }} region high where wall > 0 {{ {high} }}"
        ),
        expected,
    );
}

#[test]
fn what_is_shared_is_not_repeated() {
    with(
        "der(q) = p;",
        "der(p) = 1; der(q) = p;",
        "der(p) = 1; der(q) = p;",
        &[
            "`der(q)` stands at the top level already, for all regions: it cannot be given again in the region `low`",
        ],
    );
    with(
        "der(q) = 0; conserved c = q;",
        "der(p) = 1;",
        "der(p) = 1; conserved c = q;",
        &[
            "`c` is declared at the top level already, for all regions: it cannot be declared again in the region `high`",
        ],
    );
    with(
        "hamiltonian H = p^2 in (q, p);",
        "der(q) = p;",
        "",
        &[
            "`q` is in a pair of the hamiltonian `H` of all regions, which gives `der(q)`: remove one of them",
        ],
    );
    with(
        "der(q) = p;",
        "der(p) = 1;",
        "hamiltonian H = p^2 in (q, p);",
        &[
            "`q` is in a pair of the hamiltonian `H` and has a `der` of all regions: remove one of them",
        ],
    );
    with(
        "hamiltonian H = p^2 in (q, p);",
        "hamiltonian H = p^2 in (q, p);",
        "hamiltonian G = q^2 in (q, p);",
        &[
            "`H` is declared at the top level already, for all regions: it cannot be declared again in the region `low`",
            "`q` is in a pair of `G` and in one of `H` of all regions",
        ],
    );
    // two regions may use the same name
    with(
        "der(q) = 0; der(p) = 0;",
        "conserved c = q;",
        "conserved c = p;",
        &[],
    );
}

#[test]
fn what_no_region_has_is_said_once() {
    with(
        "",
        "der(q) = 1;",
        "",
        &[
            "no region has `der(p)`: give it in each of them, or at the top level for all",
            "the region `high` has no `der(q)`",
        ],
    );
    with(
        "der(q) = p;",
        "",
        "der(p) = 1;",
        &["the region `low` has no `der(p)`"],
    );
    with(
        "der(q) = zz; der(p) = 1;",
        "",
        "",
        &["`zz` is not declared: declare it as a `state`, a `param`, a `const` or a `let`"],
    );
}

#[test]
fn shared_formulas_do_not_see_the_names_of_regions() {
    let messages = messages(
        "state q; interface wall = q; der(q) = stretch;
         region low where wall < 0 { let stretch = q; conserved c = stretch; }
         region high where wall > 0 { }",
    );
    assert_eq!(messages.len(), 1, "{messages:?}");
    assert!(messages[0].contains("a `let` of the region `low`"));
}
