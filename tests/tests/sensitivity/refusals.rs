//! Where there is no derivative, that is said.

use dmm_runtime::{Best, ErrorKind, Integrator, Taylor, pws};

use super::{Failure, kind};

pws! {
    /// A body that flies through two lines, and changes a value by its height.
    system Flight {
        state x, y;
        discrete seen = 0;
        param u = 1, v = 1;
        interface first = x - 1;
        interface second = y - 1;
        interface third = x - 3;
        der(x) = u + seen;
        der(y) = v;
        on first rising { y = y + 0.1; }
        on second rising { x = x + 0.5; }
        on third rising { seen = x * y / 100; }
    }
}

fn refusal(y: f64, t_end: f64) -> Result<String, Failure> {
    let solution = Integrator::new(&Flight::default(), Best::tolerance(1e-12))
        .initial(0.0, [0.0, y])
        .run_until(t_end)?;
    let error = solution.sensitivities().err().ok_or("there is one")?;
    assert!(matches!(error.kind, ErrorKind::NoDerivative { .. }));
    Ok(kind(&error))
}

#[test]
fn what_has_no_derivative_is_refused() -> Result<(), Failure> {
    // both lines at once
    assert!(refusal(0.0, 1.5)?.contains("several interfaces are met at once"));
    assert!(refusal(-5.0, 1.0)?.contains("a transition is at the end time"));
    assert!(refusal(-9.0, 4.0)?.contains("a discrete state depends on the state"));
    let solution = Integrator::new(&Flight::default(), Taylor::tolerance(1e-12))
        .initial(0.0, [0.0, -5.0])
        .output_times([0.5])
        .run_until(0.9)?;
    let error = solution.sensitivities().err().ok_or("there is one")?;
    assert!(kind(&error).contains("not every step"), "{error}");
    Ok(())
}

#[test]
fn between_points_there_is_one() -> Result<(), Failure> {
    let solution = Integrator::new(&Flight::default(), Best::tolerance(1e-12))
        .initial(0.0, [0.0, -5.0])
        .run_until(2.5)?;
    let along = solution.sensitivities()?;
    // y = y₀ + v t + 0.1 behind x = u t = 1, which does not depend on y₀
    for t in [0.0, 0.3, 1.0, 1.7, 2.5] {
        let here = solution.sensitivity_at(t, &along)?;
        assert!((here.by_initial[(1, 1)] - 1.0).abs() < 1e-14);
        assert!(
            (here.by_parameters[(1, 1)] - t).abs() < 1e-14,
            "{t} {here:?}"
        );
        assert!((here.by_parameters[(0, 0)] - t).abs() < 1e-14);
    }
    assert!(solution.sensitivity_at(3.0, &along).is_err());
    assert!(solution.sensitivity_at(-1.0, &along).is_err());
    Ok(())
}
