//! Second derivatives, beside differences of first ones.

use dmm_runtime::nalgebra::DMatrix;
use dmm_runtime::{
    Integrator, Method, RungeKutta, SecondSensitivities, Sensitivity, Symmetric, Taylor,
};

use super::Failure;
use super::discrete::changed;

const DIRECTIONS: usize = 5;

/// With one number changed: a component of the initial state or a parameter.
fn run(
    method: impl Method + 'static,
    direction: usize,
    step: f64,
) -> Result<SecondSensitivities<2>, Failure> {
    let (system, start) = changed(direction, step);
    let solution = Integrator::new(&system, method)
        .initial(0.0, start)
        .run_until(3.0)?;
    let second = solution.second_sensitivities()?;
    let first = solution.sensitivities()?;
    for (one, other) in second.first().points().iter().zip(first.points()) {
        assert!((one.by_initial - other.by_initial).amax() < 1e-12);
        assert!((&one.by_parameters - &other.by_parameters).amax() < 1e-12);
    }
    Ok(second)
}

/// A row of first derivatives.
fn row(of: &Sensitivity<2>, i: usize) -> Vec<f64> {
    let (initial, parameters) = (of.by_initial.row(i), of.by_parameters.row(i));
    initial.iter().chain(parameters.iter()).copied().collect()
}

/// The first derivatives of the end and of the transitions, and the second ones of the same numbers.
fn both(second: &SecondSensitivities<2>) -> (Vec<Vec<f64>>, Vec<&DMatrix<f64>>) {
    let (mut firsts, mut seconds) = (Vec::new(), Vec::new());
    let (end, hessians) = (second.first().last().unwrap(), second.last().unwrap());
    for (i, hessian) in hessians.iter().enumerate() {
        firsts.push(row(end, i));
        seconds.push(hessian);
    }
    for (met, hessians) in (second.first().transitions().iter()).zip(second.transitions()) {
        let (initial, parameters) = (met.time_by_initial.iter(), met.time_by_parameters.iter());
        firsts.push(initial.chain(parameters).copied().collect());
        seconds.push(&hessians.time);
        for i in 0..2 {
            firsts.extend([row(&met.before, i), row(&met.after, i)]);
            seconds.extend([&hessians.before[i], &hessians.after[i]]);
        }
    }
    (firsts, seconds)
}

fn assert_second<Met: Method + 'static>(name: &str, method: Met) -> Result<(), Failure> {
    const STEP: f64 = 1e-5;
    let found = run(method.clone(), 0, 0.0)?;
    let (_, seconds) = both(&found);
    // two at least
    assert!(seconds.len() >= 12, "{name}");
    for j in 0..DIRECTIONS {
        let above = run(method.clone(), j, STEP)?;
        let below = run(method.clone(), j, -STEP)?;
        let (above, below) = (both(&above).0, both(&below).0);
        for (number, hessian) in seconds.iter().enumerate() {
            for k in 0..DIRECTIONS {
                let difference = (above[number][k] - below[number][k]) / (2.0 * STEP);
                let error = (hessian[(j, k)] - difference).abs() / (1.0 + hessian.amax());
                assert!(
                    error < 1e-7,
                    "{name} {number} {j} {k}: {} {difference}",
                    hessian[(j, k)]
                );
            }
        }
    }
    Ok(())
}

#[test]
fn they_are_the_derivatives_of_the_first() -> Result<(), Failure> {
    assert_second("Taylor", Taylor::tolerance(1e-14))?;
    assert_second(
        "symmetric",
        Symmetric::step_size(0.1).level_correction(false),
    )?;
    for (name, method) in [
        ("Heun", RungeKutta::explicit::<3>()),
        ("Radau IIA", RungeKutta::radau_iia::<2>()),
        ("Lobatto IIIC", RungeKutta::lobatto_iiic::<3>()),
    ] {
        assert_second(name, method.step_size(0.1).level_correction(false))?;
    }
    Ok(())
}
