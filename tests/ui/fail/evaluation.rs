//! Formulas that cannot be evaluated, whatever the state is.

use dmm_runtime::pws;

pws! {
    system Evaluation {
        state x;
        let a = x / 0;
        let b = 1 / (0.1 + 0.2 - 0.3);
        let c = 1 / (sin(x)^2 + cos(x)^2 - 1);
        let d = x + ln(-1);
        let e = sqrt(1 - 2);
        let f = asin(2);
        let g = exp(1000);
        let h = 10^400;
        let i = 1e300 * x * 1e300;
        let j = 0^-1;
        let k = (-8)^(1/3);
        let l = (-2)^x;
        let m = x^1000;
        der(x) = a + b + c + d + e + f + g + h + i + j + k + l + m;
    }
}

fn main() {}
