//! Numbers are exact, decimal and without a type.

use dmm_runtime::pws;

pws! {
    system Numbers {
        state x;
        let a = 1.0f32;
        let b = 2_u8;
        let c = 2x;
        let d = 0x1F;
        let e = 1e400;
        der(x) = a;
    }
}

fn main() {}
