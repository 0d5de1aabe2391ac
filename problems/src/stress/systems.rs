//! Systems that are made for stress alone.

use dmm_runtime::pws;

use crate::problem::{Description, Problem};
use crate::registry;

pws! {
    /// A particle on a circle in phase space that touches a wall, which changes nothing.
    pub system Circle {
        state q, p;
        param c = 1.0;
        interface wall = q - c;
        region before where wall < 0 {
            der(q) = p;
            der(p) = -q;
            conserved energy = (p^2 + q^2) / 2;
        }
        region beyond where wall > 0 {
            der(q) = p;
            der(p) = -q;
            conserved energy = (p^2 + q^2) / 2;
        }
    }
}

pws! {
    /// The same with the force of a quartic potential.
    pub system Quartic {
        state q, p;
        param c = 1.0;
        interface wall = q - c;
        region before where wall < 0 {
            der(q) = p;
            der(p) = -q^3;
            conserved energy = p^2 / 2 + q^4 / 4;
        }
        region beyond where wall > 0 {
            der(q) = p;
            der(p) = -q^3;
            conserved energy = p^2 / 2 + q^4 / 4;
        }
    }
}

pws! {
    /// A star that meets the axis of its galaxy, on whose two sides it is bound more and less:
    /// energy is the same on both, and orbits are chaotic.
    pub system Warped {
        state x, y;
        state u, v;
        param above = 1.3, below = 0.9;
        interface axis = x;
        region right where axis > 0 {
            hamiltonian energy =
                (u^2 + v^2) / 2 + (above * x^2 + y^2) / 2 + x^2 * y - y^3 / 3 in (x, u), (y, v);
        }
        region left where axis < 0 {
            hamiltonian energy =
                (u^2 + v^2) / 2 + (below * x^2 + y^2) / 2 + x^2 * y - y^3 / 3 in (x, u), (y, v);
        }
    }
}

/// A description without a source.
const fn description(
    name: &'static str,
    title: &'static str,
    initial: &'static [f64],
) -> Description {
    Description {
        name,
        title,
        source: "",
        initial,
        t_end: 10.0,
        step_size: 1e-2,
        longest: None,
        reference: None,
    }
}

/// The description of [`Circle`].
const CIRCLE: Description = description("circle", "a circle that touches a wall", &[-1.0, 0.1]);
/// The description of [`Quartic`].
const QUARTIC: Description = description("quartic", "a curve that touches a wall", &[-1.0, 0.1]);
/// The description of [`Warped`].
const WARPED: Description = description(
    "warped",
    "a star bound more on one side of an axis",
    &[0.05, 0.1, 0.44, 0.05],
);

/// [`Circle`]
pub(super) fn circle() -> Problem {
    registry::of(CIRCLE, &Circle::default())
}

/// [`Quartic`]
pub(super) fn quartic() -> Problem {
    registry::of(QUARTIC, &Quartic::default())
}

/// [`Warped`]
pub(super) fn warped() -> Problem {
    registry::of(WARPED, &Warped::default())
}
