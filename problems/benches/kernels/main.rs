//! Generated code beside hand-written kernels of the same schemes.
//!
//! `cargo bench -p dmm-problems --features types --bench kernels` runs them in turn on the same problem and
//! prints the ratio generated / hand-written pair by pair (minimum, median, maximum), with
//! nanoseconds and Newton iterations a step. A run is T = 1000 with τ = 10⁻³: a million steps
//! and 404 (harmonic) or 1056 (elliptic) transitions.
//!
//! The kernels do what the library does — compensated state, the level of ψ kept from the
//! entry into a region, a look at the interface that does not miss double crossings — written
//! out by hand for two variables, with nothing generic left.

mod hand;

use std::time::Instant;

use dmm_problems::systems::elliptic::Elliptic;
use dmm_problems::systems::harmonic::Harmonic;
use dmm_runtime::{Integrator, Symmetric, System};

const STEP_SIZE: f64 = 1e-3;
const END: f64 = 1000.0;
const PAIRS: usize = 15;

/// The end of a run: state, steps, Newton iterations, transitions.
#[derive(Clone, Copy, Debug)]
struct Run {
    x: [f64; 2],
    steps: u64,
    iterations: u64,
    transitions: u64,
}

fn main() {
    let (harmonic, elliptic) = (Harmonic::default(), Elliptic::default());
    compare(
        "harmonic, closed form",
        || generated(&harmonic, [1.0, 1.0]),
        || hand::run::<hand::Harmonic>([1.0, 1.0]),
    );
    compare(
        "elliptic, sweeps",
        || generated(&elliptic, [-1.0, -1.0]),
        || hand::run::<hand::Elliptic>([-1.0, -1.0]),
    );
}

/// T = END by the library.
fn generated<Sys: System<2>>(system: &Sys, x: [f64; 2]) -> Run {
    let end = Integrator::new(system, Symmetric::step_size(STEP_SIZE))
        .initial(0.0, x)
        .observe_until(END, &mut ())
        .map_err(dmm_runtime::Error::from)
        .expect("the problem is integrated to its end");
    Run {
        x: end.point.x.into(),
        steps: end.statistics.steps,
        iterations: end.statistics.newton_iterations,
        transitions: end.statistics.transitions,
    }
}

/// Runs both in turn and prints their ratio.
fn compare(name: &str, generated: impl Fn() -> Run, hand_written: impl Fn() -> Run) {
    let time = |run: &dyn Fn() -> Run| {
        let start = Instant::now();
        let result = std::hint::black_box(run());
        (
            start.elapsed().as_secs_f64() * 1e9 / result.steps as f64,
            result,
        )
    };
    let (_, ours) = time(&generated);
    let (_, theirs) = time(&hand_written);
    // two roundings of the same scheme: equal but for a phase of a few hundred ulps
    let distance = (0..2)
        .map(|i| (ours.x[i] - theirs.x[i]).abs())
        .fold(0.0, f64::max);
    assert!(
        distance < 1e-10 && ours.transitions == theirs.transitions,
        "{ours:?} {theirs:?}"
    );
    let mut pairs: Vec<[f64; 3]> = (0..PAIRS)
        .map(|_| {
            let (a, b) = (time(&generated).0, time(&hand_written).0);
            [a / b, a, b]
        })
        .collect();
    pairs.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let median = pairs[PAIRS / 2];
    let fastest = |i: usize| {
        pairs
            .iter()
            .map(|pair| pair[i])
            .fold(f64::INFINITY, f64::min)
    };
    println!(
        "{name}: generated / hand-written {:.3} (min {:.3}, max {:.3}); ns a step {:.2} / {:.2} \
         (fastest {:.2} / {:.2}); Newton iterations a step {:.3} / {:.3}; transitions {}",
        median[0],
        pairs[0][0],
        pairs[PAIRS - 1][0],
        median[1],
        median[2],
        fastest(1),
        fastest(2),
        ours.iterations as f64 / ours.steps as f64,
        theirs.iterations as f64 / theirs.steps as f64,
        ours.transitions,
    );
}
