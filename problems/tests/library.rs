//! What the library is made of: the registry, schemes by name, fits, references and studies.

mod fit {
    use dmm_problems::fit::fitted_order;

    #[test]
    fn the_fitted_order_of_a_power_is_its_exponent() {
        let step_sizes: Vec<f64> = (4..10).map(|k| 0.5f64.powi(k)).collect();
        let errors: Vec<f64> = step_sizes.iter().map(|tau| 3.0 * tau.powf(1.7)).collect();
        assert!((fitted_order(&step_sizes, &errors) - 1.7).abs() < 1e-12);
        assert!(fitted_order(&step_sizes[..1], &errors[..1]).is_nan());
    }
}

mod growth {
    use dmm_problems::growth::Growth;

    #[test]
    fn the_exponent_of_a_root_is_a_half() {
        let mut growth = Growth::default();
        for n in 0..100_000 {
            growth.offer(f64::from(n), f64::from(n).sqrt());
        }
        assert!((growth.exponent() - 0.5).abs() < 1e-3);
        assert!(growth.points().len() < 40);
    }
}

mod method {
    use dmm_problems::method::{Control, MethodName};

    #[test]
    fn a_name_and_a_control_are_one_scheme() {
        let rows: Vec<_> = MethodName::all()
            .map(|method| (method.name(), method.control() == Control::Tolerance))
            .collect();
        for (i, row) in rows.iter().enumerate() {
            assert!(!rows[..i].contains(row), "{row:?}");
        }
        for method in MethodName::all() {
            let adaptive = method.control() == Control::Tolerance;
            assert_eq!(MethodName::find(method.name(), adaptive), Some(method));
        }
        assert_eq!(MethodName::find("taylor", false), Some(MethodName::Taylor));
        assert_eq!(MethodName::find("leapfrog", false), None);
    }
}

mod standard {
    use dmm_problems::method::MethodName;
    use dmm_problems::standard::{TwoRegions, integrate};

    /// x(2) of ẋ = −sgn x from x(0) = 1, which slides from t = 1.
    fn slides(method: MethodName, steps: u32) -> f64 {
        let system = TwoRegions {
            below: &|_, _| vec![1.0],
            above: &|_, _| vec![-1.0],
            switching_function: &|_, x| x[0],
        };
        let method = method.runge_kutta().unwrap();
        integrate(&system, method, &[1.0], 2.0, steps).unwrap()[0]
    }

    #[test]
    fn implicit_steps_slide_and_explicit_ones_chatter() {
        for steps in [20, 23] {
            let tau = 2.0 / f64::from(steps);
            for &method in MethodName::RUNGE_KUTTA {
                let x = slides(method, steps).abs();
                assert!(x < 1.5 * tau, "{}: {x}", method.name());
            }
            // the last stage is the end of the step: it is put on the surface
            for method in [
                MethodName::RadauIia1,
                MethodName::RadauIia3,
                MethodName::LobattoIiic3,
            ] {
                let x = slides(method, steps).abs();
                assert!(x < 1e-12, "{}: {x}", method.name());
            }
        }
        assert!(slides(MethodName::Euler, 23).abs() > 1e-3);
    }

    #[test]
    fn smooth_steps_have_the_order_of_the_method() {
        let system = TwoRegions {
            below: &|_, x| vec![x[0]],
            above: &|_, x| vec![x[0]],
            switching_function: &|t, _| t - 2.0,
        };
        for &method in MethodName::RUNGE_KUTTA {
            let error = |steps| {
                let method = method.runge_kutta().unwrap();
                let x = integrate(&system, method, &[1.0], 1.0, steps).unwrap();
                (x[0] - 1f64.exp()).abs()
            };
            let (coarse, fine) = (error(3), error(6));
            let order = (coarse / fine).log2();
            let dmm_problems::method::Control::StepSize { order: theory } = method.control() else {
                continue;
            };
            if fine > 1e-13 {
                assert!(
                    (order - f64::from(theory)).abs() < 0.5,
                    "{}: {order}",
                    method.name()
                );
            }
        }
    }
}

