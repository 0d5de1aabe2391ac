//! What sensitivities cost: the time that they take as a multiple of the time of the run. Forward for
//! all directions and for one, the gradient of one number by the adjoint, and second derivatives.
//!
//! ```sh
//! cargo bench -p dmm-runtime --bench sensitivity_cost
//! ```

use std::time::Instant;

use dmm_runtime::{
    Composed, Error, Functional, Integrator, Method, RungeKutta, Symmetric, Taylor, Vector, pws,
};

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

/// The components of the state, and the parameters.
const DIRECTIONS: usize = 3 + 8;
const ROUNDS: usize = 15;

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// The time that something takes, and its result.
fn timed<R>(run: impl FnOnce() -> Result<R, Error>) -> Result<(f64, R), Error> {
    let start = Instant::now();
    let result = run()?;
    Ok((start.elapsed().as_secs_f64(), result))
}

fn cost(name: &str, method: impl Method) -> Result<(), Error> {
    let system = Pendulum::default();
    let t_end = 50.0;
    let mut times = [const { Vec::new() }; 4];
    let mut transitions = 0;
    for _ in 0..ROUNDS {
        let integrator = Integrator::new(&system, method.clone()).initial(0.0, [0.1, 0.6, 0.0]);
        let (plain, solution) = timed(|| Ok(integrator.run_until(t_end)?))?;
        let (forward, _) = timed(|| solution.sensitivities())?;
        let weights = Vector::from([1.0, 0.0, 0.0]);
        let number = Functional::State { t: t_end, weights };
        let (adjoint, _) = timed(|| solution.gradients(&[number]))?;
        let (second, _) = timed(|| solution.second_sensitivities())?;
        for (all, time) in times.iter_mut().zip([plain, forward, adjoint, second]) {
            all.push(time);
        }
        transitions = solution.transitions().len();
    }
    let [plain, forward, adjoint, second] = times.map(median);
    println!(
        "{name:<24} {:>8.1} {:>15.2} {:>9.1} {:>8.0} {transitions:>12}",
        forward / plain,
        forward / plain / DIRECTIONS as f64,
        adjoint / plain,
        second / plain,
    );
    Ok(())
}

fn main() -> Result<(), Error> {
    println!("time / run                forward  for a direction   adjoint   second  transitions");
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
