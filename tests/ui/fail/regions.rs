//! One interface has two sides, and each of them is a region.

use dmm_runtime::pws;

pws! {
    system OneSide {
        state x;
        interface wall = x;
        region right where wall > 0 { der(x) = 1; }
    }
}

pws! {
    system Overlap {
        state x;
        interface wall = x;
        region right where wall > 0 { der(x) = 1; }
        region left where wall > 0 { der(x) = 1; }
    }
}

pws! {
    system SameName {
        state x;
        interface wall = x;
        region side where wall > 0 { der(x) = 1; }
        region side where wall < 0 { der(x) = 1; }
    }
}

pws! {
    system SameVariant {
        state x;
        interface wall = x;
        region low_x where wall < 0 { der(x) = 1; }
        region lowX where wall > 0 { der(x) = 1; }
    }
}

pws! {
    system NoCondition {
        state x;
        interface wall = x;
        region right { der(x) = 1; }
        region left where wall < 0 { der(x) = 1; }
    }
}

pws! {
    system Misspelt {
        state x;
        interface wall = x;
        region right where wal > 0 { der(x) = 1; }
        region left where wall < 0 { der(x) = 1; }
    }
}

pws! {
    system State {
        state x;
        interface wall = x;
        region right where x > 0 { der(x) = 1; }
        region left where wall < 0 { der(x) = 1; }
    }
}

pws! {
    system TwiceInPattern {
        state x;
        interface wall = x;
        region right where wall > 0 and wall > 0 { der(x) = 1; }
        region left where wall < 0 { der(x) = 1; }
    }
}

pws! {
    system Outside {
        state x;
        interface wall = x;
        der(x) = 2;
        conserved e = x;
        region right where wall > 0 { der(x) = 1; }
        region left where wall < 0 { der(x) = 1; }
    }
}

pws! {
    system NoInterface {
        state x;
        region everything { der(x) = 1; }
    }
}

pws! {
    system Undeclared {
        state x;
        region right where wall > 0 { der(x) = 1; }
    }
}

fn main() {}
