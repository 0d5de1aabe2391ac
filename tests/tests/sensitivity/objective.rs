//! Nurkanović, Sperl, Albrecht & Diehl, eq. (56): the derivatives of
//! V(x₀) = ∫₀² x² dt + (x(2) − 5/3)² for ẋ = 2 − sign x.

use dmm_runtime::{
    Best, Functional, Integrator, Method, RungeKutta, Symmetric, Taylor, Vector, pws,
};

use super::Failure;

pws! {
    /// eq. (56), with the integral as a state.
    system Objective {
        state x, integral;
        interface origin = x;
        der(integral) = x^2;
        region left where origin < 0 { der(x) = 3; }
        region right where origin > 0 { der(x) = 1; }
    }
}

const TARGET: f64 = 5.0 / 3.0;

/// V′ and V″ for x₀ < 0, where the origin is met at −x₀/3.
fn exact(x0: f64) -> [f64; 2] {
    let end = 2.0 + x0 / 3.0;
    [
        (end * end - x0 * x0) / 3.0 + 2.0 / 3.0 * (end - TARGET),
        2.0 / 9.0 * end - 2.0 / 3.0 * x0 + 2.0 / 9.0,
    ]
}

/// Relative errors of V′ by sensitivities, V′ by the adjoint, and V″.
fn errors(method: impl Method + 'static, x0: f64) -> Result<[f64; 3], Failure> {
    let solution = Integrator::new(&Objective {}, method)
        .initial(0.0, [x0, 0.0])
        .run_until(2.0)?;
    let second = solution.second_sensitivities()?;
    let end = solution.last().ok_or("no point")?.x[0];
    let first = second.first().last().ok_or("no point")?.by_initial;
    let weights = Vector::from([2.0 * (end - TARGET), 1.0]);
    let by_sensitivities = (weights.transpose() * first)[(0, 0)];
    let gradients = solution.gradients(&[Functional::State { t: 2.0, weights }])?;
    let hessians = second.last().ok_or("no point")?;
    let curvature = weights[0] * hessians[0][(0, 0)] + hessians[1][(0, 0)];
    let curvature = curvature + 2.0 * first[(0, 0)] * first[(0, 0)];
    let found = [by_sensitivities, gradients[0].by_initial[0], curvature];
    let expected = exact(x0);
    Ok([0, 1, 2].map(|k| {
        let expected = expected[k / 2];
        (found[k] - expected).abs() / (1.0 + expected.abs())
    }))
}

#[test]
fn its_derivatives_are_exact() -> Result<(), Failure> {
    for x0 in [-1.9, -1.2, -0.3] {
        for errors in [
            errors(Taylor::tolerance(1e-14), x0)?,
            errors(Best::tolerance(1e-14), x0)?,
            // polynomials of degree 3
            errors(RungeKutta::explicit::<3>().step_size(0.07), x0)?,
            errors(RungeKutta::radau_iia::<2>().step_size(0.07), x0)?,
        ] {
            assert!(errors.iter().all(|&error| error < 1e-13), "{x0} {errors:?}");
        }
        for h in [0.04, 0.01, 0.0025] {
            let errors = errors(Symmetric::step_size(h), x0)?;
            // the part of a step up to the transition changes with x₀: its second derivative is of
            // one order less
            let bounds = [10.0 * h * h, 10.0 * h * h, h];
            for (error, bound) in errors.into_iter().zip(bounds) {
                assert!(error < bound, "{x0} {h} {error:e}");
            }
        }
    }
    Ok(())
}
