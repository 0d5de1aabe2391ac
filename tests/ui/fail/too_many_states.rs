//! There is a limit to the number of states.

use dmm_runtime::pws;

pws! {
    system Many {
        state x0, x1, x2, x3, x4, x5, x6, x7, x8, x9, x10, x11, x12, x13, x14, x15, x16, x17, x18, x19, x20, x21, x22, x23, x24, x25, x26, x27, x28, x29, x30, x31, x32;
        der(x0) = 1;
        der(x1) = 1;
        der(x2) = 1;
        der(x3) = 1;
        der(x4) = 1;
        der(x5) = 1;
        der(x6) = 1;
        der(x7) = 1;
        der(x8) = 1;
        der(x9) = 1;
        der(x10) = 1;
        der(x11) = 1;
        der(x12) = 1;
        der(x13) = 1;
        der(x14) = 1;
        der(x15) = 1;
        der(x16) = 1;
        der(x17) = 1;
        der(x18) = 1;
        der(x19) = 1;
        der(x20) = 1;
        der(x21) = 1;
        der(x22) = 1;
        der(x23) = 1;
        der(x24) = 1;
        der(x25) = 1;
        der(x26) = 1;
        der(x27) = 1;
        der(x28) = 1;
        der(x29) = 1;
        der(x30) = 1;
        der(x31) = 1;
        der(x32) = 1;
    }
}

fn main() {}
