//! Canonical pairs, and `assume`.

use dmm_runtime::pws;

pws! {
    system NoPairs {
        state q, p;
        hamiltonian H = p^2/2 + q^2/2;
    }
}

pws! {
    system OddPair {
        state q, p, s;
        hamiltonian H = p^2/2 + q^2/2 + s in (q, p, s);
    }
}

pws! {
    system Lengths {
        state q[3], p[2];
        hamiltonian H = p[0]^2 + p[1]^2 + q[0]^2 in (q, p);
    }
}

pws! {
    system Twice {
        state q, p, r;
        hamiltonian H = p^2/2 + q^2/2 + r^2/2 in (q, p), (r, p);
    }
}

pws! {
    system Both {
        state q, p;
        hamiltonian H = p^2/2 + q^2/2 in (q, p);
        der(p) = -q;
    }
}

pws! {
    system Parameter {
        state q;
        param m = 1;
        hamiltonian H = m^2/2 + q^2/2 in (q, m);
    }
}

pws! {
    system Assume {
        state x;
        der(x) = 0;
        assume energy = x;
    }
}

fn main() {}
