//! A region is bounded by named interfaces that are compared with zero.

use dmm_runtime::pws;

pws! {
    system Conditions {
        state x, y;
        interface wall = x;
        region not_strict where wall >= 0 {}
        region level where wall > 1 {}
        region equal where wall == 0 {}
        region nothing where wall {}
        region reversed where 0 < wall {}
        region formula where x + y > 0 {}
        region alternative where wall > 0 or wall < 0 {}
        region no_separator where wall > 0 wall < 0 {}
        region empty where {}
        region no_where wall > 0 {}
    }
}

fn main() {}