mod registry {
    use dmm_problems::registry::{all, find};

    #[test]
    fn names_are_unique_and_found() {
        let names: Vec<_> = all()
            .iter()
            .map(|problem| problem.description().name)
            .collect();
        for (i, name) in names.iter().enumerate() {
            assert!(!names[..i].contains(name));
            assert_eq!(
                find(&name.replace('_', "-")).unwrap().description().name,
                *name
            );
        }
    }

    #[test]
    fn unknown_names_have_a_suggestion() {
        let suggestion = |name| find(name).err().and_then(|unknown| unknown.closest);
        assert_eq!(suggestion("harmonc").as_deref(), Some("harmonic"));
        assert_eq!(suggestion("kepler").as_deref(), Some("kepler_refraction"));
        assert_eq!(suggestion("qqq"), None);
    }

    #[test]
    fn descriptions_fit_their_systems() {
        for problem in all() {
            let description = problem.description();
            assert_eq!(
                description.initial.len(),
                problem.states().len(),
                "{}",
                description.name
            );
            assert!(
                problem.is_reference_run(description.initial) == description.reference.is_some()
            );
        }
    }
}

mod accurate {
    use dmm_problems::accurate::{crossings, state_at};
    use dmm_problems::reference::Reference;
    use dmm_problems::registry;

    /// |a − b|/|a|
    fn difference(a: &[f64], b: &[f64]) -> f64 {
        let largest = |x: &[f64]| x.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
        let difference: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
        largest(&difference) / largest(a)
    }

    /// Each segment shifts the level by a few 10⁻¹⁶ and with it the period, so that the error
    /// of time grows with the square of the number of segments, of which there are 52 at most.
    const AGREEMENT: f64 = 2e-12;

    #[test]
    fn agrees_with_the_reference_data() {
        for problem in registry::all() {
            let Some(reference) = Reference::of(&problem).unwrap() else {
                continue;
            };
            let initial = problem.description().initial;
            let nodes = crossings(&problem, initial, 50.0, usize::MAX).unwrap();
            let expected = reference
                .crossings
                .iter()
                .filter(|crossing| crossing.t < 50.0);
            // the data list 40 crossings at most
            assert_eq!(
                expected.clone().count(),
                (nodes.len() - 1).min(40),
                "{}",
                problem.description().name
            );
            for (node, crossing) in nodes[1..].iter().zip(expected) {
                assert!(
                    (node.t - crossing.t).abs() < AGREEMENT,
                    "{} {node:?}",
                    problem.description().name
                );
                assert!(difference(&crossing.x, &node.x) < AGREEMENT);
                assert_eq!(Some(node.region), problem.region_on_side(crossing.to));
            }
            for sample in &reference.samples {
                if sample.t <= 50.0 {
                    let from = &nodes[sample.crossings_before as usize];
                    let x = state_at(&problem, from, sample.t).unwrap();
                    let error = difference(&sample.x, &x);
                    assert!(
                        error < AGREEMENT,
                        "{} at {}: {error:e}",
                        problem.description().name,
                        sample.t
                    );
                }
            }
        }
    }

    #[test]
    fn agrees_with_a_closed_form() {
        // in the Pöschl–Teller well sinh q oscillates harmonically
        let problem = registry::find("poschl_teller").unwrap();
        let (q, p): (f64, f64) = (0.5, 0.8);
        let omega = (2.0 * (1.0 - p * p / 2.0 - q.tanh().powi(2))).sqrt();
        let amplitude = (q.sinh().powi(2) + (p * q.cosh() / omega).powi(2)).sqrt();
        let phase = (q.sinh() / amplitude).asin();
        let nodes = crossings(&problem, &[q, p], 20.0, 1).unwrap();
        let x = state_at(&problem, &nodes[0], 20.0).unwrap();
        let expected = (amplitude * (omega * 20.0 + phase).sin()).asinh();
        assert!((x[0] - expected).abs() < AGREEMENT);
    }
}

