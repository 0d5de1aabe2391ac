//! Events in time: a mass that is kicked and whose force turns, and a population that is halved.

use dmm_runtime::TransitionKind::Jumped;

use super::solution::{Solution, Spring, logistic};
use super::{Case, Failure};

#[test]
fn orders_through_kicks() -> Result<(), Failure> {
    let mut solution = Solution::default();
    let mut at = [0.5, 0.0];
    let mut force = 1.0;
    for _ in 0..32 {
        let spring = Spring {
            growth: -0.05,
            stiffness: 1.0,
            centre: force,
        };
        let flow = move |time| spring.flow(at, time);
        solution.go(2.3, Jumped, move |time| flow(time).to_vec());
        let [x, v] = flow(2.3);
        at = [x, v + 0.2 * x];
        force = -force;
    }
    Case {
        declaration: "system Kicks {
            state x, v;
            discrete force = 1;
            der(x) = v;
            der(v) = force - x - 0.1*v;
            every 2.3 { v = v + 0.2*x; force = -force; }
        }",
        initial: &[0.5, 0.0],
        solution,
        events: &[10, 30],
        is_located: false,
        schemes: 3,
    }
    .check()
}

#[test]
fn orders_through_a_nonlinear_growth_that_is_cut_in_time() -> Result<(), Failure> {
    let mut solution = Solution::default();
    let mut x = 0.1;
    for _ in 0..32 {
        let start = x;
        solution.go(2.3, Jumped, move |time| {
            vec![logistic(1.0, start, 1.5 * time)]
        });
        x = 0.3 * logistic(1.0, start, 1.5 * 2.3);
    }
    Case {
        declaration: "system Cut {
            state x;
            der(x) = 1.5*x*(1 - x);
            every 2.3 { x = 0.3*x; }
        }",
        initial: &[0.1],
        solution,
        events: &[10, 30],
        is_located: false,
        schemes: 3,
    }
    .check()
}
