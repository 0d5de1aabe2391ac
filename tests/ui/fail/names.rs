//! Names are declared once, in front of their use, and are not reserved.

use dmm_runtime::pws;

pws! {
    system Twice {
        state x, x;
        der(x) = 1;
    }
}

pws! {
    system AlreadyState {
        state x;
        param x = 1;
        der(x) = x;
    }
}

pws! {
    system Time {
        state x, t;
        der(x) = t;
    }
}

pws! {
    system Pi {
        state x;
        param pi = 3;
        der(x) = pi;
    }
}

pws! {
    system Function {
        state x;
        let sin = 3;
        der(x) = sin;
    }
}

pws! {
    system TwiceConserved {
        state x;
        der(x) = 1;
        conserved a = t - x;
        conserved a = x - t;
    }
}

pws! {
    system Order {
        state x;
        let a = b;
        let b = x;
        der(x) = a + b;
    }
}

pws! {
    system Itself {
        state x;
        let a = a + x;
        der(x) = a;
    }
}

pws! {
    system Undeclared {
        state velocity;
        param k_above = 1;
        der(velocity) = velocty * k_abov + mystery;
    }
}

pws! {
    system Special {
        state x;
        let a = time;
        let b = 2*PI;
        let c = e^x;
        let d = sin + 1;
        der(x) = a + b + c + d;
    }
}

pws! {
    system Meaning {
        state x;
        interface wall = x;
        region right where wall > 0 {
            let stretch = 2;
            der(x) = stretch + wall;
        }
        region left where wall < 0 {
            der(x) = stretch + energy;
            conserved energy = x;
        }
    }
}

pws! {
    system LocalTwice {
        state x;
        let r = x;
        interface wall = r;
        region right where wall > 0 {
            let r = 2;
            der(x) = r;
        }
        region left where wall < 0 {
            der(x) = 1;
        }
    }
}

fn main() {}
