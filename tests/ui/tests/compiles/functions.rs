//! Every function, `pi`, and integer, rational and real powers; nothing is conserved.

use dmm_runtime::{System, pws};

pws! {
    system Functions {
        state x, y, z;
        der(x) = sqrt(x) + exp(y) + ln(x) + sin(x) + cos(y) + tan(z);
        der(y) = sinh(x) + cosh(y) + tanh(z) + asin(x/10) + acos(y/10) + atan(z);
        der(z) = x^2 + x^-3 + x^(1/3) + x^0.37 + 2^y + x^y + pi*t - 1e-3;
    }
}

#[test]
fn compiles() {
    assert_eq!(
        Functions::default()
            .of_region(FunctionsRegion::Everywhere)
            .conserved,
        [""; 0]
    );
}
