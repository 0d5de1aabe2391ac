//! What is declared is used.

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

fn main() {}
