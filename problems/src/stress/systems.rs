//! Systems that are made for stress alone.

use crate::problem::{Description, Problem};
use crate::registry;

/// A particle on a circle in phase space that touches a wall, which changes nothing.
const CIRCLE: &str = "
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
";

/// The same with the force of a quartic potential.
const QUARTIC: &str = "
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
";

/// A star that meets the axis of its galaxy, on whose two sides it is bound more and less:
/// energy is the same on both, and orbits are chaotic.
const WARPED: &str = "
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
";

/// ẋ = x², which is infinite at t = 1/x(0).
const BLOWUP: &str = "
pub system Blowup {
    state x;
    der(x) = x^2;
}
";

/// Falls at a steady rate to where ln x ends.
const LOGARITHM: &str = "
pub system Logarithm {
    state x, y;
    der(x) = -1;
    der(y) = ln(x);
}
";

/// Both fields point at the interface where y > 0.
const STUCK: &str = "
pub system Stuck {
    state x, y;
    interface wall = x;
    region right where wall > 0 {
        der(x) = -1;
        der(y) = 0;
    }
    region left where wall < 0 {
        der(x) = y;
        der(y) = 0;
    }
}
";

/// The field beyond the interface is tangential to it where it is met.
const TANGENT: &str = "
pub system Tangent {
    state x, y;
    interface wall = x;
    region right where wall > 0 {
        der(x) = -1;
        der(y) = 0;
    }
    region left where wall < 0 {
        der(x) = y - 1;
        der(y) = x;
    }
}
";

/// A problem without a source.
fn problem(
    name: &'static str,
    title: &'static str,
    initial: &'static [f64],
    declaration: &str,
) -> Problem {
    let description = Description {
        name,
        title,
        source: "",
        initial,
        t_end: 10.0,
        step_size: 1e-2,
        longest: None,
        reference: None,
    };
    registry::of(description, declaration)
}

/// [`CIRCLE`]
pub(super) fn circle() -> Problem {
    let title = "a circle that touches a wall";
    problem("circle", title, &[-1.0, 0.1], CIRCLE)
}

/// [`QUARTIC`]
pub(super) fn quartic() -> Problem {
    let title = "a curve that touches a wall";
    problem("quartic", title, &[-1.0, 0.1], QUARTIC)
}

/// [`WARPED`]
pub(super) fn warped() -> Problem {
    let title = "a star bound more on one side of an axis";
    problem("warped", title, &[0.05, 0.1, 0.44, 0.05], WARPED)
}

/// [`BLOWUP`], which is infinite at t = 1.
pub(super) fn blowup() -> Problem {
    problem("blowup", "blow-up", &[1.0], BLOWUP)
}

/// [`LOGARITHM`], which ends at t = 1.
pub(super) fn logarithm() -> Problem {
    let title = "the end of a logarithm";
    problem("logarithm", title, &[1.0, 0.0], LOGARITHM)
}

/// [`STUCK`], from where it comes to the interface at t = 1.
pub(super) fn stuck() -> Problem {
    let title = "two fields against each other";
    problem("stuck", title, &[1.0, 1.0], STUCK)
}

/// [`TANGENT`], from where it comes to the interface at t = 1.
pub(super) fn tangent() -> Problem {
    let title = "a field along an interface";
    problem("tangent", title, &[1.0, 1.0], TANGENT)
}
