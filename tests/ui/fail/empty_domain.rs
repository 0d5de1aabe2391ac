//! A conserved quantity has a value somewhere in its region.

use dmm_runtime::pws;

pws! {
    system Logarithms {
        state x, y;
        der(x) = x;
        der(y) = y;
        conserved ratio = ln(x) - ln(-y) + ln(-x) - ln(y);
    }
}

pws! {
    system Wall {
        state x, v;
        interface wall = x - 1;
        der(x) = v;
        region right where wall > 0 {
            der(v) = 1 / x;
            conserved energy = v^2 / 2 - ln(-x);
        }
        region left where wall < 0 {
            der(v) = -1;
            conserved energy = v^2 / 2 + x;
        }
    }
}

fn main() {}
