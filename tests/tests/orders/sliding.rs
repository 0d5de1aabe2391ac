//! Stick and slip on a belt that runs the faster the further the mass is: with regions, and with a
//! switch that slides.

use dmm_runtime::TransitionKind::{BeganToSlide, LeftSlide};

use super::solution::{Solution, Spring, first_zero};
use super::{Case, Failure};

/// Speed of the belt at x = 0, and what it gains with x.
const BELT: [f64; 2] = [0.2, 0.1];
/// Friction where the mass slips slowly, and what it loses with the speed of slipping.
const FRICTION: [f64; 2] = [0.4, 0.5];

/// Of sticking, ẋ = v = the speed of the belt.
fn stick(x: f64, time: f64) -> Vec<f64> {
    let rest = BELT[0] / BELT[1];
    let x = (x + rest) * (BELT[1] * time).exp() - rest;
    vec![x, BELT[0] + BELT[1] * x]
}

/// Events 2n − 1 are beginnings of sliding, 2n are ends.
fn case(declaration: &'static str) -> Case {
    let stiffness = 1.0 + FRICTION[1] * BELT[1];
    let slip = Spring {
        growth: FRICTION[1] / 2.0,
        stiffness,
        centre: (FRICTION[0] - FRICTION[1] * BELT[0]) / stiffness,
    };
    // where the spring and the gain of speed need all of the friction
    let end = (FRICTION[0] - BELT[0] * BELT[1]) / (1.0 + BELT[1] * BELT[1]);
    let mut at = [0.3, 0.0];
    let mut solution = Solution::default();
    while solution.len() < 62 {
        let flow = move |time| slip.flow(at, time);
        let time = first_zero(|time| {
            let [x, v] = flow(time);
            v - BELT[0] - BELT[1] * x
        });
        solution.go(time, BeganToSlide, move |time| flow(time).to_vec());
        let [x, _] = flow(time);
        let rest = BELT[0] / BELT[1];
        let time = ((end + rest) / (x + rest)).ln() / BELT[1];
        solution.go(time, LeftSlide, move |time| stick(x, time));
        at = [end, BELT[0] + BELT[1] * end];
    }
    Case {
        declaration,
        initial: &[0.3, 0.0],
        solution,
        events: &[19, 20, 59, 60],
        is_located: true,
        schemes: 3,
    }
}

#[test]
fn orders_through_stick_and_slip_between_regions() -> Result<(), Failure> {
    case(
        "system Belt {
            state x, v;
            let slip = v - 0.2 - 0.1*x;
            interface belt = slip, sliding;
            der(x) = v;
            region faster where belt > 0 { der(v) = -x - 0.4 + 0.5*slip; }
            region slower where belt < 0 { der(v) = -x + 0.4 + 0.5*slip; }
        }",
    )
    .check()
}

#[test]
fn orders_through_stick_and_slip_of_a_switch() -> Result<(), Failure> {
    case(
        "system Friction {
            state x, v;
            let slip = v - 0.2 - 0.1*x;
            der(x) = v;
            der(v) = -x + 0.5*slip - 0.4*(if slip > 0 sliding { 1 } else { -1 });
        }",
    )
    .check()
}

/// A belt of a speed that changes in time, so that the mass may slip either way.
#[test]
fn orders_through_stick_and_slip_on_a_belt_that_turns() -> Result<(), Failure> {
    const FRICTION: f64 = 0.4;
    let speed = |t: f64| 0.2 + 0.3 * (0.7 * t).sin();
    let way = |t: f64| 0.2 * t - 0.3 / 0.7 * (0.7 * t).cos();
    let gain = |t: f64| 0.21 * (0.7 * t).cos();
    let mut at = [0.3, -0.5];
    let mut side = -1.0;
    let mut solution = Solution::default();
    while solution.len() < 62 {
        let (before, start) = (at, solution.t());
        let slip = Spring {
            growth: 0.0,
            stiffness: 1.0,
            centre: -FRICTION * side,
        };
        let flow = move |time| slip.flow(before, time);
        let time = first_zero(|time| flow(time)[1] - speed(start + time));
        solution.go(time, BeganToSlide, move |time| flow(time).to_vec());
        let ([x, _], start) = (flow(time), solution.t());
        // what friction has to give
        let stuck = move |time: f64| x + way(start + time) - way(start);
        let force = |time: f64| stuck(time) + gain(start + time);
        assert!(force(0.0).abs() < FRICTION);
        let time = first_zero(|time| force(time).abs() - FRICTION);
        side = -force(time).signum();
        solution.go(time, LeftSlide, move |time| {
            vec![stuck(time), speed(start + time)]
        });
        at = [stuck(time), speed(solution.t())];
    }
    Case {
        declaration: "system Turning {
            state x, v;
            param speed = 0.2, swing = 0.3;
            interface belt = v - speed - swing*sin(0.7*t), sliding;
            der(x) = v;
            region faster where belt > 0 { der(v) = -x - 0.4; }
            region slower where belt < 0 { der(v) = -x + 0.4; }
        }",
        initial: &[0.3, -0.5],
        solution,
        events: &[19, 20, 59, 60],
        is_located: true,
        schemes: 3,
    }
    .check()
}

