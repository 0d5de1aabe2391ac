//! Parameters may have the names of constants, types and variants in scope.
use dmm_runtime::pws;

#[allow(dead_code)]
const G: f64 = 9.81;

pws! {
    /// Fall.
    pub system Fall {
        state x, v;
        param G = 1, None = 2;
        der(x) = v;
        der(v) = -G * None;
        conserved energy = v^2 / 2 + G * None * x;
    }
}

#[test]
fn compiles() {
    let fall = Fall {
        G,
        ..Default::default()
    };
    assert_eq!((fall.G, fall.None), (9.81, 2.0));
}
