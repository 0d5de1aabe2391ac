//! Backwards in time: what went forwards comes back, by every method.

use dmm_runtime::{
    Best, Composed, Ensemble, ErrorKind, Integrator, Member, Method, Reversed, Symmetric, System,
    Taylor, pws,
};
use dmm_tests::systems::Springs;

pws! {
    /// A driven oscillator that stiffens beyond a line that moves.
    pub system Driven {
        state x, y;
        param k = 3;
        interface line = x - cos(t) / 8;
        region right where line > 0 {
            der(x) = y; der(y) = -x - x^3 + sin(t);
        }
        region left where line < 0 {
            der(x) = y; der(y) = -k * x;
            conserved energy = (y^2 + k*x^2) / 2;
        }
    }
}

const START: [f64; 2] = [0.3, 1.0];
const END: f64 = 20.0;

/// The start that a run forwards and one backwards come back to, and the greatest difference of the
/// times of their transitions.
fn there_and_back<Sys: System<2>>(system: &Sys, method: impl Method) -> (f64, f64) {
    let forwards = Integrator::new(system, method.clone())
        .initial(0.0, START)
        .run_until(END)
        .unwrap();
    let end = forwards.last().unwrap();
    let backwards = Integrator::new(&Reversed(system.clone()), method)
        .initial(-END, end.x)
        .run_until(0.0)
        .unwrap();
    let (there, back) = (forwards.transitions(), backwards.transitions());
    assert_eq!(there.len(), back.len());
    assert!(there.len() >= 6, "{}", there.len());
    let times = there.iter().zip(back.iter().rev()).map(|(there, back)| {
        assert_eq!((there.from, there.to), (back.to, back.from));
        (there.t + back.t).abs()
    });
    let start = backwards.last().unwrap().x;
    let distance = (start[0] - START[0]).abs().max((start[1] - START[1]).abs());
    (distance, times.fold(0.0, f64::max))
}

#[test]
fn every_method_comes_back() {
    // a symmetric scheme retraces its steps, also in the regions that it enters; a step at a
    // transition is not of the same grid, which costs its local error
    let (driven, springs) = (Driven::default(), Springs {});
    let bounds = [
        there_and_back(&driven, Taylor::tolerance(1e-14)),
        there_and_back(&springs, Best::tolerance(1e-14)),
        there_and_back(&driven, Composed::<8>::tolerance(1e-12)),
        there_and_back(&driven, Symmetric::step_size(1e-3)),
        there_and_back(&springs, Symmetric::step_size(1e-3)),
    ];
    for ((distance, times), bound) in bounds.iter().zip([1e-11, 1e-12, 1e-8, 1e-4, 1e-4]) {
        assert!(*distance < bound && *times < bound, "{bounds:?}");
    }
}

#[test]
fn ensembles_go_back() {
    let members = |t0: f64, starts: [[f64; 2]; 9]| {
        starts.map(|start| Member::new(Reversed(Springs {}), t0, start))
    };
    let starts = std::array::from_fn(|i| [0.3, 1.0 + 0.1 * i as f64]);
    let ensemble = Ensemble::new(Taylor::tolerance(1e-12));
    for (member, outcome) in members(0.0, starts)
        .iter()
        .zip(ensemble.collect_until(END, members(0.0, starts)))
    {
        let end = outcome.unwrap().point;
        let forwards = Integrator::new(&Springs {}, Taylor::tolerance(1e-12))
            .initial(-END, end.x)
            .run_until(0.0)
            .unwrap();
        let back = forwards.last().unwrap().x;
        assert!((back - member.x0).amax() < 1e-10);
    }
}

#[test]
fn an_end_before_the_start_is_refused_with_the_way() {
    let problem = Integrator::new(&Springs {}, Best::tolerance(1e-12)).initial(2.0, START);
    let refused = problem.run_until(-1.0).unwrap_err();
    let kind = ErrorKind::BackwardTime {
        t0: 2.0,
        t_end: -1.0,
    };
    assert_eq!(refused.error().kind, kind);
    let text = refused.to_string();
    assert!(text.contains("`Reversed(system)` from -2 to 1"), "{text}");
}
