//! A smooth system: one region, no interface.

use dmm_runtime::{System, pws};

pws! {
    /// A pendulum.
    pub system Pendulum {
        /// Angle and momentum.
        state q, p;
        /// Squared frequency.
        param w2 = 1;
        der(q) = p;
        der(p) = -w2 * sin(q);
        /// The energy.
        conserved energy = p^2/2 - w2 * cos(q);
    }
}

#[test]
fn compiles() {
    let system = Pendulum::default();
    assert_eq!(system.w2, 1.0);
    let metadata = system.metadata();
    assert_eq!(metadata.states, ["q", "p"]);
    assert_eq!(metadata.parameters, ["w2"]);
    assert!(metadata.interfaces.is_empty());
    assert_eq!(metadata.regions.len(), 1);
    assert_eq!(system.region(0), Some(PendulumRegion::Everywhere));
    assert_eq!(
        system.of_region(PendulumRegion::Everywhere).conserved,
        ["energy"]
    );
}
