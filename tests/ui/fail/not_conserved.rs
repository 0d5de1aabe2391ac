//! A quantity that is declared to be conserved has to be.

use dmm_runtime::pws;

pws! {
    system Harmonic {
        state x, y;
        param k_above = 1, k_below = 3;
        interface spring = y;
        region above where spring > 0 {
            der(x) = y;
            der(y) = -k_above * x;
            conserved energy = (y^2 + x^2) / 2;
        }
        region below where spring < 0 {
            der(x) = y;
            der(y) = -k_below * x;
            conserved energy = (y^2 + k_below * x^2) / 2;
        }
    }
}

pws! {
    system Drift {
        state x;
        der(x) = 1;
        conserved offset = x - 2*t;
    }
}

pws! {
    system Constant {
        state x;
        der(x) = x;
        conserved one = sin(x)^2 + cos(x)^2;
    }
}

fn main() {}
