//! A Hamiltonian in canonical pairs, and what regions share: a chain whose last mass has a
//! stiffer spring beyond a wall, integrated through transitions.
#![deny(missing_docs, warnings)]

use dmm_runtime::{Integrator, Symmetric, System, pws};

pws! {
    /// Fermi–Pasta–Ulam–Tsingou chain with a stiff end.
    pub system Chain {
        const n = 4;
        state q[n], p[n];
        param alpha = 0.25, stiff = 4;
        interface wall = q[n - 1];
        fn V(r) = r^2/2 + alpha*r^3/3;
        let inner = sum(i in 0..n, p[i]^2)/2 + V(q[0]) + sum(i in 0..n - 1, V(q[i + 1] - q[i]));
        region free where wall < 0 {
            hamiltonian H = inner in (q, p);
        }
        region pressed where wall > 0 {
            hamiltonian H = inner + stiff*q[n - 1]^2/2 in (q, p);
        }
    }
}

pws! {
    /// What both regions share stands outside of them.
    pub system Charged {
        state x, y, vx, vy, z;
        param b_left = 1, b_right = 2;
        interface screen = x;
        der(x) = vx;
        der(y) = vy;
        der(z) = 0;
        conserved energy = (vx^2 + vy^2)/2;
        conserved height = z;
        region left where screen < 0 {
            der(vx) = b_left*vy;
            der(vy) = -b_left*vx;
            conserved across = vx - b_left*y;
        }
        region right where screen > 0 {
            der(vx) = b_right*vy;
            der(vy) = -b_right*vx;
            conserved across = vx - b_right*y;
        }
    }
}

pws! {
    /// With an explicit time, only the field is derived. The argument of V is not the state.
    pub system Driven {
        state q, p;
        fn V(q) = -cos(q);
        hamiltonian H = p^2/2 + V(q) - q*sin(t)/10 in (q, p);
    }
}

#[test]
fn compiles() {
    let chain = Chain::default();
    for region in chain.metadata().regions {
        assert_eq!(region.conserved, ["H"]);
    }
    let start = [0.1, 0.2, -0.1, -0.3, 0.4, 0.1, -0.2, 0.6];
    let energy = |x: &[f64; 8]| {
        let v = |r: f64| r * r / 2.0 + chain.alpha * r.powi(3) / 3.0;
        let kinetic: f64 = x[4..].iter().map(|p| p * p / 2.0).sum();
        let inner: f64 = x[..4].windows(2).map(|pair| v(pair[1] - pair[0])).sum();
        kinetic + v(x[0]) + inner + chain.stiff * x[3].max(0.0).powi(2) / 2.0
    };
    let solution = Integrator::new(&chain, Symmetric::step_size(0.01))
        .initial(0.0, start)
        .run_until(30.0)
        .unwrap();
    assert!(solution.transitions().len() > 4);
    let end = solution.last().unwrap();
    // the level is kept to a few units in the last place, and passed on at each transition
    assert!((energy(&end.x.into()) - energy(&start)).abs() < 1e-13);

    assert_eq!(
        Charged::default().of_region(ChargedRegion::Left).conserved,
        ["energy", "height", "across"]
    );
    let charged = Charged::default();
    let solution = Integrator::new(&charged, Symmetric::step_size(0.01))
        .initial(0.0, [-0.5, 0.0, 1.0, 0.2, 3.0])
        .run_until(10.0)
        .unwrap();
    let end = solution.last().unwrap();
    let speed = end.x[2].powi(2) + end.x[3].powi(2);
    assert!((speed - 1.04).abs() < 1e-14);
    assert_eq!(end.x[4], 3.0);

    assert_eq!(
        Driven::default()
            .of_region(DrivenRegion::Everywhere)
            .conserved,
        [""; 0]
    );
    let solution = Integrator::new(&Driven::default(), Symmetric::step_size(0.01))
        .initial(0.0, [0.5, 0.0])
        .run_until(1.0)
        .unwrap();
    assert!(solution.last().unwrap().x[1] < 0.0);
}
