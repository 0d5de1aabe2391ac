//! Nurkanović, Sperl, Albrecht & Diehl, eq. (47), whose solution behind the circle is
//! x(T) = r e^T (cos θ, sin θ) with θ = α + ωT + 2ω ln r from x₀ = r (cos α, sin α); the circle is
//! met at t* = −ln r.

use std::f64::consts::PI;

use dmm_runtime::{Best, Composed, Integrator, Method, RungeKutta, Symmetric, Taylor, pws};

use super::Failure;

pws! {
    system Spiral {
        state x1, x2;
        param omega = 2 * pi;
        interface circle = x1^2 + x2^2 - 1;
        region inside where circle < 0 {
            der(x1) = x1 + omega * x2;
            der(x2) = -omega * x1 + x2;
        }
        region outside where circle > 0 {
            der(x1) = x1 - omega * x2;
            der(x2) = omega * x1 + x2;
        }
    }
}

/// The largest error of ∂x(T)/∂x₀ and ∂x(T)/∂ω relative to the largest entry, and that of t*'s
/// derivatives.
fn errors(method: impl Method + 'static, alpha: f64) -> Result<[f64; 2], Failure> {
    let (r, omega, t_end) = ((-1.0f64).exp(), 2.0 * PI, PI / 2.0);
    let start = [r * alpha.cos(), r * alpha.sin()];
    let solution = Integrator::new(&Spiral::default(), method)
        .initial(0.0, start)
        .run_until(t_end)?;
    let sensitivities = solution.sensitivities()?;
    let end = sensitivities.last().ok_or("no point")?;
    let theta = alpha + omega * t_end + 2.0 * omega * r.ln();
    let (size, along, across) = (
        t_end.exp(),
        [theta.cos(), theta.sin()],
        [-theta.sin(), theta.cos()],
    );
    let mut worst = [0.0f64; 2];
    for i in 0..2 {
        let by_radius = size * (along[i] + 2.0 * omega * across[i]);
        // for a displacement by one
        let by_angle = size * across[i];
        let by_start = [
            by_radius * alpha.cos() - by_angle * alpha.sin(),
            by_radius * alpha.sin() + by_angle * alpha.cos(),
        ];
        let by_omega = r * size * across[i] * (t_end + 2.0 * r.ln());
        let scale = 2.0 * omega * size;
        for (j, expected) in by_start.iter().enumerate() {
            worst[0] = worst[0].max((end.by_initial[(i, j)] - expected).abs() / scale);
        }
        worst[0] = worst[0].max((end.by_parameters[(i, 0)] - by_omega).abs() / scale);
    }
    let met = &sensitivities.transitions()[0];
    let expected = [-alpha.cos() / r, -alpha.sin() / r];
    for (found, expected) in met.time_by_initial.iter().zip(expected) {
        worst[1] = worst[1].max((found - expected).abs() * r);
    }
    worst[1] = worst[1].max(met.time_by_parameters[0].abs());
    Ok(worst)
}

#[test]
fn series_and_flows_give_them_to_rounding() -> Result<(), Failure> {
    for alpha in [0.0, 0.7, 2.0] {
        for worst in [
            errors(Taylor::tolerance(1e-14), alpha)?,
            errors(Best::tolerance(1e-14), alpha)?,
        ] {
            assert!(worst[0] < 2e-13 && worst[1] < 2e-13, "{worst:?}");
        }
    }
    Ok(())
}

/// The orders at which the errors of x(T) and of t* fall, between step sizes of which one is a quarter, and the smaller
/// error of t*.
fn order<Met: Method + 'static>(
    method: impl Fn(f64) -> Met,
    steps: f64,
) -> Result<([f64; 2], f64), Failure> {
    let at = |steps: f64| errors(method(PI / 2.0 / steps), 0.7);
    let (coarse, fine) = (at(steps)?, at(4.0 * steps)?);
    Ok(([0, 1].map(|k| 0.5 * (coarse[k] / fine[k]).log2()), fine[1]))
}

#[test]
fn one_step_methods_give_them_at_their_order() -> Result<(), Failure> {
    let orders = [
        (2.0, order(Symmetric::step_size, 400.0)?),
        (4.0, order(Composed::<4>::step_size, 100.0)?),
        (6.0, order(Composed::<6>::step_size, 40.0)?),
        (
            4.0,
            order(|h| RungeKutta::explicit::<4>().step_size(h), 200.0)?,
        ),
        (
            5.0,
            order(|h| RungeKutta::radau_iia::<3>().step_size(h), 40.0)?,
        ),
        (
            6.0,
            order(|h| RungeKutta::gauss_legendre::<3>().step_size(h), 30.0)?,
        ),
        (
            4.0,
            order(|h| RungeKutta::lobatto_iiic::<3>().step_size(h), 100.0)?,
        ),
    ];
    for (expected, ([state, time], error)) in orders {
        println!("{expected} {state:.2} {time:.2} {error:.1e}");
        assert!((state - expected).abs() < 0.4, "{expected} {state}");
        // that of the radius alone, which some methods have more exactly
        assert!(
            time > expected - 1.0 || error < 1e-10,
            "{expected} {time} {error:e}"
        );
    }
    Ok(())
}
