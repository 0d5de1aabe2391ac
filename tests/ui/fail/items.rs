//! Items that are written wrongly, each reported once.

use dmm_runtime::pws;

pws! {
    system Items {
        state x
        state y = 1;
        state z: f64;
        state v w;
        param k;
        param m: f64 = 1;
        let type = 1;
        state _;
        state r#in;
        state region;
        sate s;
        parameter p = 1;
        invariant h = 1;
        q = 1;
        dx/dt = y;
        fn f() {}
        #[allow(dead_code)]
        state u;
        #![doc = "inner"]
    }
}

pws! {
    system Derivatives {
        state x;
        der x = 1;
        der(x) == 1;
        der(x, y) = 1;
        der() = 1;
        der(x) 1;
        der(x) = 1
        der(y) = 2;
        conserved = x;
        # comment
        conserved x^2;
        conserved a = x, b = y;
        interface wall = x, floor = y;
        region a { state x; }
        region b;
    }
}

fn main() {}
