//! Which strategy is chosen, and what f^τ comes out.

use dmm_compiler::algebra::{Dag, Id, Name, Verdict, decide_zero, to_text};
use dmm_compiler::scheme::{
    Evidence, Explicit, Obstacle, RegionScheme, Scheme, Solvability, Strategy,
};

use crate::{scheme, systems};

/// f^τ of an explicit strategy.
fn explicit(region: &RegionScheme) -> &Explicit {
    match &region.strategy {
        Strategy::Midpoint { field }
        | Strategy::SkewPairing { field, .. }
        | Strategy::CrossProduct { field, .. } => field,
        Strategy::MinimalNorm { .. } => panic!("the strategy is the minimal norm"),
    }
}

fn assert_equal(dag: &mut Dag, found: Id, expected: Id) {
    let difference = dag.sub(found, expected);
    let verdict = decide_zero(dag, difference);
    assert_eq!(verdict, Verdict::Proved, "{}", to_text(dag, found));
}

/// x₀, x₁ and their mean.
fn ends(dag: &mut Dag, name: &str) -> [Id; 3] {
    let name = Name::new(name);
    let start = dag.variable(&name.at_start());
    let end = dag.variable(&name.at_end());
    let mean = dag.mean(start, end);
    [start, end, mean]
}

fn all_proved(scheme: &Scheme) -> bool {
    scheme.regions.iter().all(|region| {
        let proofs = &region.proofs;
        [proofs.telescopes, proofs.conserves, proofs.consistent] == [Evidence::Proved; 3]
    })
}

#[test]
fn harmonic_is_the_implicit_midpoint_rule() {
    let scheme = scheme(systems::HARMONIC);
    assert!(all_proved(&scheme));
    let mut dag = scheme.dag().clone();
    for (region, stiffness) in scheme.regions.iter().zip(["k_above", "k_below"]) {
        let field = explicit(region);
        let [.., x] = ends(&mut dag, "x");
        let [.., y] = ends(&mut dag, "y");
        let stiffness = dag.variable(&Name::new(stiffness));
        let force = dag.mul(stiffness, x);
        let force = dag.neg(force);
        assert_equal(&mut dag, field.value[0], y);
        assert_equal(&mut dag, field.value[1], force);
        assert_eq!(region.solvability, Solvability::Linear);
        assert!(region.autonomous);
    }
}

#[test]
fn elliptic_is_the_published_scheme() {
    let scheme = scheme(systems::ELLIPTIC);
    assert!(all_proved(&scheme));
    let mut dag = scheme.dag().clone();
    for (region, parameter) in scheme.regions.iter().zip(["a_outside", "a_inside"]) {
        let field = explicit(region);
        let [x0, x1, _] = ends(&mut dag, "x");
        let [y0, y1, _] = ends(&mut dag, "y");
        let first = dag.add(y1, y0);
        let squares = [dag.powi(x1, 2), dag.mul(x1, x0), dag.powi(x0, 2)];
        let parameter = dag.variable(&Name::new(parameter));
        let sum = dag.sum(squares);
        let second = dag.add(sum, parameter);
        assert_equal(&mut dag, field.value[0], first);
        assert_equal(&mut dag, field.value[1], second);
        assert_eq!(region.solvability, Solvability::Nonlinear);
        // as it is written, not only as it is worth: four additions, three products
        assert_eq!(to_text(&dag, field.value[0]), "y₁ + y₀");
    }
}

#[test]
fn pendulum_and_lotka_volterra_are_skew_pairings() {
    for (source, expected) in [(systems::PENDULUM, "1"), (systems::LOTKA_VOLTERRA, "-x*y")] {
        let scheme = scheme(source);
        assert!(all_proved(&scheme));
        let Strategy::SkewPairing { pairs, alone, .. } = &scheme.regions[0].strategy else {
            panic!("{:?}", scheme.regions[0].strategy);
        };
        assert!(alone.is_empty());
        assert_eq!(pairs.len(), 1);
        assert_eq!(to_text(scheme.dag(), pairs[0].alpha), expected);
    }
}

#[test]
fn rigid_body_is_a_cross_product_with_a_constant_factor() {
    let scheme = scheme(systems::RIGID_BODY);
    assert!(all_proved(&scheme));
    let Strategy::CrossProduct { alpha, .. } = scheme.regions[0].strategy else {
        panic!("{:?}", scheme.regions[0].strategy);
    };
    assert!(
        scheme.dag().as_constant(alpha).is_some(),
        "{}",
        to_text(scheme.dag(), alpha)
    );
}

