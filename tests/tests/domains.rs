//! The domain of a proof is the domain of a run: where a quantity was proved to be conserved on a
//! part of what code evaluates, a run ends where it leaves that part.

use std::fmt::Debug;

use dmm_runtime::{
    Best, Composed, Ensemble, Error, ErrorKind, Integrator, Member, Method, Place, Symmetric,
    System, Taylor, pws,
};

pws! {
    /// ẏ = |x| x, in which x^k cancels: y − x³/3 is conserved where x > 0, and y + x³/3 where
    /// x < 0.
    pub system Ramp {
        state x, y;
        param k = 2, speed = 1;
        der(x) = speed;
        der(y) = speed * sqrt(x^2) * x^k / x^k * x;
        conserved e = y - x^3 / 3;
    }
}

pws! {
    /// x² + y² is conserved where x > 0.
    pub system Turn {
        state x, y;
        param k = 2;
        der(x) = y * x^k;
        der(y) = -sqrt(x^2) * x^k;
        conserved e = (x^2 + y^2) / 2;
    }
}

pws! {
    /// A spring with a power that is a parameter.
    pub system Spring {
        state x, v;
        param k = 4;
        der(x) = v;
        der(v) = -k * x^(k - 1);
        conserved e = v^2 / 2 + x^k;
    }
}

pws! {
    /// f has a value where x ≥ 0, and what is made from a component of it everywhere.
    pub system Half {
        state x, y;
        der(x) = y * sqrt(x^2);
        der(y) = -x * sqrt(x)^2;
        conserved e = (x^2 + y^2) / 2;
    }
}

pws! {
    /// A rotation with its angle, which jumps where x = 0.
    pub system Rotation {
        state x, y;
        der(x) = -y;
        der(y) = x;
        conserved angle = atan(y / x) - t;
    }
}

pws! {
    /// A quantity that jumps where x = 0, though f is constant.
    pub system Sign {
        state x, y;
        der(x) = 1;
        der(y) = 0;
        conserved e = y + sqrt(x^2) / x;
    }
}

pws! {
    /// ẋ = |1 − t|, in which a power cancels.
    pub system Clock {
        state x;
        param k = 2;
        der(x) = sqrt((1 - t)^2) * (1 - t)^k / (1 - t)^k;
        conserved e = x + (1 - t)^2 / 2;
    }
}

pws! {
    /// A condition on a parameter alone.
    pub system Rates {
        state x, y;
        param a = 2, k = 2;
        der(x) = a;
        der(y) = sqrt(a^2) * a^k / a^k;
        conserved e = x - y;
    }
}

pws! {
    /// Above the line there is a condition, and below nothing is conserved.
    pub system Gate {
        state x, y;
        param k = 2;
        interface line = y;
        region below where line < 0 { der(x) = -1; der(y) = 1; }
        region above where line > 0 {
            der(x) = -sqrt(x^2) * x^k / x^k;
            der(y) = 1;
            conserved e = x * exp(t);
        }
    }
}

pws! {
    /// The wall gives the sign that the proof needs.
    pub system Wall {
        state x, v;
        interface wall = x;
        der(x) = v;
        region right where wall > 0 { der(v) = -1; conserved e = v^2 / 2 + sqrt(x^2); }
        region left where wall < 0 { der(v) = 1; conserved e = v^2 / 2 + sqrt(x^2); }
    }
}

/// The end of a run, or what stopped it.
fn run<Sys: System<N>, const N: usize>(
    system: &Sys,
    scheme: impl Method + Debug,
    x: [f64; N],
    t_end: f64,
) -> Result<[f64; N], Error> {
    Integrator::new(system, scheme)
        .initial(0.0, x)
        .observe_until(t_end, &mut ())
        .map(|end| end.point.x.into())
        .map_err(Error::from)
}

/// The outcomes under every scheme.
fn all<Sys: System<N>, const N: usize>(
    system: &Sys,
    x: [f64; N],
    t_end: f64,
) -> Vec<(String, Result<[f64; N], Error>)> {
    vec![
        (
            "symmetric".into(),
            run(system, Symmetric::step_size(0.01), x, t_end),
        ),
        (
            "symmetric by tolerance".into(),
            run(system, Symmetric::tolerance(1e-6), x, t_end),
        ),
        (
            "composed".into(),
            run(system, Composed::<4>::step_size(0.02), x, t_end),
        ),
        (
            "composed by tolerance".into(),
            run(system, Composed::<6>::tolerance(1e-9), x, t_end),
        ),
        (
            "taylor".into(),
            run(system, Taylor::tolerance(1e-12), x, t_end),
        ),
        ("best".into(), run(system, Best::tolerance(1e-12), x, t_end)),
    ]
}

