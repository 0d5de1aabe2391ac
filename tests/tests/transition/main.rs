//! The rules of transitions, each on a system whose solution is known in closed form.

mod crossings;
mod ends;
mod faulty;
mod points;
mod starts;
mod taylor;

use dmm_runtime::{InitialValueProblem, Integrator, Symmetric, System, Uniform, pws};

pws! {
    /// Constant acceleration on both sides of x = 0: the symmetric scheme is exact for it.
    system Parabola {
        state x, v;
        param a = 1;
        interface floor = x;
        region above where floor > 0 {
            der(x) = v;
            der(v) = a;
            conserved energy = v^2 / 2 - a * x;
        }
        region below where floor < 0 {
            der(x) = v;
            der(v) = a;
            conserved energy = v^2 / 2 - a * x;
        }
    }
}

pws! {
    /// Constant velocities on both sides of x = 0.
    system Drift {
        state x;
        param up = -1, down = -2;
        interface wall = x;
        region above where wall > 0 { der(x) = up; }
        region below where wall < 0 { der(x) = down; }
    }
}

pws! {
    /// A straight line through a moving interface.
    system Moving {
        state x;
        interface front = x - 2 * t + 1;
        region ahead where front > 0 { der(x) = 1; }
        region behind where front < 0 { der(x) = 1 / 2; }
    }
}

pws! {
    /// x² = 1 − t: the solution ends at t = 1.
    system Vanishing {
        state x;
        der(x) = -1 / (2 * x);
    }
}

pws! {
    /// A circle, turning the other way below y = 0.
    system Turning {
        state x, y;
        interface axis = y;
        region above where axis > 0 {
            der(x) = -y;
            der(y) = x;
            conserved radius = x^2 + y^2;
        }
        region below where axis < 0 {
            der(x) = -2 * y;
            der(y) = 2 * x;
            conserved radius = x^2 + y^2;
        }
    }
}

pws! {
    /// Grows until it overflows.
    system Growing {
        state x;
        der(x) = 50 * x;
    }
}

/// The problem from `x` at t = 0, in steps of `step_size`.
fn start<Sys: System<N>, const N: usize>(
    system: &Sys,
    step_size: f64,
    x: [f64; N],
) -> InitialValueProblem<'_, Sys, Uniform<Symmetric>, N> {
    Integrator::new(system, Symmetric::step_size(step_size)).initial(0.0, x)
}
