//! What could not be proved, and what `assume conserved` does not accept.

use dmm_runtime::pws;

pws! {
    system Undecided {
        state x, y;
        der(x) = y * ((9*2^(1/3) - 9)^(1/3) - 1 + 2^(1/3) - 4^(1/3));
        der(y) = 1;
        conserved a = x;
    }
}

pws! {
    system Unchecked {
        state x, y;
        der(x) = ln(-1 - x^2) - ln(-1 - x^2 - y^2);
        der(y) = 0;
        assume conserved a = x;
    }
}

pws! {
    system Rounding {
        state x, y;
        der(x) = (9*2^(1/3) - 9)^(1/3) - 1 + 2^(1/3) - 4^(1/3);
        der(y) = 1;
        assume conserved a = x;
    }
}

pws! {
    system NotSmall {
        state x, y;
        der(x) = sqrt(x - 4);
        der(y) = 0;
        assume conserved a = x;
    }
}

pws! {
    system Refuted {
        state x, y;
        der(x) = y;
        der(y) = -x;
        assume conserved a = x^2 - y^2;
    }
}

fn main() {}
