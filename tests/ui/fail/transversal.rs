//! An interface that no trajectory can cross.

use dmm_runtime::pws;

pws! {
    system Towards {
        state x;
        interface wall = x;
        region right where wall > 0 { der(x) = -1; }
        region left where wall < 0 { der(x) = 1; }
    }
}

pws! {
    system Away {
        state x;
        interface wall = x;
        region right where wall > 0 { der(x) = 1; }
        region left where wall < 0 { der(x) = -1; }
    }
}

fn main() {}
