//! Solutions that come to rest.

use dmm_runtime::{Composed, Method, Symmetric, Taylor, pws};
use dmm_tests::run;

pws! {
    /// A sink.
    pub system Sink {
        state x, y;
        param a = -1, b = 3, c = -3, d = -0.5;
        der(x) = a*x + b*y;
        der(y) = c*x + d*y;
    }
}

fn sinks(scheme: impl Method) {
    let mut number = 0.3;
    let mut random = || {
        number = (number * 9301.0 + 0.618) % 1.0;
        2.0 * number - 1.0
    };
    let mut count = 0;
    while count < 300 {
        let [a, b, c, d] = [0; 4].map(|_| 3.0 * random());
        // a sink: negative trace, positive determinant
        if a + d > -0.1 || a * d - b * c < 0.1 {
            continue;
        }
        count += 1;
        let system = Sink { a, b, c, d };
        let found = run(&system, scheme.clone(), [random(), random()], 200.0).unwrap();
        assert!(found.point.x.norm() < 1e-3, "{system:?} {:?}", found.point);
    }
}

#[test]
fn sinks_come_to_rest() {
    sinks(Symmetric::tolerance(1e-6));
    sinks(Composed::<4>::tolerance(1e-6));
    sinks(Composed::<6>::tolerance(1e-9));
    sinks(Composed::<8>::tolerance(1e-12));
    sinks(Taylor::tolerance(1e-9));
}
