//! What is not an initial state of a system.

use dmm_runtime::{Best, Integrator, Vector, pws};

pws! {
    pub system Springs {
        state x, y;
        der(x) = y;
        der(y) = -x;
    }
}

fn main() {
    let integrator = || Integrator::new(&Springs {}, Best::tolerance(1e-12));
    let _ = integrator().initial(0.0, [1.0, 2.0, 3.0]);
    let _ = integrator().initial(0.0, (1.0, 2.0));
    let _ = integrator().initial(0.0, ["1", "2"]);
    let _ = integrator().initial(0.0, Vector::<f64, 3>::zeros());
}
