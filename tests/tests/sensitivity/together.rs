//! Transitions at the same time: an event that leads onto a surface that is slid on.

use dmm_runtime::{Functional, Integrator, Taylor, TransitionKind, Vector, pws};

use super::Failure;

pws! {
    /// A body that a wall leaves with the speed of a belt, on which it stays.
    system Caught {
        state x, v;
        param belt = 0.2, a = 0.3;
        interface wall = x - 1;
        interface contact = v - belt, sliding;
        der(x) = v;
        region slower where contact < 0 { der(v) = 1 + a; }
        region faster where contact > 0 { der(v) = -1 - a; }
        on wall rising { v = belt; }
    }
}

#[test]
fn a_jump_and_the_beginning_of_a_slide() -> Result<(), Failure> {
    let (x0, v0, belt, a, t_end) = (0.7, 1.0, 0.2, 0.3, 3.0);
    let solution = Integrator::new(&Caught::default(), Taylor::tolerance(1e-14))
        .initial(0.0, [x0, v0])
        .run_until(t_end)?;
    let kinds: Vec<_> = solution.transitions().iter().map(|met| met.kind).collect();
    assert!(kinds.contains(&TransitionKind::Jumped), "{kinds:?}");
    let sensitivities = solution.sensitivities()?;
    let end = sensitivities.last().ok_or("no point")?;
    // 1 = x₀ + v₀ t* − (1 + a) t*²/2, and x = 1 + belt (t − t*)
    let b = 1.0 + a;
    let root = f64::sqrt(v0 * v0 - 2.0 * b * (1.0 - x0));
    let time = (v0 - root) / b;
    let by = [-1.0 / root, -time / root, 0.0, 0.5 * time * time / root];
    let found = |k: usize| match k {
        0 | 1 => end.by_initial[(0, k)],
        _ => end.by_parameters[(0, k - 2)],
    };
    let weights = Vector::from([1.0, 0.0]);
    let gradients = solution.gradients(&[Functional::State { t: t_end, weights }])?;
    for k in 0..4 {
        let expected = -belt * by[k] + if k == 2 { t_end - time } else { 0.0 };
        assert!(
            (found(k) - expected).abs() < 1e-12,
            "{k}: {} {expected}",
            found(k)
        );
        let adjoint = gradients[0]
            .by_initial
            .iter()
            .chain(&gradients[0].by_parameters);
        let adjoint: Vec<f64> = adjoint.copied().collect();
        assert!(
            (adjoint[k] - expected).abs() < 1e-12,
            "{k}: {} {expected}",
            adjoint[k]
        );
    }
    Ok(())
}
