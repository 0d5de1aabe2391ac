//! Conservation within segments over long runs: |ψ − ψ_ref| must not grow with the number of
//! steps, neither on closed orbits, on which floating-point states lock onto a cycle, nor on
//! open ones.

use std::ops::ControlFlow;

use super::report::{Extent, Observe, Row, Verdict, kind_of};
use super::setting::Setting;
use crate::growth::Growth;
use crate::method::MethodName;
use crate::problem::{AnyObserver, Problem, Record, Run};
use crate::registry::find;
use dmm_picture::{Axis, Look, Panel, Scale, Stroke};

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
        let Ok(problem) = find(name) else {
            continue;
        };
        if observer.begins(&what).is_break() {
            break;
        }
        let steps = steps / extent.of(1, 5000);
        let Some((row, growth)) = measure(&problem, &setting, steps, observer) else {
            break;
        };
        observer.ended(row);
        let look = Look::nth(k);
        panel.curve(Some(what), growth.points(), Stroke::Marked, look);
    }
    vec![panel]
}

/// |ψ − ψ_ref| over a number of steps.
struct Meter<'a> {
    growth: Growth,
    steps: u64,
    wanted: u64,
    is_stopped: bool,
    observer: &'a mut dyn Observe,
}

/// Steps from one word of progress to the next.
const TOLD: u64 = 1 << 14;

impl AnyObserver for Meter<'_> {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        self.growth.offer(self.steps as f64, record.error_ulps());
        self.steps += 1;
        if self.steps > self.wanted {
            return ControlFlow::Break(());
        }
        if self.steps.is_multiple_of(TOLD) {
            let flow = self.observer.at(self.steps as f64 / self.wanted as f64);
            self.is_stopped = flow.is_break();
            return flow;
        }
        ControlFlow::Continue(())
    }
}

/// Nothing if the run was stopped.
fn measure(
    problem: &Problem,
    setting: &Setting,
    steps: u64,
    observer: &mut dyn Observe,
) -> Option<(Row, Growth)> {
    let mut meter = Meter {
        growth: Growth::default(),
        steps: 0,
        wanted: steps,
        is_stopped: false,
        observer,
    };
    let run = Run {
        // the meter stops the run
        t_end: 10.0 * steps as f64 * setting.step_size,
        ..setting.run(problem)
    };
    let result = problem.integrate(&run, &mut meter);
    if meter.is_stopped {
        return None;
    }
    let (ulps, exponent) = (meter.growth.largest(), meter.growth.exponent());
    let what = format!("{}, {:.0e} steps", problem.description().name, steps as f64);
    let row = match result {
        Ok(finish) => Row::new(
            what,
            setting.name,
            Verdict::within(ulps <= BOUND),
            format!(
                "{ulps:.2} ulp after {} transitions, growing with the power {exponent:.2}",
                finish.statistics.transitions
            ),
        ),
        // nothing stands in the way of these runs
        Err(error) => Row::new(what, setting.name, Verdict::Wrong, kind_of(&error)),
    };
    Some((row, meter.growth))
}