#[test]
fn kepler_refuses_the_cross_product_where_its_invariants_become_dependent() {
    let scheme = scheme(systems::KEPLER);
    let region = &scheme.regions[0];
    assert!(matches!(region.strategy, Strategy::MinimalNorm { .. }));
    let [skew_pairing, cross_product] = &region.refusals[..] else {
        panic!("{:?}", region.refusals);
    };
    assert!(matches!(skew_pairing.obstacle, Obstacle::Count { .. }));
    let Obstacle::Denominator(factor) = cross_product.obstacle else {
        panic!("{cross_product:?}");
    };
    // r times the other component of the Laplace vector, A_y = −vx (x vy − y vx) − mu y/r
    let mut dag = scheme.dag().clone();
    let [x, y, vx, vy, mu] =
        ["x", "y", "vx", "vy", "mu"].map(|name| dag.variable(&Name::new(name)));
    let squares = [dag.powi(x, 2), dag.powi(y, 2)];
    let square = dag.sum(squares);
    let r = dag.sqrt(square);
    let (first, second) = (dag.mul(x, vy), dag.mul(y, vx));
    let momentum = dag.sub(first, second);
    let kinetic = [vx, momentum, r].into_iter().reduce(|a, b| dag.mul(a, b));
    let potential = dag.mul(mu, y);
    let laplace = dag.add(kinetic.expect("three factors"), potential);
    let same = dag.sub(factor, laplace);
    let opposite = dag.add(factor, laplace);
    assert!(
        [same, opposite]
            .iter()
            .any(|&id| decide_zero(&mut dag, id) == Verdict::Proved)
    );
}

#[test]
fn a_conserved_quantity_that_depends_on_the_time_takes_the_minimal_norm() {
    let scheme = scheme(systems::DAMPED);
    assert!(all_proved(&scheme));
    let region = &scheme.regions[0];
    assert!(matches!(region.strategy, Strategy::MinimalNorm { .. }));
    assert!(!region.autonomous);
}

#[test]
fn states_that_psi_does_not_see_stand_alone() {
    let scheme = scheme(
        "system Drift {
            state q, p, s, c;
            der(q) = p;
            der(p) = -q;
            der(s) = sin(s) + q;
            der(c) = 0;
            conserved energy = (p^2 + q^2) / 2 + 0 * c;
        }",
    );
    let Strategy::SkewPairing { pairs, alone, .. } = &scheme.regions[0].strategy else {
        panic!("{:?}", scheme.regions[0].strategy);
    };
    assert_eq!((pairs.len(), &alone[..]), (1, &[2, 3][..]));
}

#[test]
fn without_conserved_quantities_f_is_taken_at_the_midpoint() {
    let scheme = scheme(
        "system Decay {
            state x;
            param rate = 1;
            der(x) = -rate * x + sin(t);
        }",
    );
    let region = &scheme.regions[0];
    assert!(matches!(region.strategy, Strategy::Midpoint { .. }));
    // affine, and not linear: sin(t) is not a constant
    assert_eq!(region.solvability, Solvability::Affine);
}

#[test]
fn a_pole_that_f_does_not_have_is_not_used() {
    let scheme = scheme(
        "system Saddle {
            state x, y;
            der(x) = 1;
            der(y) = -y/(x + 2);
            conserved level = y * (x + 2);
        }",
    );
    let region = &scheme.regions[0];
    match &region.strategy {
        // α = 1/(x + 2) has f's own pole
        Strategy::SkewPairing { pairs, .. } => {
            assert_eq!(to_text(scheme.dag(), pairs[0].alpha), "1/(x + 2)");
        }
        strategy => panic!("{strategy:?}, {:?}", region.refusals),
    }
    let scheme = self::scheme(
        "system Squared {
            state x, y;
            der(x) = y;
            der(y) = -x;
            conserved level = (x^2 + y^2)^2;
        }",
    );
    let region = &scheme.regions[0];
    assert!(matches!(region.strategy, Strategy::MinimalNorm { .. }));
    let obstacle = &region.refusals[0].obstacle;
    assert!(matches!(obstacle, Obstacle::Denominator(_)), "{obstacle:?}");
}

#[test]
fn groups_called_as_the_symbols_of_the_compiler_are_kept_apart() {
    let listing = dmm_compiler::explain(
        "system Masses {
            state q[3], p[3];
            param w[3] = [1, 2, 3];
            hamiltonian energy = sum(i in 0..3, p[i]^2 / (2 * w[i])) + (q[0] - q[1])^4 / 4
                + (q[1] - q[2])^4 / 4 in (q, p);
            conserved momentum = sum(i in 0..3, p[i]);
        }"
        .parse()
        .expect("tokens"),
    )
    .expect("a scheme");
    assert!(!listing.contains("not proved"), "{listing}");
    assert!(
        listing.contains("f̄[q[2]] = (p[2]₁ + p[2]₀)/(2*w[2])") || listing.contains("w[i]"),
        "{listing}"
    );
}