/// Asserts that every scheme ends at time `t` and coordinate `x[0]` because of a condition.
#[track_caller]
fn ends<Sys: System<N>, const N: usize>(
    system: &Sys,
    start: [f64; N],
    (t_end, t_stop, x_stop): (f64, f64, f64),
    (wanted, names): (&str, &str),
) {
    for (scheme, outcome) in all(system, start, t_end) {
        let Err(error) = outcome else {
            panic!("{scheme}: {outcome:?}");
        };
        let (
            Some(Place { t, x, .. }),
            ErrorKind::ConditionFails {
                condition,
                quantity,
            },
        ) = (error.place(), &error.kind)
        else {
            panic!("{scheme}: {error}");
        };
        assert!((t - t_stop).abs() < 1e-3, "{scheme}: {t}");
        assert!((x[0] - x_stop).abs() < 1e-3, "{scheme}: {x:?}");
        assert_eq!((*condition, *quantity), (wanted, names), "{scheme}");
    }
}

/// Asserts that every scheme comes to a point, to the accuracy of the lowest order.
#[track_caller]
fn comes_to<Sys: System<N>, const N: usize>(
    system: &Sys,
    start: [f64; N],
    t_end: f64,
    expected: [f64; N],
) {
    for (scheme, outcome) in all(system, start, t_end) {
        let Ok(x) = outcome else {
            panic!("{scheme}: {outcome:?}");
        };
        for (x, expected) in x.iter().zip(expected) {
            assert!((x - expected).abs() < 1e-3, "{scheme}: {x} for {expected}");
        }
    }
}

#[test]
fn a_start_outside_of_a_condition_is_refused() {
    let condition = ("x > 0", "e");
    ends(&Ramp::default(), [-1.0, 0.5], (0.5, 0.0, -1.0), condition);
    ends(&Turn::default(), [-1.0, 0.5], (0.5, 0.0, -1.0), condition);
    // within it the truth is known
    comes_to(&Ramp::default(), [1.0, 0.5], 0.5, [1.5, 0.5 + 2.375 / 3.0]);
}

#[test]
fn a_run_ends_where_it_leaves_a_condition() {
    let ramp = Ramp {
        speed: -1.0,
        ..Ramp::default()
    };
    ends(&ramp, [1.0, 0.5], (2.0, 1.0, 0.0), ("x > 0", "e"));
    ends(
        &Clock::default(),
        [1.0],
        (2.0, 1.0, 1.5),
        ("1 - t > 0", "e"),
    );
}

#[test]
fn what_was_computed_is_kept() {
    let ramp = Ramp {
        speed: -1.0,
        ..Ramp::default()
    };
    let stopped = Integrator::new(&ramp, Taylor::tolerance(1e-12))
        .initial(0.0, [1.0, 0.5])
        .run_until(2.0)
        .unwrap_err();
    let at = stopped.solution().at(0.5).expect("a point before the end");
    assert!((at[1] - (0.5 - 0.875 / 3.0)).abs() < 1e-11, "{at}");
}

#[test]
fn a_power_with_an_integer_exponent_goes_through_zero() {
    let energy = |k: f64, [x, v]: [f64; 2]| v * v / 2.0 + x.powf(k);
    let start = [1.0, 0.25];
    for k in [2.0, 4.0] {
        let spring = Spring { k };
        for end in [
            run(&spring, Taylor::tolerance(1e-12), start, 2.0),
            run(&spring, Best::tolerance(1e-12), start, 2.0),
        ] {
            let end = end.unwrap();
            assert!(end[0] < -0.2, "{k}: {end:?}");
            assert!((energy(k, end) - energy(k, start)).abs() < 1e-13, "{k}");
        }
        // the divided difference of x^k takes logarithms
        let end = run(&spring, Symmetric::step_size(0.01), start, 2.0);
        assert!(
            matches!(
                end,
                Err(Error {
                    kind: ErrorKind::LeftDomain,
                    ..
                })
            ),
            "{end:?}"
        );
    }
    // and with another exponent it has no value there
    let end = run(&Spring { k: 2.5 }, Taylor::tolerance(1e-12), start, 2.0);
    assert!(
        matches!(
            end,
            Err(Error {
                kind: ErrorKind::LeftDomain,
                ..
            })
        ),
        "{end:?}"
    );
}

