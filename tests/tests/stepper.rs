//! The stepper: the steps of a run, one at a time, and what may be done between them.

use dmm_runtime::{
    Best, Composed, ErrorKind, Integrator, Method, Stepped, Stepper, Symmetric, System, Taylor, pws,
};

pws! {
    /// An oscillator that stiffens below y = 0, and is damped nowhere.
    pub system Oscillator {
        state x, y;
        param k = 3;
        interface spring = y;
        region above where spring > 0 {
            der(x) = y; der(y) = -x - x^3;
            conserved energy = (y^2 + x^2)/2 + x^4/4;
        }
        region below where spring < 0 {
            der(x) = y; der(y) = -k*x;
            conserved energy = (y^2 + k*x^2)/2;
        }
    }
}

pws! {
    /// Affine on both sides.
    pub system Springs {
        state x, y;
        param k = 3;
        interface spring = y;
        region above where spring > 0 {
            der(x) = y; der(y) = -x;
            conserved energy = (y^2 + x^2)/2;
        }
        region below where spring < 0 {
            der(x) = y; der(y) = -k*x;
            conserved energy = (y^2 + k*x^2)/2;
        }
    }
}

pws! {
    /// Bounded by nothing.
    pub system Duffing {
        state x, y;
        der(x) = y;
        der(y) = -x - x^3;
        conserved energy = (y^2 + x^2)/2 + x^4/4;
    }
}

const START: [f64; 2] = [0.3, 1.0];

fn stepper<Sys: System<2>, Met: Method>(system: &Sys, method: Met) -> Stepper<Sys, Met, 2> {
    Integrator::new(system, method)
        .initial(0.0, START)
        .stepper(40.0)
        .unwrap()
}

/// Every point and transition is that of a run, to the last bit.
fn steps_are_those_of_a_run<Sys: System<2>, Met: Method>(system: &Sys, method: Met) {
    let solution = Integrator::new(system, method.clone())
        .initial(0.0, START)
        .run_until(40.0)
        .unwrap();
    let mut stepper = stepper(system, method);
    let mut points = vec![stepper.point()];
    let mut transitions = Vec::new();
    while let Some(event) = stepper.step().unwrap() {
        match event {
            Stepped::Step(point) => points.push(point),
            Stepped::Transition(transition) => {
                transitions.push(transition);
                points.push(stepper.point());
            }
        }
    }
    assert_eq!(
        transitions,
        solution.transitions(),
        "{}",
        std::any::type_name::<Met>()
    );
    assert!(transitions.len() >= 10);
    assert_eq!(points.len(), solution.points().len());
    for (point, expected) in points.iter().zip(solution.points()) {
        let seen = (point.t, point.x, point.region);
        assert_eq!(seen, (expected.t, expected.x, expected.region));
    }
    assert_eq!(stepper.statistics().steps, solution.statistics().steps);
    assert!(stepper.step().unwrap().is_none());
}

#[test]
fn every_method_steps_as_it_runs() {
    let oscillator = Oscillator::default();
    steps_are_those_of_a_run(&oscillator, Symmetric::step_size(1e-2));
    steps_are_those_of_a_run(&oscillator, Composed::<6>::step_size(5e-2));
    steps_are_those_of_a_run(&oscillator, Symmetric::tolerance(1e-4));
    steps_are_those_of_a_run(&oscillator, Composed::<8>::tolerance(1e-10));
    steps_are_those_of_a_run(&oscillator, Taylor::tolerance(1e-12));
    steps_are_those_of_a_run(&oscillator, Best::tolerance(1e-9));
    steps_are_those_of_a_run(&Springs::default(), Best::tolerance(1e-12));
    steps_are_those_of_a_run(&Springs::default(), Symmetric::step_size(1e-2));
}

/// Steps that nothing bounds go on from states that are near the level; what is shown lies on it.
#[test]
fn points_between_corrections_are_those_of_a_run_and_on_the_level() {
    let system = Duffing::default();
    let energy = |x: &[f64]| (x[1] * x[1] + x[0] * x[0]) / 2.0 + x[0].powi(4) / 4.0;
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12] {
        let method = Taylor::tolerance(tolerance);
        let problem = || Integrator::new(&system, method).initial(0.0, START);
        let solution = problem().run_until(40.0).unwrap();
        let mut stepper = problem().stepper(40.0).unwrap();
        for expected in &solution.points()[1..] {
            let Some(Stepped::Step(point)) = stepper.step().unwrap() else {
                panic!("no step to {}", expected.t);
            };
            assert_eq!((point.t, point.x), (expected.t, expected.x));
            let error = energy(point.x.as_slice()) - energy(&START);
            assert!(error.abs() < 4.0 * f64::EPSILON, "{error:e} at {}", point.t);
        }
        assert!(stepper.step().unwrap().is_none());
        let silent = problem().observe_until(40.0, &mut ()).unwrap();
        assert_eq!(silent.point.x, solution.last().unwrap().x);
    }
}

