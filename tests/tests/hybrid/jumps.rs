//! Events: jumps of the state, discrete states, and what happens at given times.

use dmm_runtime::{
    Best, Composed, Error, ErrorKind, Integrator, Mode, Side, Symmetric, Taylor, TransitionKind,
    pws,
};
use dmm_tests::systems::Walls;

use super::{Failure, best, run, same_at_run_time, times};

pws! {
    /// A ball that loses speed where it bounces.
    pub system Ball {
        state y, v;
        param e = 0.5;
        discrete bounces = 0;
        interface floor = y;
        der(y) = v;
        der(v) = -1;
        conserved energy = v^2 / 2 + y;
        on floor falling {
            v = -e * v;
            bounces = bounces + 1;
        }
    }
}

/// The time of bounce number n of the ball dropped from 1/2: 1 + 2 (e + e² + …).
fn bounce(e: f64, n: i32) -> f64 {
    (1..=n).fold(1.0, |sum, k| sum + 2.0 * e.powi(k))
}

#[test]
fn a_ball_bounces_with_every_scheme() -> Result<(), Error> {
    let ball = Ball { e: 0.8 };
    // between two bounces: which of them are before the end is not for rounding errors to decide
    let end = bounce(0.8, 10) - 0.01;
    // the flow is a polynomial of degree 2: every scheme has it exactly
    let times = [
        times(run(&ball, Best::tolerance(1e-12), [0.5, 0.0], end)?),
        times(run(&ball, Taylor::tolerance(1e-12), [0.5, 0.0], end)?),
        times(run(&ball, Symmetric::step_size(0.3), [0.5, 0.0], end)?),
        times(run(&ball, Composed::<4>::step_size(0.7), [0.5, 0.0], end)?),
        times(run(&ball, Symmetric::tolerance(1e-6), [0.5, 0.0], end)?),
    ];
    for times in times {
        assert_eq!(times.len(), 10, "{times:?}");
        for (n, t) in times.iter().enumerate() {
            assert!((t - bounce(0.8, n as i32)).abs() < 2e-14, "{n}: {t}");
        }
    }
    Ok(())
}

#[test]
fn a_transition_tells_what_has_happened() -> Result<(), Failure> {
    let ball = Ball { e: 0.5 };
    let solution = run(&ball, Taylor::tolerance(1e-12), [0.5, 0.0], 2.4)?;
    let [first, second] = solution.transitions() else {
        return Err("two bounces".into());
    };
    assert_eq!(first.kind, TransitionKind::Jumped);
    assert!((first.x[1] + 1.0).abs() < 1e-15 && (first.after[1] - 0.5).abs() < 1e-15);
    assert_eq!((first.from.discrete, first.to.discrete), ([0.0], [1.0]));
    assert_eq!(second.to.region, BallRegion::Everywhere);
    let statistics = solution.statistics();
    assert_eq!(
        (
            statistics.jumped,
            statistics.crossed,
            statistics.transitions
        ),
        (2, 0, 2)
    );
    // between bounces the solution never crosses one
    assert!((solution.at(1.0 + 0.25)?[0] - (0.5 * 0.25 - 0.25 * 0.25 / 2.0)).abs() < 1e-15);
    assert_eq!(solution.last().map(|end| end.region.discrete), Some([2.0]));
    Ok(())
}

#[test]
fn bounces_that_accumulate_end_as_an_error() {
    let stopped = run(&Ball::default(), Best::tolerance(1e-12), [0.5, 0.0], 10.0);
    let error = stopped.map(|_| ()).unwrap_err();
    // 1 + 2 (1/2 + 1/4 + …) = 3
    let t = error.place().map(|place| place.t);
    let accumulates = matches!(error.kind, ErrorKind::Zeno { .. });
    assert!(accumulates && t == Some(3.0), "{error}");
}

