//! Regions with an exact flow beside others, in one run.

use dmm_runtime::{Best, Integrator, System, Taylor, pws};

pws! {
    /// A pendulum that hangs from a spring on one side.
    system Mixed {
        state q, p;
        param k = 2;
        interface middle = q - 0.1;
        region swings where middle < 0 {
            der(q) = p;
            der(p) = -sin(q);
            conserved energy = p^2 / 2 - cos(q);
        }
        region bounces where middle > 0 {
            der(q) = p;
            der(p) = -k * q;
            conserved energy = (p^2 + k * q^2) / 2;
        }
    }
}

#[test]
fn each_region_has_its_own_scheme() {
    let system = Mixed::default();
    let best = Integrator::new(&system, Best::tolerance(1e-15)).initial(0.0, [-0.7, 0.9]);
    let series = Integrator::new(&system, Taylor::tolerance(1e-15)).initial(0.0, [-0.7, 0.9]);
    let (best, series) = (
        best.run_until(200.0).unwrap(),
        series.run_until(200.0).unwrap(),
    );
    assert!(best.transitions().len() > 50);
    assert_eq!(best.transitions().len(), series.transitions().len());
    for (best, series) in best.transitions().iter().zip(series.transitions()) {
        assert!((best.t - series.t).abs() < 1e-12);
        assert!((best.x - series.x).norm() < 1e-12);
    }
    for point in best.points() {
        let psi = system.conserved(point.region, point.t, &point.x)[0];
        let near = best
            .transitions()
            .iter()
            .rev()
            .find(|t| t.t <= point.t && t.to == point.region);
        if let Some(entry) = near {
            let level = system.conserved(point.region, entry.t, &entry.x)[0];
            assert!((psi - level).abs() < 2e-15, "{}", psi - level);
        }
    }
    // where the scheme is exact the tolerance does not matter
    let loose = Integrator::new(&system, Best::tolerance(1e-3)).initial(0.0, [0.2, -1.0]);
    let loose = loose.run_until(1.0).unwrap();
    let root = std::f64::consts::SQRT_2;
    let exact = |t: f64| 0.2 * (root * t).cos() - (root * t).sin() / root - 0.1;
    assert!(exact(loose.transitions()[0].t).abs() < 1e-16);
}

pws! {
    /// A circle is no affine interface: the flow is not taken, and the answer is as good.
    system Circle {
        state x, y;
        interface circle = x^2 + y^2 - 4;
        region inside where circle < 0 {
            der(x) = x - y;
            der(y) = x + y;
            conserved growth = (x^2 + y^2) * exp(-2 * t);
        }
        region outside where circle > 0 {
            der(x) = -y;
            der(y) = x;
            conserved radius = x^2 + y^2;
        }
    }
}

#[test]
fn a_curved_interface_is_left_to_the_series() {
    let solution = Integrator::new(&Circle {}, Best::tolerance(1e-14)).initial(0.0, [1.0, 0.0]);
    let solution = solution.run_until(1.0);
    // outside, the circle is followed for ever: dg/dt = 0 there
    let error = solution.unwrap_err();
    assert!(error.to_string().contains("tangential"), "{error}");
    let last = error.solution().last().unwrap();
    assert!((last.t - 2f64.ln()).abs() < 1e-14, "{}", last.t);
}
