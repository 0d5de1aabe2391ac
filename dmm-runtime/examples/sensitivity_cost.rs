//! What sensitivities cost: the time that they take as a multiple of the time of the run.
//!
//! ```sh
//! cargo run --release -p dmm-runtime --example sensitivity_cost
//! ```

use std::time::Instant;

use dmm_runtime::{Composed, Error, Integrator, Method, RungeKutta, Symmetric, Taylor, pws};

pws! {
    /// A pendulum between walls, with eight parameters.
    pub system Pendulum {
        state q, p, s;
        param k = 1.3, e = 0.9, a = 0.4, w = 3, d = 0.01, left = -0.9, right = 0.5, c = 0.1;
        interface stop = q - right;
        interface floor = q - left;
        der(q) = p;
        der(p) = -k * sin(q) - d * p + a * cos(w * t) + c * s;
        der(s) = q - s;
        on stop rising { p = -e * p; }
        on floor falling { p = -e * p; }
    }
}

/// Directions: the states and the parameters.
const DIRECTIONS: usize = 3 + 8;
const ROUNDS: usize = 15;

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn cost(name: &str, method: impl Method) -> Result<(), Error> {
    let system = Pendulum::default();
    let (mut plain, mut derived) = (Vec::new(), Vec::new());
    let mut transitions = 0;
    for _ in 0..ROUNDS {
        let integrator = Integrator::new(&system, method.clone()).initial(0.0, [0.1, 0.6, 0.0]);
        let start = Instant::now();
        let solution = integrator.run_until(50.0)?;
        plain.push(start.elapsed().as_secs_f64());
        let start = Instant::now();
        let sensitivities = solution.sensitivities()?;
        derived.push(start.elapsed().as_secs_f64());
        transitions = sensitivities.transitions().len();
    }
    let factor = median(derived) / median(plain);
    println!(
        "{name:<24} {factor:>7.1} {:>16.2} {transitions:>12}",
        factor / DIRECTIONS as f64
    );
    Ok(())
}

fn main() -> Result<(), Error> {
    println!("sensitivities / run      factor  for a direction  transitions");
    cost("Taylor 1e-12", Taylor::tolerance(1e-12))?;
    cost("Symmetric 0.001", Symmetric::step_size(1e-3))?;
    cost("Composed<6> 0.02", Composed::<6>::step_size(0.02))?;
    cost(
        "Dormand-Prince 0.005",
        RungeKutta::dormand_prince().step_size(5e-3),
    )?;
    cost(
        "Radau IIA 3 0.01",
        RungeKutta::radau_iia::<3>().step_size(0.01),
    )
}
