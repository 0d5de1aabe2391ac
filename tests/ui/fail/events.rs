//! What is wrong with events and branches.

use dmm_runtime::pws;

pws! {
    system Directions {
        state y, v;
        interface floor = y;
        der(y) = v;
        der(v) = -1;
        on floor down { v = -v; }
    }
}

pws! {
    system Targets {
        state y, v;
        param e = 1;
        interface floor = y;
        der(y) = v;
        der(v) = -e;
        on floor falling { e = 2; }
    }
}

pws! {
    system Twice {
        state y, v;
        interface floor = y;
        der(y) = v;
        der(v) = -1;
        on floor falling { v = -v; v = 0; }
    }
}

pws! {
    system Times {
        state y;
        der(y) = 1;
        every y { y = 0; }
    }
}

pws! {
    system Claims {
        state y, v;
        interface floor = y;
        der(y) = v;
        der(v) = -1;
        conserved energy = v^2/2 + y;
        on floor falling { v = -v/2; conserves energy; }
    }
}

pws! {
    system Branches {
        state x;
        der(x) = if x > 0 { floor(x) } else { 0 };
    }
}

fn main() {}