#[test]
fn a_corner_turns_both_velocities() -> Result<(), Error> {
    for x0 in [
        [0.25, 0.25, 1.0, 1.0],
        [0.75, 0.25, -1.0, 1.0],
        [0.3, 0.3, -2.0, -2.0],
    ] {
        let end = run(&Walls {}, Taylor::tolerance(1e-12), x0, 40.0)?;
        // the diagonal is run through once in a time of 1/|u|
        let last = end.last().map(|end| end.x).unwrap_or_default();
        let difference = (last - dmm_runtime::Vector::from(x0)).amax();
        assert!(difference < 1e-12, "{difference:e}");
    }
    Ok(())
}

pws! {
    /// A heater with a thermostat that remembers which bound it met last.
    pub system Thermostat {
        state x;
        param low = 18, high = 20;
        discrete on_off = 1;
        interface cold = x - low;
        interface hot = x - high;
        der(x) = 30 * on_off - x;
        on hot rising { on_off = 0; }
        on cold falling { on_off = 1; }
    }
}

#[test]
fn hysteresis_remembers_what_it_met() -> Result<(), Error> {
    let thermostat = Thermostat::default();
    // heating from 18 to 20 towards 30, cooling from 20 to 18 towards 0
    let (up, down) = ((12.0_f64 / 10.0).ln(), (20.0_f64 / 18.0).ln());
    let mut expected = vec![(30.0_f64 / 10.0).ln()];
    while expected.len() < 40 {
        let last = expected[expected.len() - 1];
        expected.push(last + if expected.len() % 2 == 1 { down } else { up });
    }
    for times in [
        times(run(&thermostat, Best::tolerance(1e-12), [0.0], 8.0)?),
        times(run(&thermostat, Taylor::tolerance(1e-14), [0.0], 8.0)?),
    ] {
        assert!(times.len() > 40);
        for (t, expected) in times.iter().zip(&expected) {
            assert!((t - expected).abs() < 1e-13, "{t} {expected}");
        }
    }
    Ok(())
}

pws! {
    /// Doses of a medicine that decays.
    pub system Doses {
        state x;
        param rate = 0.5, interval = 3;
        der(x) = -rate * x;
        every interval { x = x + 1; }
        at 4.05 { x = x / 2; }
    }
}

#[test]
fn events_in_time_are_met_exactly() -> Result<(), Error> {
    let doses = Doses {
        rate: 0.5,
        interval: 0.1,
    };
    let solution = run(&doses, Best::tolerance(1e-14), [0.0], 10.05)?;
    let times: Vec<f64> = times(solution);
    assert_eq!(times.len(), 101);
    let mut expected: Vec<f64> = (1..=100).map(|n| f64::from(n) * 0.1).collect();
    expected.push(4.05);
    expected.sort_by(f64::total_cmp);
    for (t, expected) in times.iter().zip(expected) {
        assert!(
            (t - expected).abs() <= 4.0 * f64::EPSILON * expected,
            "{t} {expected}"
        );
    }
    // a run that starts later goes on with the next one, and not with one at its start
    let late = Integrator::new(&doses, Taylor::tolerance(1e-12))
        .initial(5.0, [1.0])
        .run_until(5.25);
    let late = late.map_err(|stopped| stopped.error().clone())?;
    let late: Vec<f64> = late.transitions().iter().map(|one| one.t).collect();
    assert!(late.len() == 2 && (late[0] - 5.1).abs() < 1e-14, "{late:?}");
    let none = Doses {
        rate: 1.0,
        interval: 0.0,
    };
    let error = run(&none, Taylor::tolerance(1e-12), [0.0], 1.0)
        .map(|_| ())
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "time between events: 0 (must be positive)"
    );
    Ok(())
}

pws! {
    /// A leaky neuron that fires and is silent for a while.
    pub system Neuron {
        state v, clock;
        param input = 2, silent = 0.5;
        discrete firing = 1, spikes = 0;
        interface threshold = v - 1;
        interface wakes = clock - silent;
        der(v) = firing * (input - v);
        der(clock) = 1;
        on threshold rising {
            v = 0;
            clock = 0;
            firing = 0;
            spikes = spikes + 1;
        }
        on wakes rising where firing < 0.5 { firing = 1; }
    }
}

