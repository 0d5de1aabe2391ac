//! The declarations that the tests are about.

/// Hirani, Wan & Wojtalewicz §4.1: the oscillator with a stiffness that jumps at y = 0.
pub(crate) const HARMONIC: &str = "
    pub system Harmonic {
        state x, y;
        param k_above = 1, k_below = 3;
        interface spring = y;
        region above where spring > 0 {
            der(x) = y;
            der(y) = -k_above * x;
            conserved energy = (y^2 + k_above * x^2) / 2;
        }
        region below where spring < 0 {
            der(x) = y;
            der(y) = -k_below * x;
            conserved energy = (y^2 + k_below * x^2) / 2;
        }
    }";

/// Hirani, Wan & Wojtalewicz §4.2: elliptic curves with a coefficient that jumps on the unit circle.
pub(crate) const ELLIPTIC: &str = "
    pub system Elliptic {
        state x, y;
        param a_outside = -2, a_inside = -3;
        interface circle = x^2 + y^2 - 1;
        region outside where circle > 0 {
            der(x) = 2 * y;
            der(y) = 3 * x^2 + a_outside;
            conserved curve = y^2 - x^3 - a_outside * x;
        }
        region inside where circle < 0 {
            der(x) = 2 * y;
            der(y) = 3 * x^2 + a_inside;
            conserved curve = y^2 - x^3 - a_inside * x;
        }
    }";

/// The mathematical pendulum.
pub(crate) const PENDULUM: &str = "
    pub system Pendulum {
        state theta, omega;
        param g = 9.81, length = 1;
        der(theta) = omega;
        der(omega) = -g / length * sin(theta);
        conserved energy = omega^2 / 2 - g / length * cos(theta);
    }";

/// Predators and prey.
pub(crate) const LOTKA_VOLTERRA: &str = "
    pub system LotkaVolterra {
        state x, y;
        param alpha = 1, beta = 1, gamma = 1, delta = 1;
        der(x) = x * (alpha - beta * y);
        der(y) = y * (delta * x - gamma);
        conserved level = delta * x - gamma * ln(x) + beta * y - alpha * ln(y);
    }";

/// Hirani, Wan & Wojtalewicz §1.3: the damped oscillator, whose conserved quantity depends on the time.
pub(crate) const DAMPED: &str = "
    pub system Damped {
        state x, v;
        param m = 1, gamma = 0.2, k = 1;
        der(x) = v;
        der(v) = -gamma / m * v - k / m * x;
        conserved psi = (m * v^2 + gamma * x * v + k * x^2) / 2 * exp(gamma * t / m);
    }";

/// Euler's equations of a free rigid body: two conserved quantities, three states.
pub(crate) const RIGID_BODY: &str = "
    pub system RigidBody {
        state x, y, z;
        param I1 = 1, I2 = 2, I3 = 3;
        der(x) = (1/I3 - 1/I2) * y * z;
        der(y) = (1/I1 - 1/I3) * z * x;
        der(z) = (1/I2 - 1/I1) * x * y;
        conserved momentum = x^2 + y^2 + z^2;
        conserved energy = x^2/I1 + y^2/I2 + z^2/I3;
    }";

/// Kepler's problem in the plane: energy, angular momentum, and a component of the Laplace
/// vector, which becomes dependent on them where its other component is zero.
pub(crate) const KEPLER: &str = "
    pub system Kepler {
        state x, y, vx, vy;
        param mu = 1;
        let r = sqrt(x^2 + y^2);
        der(x) = vx;
        der(y) = vy;
        der(vx) = -mu * x / r^3;
        der(vy) = -mu * y / r^3;
        conserved energy = (vx^2 + vy^2) / 2 - mu / r;
        conserved momentum = x * vy - y * vx;
        conserved laplace = vy * (x * vy - y * vx) - mu * x / r;
    }";

/// Names that emitted code uses itself, keywords of Rust, and names that differ in case only.
pub(crate) const HOSTILE: &str = "
    pub system S {
        state x0, x1, u1, E, e, matched, projection, multipliers;
        param lambda1 = 1, boundary = 2, c1 = 3, half_k = 4, f64_ = 5, mean = -1.5;
        der(x0) = x1 * lambda1;
        der(x1) = -x0 * lambda1;
        der(u1) = mean * boundary;
        der(E) = c1 * half_k;
        der(e) = f64_ * u1 * u1;
        der(matched) = (E + x0) * (E + x0) / 2;
        der(projection) = multipliers;
        der(multipliers) = -projection;
        conserved circle = x0^2 + x1^2;
        conserved projection_ = projection^2 + multipliers^2;
    }";
