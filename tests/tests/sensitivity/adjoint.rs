//! Gradients by the adjoint are the rows of the sensitivities, to rounding.

use dmm_runtime::{
    Best, Composed, EmbeddedRungeKutta, ErrorKind, Functional, Integrator, Method, RungeKutta,
    Sensitivity, Symmetric, Taylor, Vector,
};

use super::Failure;
use super::discrete::Pendulum;

const WEIGHTS: [f64; 2] = [0.7, -1.9];

/// wᵀ ∂x
fn weighted(of: &Sensitivity<2>) -> Vec<f64> {
    let weights = Vector::from(WEIGHTS);
    let initial = of.by_initial.transpose() * weights;
    let parameters = of.by_parameters.transpose() * weights;
    initial.iter().chain(parameters.iter()).copied().collect()
}

fn assert_gradients(name: &str, method: impl Method + 'static) -> Result<(), Failure> {
    let t_end = 5.0;
    let solution = Integrator::new(&Pendulum::default(), method)
        .initial(0.0, [0.1, 0.6])
        .run_until(t_end)?;
    let along = solution.sensitivities()?;
    let weights = Vector::from(WEIGHTS);
    let (mut functionals, mut expected) = (Vec::new(), Vec::new());
    let step = (solution.points()[3].t + solution.points()[4].t) / 2.0;
    let event = solution.transitions()[1].t;
    for t in [t_end, 0.0, step, solution.points()[2].t, event] {
        functionals.push(Functional::State { t, weights });
        // at a transition it is the point behind it that counts
        expected.push(weighted(
            &match solution.points().iter().rposition(|point| point.t == t) {
                Some(index) => along.points()[index].clone(),
                None => solution.sensitivity_at(t, &along)?,
            },
        ));
    }
    assert!(solution.transitions().len() > 2, "{name}");
    for (transition, met) in along.transitions().iter().enumerate() {
        functionals.push(Functional::TransitionTime { transition });
        let (initial, parameters) = (met.time_by_initial.iter(), met.time_by_parameters.iter());
        expected.push(initial.chain(parameters).copied().collect());
        functionals.push(Functional::AfterTransition {
            transition,
            weights,
        });
        expected.push(weighted(&met.after));
    }
    let gradients = solution.gradients(&functionals)?;
    assert_eq!(gradients.len(), functionals.len());
    for ((gradient, expected), functional) in gradients.iter().zip(&expected).zip(&functionals) {
        let size = expected
            .iter()
            .fold(1.0, |size: f64, part| size.max(part.abs()));
        let found = gradient.by_initial.iter().chain(&gradient.by_parameters);
        for (found, expected) in found.zip(expected) {
            assert!(
                (found - expected).abs() < 1e-12 * size,
                "{name} {functional:?}: {found} {expected}"
            );
        }
    }
    Ok(())
}

#[test]
fn they_are_the_rows_of_sensitivities() -> Result<(), Failure> {
    assert_gradients("Taylor", Taylor::tolerance(1e-12))?;
    assert_gradients("best", Best::tolerance(1e-12))?;
    assert_gradients("symmetric", Symmetric::step_size(0.05))?;
    assert_gradients("by tolerance", Composed::<8>::tolerance(1e-9))?;
    assert_gradients("Heun", RungeKutta::explicit::<3>().step_size(0.05))?;
    assert_gradients("Gauss", RungeKutta::gauss_legendre::<3>().step_size(0.1))?;
    assert_gradients(
        "Radau IIA",
        EmbeddedRungeKutta::radau_iia::<3>().tolerance(1e-8),
    )
}

#[test]
fn what_there_is_not_is_refused() -> Result<(), Failure> {
    let solution = Integrator::new(&Pendulum::default(), Taylor::tolerance(1e-12))
        .initial(0.0, [0.1, 0.6])
        .run_until(1.0)?;
    let weights = Vector::from(WEIGHTS);
    for t in [-0.5, 1.5, f64::NAN] {
        let late = solution.gradients(&[Functional::State { t, weights }]);
        let kind = late.err().ok_or("there is one")?.kind;
        assert!(matches!(kind, ErrorKind::OutOfRange { .. }), "{kind}");
    }
    let transition = solution.transitions().len();
    let unknown = solution.gradients(&[Functional::TransitionTime { transition }]);
    let message = unknown.err().ok_or("there is one")?.to_string();
    assert!(message.contains("transition"), "{message}");
    assert_eq!(solution.gradients(&[])?, []);
    Ok(())
}
