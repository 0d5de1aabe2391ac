//! The number of states is bounded.

use dmm_runtime::pws;

pws! {
    system Many {
        state q[1000];
        for i in 0..1000 {
            der(q[i]) = 1;
        }
    }
}

fn main() {}