#[test]
fn a_neuron_fires_at_its_rate() -> Result<(), Error> {
    let neuron = Neuron::default();
    let end = run(&neuron, Best::tolerance(1e-12), [0.0, 0.0], 100.0)?;
    // ln 2 to the threshold and the silent time
    let period = 2.0_f64.ln() + 0.5;
    let spikes = 1.0 + ((100.0 - 2.0_f64.ln()) / period).floor();
    assert_eq!(end.last().map(|end| end.region.discrete[1]), Some(spikes));
    let fired: Vec<f64> = (end.transitions().iter())
        .filter(|one| one.interface == 0)
        .map(|one| one.t)
        .collect();
    let last = 2.0_f64.ln() + (spikes - 1.0) * period;
    assert!((fired[fired.len() - 1] - last).abs() < 1e-12);
    Ok(())
}

#[test]
fn a_mode_can_be_named_at_the_start() -> Result<(), Failure> {
    let thermostat = Thermostat::default();
    let off = Mode::<_, 1, 2> {
        sides: [Some(Side::Positive), Some(Side::Negative)],
        ..Mode::new(ThermostatRegion::Everywhere, [0.0])
    };
    let solution = Integrator::new(&thermostat, Best::tolerance(1e-12))
        .initial(0.0, [19.0])
        .region(off)
        .run_until(1.0)?;
    assert!((solution.transitions()[0].t - (19.0_f64 / 18.0).ln()).abs() < 1e-14);
    Ok(())
}

pws! {
    /// Two events that set the same state.
    pub system Both {
        state x, y;
        interface a = x;
        interface b = y;
        der(x) = 1;
        der(y) = 1;
        on a rising { y = y + 1; }
        on b rising { y = y - 1; }
    }
}

#[test]
fn events_at_once_must_agree() {
    let error = run(&Both {}, Taylor::tolerance(1e-12), [-1.0, -1.0], 3.0)
        .map(|_| ())
        .unwrap_err();
    assert!(
        matches!(error.kind, ErrorKind::Conflict { state: "y" }),
        "{error}"
    );
    assert!(run(&Both {}, Taylor::tolerance(1e-12), [-1.0, -0.5], 3.0).is_ok());
}

#[test]
fn systems_compiled_at_run_time_have_the_same_events() -> Result<(), Failure> {
    same_at_run_time(&Ball::default(), [0.5, 0.0], 2.9)?;
    same_at_run_time(&Walls {}, [0.2, 0.3, 0.7, 1.1], 50.0)?;
    same_at_run_time(&Thermostat::default(), [0.0], 8.0)?;
    same_at_run_time(&Doses::default(), [0.0], 20.0)?;
    same_at_run_time(&Neuron::default(), [0.0, 0.0], 30.0)?;
    Ok(())
}

#[test]
fn what_an_event_stops_rests_on_its_interface() -> Result<(), Failure> {
    // a rectifier: the current stops at zero and comes again when the voltage drives it
    let declaration = "system Rectifier {
        state i, c;
        param r = 0.3;
        discrete conducts = 1;
        interface current = i;
        interface forward = sin(t);
        der(i) = conducts*(sin(t) - r*i);
        der(c) = 1;
        on current falling { conducts = 0; i = 0; }
        on forward rising { conducts = 1; }
    }";
    let end = best(declaration, 1e-13, &[0.1, 0.0], 60.0)?;
    // i stops once a period and goes on once
    assert_eq!(end.statistics.transitions, 18);
    assert!(end.x[0] >= 0.0);
    let stop = "system Stop {
        state x;
        discrete moving = 1;
        interface floor = x;
        der(x) = -moving;
        on floor falling { moving = 0; }
    }";
    let end = best(stop, 1e-13, &[1.0], 3.0)?;
    assert_eq!((end.statistics.transitions, end.x), (1, vec![0.0]));
    Ok(())
}
