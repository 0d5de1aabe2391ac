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

fn main() {
    let system = Pendulum::default();
    assert_eq!(system.w2, 1.0);
    assert_eq!(Pendulum::STATES, ["q", "p"]);
    assert_eq!(Pendulum::PARAMETERS, ["w2"]);
    assert!(Pendulum::INTERFACES.is_empty());
    assert_eq!(Pendulum::REGIONS, [PendulumRegion::Everywhere]);
    assert_eq!(Pendulum::conserved_names(PendulumRegion::Everywhere), ["energy"]);
}
