//! A spring and a damping that change where a mass passes a point: with regions, and with a switch.

use dmm_runtime::TransitionKind::Crossed;

use super::solution::{Solution, Spring, first_zero};
use super::{Case, Failure};

const RIGHT: Spring = Spring {
    growth: -0.03,
    stiffness: 1.0,
    centre: 0.0,
};
const LEFT: Spring = Spring {
    growth: 0.03,
    stiffness: 3.0,
    centre: 0.1,
};
const PLACE: f64 = 0.25;

fn case(declaration: &'static str) -> Case {
    let mut solution = Solution::default();
    let mut at = [1.0, 0.5];
    for n in 0..32 {
        let spring = if n % 2 == 0 { RIGHT } else { LEFT };
        let flow = move |time| spring.flow(at, time);
        let time = first_zero(|time| flow(time)[0] - PLACE);
        solution.go(time, Crossed, move |time| flow(time).to_vec());
        at = flow(time);
    }
    Case {
        declaration,
        initial: &[1.0, 0.5],
        solution,
        events: &[10, 30],
        is_located: true,
        schemes: 3,
    }
}

#[test]
fn orders_through_crossings_of_regions() -> Result<(), Failure> {
    case(
        "system Springs {
            state x, v;
            interface place = x - 0.25;
            der(x) = v;
            region right where place > 0 { der(v) = -0.06*v - x; }
            region left where place < 0 { der(v) = 0.06*v - 3*(x - 0.1); }
        }",
    )
    .check()
}

#[test]
fn orders_through_crossings_of_a_switch() -> Result<(), Failure> {
    case(
        "system Switch {
            state x, v;
            der(x) = v;
            der(v) = if x > 0.25 { -0.06*v - x } else { 0.06*v - 3*(x - 0.1) };
        }",
    )
    .check()
}
