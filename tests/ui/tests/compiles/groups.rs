//! Groups of states and parameters, `sum`, `for` and `fn`: a chain of three masses with a wall,
//! integrated.
#![deny(missing_docs, warnings)]

use dmm_runtime::{Integrator, Symmetric, System, pws};

pws! {
    /// Masses between walls, with springs that harden.
    pub system Chain {
        const n = 3;
        state
            /// Displacements.
            q[n],
            /// Momenta.
            p[n];
        /// Masses.
        param m[n] = [1, 2, 1];
        param k[n + 1] = 1, beta = 0.5;
        /// A spring's energy.
        fn V(stretch, stiffness) = stiffness*stretch^2/2 + beta*stretch^4/4;
        fn force(stretch, stiffness) = stiffness*stretch + beta*stretch^3;
        let at_left = force(q[0], k[0]);
        let at_right = force(-q[n - 1], k[n]);
        for i in 0..n {
            der(q[i]) = p[i]/m[i];
        }
        der(p[0]) = force(q[1] - q[0], k[1]) - at_left;
        for i in 1..n - 1 {
            der(p[i]) = force(q[i + 1] - q[i], k[i + 1]) - force(q[i] - q[i - 1], k[i]);
        }
        der(p[n - 1]) = at_right - force(q[n - 1] - q[n - 2], k[n - 1]);
        conserved energy = sum(i in 0..n, p[i]^2/(2*m[i]))
            + V(q[0], k[0]) + sum(i in 1..n, V(q[i] - q[i - 1], k[i])) + V(q[n - 1], k[n]);
    }
}

#[test]
fn compiles() {
    let chain = Chain {
        m: [1.0, 3.0, 1.0],
        ..Default::default()
    };
    assert_eq!(Chain::default().m, [1.0, 2.0, 1.0]);
    assert_eq!(chain.k, [1.0; 4]);
    assert_eq!(
        chain.metadata().states,
        ["q[0]", "q[1]", "q[2]", "p[0]", "p[1]", "p[2]"]
    );
    assert_eq!(
        chain.metadata().parameters,
        [
            "m[0]", "m[1]", "m[2]", "k[0]", "k[1]", "k[2]", "k[3]", "beta"
        ]
    );
    assert_eq!(chain.parameters(), [1.0, 3.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.5]);
    let mut other = chain;
    *other.parameter_mut(1).unwrap() = 2.0;
    assert_eq!(other, Chain::default());

    let energy = |x: &[f64; 6]| {
        let [a, b, c, ..] = *x;
        let spring = |s: f64| s * s / 2.0 + 0.5 * s.powi(4) / 4.0;
        let kinetic: f64 = (0..3)
            .map(|i| x[3 + i] * x[3 + i] / (2.0 * chain.m[i]))
            .sum();
        kinetic + spring(a) + spring(b - a) + spring(c - b) + spring(c)
    };
    let start = [0.3, -0.2, 0.5, 0.1, 0.0, -0.4];
    let solution = Integrator::new(&chain, Symmetric::step_size(0.01))
        .initial(0.0, start)
        .run_until(20.0)
        .unwrap();
    let end = solution.last().unwrap();
    // six states of order one, the level is kept to a few units in the last place
    assert!((energy(&end.x.into()) - energy(&start)).abs() < 1e-15 * 20.0);
    assert!((end.x[0] - start[0]).abs() > 1e-3);
}
