//! Loops, sums and functions.

use dmm_runtime::pws;

pws! {
    system Written {
        state q[3];
        for i = 0..3 { der(q[0]) = 1; }
        for i in 0..=2 { der(q[i]) = sum(q); }
        for i in q { der(q[0]) = 1; }
        conserved a = sum(q[i], i in 0..3);
        conserved b = summ(i in 0..3, q[i]);
        conserved c = product(i in 0..3, q[i]);
    }
}

pws! {
    system Bounds {
        state q[3];
        param n = 3;
        for i in 0..5/2 { der(q[i]) = 1; }
        for j in 3..1 { der(q[j]) = 1; }
        for k in 0..n { der(q[k]) = 1; }
    }
}

pws! {
    system Names {
        state q[3], i;
        for i in 0..3 { der(q[i]) = 1; }
        fn f(q, q) = q^2;
        der(i) = f(i, i);
    }
}

pws! {
    system Remainder {
        state q[3], x;
        for i in 0..3 { der(q[i]) = q[i % 0]; }
        der(x) = x % 2;
    }
}

pws! {
    system Arguments {
        state q[3], x;
        fn f(i) = q[i];
        for i in 0..3 { der(q[i]) = f(i); }
        der(x) = f(x);
    }
}

pws! {
    system TooLong {
        state x;
        der(x) = sum(i in 0..1000, sum(j in 0..1000, x^i * j));
    }
}

fn main() {}
