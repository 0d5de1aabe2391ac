//! Functions that the language does not have, or that are called wrongly.

use dmm_runtime::pws;

pws! {
    system Functions {
        state x;
        param k = 1;
        let a = log(x);
        let b = abs(x);
        let c = max(x, 0);
        let d = pow(x, 2);
        let e = sine(x);
        let f = gamma(x);
        let g = sin(x, x);
        let h = cos();
        let i = x(t);
        let j = k(x + 1);
        let l = der(x);
        let m = arcsin(x);
        der(x) = a + b + c + d + e + f + g + h + i + j + l + m;
    }
}

fn main() {}
