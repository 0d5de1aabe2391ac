//! Two systems in one module, one of them private, with names that emitted code uses as well.

use dmm_runtime::{System, pws};

pws! {
    pub(crate) system First {
        state x0, x1, tau;
        param u1 = 1, self_ = 2, S = 3, M = 4;
        der(x0) = u1 * x1 * S;
        der(x1) = -u1 * x0 * S;
        der(tau) = self_ * M;
        conserved size = x0^2 + x1^2;
    }
}

pws! {
    system Second {
        state x;
        der(x) = 1;
        conserved start = x - t;
    }
}

#[test]
fn compiles() {
    assert_eq!(First::default().metadata().name, "First");
    assert_eq!(Second::default().metadata().name, "Second");
}