/// What is pushed by a force `PUSH` cos(rate t) against dry friction on the ground at rest: while it
/// sticks v is zero, and so is all that v is computed from.
const PUSH: f64 = 0.6;
const DRY: f64 = 0.5;

/// The time until it is pushed harder than friction holds, and the side it goes to; `pull` is the
/// force of a spring.
fn rest(start: f64, rate: f64, pull: f64) -> (f64, f64) {
    let force = |time: f64| PUSH * (rate * (start + time)).cos() + pull;
    assert!(force(0.0).abs() < DRY);
    let time = first_zero(|time| force(time).abs() - DRY);
    (time, force(time).signum())
}

#[test]
fn orders_through_stick_and_slip_on_the_ground() -> Result<(), Failure> {
    const RATE: f64 = 0.5;
    let mut solution = Solution::default();
    let (mut at, mut side) = ([0.3, 0.5], 1.0);
    while solution.len() < 62 {
        // in step with the force, and a free oscillation about that
        let free = Spring {
            growth: 0.0,
            stiffness: 1.0,
            centre: -side * DRY,
        };
        let size = PUSH / (1.0 - RATE * RATE);
        let start = solution.t();
        let forced = move |time: f64| {
            let (sin, cos) = (RATE * (start + time)).sin_cos();
            [size * cos, -RATE * size * sin]
        };
        let [x, v] = forced(0.0);
        let before = [at[0] - x, at[1] - v];
        let flow = move |time| {
            let (free, forced) = (free.flow(before, time), forced(time));
            [free[0] + forced[0], free[1] + forced[1]]
        };
        let time = first_zero(|time| flow(time)[1]);
        solution.go(time, BeganToSlide, move |time| flow(time).to_vec());
        let x = flow(time)[0];
        let (time, to) = rest(solution.t(), RATE, -x);
        solution.go(time, LeftSlide, move |_| vec![x, 0.0]);
        (at, side) = ([x, 0.0], to);
    }
    Case {
        declaration: "system Ground {
            state x, v;
            der(x) = v;
            der(v) = 0.6*cos(0.5*t) - x - 0.5*(if v > 0 sliding { 1 } else { -1 });
        }",
        initial: &[0.3, 0.5],
        solution,
        events: &[19, 20, 59, 60],
        is_located: true,
        schemes: 3,
    }
    .check()
}

#[test]
fn orders_through_stick_and_slip_where_all_states_are_zero() -> Result<(), Failure> {
    const RATE: f64 = 1.3;
    let mut solution = Solution::default();
    let (mut v, mut side) = (0.3, 1.0);
    while solution.len() < 62 {
        let start = solution.t();
        let (before, friction) = (v, side * DRY);
        let flow = move |time: f64| {
            let push = (RATE * (start + time)).sin() - (RATE * start).sin();
            before + PUSH / RATE * push - friction * time
        };
        let time = first_zero(flow);
        solution.go(time, BeganToSlide, move |time| vec![flow(time)]);
        let (time, to) = rest(solution.t(), RATE, 0.0);
        solution.go(time, LeftSlide, |_| vec![0.0]);
        (v, side) = (0.0, to);
    }
    Case {
        declaration: "system Pushed {
            state v;
            der(v) = 0.6*cos(1.3*t) - 0.5*(if v > 0 sliding { 1 } else { -1 });
        }",
        initial: &[0.3],
        solution,
        events: &[19, 20, 59, 60],
        is_located: true,
        schemes: 2,
    }
    .check()
}
