//! Four stiff problems as the library declares them.

use dmm_runtime::pws;

pws! {
    /// Three chemical reactions (Robertson 1966; Hairer & Wanner, Solving Ordinary Differential
    /// Equations II, eq. IV.10.3).
    pub system Robertson {
        state a, b, c;
        der(a) = -0.04 * a + 1e4 * b * c;
        der(b) = 0.04 * a - 1e4 * b * c - 3e7 * b^2;
        der(c) = 3e7 * b^2;
        conserved mass = a + b + c;
    }
}

pws! {
    /// Eight reactants of photomorphogenesis (Schäfer 1975; the same, eq. IV.10.4).
    pub system Hires {
        state y[8];
        der(y[0]) = -1.71 * y[0] + 0.43 * y[1] + 8.32 * y[2] + 0.0007;
        der(y[1]) = 1.71 * y[0] - 8.75 * y[1];
        der(y[2]) = -10.03 * y[2] + 0.43 * y[3] + 0.035 * y[4];
        der(y[3]) = 8.32 * y[1] + 1.71 * y[2] - 1.12 * y[3];
        der(y[4]) = -1.745 * y[4] + 0.43 * y[5] + 0.43 * y[6];
        der(y[5]) = -280 * y[5] * y[7] + 0.69 * y[3] + 1.71 * y[4] - 0.43 * y[5] + 0.69 * y[6];
        der(y[6]) = 280 * y[5] * y[7] - 1.81 * y[6];
        der(y[7]) = -280 * y[5] * y[7] + 1.81 * y[6];
    }
}

pws! {
    /// Van der Pol's oscillator in the time of its slow motion, ε = 10⁻⁶: μ² = 1/ε = 10⁶ (the same,
    /// eq. IV.10.2).
    pub system VanDerPol {
        state x, y;
        der(x) = y;
        der(y) = ((1 - x^2) * y - x) / 1e-6;
    }
}

pws! {
    /// A block on a belt, held by a spring through a stiff actuator and pushed by a force that
    /// grows with its speed; it sticks and slips.
    pub system Stick {
        state x, v, z;
        param speed = 0.2, force = 0.4;
        der(x) = v;
        der(v) = 0.3 * v - z - force * (if v > speed sliding { 1 } else { -1 });
        der(z) = (x - z) / 1e-5;
    }
}
