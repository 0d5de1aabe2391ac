//! Three bodies in a plane, on the figure eight.
//!
//! Newton's equations mᵢ r̈ᵢ = Σⱼ mᵢ mⱼ (rⱼ − rᵢ)/|rⱼ − rᵢ|³ with the energy, the two components
//! of the momentum and the angular momentum. Three equal masses chase each other along one
//! curve with the shape of an eight; period 6.32591398….
//!
//! Source: A. Chenciner, R. Montgomery, *A remarkable periodic solution of the three-body
//! problem in the case of equal masses*, Ann. of Math. 152 (2000), with C. Simó's initial
//! values.

use crate::problem::Description;

pws! {
    /// Three bodies in a plane.
    pub system ThreeBody {
        /// Positions.
        state x[3], y[3];
        /// Velocities.
        state u[3], v[3];
        /// Masses.
        param m[3] = 1;
        fn distance(i, j) = sqrt((x[i] - x[j])^2 + (y[i] - y[j])^2);
        for i in 0..3 {
            der(x[i]) = u[i];
            der(y[i]) = v[i];
            der(u[i]) = sum(k in 1..3, m[(i + k) % 3] * (x[(i + k) % 3] - x[i])
                / distance(i, (i + k) % 3)^3);
            der(v[i]) = sum(k in 1..3, m[(i + k) % 3] * (y[(i + k) % 3] - y[i])
                / distance(i, (i + k) % 3)^3);
        }
        conserved energy = sum(i in 0..3, m[i] * (u[i]^2 + v[i]^2) / 2)
            - sum(i in 0..3, sum(j in 0..i, m[i] * m[j] / distance(i, j)));
        conserved momentum_x = sum(i in 0..3, m[i] * u[i]);
        conserved momentum_y = sum(i in 0..3, m[i] * v[i]);
        conserved angular_momentum = sum(i in 0..3, m[i] * (x[i] * v[i] - y[i] * u[i]));
    }
}

/// Two bodies opposite each other and the third half way between them, with the momentum of
/// the two together.
const fn figure_eight() -> [f64; 12] {
    let (x, y) = (0.970_004_36, -0.243_087_53);
    let (u, v) = (-0.932_407_37, -0.864_731_46);
    let (half_u, half_v) = (-0.5 * u, -0.5 * v);
    [x, -x, 0.0, y, -y, 0.0, half_u, half_u, u, half_v, half_v, v]
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "three_body",
    title: "three bodies on the figure eight",
    source: "Chenciner & Montgomery, Ann. of Math. 152 (2000)",
    initial: &figure_eight(),
    t_end: 100.0,
    step_size: 1e-3,
    longest: None,
    reference: None,
};