#[test]
fn a_clone_is_a_checkpoint() {
    let system = Oscillator::default();
    let mut stepper = stepper(&system, Taylor::tolerance(1e-12));
    for _ in 0..7 {
        stepper.step().unwrap();
    }
    let mut checkpoint = stepper.clone();
    while stepper.step().unwrap().is_some() {}
    while checkpoint.step().unwrap().is_some() {}
    assert_eq!(stepper.point(), checkpoint.point());
}

/// A run that is extended is one to the later time, up to rounding errors.
fn goes_on<Sys: System<2>, Met: Method>(system: &Sys, method: Met, bound: f64) {
    let mut stepper = stepper(system, method.clone());
    while stepper.step().unwrap().is_some() {}
    assert_eq!(stepper.point().t, 40.0);
    let early = stepper.extend(39.0).unwrap_err();
    assert!(matches!(early.kind, ErrorKind::InvalidInput { .. }));
    stepper.extend(100.0).unwrap();
    while stepper.step().unwrap().is_some() {}
    let solution = Integrator::new(system, method)
        .initial(0.0, START)
        .run_until(100.0)
        .unwrap();
    let end = solution.last().unwrap();
    assert!((stepper.point().x - end.x).amax() < bound);
}

#[test]
fn the_end_can_be_moved() {
    // two exact flows that were composed of other steps
    goes_on(&Springs::default(), Best::tolerance(1e-12), 1e-13);
    // nodes of two grids, and steps of other sizes, within the tolerance times some growth
    goes_on(&Oscillator::default(), Symmetric::step_size(1e-2), 1e-12);
    goes_on(&Oscillator::default(), Taylor::tolerance(1e-12), 1e-10);
    goes_on(
        &Oscillator::default(),
        Composed::<8>::tolerance(1e-10),
        1e-7,
    );
}

#[test]
fn a_change_is_a_new_start() {
    let system = Springs::default();
    for method in [Best::tolerance(1e-12), Best::tolerance(1e-6)] {
        let mut stepper = stepper(&system, method);
        while stepper.point().t < 10.0 {
            stepper.step().unwrap();
        }
        let from = stepper.point();
        stepper
            .change(|system, x| (system.k, x[0]) = (5.0, x[0] + 1.0))
            .unwrap();
        assert_eq!(stepper.system().k, 5.0);
        while stepper.step().unwrap().is_some() {}
        let mut x = from.x;
        x[0] += 1.0;
        let solution = Integrator::new(&Springs { k: 5.0 }, method)
            .initial(from.t, x)
            .run_until(40.0)
            .unwrap();
        assert!((stepper.point().x - solution.last().unwrap().x).amax() < 1e-13);
        // what cannot be is refused, and nothing has changed
        let before = stepper.point();
        let refused = stepper.change(|system, _| system.k = f64::NAN);
        assert!(refused.unwrap_err().to_string().contains("k = NaN"));
        assert_eq!((stepper.point(), stepper.system().k), (before, 5.0));
    }
}

#[test]
fn a_state_is_set_and_its_region_named() {
    let system = Springs::default();
    let mut stepper = stepper(&system, Best::tolerance(1e-12));
    stepper.step().unwrap();
    stepper.set_state([1, -1]).unwrap();
    assert_eq!(stepper.point().region, SpringsRegion::Below);
    stepper
        .set_state_in(SpringsRegion::Above, [1.0, 1.0])
        .unwrap();
    assert_eq!(stepper.point().region, SpringsRegion::Above);
    // what cannot be is refused, and nothing has changed
    let before = stepper.point();
    let refused = stepper.set_state(&[1.0, 2.0, 3.0][..]).unwrap_err();
    let lengths = ErrorKind::StateLength {
        states: 2,
        given: 3,
    };
    assert_eq!(refused.kind, lengths);
    let refused = stepper.set_state_in(SpringsRegion::Below, [1.0, 1.0]);
    assert!(matches!(
        refused.unwrap_err().kind,
        ErrorKind::InvalidInput { what: "region", .. }
    ));
    assert_eq!(stepper.point(), before);
    while stepper.step().unwrap().is_some() {}
    let solution = Integrator::new(&system, Best::tolerance(1e-12))
        .initial(before.t, vec![1.0, 1.0])
        .run_until(40.0)
        .unwrap();
    assert!((stepper.point().x - solution.last().unwrap().x).amax() < 1e-13);
}
