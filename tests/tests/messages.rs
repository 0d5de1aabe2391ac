//! What errors of a run say.

use dmm_runtime::{
    Best, Composed, ErrorKind, Halted, Integrator, Method, Symmetric, System, Taylor, pws,
};

pws! {
    /// ẋ = ln x
    system Logarithm {
        state x;
        der(x) = ln(x);
    }
}

pws! {
    /// ẋ = x
    system Growth {
        state x;
        der(x) = x;
    }
}

pws! {
    /// ẋ = 1/(x − 1) + x²
    system Pole {
        state x;
        der(x) = 1/(x - 1) + x^2;
    }
}

/// What stops every method.
fn errors<Sys: System<1>>(system: &Sys, x: f64, t_end: f64) -> Vec<dmm_runtime::Error> {
    fn one<Sys: System<1>>(
        system: &Sys,
        method: impl Method,
        x: f64,
        t_end: f64,
    ) -> dmm_runtime::Error {
        let problem = Integrator::new(system, method).initial(0.0, [x]);
        let halted: Halted<_, 1> = problem.observe_until(t_end, &mut ()).unwrap_err();
        halted.into()
    }
    vec![
        one(system, Best::tolerance(1e-12), x, t_end),
        one(system, Taylor::tolerance(1e-12), x, t_end),
        one(system, Symmetric::step_size(1e-2), x, t_end),
        one(system, Composed::<6>::tolerance(1e-8), x, t_end),
    ]
}

#[test]
fn a_start_outside_the_domain_names_the_function_and_the_start() {
    for error in errors(&Logarithm {}, -1.0, 1.0) {
        let text = "at t = 0, x = [-1] in region `everywhere`: the vector field has no value \
                    there: ln(u) is not defined at u = -1";
        assert_eq!(error.to_string(), text);
    }
    for error in errors(&Pole {}, 1.0, 1.0) {
        let kind = ErrorKind::Undefined {
            function: "1/u",
            argument: 0.0,
        };
        assert_eq!(error.kind, kind);
    }
}

#[test]
fn overflow_is_called_overflow() {
    let all = errors(&Growth {}, 1.0, 1000.0).into_iter();
    for error in all.chain(errors(&Pole {}, 1e200, 1.0)) {
        assert_eq!(error.kind, ErrorKind::Overflow, "{error}");
    }
}

#[test]
fn a_debugged_error_is_text_and_its_fields_are_there_too() {
    let error = &errors(&Logarithm {}, -1.0, 1.0)[0];
    assert_eq!(format!("{error:?}"), error.to_string());
    assert!(format!("{error:#?}").contains("kind: Undefined"));
}

#[test]
fn times_are_written_as_people_write_them() {
    let halted = Integrator::new(&Logarithm {}, Best::tolerance(1e-12))
        .initial(1e-110, [-2.5e20])
        .observe_until(1.0, &mut ())
        .unwrap_err();
    assert!(
        halted
            .to_string()
            .starts_with("at t = 1e-110, x = [-2.5e20] in region"),
        "{halted}"
    );
}

#[test]
fn no_points_at_all_are_not_every_zeroth() {
    let problem = Integrator::new(&Growth {}, Best::tolerance(1e-12)).initial(0.0, [1.0]);
    let refused = problem.every(0).run_until(1.0).unwrap_err();
    let text = "every: 0 (must be at least 1)";
    assert_eq!(refused.error().to_string(), text);
    assert!(refused.solution().points().is_empty());
}
