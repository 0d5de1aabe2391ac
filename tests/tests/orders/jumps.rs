//! Jumps: impacts at a moving wall, and a population that is reaped.

use dmm_runtime::TransitionKind::Jumped;

use super::solution::{Solution, Spring, first_zero, logistic, logistic_time};
use super::{Case, Failure};

#[test]
fn orders_through_impacts() -> Result<(), Failure> {
    // the mass takes up what the wall gives
    const SPRING: Spring = Spring {
        growth: 0.0,
        stiffness: 1.0,
        centre: 0.0,
    };
    let wall = |t: f64| -0.5 + 0.1 * (1.5 * t).sin();
    let speed = |t: f64| 0.15 * (1.5 * t).cos();
    let mut solution = Solution::default();
    let mut at = [1.0, 0.0];
    for _ in 0..32 {
        let (before, start) = (at, solution.t());
        let flow = move |time| SPRING.flow(before, time);
        let time = first_zero(|time| flow(time)[0] - wall(start + time));
        solution.go(time, Jumped, move |time| flow(time).to_vec());
        let [x, v] = flow(time);
        at = [x, -0.8 * v + 1.8 * speed(solution.t())];
    }
    Case {
        declaration: "system Impacts {
            state x, v;
            interface wall = x + 0.5 - 0.1*sin(1.5*t);
            der(x) = v;
            der(v) = -x;
            conserved energy = (x^2 + v^2)/2;
            on wall falling { v = -0.8*v + 1.8*0.15*cos(1.5*t); }
        }",
        initial: &[1.0, 0.0],
        solution,
        events: &[10, 30],
        is_located: true,
        schemes: 3,
    }
    .check()
}

#[test]
fn orders_through_resets_of_a_nonlinear_growth() -> Result<(), Failure> {
    let mut solution = Solution::default();
    let mut x = 0.1;
    for _ in 0..32 {
        let start = x;
        let time = logistic_time(1.0, start, 0.8);
        solution.go(time, Jumped, move |time| vec![logistic(1.0, start, time)]);
        x = 0.2 + 0.05 * solution.t().sin();
    }
    Case {
        declaration: "system Reaped {
            state x;
            interface ripe = x - 0.8;
            der(x) = x*(1 - x);
            on ripe rising { x = 0.2 + 0.05*sin(t); }
        }",
        initial: &[0.1],
        solution,
        events: &[10, 30],
        is_located: true,
        schemes: 3,
    }
    .check()
}
