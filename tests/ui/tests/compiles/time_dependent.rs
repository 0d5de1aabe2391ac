//! Conserved quantities that depend on the time, as many as states.

use dmm_runtime::{System, pws};

pws! {
    system Damped {
        state x, v;
        param m = 1, c = 0.1, k = 2;
        der(x) = v;
        der(v) = -(c*v + k*x)/m;
        conserved h = exp(c*t/m) * (m*v^2 + c*x*v + k*x^2)/2;
    }
}

pws! {
    system Decay {
        state x;
        der(x) = -x;
        conserved initial = x * exp(t);
    }
}

#[test]
fn compiles() {
    assert_eq!(Damped::default().metadata().parameters, ["m", "c", "k"]);
    assert_eq!(Decay::default().metadata().states, ["x"]);
}
