//! Formulas that are written wrongly.

use dmm_runtime::pws;

pws! {
    system Formulas {
        state x;
        let a = x**2;
        let b = x.powi(2);
        let c = (x + 1).sqrt();
        let d = x.abs();
        let e = self.k;
        let f = x.foo();
        let g = 2 x;
        let h = x (x + 1);
        let i = sin x;
        let j = f64::consts::PI;
        let k = +x;
        let l = x + ;
        let m = ;
        let n = x % 2;
        let o = x > 0;
        let p = if x { 1 } else { 2 };
        let q = "x";
        let r = (x + );
        let s = x ~ 2;
        let u = sin^2(x);
        der(x) = a;
    }
}

fn main() {}
