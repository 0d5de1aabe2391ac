//! Constants and defaults are constant.

use dmm_runtime::pws;

pws! {
    system Constants {
        state x;
        let a = x;
        const b = x;
        const c = t;
        param k = x;
        param m = k;
        param n = a;
        der(x) = a + b + c + k + m + n;
    }
}

fn main() {}