mod convergence {
    use dmm_problems::convergence::default_after;

    #[test]
    fn defaults_fit_the_number_of_crossings() {
        assert_eq!(default_after(404), [0, 10, 20, 30]);
        assert_eq!(default_after(7), [0, 2, 4, 7]);
        assert_eq!(default_after(1), [0, 1]);
        assert_eq!(default_after(0), [0]);
    }
}

mod work_precision {
    use std::ops::ControlFlow;
    use std::time::Duration;

    use dmm_problems::method::MethodName;
    use dmm_problems::registry;
    use dmm_problems::truth::Origin;
    use dmm_problems::work_precision::{Goal, fastest};

    #[test]
    fn references_end_where_they_have_a_sample() {
        let goal = |name, t| Goal::of(&registry::find(name).unwrap(), t).unwrap();
        assert_eq!(goal("harmonic", None).t, 100.0);
        assert_eq!(goal("kepler_refraction", None).t, 50.0);
        let long = goal("elliptic", Some(1e4));
        assert_eq!((long.t, long.origin), (1e4, Origin::Reference));
        let between = goal("elliptic", Some(9.0));
        assert_eq!((between.t, between.origin), (9.0, Origin::Accurate));
        assert_eq!(goal("toda", None).origin, Origin::Accurate);
        let problem = registry::find("toda").unwrap();
        assert!(Goal::of(&problem, Some(-1.0)).is_err());
    }

    #[test]
    fn finer_settings_have_smaller_errors() {
        let problem = registry::find("harmonic").unwrap();
        let goal = Goal::of(&problem, Some(5.0)).unwrap();
        let settings = goal.measure(
            &problem,
            &[MethodName::Symmetric, MethodName::Taylor],
            2,
            Duration::from_millis(200),
            &mut |_| ControlFlow::Continue(()),
        );
        for method in [MethodName::Symmetric, MethodName::Taylor] {
            let errors: Vec<f64> = settings
                .iter()
                .filter(|setting| setting.method == method)
                .map(|setting| setting.error)
                .collect();
            assert!(errors.len() > 5 && errors[0] > 30.0 * errors[errors.len() - 1]);
            let loose = fastest(&settings, method, 1e-3).unwrap();
            assert!(loose.error <= 1e-3 && loose.seconds.len() == 2);
        }
        assert!(fastest(&settings, MethodName::Taylor, 1e-30).is_none());
    }
}

mod stress {
    use std::ops::ControlFlow;
    use std::thread;

    use dmm_problems::stress::{Extent, Observe, Row, STUDIES, Verdict};

    #[derive(Default)]
    struct Seen {
        begun: usize,
        rows: Vec<Row>,
    }

    impl Observe for Seen {
        fn begins(&mut self, _case: &str) -> ControlFlow<()> {
            self.begun += 1;
            ControlFlow::Continue(())
        }

        fn at(&mut self, share: f64) -> ControlFlow<()> {
            assert!((0.0..=1.0).contains(&share), "{share}");
            ControlFlow::Continue(())
        }

        fn ended(&mut self, row: Row) {
            self.rows.push(row);
        }
    }

    #[test]
    fn nothing_is_wrong_in_silence() {
        thread::scope(|scope| {
            for study in STUDIES {
                scope.spawn(move || {
                    let mut seen = Seen::default();
                    study.run(Extent::Brief, &mut seen);
                    assert!(seen.begun > 1 && seen.rows.len() > 1, "{}", study.name);
                    let mut rows = seen.rows;
                    rows.retain(|row| row.verdict == Verdict::Wrong);
                    assert_eq!(rows, [], "{}", study.name);
                });
            }
        });
    }
}
