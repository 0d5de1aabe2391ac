//! The recurrences of the Taylor coefficients: of every function of the language, against an
//! independent method.

use dmm_runtime::{Integrator, Taylor, pws};

pws! {
    /// Every function once.
    system Everything {
        state x, y, z;
        param a = 0.3;
        der(x) = sqrt(x) / 2 + exp(-y) + ln(x) + sin(x) * cos(y) - a;
        der(y) = tan(z / 4) + sinh(x / 5) - cosh(y / 5) + tanh(z);
        der(z) = asin(z / 9) + acos(y / 9) - atan(x) + x^y / (1 + x^2) + 2^z / 8 - x^a
            + x^(-2) + t * x / (1 + t) + x^3 / 20 - z^(3/2) / 9 - 3 * exp(-t / 2);
    }
}

/// The field as it is declared.
fn field(t: f64, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let a = 0.3;
    [
        x.sqrt() / 2.0 + (-y).exp() + x.ln() + x.sin() * y.cos() - a,
        (z / 4.0).tan() + (x / 5.0).sinh() - (y / 5.0).cosh() + z.tanh(),
        (z / 9.0).asin() + (y / 9.0).acos() - x.atan()
            + x.powf(y) / (1.0 + x * x)
            + 2f64.powf(z) / 8.0
            - x.powf(a)
            + x.powi(-2)
            + t * x / (1.0 + t)
            + x.powi(3) / 20.0
            - z.powf(1.5) / 9.0
            - 3.0 * (-t / 2.0).exp(),
    ]
}

/// The state at `t_end` by the classical Runge–Kutta method with `steps` steps.
fn runge_kutta(x0: [f64; 3], t_end: f64, steps: u32) -> [f64; 3] {
    let h = t_end / f64::from(steps);
    let along = |x: [f64; 3], k: [f64; 3], h: f64| std::array::from_fn(|i| x[i] + h * k[i]);
    (0..steps).fold(x0, |x, step| {
        let t = h * f64::from(step);
        let k1 = field(t, x);
        let k2 = field(t + h / 2.0, along(x, k1, h / 2.0));
        let k3 = field(t + h / 2.0, along(x, k2, h / 2.0));
        let k4 = field(t + h, along(x, k3, h));
        std::array::from_fn(|i| x[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
    })
}

#[test]
fn every_function_has_its_recurrence() {
    let (x0, t_end) = ([1.5, 0.7, 1.4], 0.25);
    let solution = Integrator::new(&Everything::default(), Taylor::tolerance(1e-15))
        .initial(0.0, x0)
        .run_until(t_end)
        .unwrap();
    let x = solution.last().unwrap().x;
    // the error of order 4 extrapolated away: what is left is of order 5, and rounding
    let (coarse, fine) = (runge_kutta(x0, t_end, 1000), runge_kutta(x0, t_end, 2000));
    for i in 0..3 {
        let exact = fine[i] + (fine[i] - coarse[i]) / 15.0;
        assert!((x[i] - exact).abs() < 1e-12, "{i}: {} {exact}", x[i]);
    }
    assert!(solution.statistics().steps < 40);
}
