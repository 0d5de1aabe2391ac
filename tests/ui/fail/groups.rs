//! Groups of states and parameters, and their elements.

use dmm_runtime::pws;

pws! {
    system Declared {
        state q[3][3];
        state p[0..3];
        let a[3] = 1;
        param m[2] = {1, 2};
        state position;
        der(position) = m[0];
    }
}

pws! {
    system Elements {
        state q[3];
        let a = q(0);
        let b = q[0, 1];
        let c = q[0..2];
        der(q[0]) = a + b + c;
    }
}

pws! {
    system Indices {
        const n = 3;
        state q[n], x;
        for i in 0..n {
            der(q[i]) = q[i + 1];
        }
        der(x) = q + x[0] + q[1/2];
    }
}

pws! {
    system Lengths {
        state q[5/2], p[0], x;
        param k[3] = [1, 2], m = 2, l[m] = 1;
        for i in 0..2 {
            der(q[i]) = k[i] * l[0];
        }
        der(x) = p[0];
    }
}

fn main() {}