#[test]
fn a_field_is_not_continued_where_it_has_no_value() {
    ends(&Half {}, [-1.0, 0.5], (1.0, 0.0, -1.0), ("x ≥ 0", "e"));
    // on the circle of radius r: x = r/cosh(r t)
    let x = 1.0 / 1f64.cosh();
    comes_to(&Half {}, [1.0, 0.0], 1.0, [x, -1f64.tanh()]);
}

#[test]
fn a_quantity_that_jumps_ends_a_run() {
    let (x, y) = (0.5f64.cos(), 0.5f64.sin());
    let quarter = std::f64::consts::FRAC_PI_2 - 0.5;
    for sign in [1.0, -1.0] {
        let start = [sign * x, sign * y];
        comes_to(
            &Rotation {},
            start,
            1.0,
            [sign * 1.5f64.cos(), sign * 1.5f64.sin()],
        );
        for (scheme, outcome) in all(&Rotation {}, start, 2.0) {
            let error = outcome.expect_err(&scheme);
            match &error.kind {
                ErrorKind::ConditionFails {
                    condition,
                    quantity,
                } => {
                    assert_eq!((*condition, *quantity), ("x ≠ 0", "angle"), "{scheme}");
                }
                // y/x is infinite there, and the equation of a step has no solution
                ErrorKind::NewtonFailed { .. } | ErrorKind::LeftDomain => {}
                _ => panic!("{scheme}: {error}"),
            }
            let t = error.place().expect("a point").t;
            assert!((t - quarter).abs() < 0.05, "{scheme}: {t}");
        }
    }
    // a step that would cross has no discrete field that is consistent
    for (scheme, outcome) in all(&Sign {}, [-0.997, 0.5], 2.0) {
        let error = outcome.expect_err(&scheme);
        match error.kind {
            ErrorKind::ConditionFails { .. } => {}
            ErrorKind::NewtonFailed { .. } => continue,
            _ => panic!("{scheme}: {error}"),
        }
        let Place { t, x, .. } = error.place().expect("a point");
        assert!((t - 0.997).abs() < 0.05, "{scheme}: {t}");
        assert!(
            x[0].abs() < 0.05 && (x[1] - 0.5).abs() < 1e-3,
            "{scheme}: {x:?}"
        );
    }
    comes_to(&Sign {}, [1.0, 0.5], 2.0, [3.0, 0.5]);
    comes_to(&Sign {}, [-1.0, 0.5], 0.5, [-0.5, 0.5]);
}

#[test]
fn a_condition_on_parameters_is_checked_at_the_start() {
    comes_to(&Rates::default(), [1.0, 1.0], 1.0, [3.0, 3.0]);
    let negative = Rates { a: -1.0, k: 2.0 };
    ends(&negative, [1.0, 1.0], (1.0, 0.0, 1.0), ("a > 0", "e"));
}

#[test]
fn a_condition_is_checked_where_a_region_is_entered() {
    let gate = Gate::default();
    ends(&gate, [0.5, -1.0], (2.0, 1.0, -0.5), ("x > 0", "e"));
    let decay = (-1f64).exp();
    comes_to(&gate, [2.0, -1.0], 2.0, [decay, 1.0]);
}

#[test]
fn a_region_gives_the_sign_that_a_proof_needs() {
    assert!(Wall {}.metadata().conditions.is_empty());
    comes_to(&Wall {}, [1.0, 0.0], 1.0, [0.5, -1.0]);
    comes_to(&Wall {}, [-1.0, 0.0], 1.0, [-0.5, 1.0]);
}

#[test]
fn a_member_of_an_ensemble_ends_by_itself() {
    let ramp = Ramp {
        speed: -1.0,
        ..Ramp::default()
    };
    let members = [0.5, 3.0, -1.0, 1.5].map(|x| Member::new(ramp, 0.0, [x, 0.0]));
    let outcomes = Ensemble::new(Taylor::tolerance(1e-12)).collect_until(1.0, members);
    let fails = outcomes.iter().map(|outcome| {
        let kind = outcome.as_ref().err().map(|halted| &halted.error().kind);
        matches!(kind, Some(ErrorKind::ConditionFails { .. }))
    });
    assert_eq!(fails.collect::<Vec<bool>>(), [true, false, true, false]);
}

#[test]
fn the_listing_names_what_is_checked() {
    let ramp = Ramp::default();
    assert!(ramp.listing().contains("checked"), "{}", ramp.listing());
    assert!(ramp.listing().contains("x > 0"));
    assert!(!Wall {}.listing().contains("checked"));
}
