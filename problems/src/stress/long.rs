//! Conservation within segments over long runs: |ψ − ψ_ref| must not grow with the number of
//! steps, neither on closed orbits, on which floating-point states lock onto a cycle, nor on
//! open ones.

use std::ops::ControlFlow;

use super::growth::Growth;
use super::report::{Extent, Observe, Row, Verdict, kind_of};
use super::setting::Setting;
use crate::method::MethodName;
use crate::picture::{Axis, COLOURS, Panel, Scale, Stroke};
use crate::problem::{AnyObserver, Problem, Record, Run};
use crate::registry::find;

/// Evaluating ψ costs two or three roundings of its terms, the state's own one each.
const BOUND: f64 = 8.0;

/// A problem, a setting, and the number of steps in the full study.
const CASES: [(&str, Setting, u64); 6] = [
    (
        "harmonic",
        Setting::steps("Symmetric", MethodName::Symmetric, 1e-3),
        1_000_000_000,
    ),
    (
        "elliptic",
        Setting::steps("Symmetric", MethodName::Symmetric, 1e-3),
        100_000_000,
    ),
    (
        "pendulum",
        Setting::steps("Symmetric", MethodName::Symmetric, 0.037),
        100_000_000,
    ),
    (
        "henon_heiles",
        Setting::steps("Symmetric", MethodName::Symmetric, 0.05),
        20_000_000,
    ),
    (
        "henon_heiles",
        Setting::tolerance("Taylor 1e-3", MethodName::Taylor, 1e-3),
        10_000_000,
    ),
    (
        "henon_heiles",
        Setting::tolerance("Taylor 1e-12", MethodName::Taylor, 1e-12),
        10_000_000,
    ),
];

pub(super) fn study(extent: Extent, observer: &mut dyn Observe) -> Vec<Panel> {
    let mut panel = Panel::new(
        "within segments",
        Axis::new("steps", Scale::Decades),
        Axis::new(
            "largest |ψ − ψ_ref| so far (ulp of ψ's terms)",
            Scale::Decades,
        ),
    );
    for (k, (name, setting, steps)) in CASES.into_iter().enumerate() {
        let what = format!("{name}, {}", setting.name);
        observer.begins(&what);
        let Ok(problem) = find(name) else {
            continue;
        };
        let (row, growth) = measure(&problem, &setting, steps / extent.of(1, 5000));
        observer.ended(row);
        let colour = COLOURS[k % COLOURS.len()];
        panel.curve(Some(what), growth.points(), Stroke::Marked, colour);
    }
    vec![panel]
}

/// |ψ − ψ_ref| over a number of steps.
struct Meter {
    growth: Growth,
    steps: u64,
    wanted: u64,
}

impl AnyObserver for Meter {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        self.growth.offer(self.steps as f64, record.error_ulps());
        self.steps += 1;
        if self.steps > self.wanted {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

fn measure(problem: &Problem, setting: &Setting, steps: u64) -> (Row, Growth) {
    let mut meter = Meter {
        growth: Growth::new(),
        steps: 0,
        wanted: steps,
    };
    let run = Run {
        // the meter stops the run
        t_end: 10.0 * steps as f64 * setting.step_size,
        ..setting.run(problem)
    };
    let result = problem.integrate(&run, &mut meter);
    let (ulps, exponent) = (meter.growth.largest(), meter.growth.exponent());
    let what = format!("{}, {:.0e} steps", problem.description().name, steps as f64);
    let row = match result {
        Ok(statistics) => Row::new(
            what,
            setting.name,
            Verdict::within(ulps <= BOUND),
            format!(
                "{ulps:.2} ulp after {} transitions, growing with the power {exponent:.2}",
                statistics.transitions
            ),
        ),
        // nothing stands in the way of these runs
        Err(error) => Row::new(what, setting.name, Verdict::Wrong, kind_of(&error)),
    };
    (row, meter.growth)
}
