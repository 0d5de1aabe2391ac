//! Two regions on the sides of one interface, with `let`, `const` and documentation.
#![deny(missing_docs, warnings)]

use dmm_runtime::{Side, System, pws};

pws! {
    /// Oscillator whose spring stiffens below y = 0.
    pub system Harmonic {
        state
            /// Position.
            x,
            /// Velocity.
            y;
        /// Stiffness above.
        param k_above = 1.0, k_below = 6/2;
        const half = 1/2;
        let kinetic = half * y^2;
        /// The kink of the spring.
        interface spring = y;
        /// The upper half plane.
        region above where spring > 0 {
            der(x) = y;
            der(y) = -k_above * x;
            /// The energy.
            conserved energy = kinetic + half * k_above * x^2;
        }
        /// The lower half plane.
        region below where spring < 0 {
            let force = -k_below * x;
            der(y) = force;
            der(x) = y;
            conserved energy = kinetic - half * force * x;
        }
    }
}

#[test]
fn compiles() {
    let system = Harmonic {
        k_above: 2.0,
        ..Default::default()
    };
    assert_eq!((system.k_above, system.k_below), (2.0, 3.0));
    assert_eq!(system.parameters(), [2.0, 3.0]);
    assert_eq!(system.metadata().interfaces, ["spring"]);
    let regions: Vec<HarmonicRegion> = system.regions().collect();
    assert_eq!(regions, [HarmonicRegion::Above, HarmonicRegion::Below]);
    let [above, below] = [HarmonicRegion::Above, HarmonicRegion::Below];
    for (region, side, other) in [
        (above, Side::Positive, below),
        (below, Side::Negative, above),
    ] {
        assert_eq!(system.of_region(region).sides, [Some(side)]);
        assert_eq!(system.side(region, 0), Some(side));
        assert_eq!(system.side(region, 1), None);
        assert_eq!(system.neighbour(region, 0), Some(other));
        assert_eq!(system.region_on(&[Some(side)], None), Some(region));
    }
    assert!(system.declaration().contains("let force = -k_below * x;"));
}
