//! A block that sticks and slips: the derivatives of a sliding motion, its beginning and its end.

use dmm_runtime::{Integrator, Taylor, TransitionKind, pws};

use super::Failure;

pws! {
    /// The stick-slip oscillator of Leine et al. (1998).
    system StickSlip {
        state x, v;
        param belt = 0.2, friction = 1;
        interface contact = v - belt, sliding;
        der(x) = v;
        region slower where contact < 0 { der(v) = -x + friction / (1 + 3 * (belt - v)); }
        region faster where contact > 0 { der(v) = -x - friction / (1 + 3 * (v - belt)); }
    }
}

#[test]
fn a_slide_forgets_all_but_where_it_is() -> Result<(), Failure> {
    let solution = Integrator::new(&StickSlip::default(), Taylor::tolerance(1e-14))
        .initial(0.0, [1.2, 0.0])
        .run_until(20.0)?;
    let sensitivities = solution.sensitivities()?;
    let kinds = solution.transitions().iter().map(|one| one.kind);
    let of = |kind| kinds.clone().position(|one| one == kind);
    let began = of(TransitionKind::BeganToSlide).ok_or("no slide")?;
    let left = of(TransitionKind::LeftSlide).ok_or("no end of it")?;
    // on the belt v is that of the belt, whatever the start was
    let stuck = &sensitivities.transitions()[began].after;
    assert!(stuck.by_initial.row(1).amax() < 1e-13, "{stuck:?}");
    assert!((stuck.by_parameters[(1, 0)] - 1.0).abs() < 1e-13);
    // it leaves at x = friction, when it has gone there with the belt
    let met = &sensitivities.transitions()[left];
    assert!(met.before.by_initial.amax() < 1e-12, "{met:?}");
    assert!((met.before.by_parameters[(0, 1)] - 1.0).abs() < 1e-12);
    assert!(met.before.by_parameters[(0, 0)].abs() < 1e-12);
    // so that the next slip does not depend on the start, but for when it begins
    let end = sensitivities.last().ok_or("no point")?;
    let x = solution.last().ok_or("no point")?;
    let system = solution.system();
    let field = dmm_runtime::System::vector_field(system, x.region, x.t, &x.x);
    for j in 0..2 {
        for i in 0..2 {
            let expected = -field[i] * met.time_by_initial[j];
            let error = (end.by_initial[(i, j)] - expected).abs();
            // the flow behind the end of the slide enlarges rounding errors of its time
            assert!(error < 1e-10, "{i} {j}: {error:e}");
        }
    }
    // beside a difference
    let at = |belt: f64| -> Result<_, Failure> {
        let system = StickSlip {
            belt,
            ..StickSlip::default()
        };
        let solution = Integrator::new(&system, Taylor::tolerance(1e-14))
            .initial(0.0, [1.2, 0.0])
            .run_until(20.0)?;
        Ok(solution.last().ok_or("no point")?.x)
    };
    let difference = (at(0.2 + 1e-5)? - at(0.2 - 1e-5)?) / 2e-5;
    for i in 0..2 {
        let error = (end.by_parameters[(i, 0)] - difference[i]).abs();
        assert!(error < 1e-7, "{i}: {error:e}");
    }
    Ok(())
}
