//! Sliding that cannot be.

use dmm_runtime::pws;

pws! {
    pub system NoBlock {
        state x, v;
        interface belt = v - 1, sliding;
        sliding belt;
        region fast where belt > 0 { der(x) = v; der(v) = -1; }
        region slow where belt < 0 { der(x) = v; der(v) = 1; }
    }
}

pws! {
    pub system NothingChanges {
        state x, v;
        interface belt = v - 1, sliding;
        region fast where belt > 0 { der(x) = v; der(v) = -x; }
        region slow where belt < 0 { der(x) = v - 1; der(v) = -x; }
    }
}

pws! {
    pub system NotDeclared {
        state x, v;
        interface belt = v - 1;
        region fast where belt > 0 { der(x) = v; der(v) = -1; }
        region slow where belt < 0 { der(x) = v; der(v) = 1; }
        sliding belt { conserved speed = v; }
    }
}

pws! {
    pub system WithinOneAnother {
        state x, y;
        der(x) = if x > 0 sliding { if y > 0 sliding { -1 } else { -2 } } else { 1 };
        der(y) = if y > 0 sliding { -1 } else { 1 };
    }
}

fn main() {}
