//! They are the derivatives of the discrete solution, however long its steps are: beside differences
//! of runs.

use dmm_runtime::{Composed, Integrator, Method, RungeKutta, Symmetric, pws};

use super::Failure;

pws! {
    /// A pendulum with a stop that takes speed, and a push by time.
    pub system Pendulum {
        state q, p;
        param k = 1.3, e = 0.8, push = 0.4;
        interface stop = q - 0.5;
        interface floor = q + 0.9;
        der(q) = p;
        der(p) = -k * sin(q) + push * cos(3 * t) + (if p > 0.2 { 0.1 } else { 0.3 });
        on stop rising { p = -e * p; }
        on floor falling { p = -p * (1 - e * q^2 / 4); }
    }
}

/// x(T), ∂x(T)/∂x₀ and ∂x(T)/∂p, and the times of transitions with their derivatives.
fn run(
    system: &Pendulum,
    method: impl Method + 'static,
    start: [f64; 2],
) -> Result<(Vec<f64>, Vec<Vec<f64>>), Failure> {
    let solution = Integrator::new(system, method)
        .initial(0.0, start)
        .run_until(5.0)?;
    let sensitivities = solution.sensitivities()?;
    let end = sensitivities.last().ok_or("no point")?;
    let last = solution.last().ok_or("no point")?;
    let mut values = last.x.as_slice().to_vec();
    let mut derivatives: Vec<Vec<f64>> = (0..2)
        .map(|i| {
            let by_initial = end.by_initial.row(i);
            let by_parameters = end.by_parameters.row(i);
            by_initial
                .iter()
                .chain(by_parameters.iter())
                .copied()
                .collect()
        })
        .collect();
    for (transition, met) in solution
        .transitions()
        .iter()
        .zip(sensitivities.transitions())
    {
        values.push(transition.t);
        let parts = met
            .time_by_initial
            .iter()
            .chain(met.time_by_parameters.iter());
        derivatives.push(parts.copied().collect());
    }
    assert_eq!(sensitivities.points().len(), solution.points().len());
    Ok((values, derivatives))
}

/// The start of runs.
const START: [f64; 2] = [0.1, 0.6];

/// The system and the start with one number changed: a component of the initial state, or a parameter.
pub(super) fn changed(direction: usize, step: f64) -> (Pendulum, [f64; 2]) {
    let (mut system, mut start) = (Pendulum::default(), START);
    match direction {
        0 | 1 => start[direction] += step,
        2 => system.k += step,
        3 => system.e += step,
        _ => system.push += step,
    }
    (system, start)
}

/// Compares with central differences.
fn assert_derivatives<Met: Method + 'static>(name: &str, method: Met) -> Result<(), Failure> {
    const STEP: f64 = 1e-5;
    let (values, derivatives) = run(&Pendulum::default(), method.clone(), START)?;
    assert!(values.len() > 4, "{name}: {values:?}");
    for direction in 0..5 {
        let at = |step: f64| {
            let (system, start) = changed(direction, step);
            run(&system, method.clone(), start)
        };
        let (above, below) = (at(STEP)?.0, at(-STEP)?.0);
        for (k, row) in derivatives.iter().enumerate() {
            let difference = (above[k] - below[k]) / (2.0 * STEP);
            let error = (row[direction] - difference).abs() / (1.0 + difference.abs());
            assert!(
                error < 1e-7,
                "{name} {k} {direction}: {} {difference}",
                row[direction]
            );
        }
    }
    Ok(())
}

#[test]
fn of_steps_by_the_discrete_multiplier_method() -> Result<(), Failure> {
    // a step of 0.1 errs by about 10⁻² at order 2
    assert_derivatives(
        "symmetric",
        Symmetric::step_size(0.1).level_correction(false),
    )?;
    assert_derivatives(
        "composed",
        Composed::<4>::step_size(0.25).level_correction(false),
    )
}

#[test]
fn of_runge_kutta_steps() -> Result<(), Failure> {
    let methods = [
        ("Euler", RungeKutta::explicit::<1>()),
        ("Heun", RungeKutta::explicit::<3>()),
        ("Radau IIA", RungeKutta::radau_iia::<2>()),
        ("Gauss-Legendre", RungeKutta::gauss_legendre::<2>()),
        ("Lobatto IIIC", RungeKutta::lobatto_iiic::<3>()),
    ];
    for (name, method) in methods {
        assert_derivatives(name, method.step_size(0.1).level_correction(false))?;
    }
    Ok(())
}
