//! Conserved quantities are independent and leave something to move.

use dmm_runtime::pws;

pws! {
    system Dependent {
        state x, y, z;
        der(x) = y;
        der(y) = -x;
        der(z) = 0;
        conserved energy = x^2 + y^2;
        conserved square = (x^2 + y^2)^2;
    }
}

pws! {
    system TooMany {
        state x, y;
        der(x) = y;
        der(y) = -x;
        conserved a = x^2 + y^2;
        conserved b = exp(-x^2 - y^2);
        conserved c = ln(x^2 + y^2);
    }
}

pws! {
    system NothingMoves {
        state x, y;
        der(x) = 0;
        der(y) = 0;
        conserved a = x + y;
        conserved b = x - y;
    }
}

fn main() {}
