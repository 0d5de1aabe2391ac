//! Systems of several tests.

use dmm_runtime::pws;

pws! {
    /// Affine on both sides.
    pub system Springs {
        state x, y;
        interface spring = y;
        region above where spring > 0 {
            der(x) = y; der(y) = -x;
            conserved energy = (y^2 + x^2)/2;
        }
        region below where spring < 0 {
            der(x) = y; der(y) = -3*x;
            conserved energy = (y^2 + 3*x^2)/2;
        }
    }
}

pws! {
    /// A ball between four walls without friction.
    pub system Walls {
        state x, y, u, v;
        discrete hits = 0;
        interface left = x;
        interface right = x - 1;
        interface low = y;
        interface high = y - 1;
        der(x) = u;
        der(y) = v;
        der(u) = 0;
        der(v) = 0;
        conserved energy = (u^2 + v^2) / 2;
        on left falling { u = -u; }
        on right rising { u = -u; }
        on low falling { v = -v; }
        on high rising { v = -v; }
    }
}

pws! {
    /// A bead that is pressed onto a moving ellipse and driven along it.
    pub system Bead {
        state x, y;
        interface ring = (x - 0.1*sin(t))^2 + 2*y^2 - 1, sliding;
        region outside where ring > 0 { der(x) = -x - 2*y; der(y) = x - y; }
        region inside where ring < 0 { der(x) = x - 2*y; der(y) = x + y; }
    }
}
