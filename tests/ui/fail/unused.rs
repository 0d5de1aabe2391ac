//! What is declared is used: if not, that is a warning, which is shown as such a one is of what is
//! deprecated.

#![deny(deprecated)]

use dmm_runtime::pws;

pws! {
    system Unused {
        state x;
        param k = 1;
        const c = 1;
        let r = x;
        interface wall = x;
        region right where wall > 0 {
            let q = 1;
            der(x) = 1;
        }
        region left where wall < 0 {
            der(x) = 1;
        }
    }
}

pws! {
    system NoRegion {
        state x;
        interface wall = x;
        der(x) = 1;
    }
}

fn main() {}
