//! An interface is crossed by something.

use dmm_runtime::pws;

pws! {
    system NoState {
        state x;
        param k = 1;
        interface wall = k - 2;
        region right where wall > 0 { der(x) = 1; }
        region left where wall < 0 { der(x) = 1; }
    }
}

pws! {
    system Constant {
        state x;
        interface wall = sin(x)^2 + cos(x)^2 - 1/2;
        region right where wall > 0 { der(x) = 1; }
        region left where wall < 0 { der(x) = 2; }
    }
}

pws! {
    system NeverCrossed {
        state x, y;
        interface circle = x^2 + y^2 - 1;
        region outside where circle > 0 { der(x) = y; der(y) = -x; }
        region inside where circle < 0 { der(x) = -y; der(y) = x; }
    }
}

fn main() {}
