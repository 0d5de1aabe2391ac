//! What the language has room for, but this version does not support.

use dmm_runtime::pws;

pws! {
    system Sliding {
        state x;
        interface wall = x, sliding;
        region right where wall > 0 { der(x) = -1; }
        region left where wall < 0 { der(x) = 1; }
    }
}

fn main() {}
