//! Changes of a discrete state: relays with hysteresis.

use dmm_runtime::TransitionKind::Jumped;

use super::solution::{Solution, Spring, first_zero, logistic, logistic_time};
use super::{Case, Failure};

#[test]
fn orders_through_the_switching_of_a_relay() -> Result<(), Failure> {
    let mut solution = Solution::default();
    let mut at = [0.0, 0.0];
    let mut relay = 1.0;
    for _ in 0..32 {
        let spring = Spring {
            growth: -0.2,
            stiffness: 1.0,
            centre: relay,
        };
        let flow = move |time| spring.flow(at, time);
        let bound = 0.3 * relay;
        let time = first_zero(|time| flow(time)[0] - bound);
        solution.go(time, Jumped, move |time| flow(time).to_vec());
        at = flow(time);
        relay = -relay;
    }
    Case {
        declaration: "system Relay {
            state x, v;
            discrete relay = 1;
            interface high = x - 0.3;
            interface low = x + 0.3;
            der(x) = v;
            der(v) = relay - x - 0.4*v;
            on high rising { relay = -1; }
            on low falling { relay = 1; }
        }",
        initial: &[0.0, 0.0],
        solution,
        events: &[10, 30],
        is_located: true,
        schemes: 3,
    }
    .check()
}

#[test]
fn orders_through_the_switching_of_a_nonlinear_growth() -> Result<(), Failure> {
    let mut solution = Solution::default();
    let (mut x, mut rate, mut bound) = (0.1, 1.0, 0.8);
    for _ in 0..32 {
        let (start, growth) = (x, rate);
        let time = logistic_time(growth, start, bound);
        solution.go(time, Jumped, move |time| {
            vec![logistic(growth, start, time)]
        });
        x = bound;
        (rate, bound) = if rate > 0.0 { (-0.5, 0.3) } else { (1.0, 0.8) };
    }
    Case {
        declaration: "system Harvest {
            state x;
            discrete harvested = 0;
            interface many = x - 0.8;
            interface few = x - 0.3;
            der(x) = x*(1 - 1.5*harvested - x);
            on many rising { harvested = 1; }
            on few falling { harvested = 0; }
        }",
        initial: &[0.1],
        solution,
        events: &[10, 30],
        is_located: true,
        schemes: 3,
    }
    .check()
}
