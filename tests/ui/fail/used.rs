//! A program that uses wrong systems has no other errors than those of their declarations.

use dmm_runtime::{Integrator, Symmetric, System, pws};

pws! {
    system Ring {
        const n = 3;
        state q[n], p[n];
        param m[n] = [1, 2, 4], k = 1.0f64;
        for i in 0..n {
            der(q[i]) = p[i] / m[i];
            der(p[i]) = k * (q[(i + 1) % n] - 2 * q[i] + q[(i + n - 1) % n]);
        }
        conserved momentum = sum(i in 0..=n, p[i]);
    }
}

pws! {
    system Chain {
        state q[n], x;
        param m[n] = 1;
        region one where g > 0 { der(x) = 2x; }
        region two;
    }
}

pws! {
    system Words {
        state sum, y
        param gamma: f64 = 1, type = 2;
        der(sum) = y;
        der(y) = -gamma * sum
    }
}

pws! {
    system sum {
        state x;
        interface wall = x;
        region left where wall < 0 { param k = 1; der(x) = k; }
        region right where wall > 0 { der(x) = 1; }
    }
}

fn main() {
    let ring = Ring { k: 2.0, m: [1.0, 2.0, 3.0], ..Default::default() };
    let solution = Integrator::new(&ring, Symmetric::step_size(0.1))
        .initial(0.0, [1.0; 6])
        .run_until(10.0);
    println!("{} {:?} {}", ring.m[2], ring.metadata().states, solution.is_ok());

    let mut chain = Chain::default();
    chain.m[3] = 2.0;
    let solution = Integrator::new(&chain, Symmetric::step_size(0.1))
        .initial(0.0, [1.0, 2.0, 3.0])
        .run_until(10.0);
    println!("{:?} {:?} {}", ChainRegion::One, ChainRegion::Two, solution.is_ok());

    let words = Words { gamma: 2.0, ..Words::default() };
    let solution = Integrator::new(&words, Symmetric::step_size(0.1))
        .initial(0.0, [1.0, 2.0])
        .run_until(10.0);
    println!("{:?} {}", WordsRegion::Everywhere, solution.is_ok());

    let sum = sum { k: 2.0 };
    let solution = Integrator::new(&sum, Symmetric::step_size(0.1))
        .initial(0.0, [1.0])
        .run_until(10.0);
    println!("{:?} {}", sumRegion::Left, solution.is_ok());
}
