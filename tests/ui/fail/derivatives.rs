//! Every state has one derivative in every region.

use dmm_runtime::pws;

pws! {
    system Missing {
        state x, y, z;
        der(x) = y;
    }
}

pws! {
    system GivenTwice {
        state x;
        der(x) = 1;
        der(x) = 2;
    }
}

pws! {
    system NotAState {
        state position;
        param k = 1;
        der(positon) = k;
        der(k) = 1;
        der(z) = 1;
        der(t) = 1;
    }
}

pws! {
    system MissingInRegion {
        state x, y;
        interface wall = x;
        region right where wall > 0 { der(x) = y; }
        region left where wall < 0 { der(x) = y; der(y) = 1; der(y) = 2; }
    }
}

pws! {
    system NoState {
        param _k = 1;
    }
}

fn main() {}
