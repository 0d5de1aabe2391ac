//! Runge–Kutta methods keep their order through switches (Nurkanović, Sperl, Albrecht & Diehl, Numer.
//! Math. 156, 2024, theorem 17 and Fig. 8), and ψ with the correction of the level.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use dmm_problems::conservation::measure;
use dmm_problems::fit::fitted_order;
use dmm_problems::method::{Control, MethodName};
use dmm_problems::problem::Problem;
use dmm_problems::registry::find;
use dmm_runtime::dynamic::{AnyObserver, Record};

/// The last point of a run.
#[derive(Default)]
struct Last {
    x: Vec<f64>,
}

impl AnyObserver for Last {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        self.x = record.x.to_vec();
        ControlFlow::Continue(())
    }
}

/// The error at T = π/2 of their eq. (47), which switches at t = 1. (In the solution that the paper
/// prints, x₂ has the other sign.)
fn error(problem: &Problem, method: MethodName, steps: u32) -> f64 {
    let t_end = PI / 2.0;
    let mut run = problem.default_run();
    run.method = method;
    run.step_size = t_end / f64::from(steps);
    run.t_end = t_end;
    // which would take off all errors but those of the angle
    run.level_correction = false;
    let mut last = Last::default();
    problem.integrate(&run, &mut last).unwrap();
    let x = last.x;
    let (size, angle) = ((t_end - 1.0).exp(), 2.0 * PI * (t_end - 1.0));
    (x[0] - size * angle.cos()).hypot(x[1] - size * angle.sin())
}

#[test]
fn every_family_keeps_its_order_through_a_switch() {
    let problem = find("spiral").unwrap();
    for &method in MethodName::RUNGE_KUTTA {
        let Control::StepSize { order } = method.control() else {
            continue;
        };
        // as far as rounding allows
        let counts = (0..24).map(|k| (8.0 * 2.0f64.powf(0.5 * f64::from(k))) as u32);
        let errors = counts.map(|n| (1.0 / f64::from(n), error(&problem, method, n)));
        let far = errors.skip_while(|(_, error)| *error > 0.1);
        let used: Vec<_> = far.take_while(|(_, error)| *error > 1e-12).collect();
        let last = &used[used.len().saturating_sub(4)..];
        let (sizes, errors): (Vec<_>, Vec<_>) = last.iter().copied().unzip();
        assert!(sizes.len() > 2, "{}: {used:?}", method.name());
        let fitted = fitted_order(&sizes, &errors);
        println!("{:20} {order} {fitted:.2}", method.name());
        let off = (fitted - f64::from(order)).abs();
        // steps of order 9 are at the level of rounding before they are short
        let allowed = if order > 8 { 0.9 } else { 0.15 };
        assert!(off < allowed, "{}: order {fitted}, {used:?}", method.name());
    }
}

/// The points of a run, with their regions.
#[derive(Default)]
struct Points(Vec<(f64, Vec<f64>, usize)>);

impl AnyObserver for Points {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        (self.0).push((record.t, record.x.to_vec(), record.mode.region));
        ControlFlow::Continue(())
    }
}

/// Stewart's form of the paper (eqs 12–13): g = −S c with S = (−1, 1)ᵀ, θ the unit vector of the
/// region, μ = min g and λ = g − μ. A step does not change its region, so that θᵢ λⱼᵢ = 0 for every
/// point j of it, both ends included: cross complementarity (eq. 28). Steps between switches have one
/// size (eq. 31) but for those that lead from a switch to the grid, and from the grid to a switch.
#[test]
fn active_sets_change_at_the_ends_of_steps() {
    const TAU: f64 = 0.01;
    let problem = find("spiral").unwrap();
    for &method in MethodName::RUNGE_KUTTA {
        let mut run = problem.default_run();
        (run.method, run.step_size) = (method, TAU);
        let mut points = Points::default();
        problem.integrate(&run, &mut points).unwrap();
        let multiplier = |x: &[f64], region: usize| {
            let c = problem.switching_function(0, 0.0, x);
            let g = [c, -c];
            g[region] - g[0].min(g[1])
        };
        let mut others = 0;
        for pair in points.0.windows(2) {
            let [(t0, x0, region), (t1, x1, end)] = pair else {
                continue;
            };
            if t0 == t1 {
                continue;
            }
            assert_eq!(region, end);
            for x in [x0, x1] {
                let product = multiplier(x, *region);
                assert!(
                    product <= 4.0 * f64::EPSILON,
                    "{} {product:e}",
                    method.name()
                );
            }
            others += usize::from((t1 - t0 - TAU).abs() > 1e-12);
        }
        // to the switch, from it to the grid, and to the end
        assert!(others <= 3, "{}: {others}", method.name());
    }
}

#[test]
fn a_corrected_level_is_kept_to_rounding() {
    for name in ["elliptic", "kepler_refraction"] {
        let problem = find(name).unwrap();
        for &method in MethodName::RUNGE_KUTTA {
            let mut run = problem.default_run();
            run.method = method;
            run.step_size = 1.0 / 64.0;
            run.t_end = 10.0;
            let measured = measure(&problem, &run, &mut |_| ControlFlow::Continue(())).unwrap();
            assert!(
                measured.ulps < 32.0,
                "{name}, {}: {}",
                method.name(),
                measured.ulps
            );
        }
    }
}
