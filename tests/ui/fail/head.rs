//! What stands in front of a system's block.

use dmm_runtime::pws;

pws! {}

pws! {
    pub Harmonic { state x; der(x) = 1; }
}

pws! {
    system struct { state x; der(x) = 1; }
}

pws! {
    system f64 { state x; der(x) = 1; }
}

pws! {
    system NoBlock;
}

pws! {
    system First { state x; der(x) = 1; }
    system Second { state x; der(x) = 1; }
}

pws! {
    #[derive(Debug)]
    system Attribute { state x; der(x) = 1; }
}

pws! {
    #![allow(dead_code)]
    system InnerAttribute { state x; der(x) = 1; }
}

pws! {
    pub(in 3) system Visibility { state x; der(x) = 1; }
}

fn main() {}
