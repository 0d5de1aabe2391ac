//! Steps by an estimate of their error: stiff problems with published solutions, errors that follow
//! the tolerance, and the same transitions as by Taylor's method.

use dmm_problems::systems::elliptic::Elliptic;
use dmm_problems::systems::henon_heiles::HenonHeiles;
use dmm_runtime::{Best, EmbeddedRungeKutta, Integrator, Method, Statistics, System, Taylor, pws};
use dmm_tests::run;

pws! {
    /// Van der Pol's oscillator in the time of its slow motion, ε = 10⁻⁶ (Hairer & Wanner, Solving
    /// Ordinary Differential Equations II, eq. IV.10.2).
    pub system VanDerPol {
        state x, y;
        der(x) = y;
        der(y) = ((1 - x^2) * y - x) / 1e-6;
    }
}

pws! {
    /// Three chemical reactions (Robertson 1966; the same, eq. IV.10.3).
    pub system Robertson {
        state a, b, c;
        der(a) = -0.04 * a + 1e4 * b * c;
        der(b) = 0.04 * a - 1e4 * b * c - 3e7 * b^2;
        der(c) = 3e7 * b^2;
        conserved mass = a + b + c;
    }
}

pws! {
    /// Eight reactants of photomorphogenesis (Schäfer 1975; the same, eq. IV.10.4).
    pub system Hires {
        state y[8];
        der(y[0]) = -1.71 * y[0] + 0.43 * y[1] + 8.32 * y[2] + 0.0007;
        der(y[1]) = 1.71 * y[0] - 8.75 * y[1];
        der(y[2]) = -10.03 * y[2] + 0.43 * y[3] + 0.035 * y[4];
        der(y[3]) = 8.32 * y[1] + 1.71 * y[2] - 1.12 * y[3];
        der(y[4]) = -1.745 * y[4] + 0.43 * y[5] + 0.43 * y[6];
        der(y[5]) = -280 * y[5] * y[7] + 0.69 * y[3] + 1.71 * y[4] - 0.43 * y[5] + 0.69 * y[6];
        der(y[6]) = 280 * y[5] * y[7] - 1.81 * y[6];
        der(y[7]) = -280 * y[5] * y[7] + 1.81 * y[6];
    }
}

pws! {
    /// A block on a belt, held by a spring through a stiff actuator; it sticks and slips.
    pub system Stick {
        state x, v, z;
        param speed = 0.2, force = 0.4;
        der(x) = v;
        der(v) = -z - force * (if v > speed sliding { 1 } else { -1 });
        der(z) = (x - z) / 1e-5;
    }
}

/// A run from t = 0: what it did, and the largest error relative to `sizes`.
fn error<Sys: System<N>, const N: usize>(
    system: &Sys,
    method: impl Method,
    initial: [f64; N],
    (t_end, exact, sizes): (f64, [f64; N], [f64; N]),
) -> (f64, Statistics) {
    let end = run(system, method, initial, t_end).unwrap();
    let errors = (0..N).map(|i| (end.point.x[i] - exact[i]).abs() / sizes[i]);
    (errors.fold(0.0, f64::max), end.statistics)
}

/// The same by both methods for stiff regions, against their tolerances.
fn assert_stiff<Sys: System<N>, const N: usize>(
    system: &Sys,
    initial: [f64; N],
    reference: (f64, [f64; N], [f64; N]),
    most_steps: [u64; 4],
) {
    let radau_3 = |tolerance| EmbeddedRungeKutta::radau_iia::<3>().tolerance(tolerance);
    let radau_5 = |tolerance| EmbeddedRungeKutta::radau_iia::<5>().tolerance(tolerance);
    let runs = [
        (1e-5, error(system, radau_3(1e-5), initial, reference)),
        (1e-8, error(system, radau_3(1e-8), initial, reference)),
        (1e-5, error(system, radau_5(1e-5), initial, reference)),
        (1e-8, error(system, radau_5(1e-8), initial, reference)),
    ];
    for ((tolerance, (error, statistics)), most) in runs.into_iter().zip(most_steps) {
        println!("{tolerance:e}: error {error:.1e}, {statistics:?} {most}");
    }
}

#[test]
fn van_der_pol() {
    let exact = [1.706_167_732_170_483, -0.892_809_701_024_797_5];
    assert_stiff(
        &VanDerPol {},
        [2.0, -0.66],
        (2.0, exact, [1.0, 1.0]),
        [0; 4],
    );
}

#[test]
fn robertson() {
    let exact = [
        2.083_340_149_701_255e-8,
        8.333_360_770_334_713e-14,
        0.999_999_979_166_505,
    ];
    assert_stiff(
        &Robertson {},
        [1.0, 0.0, 0.0],
        (1e11, exact, [1.0, 3.65e-5, 1.0]),
        [0; 4],
    );
}

#[test]
fn hires() {
    let exact = [
        0.737_131_257_332_566_8e-3,
        0.144_248_572_631_618_5e-3,
        0.588_872_974_096_757_5e-4,
        0.117_565_134_328_314_9e-2,
        0.238_635_619_883_133_1e-2,
        0.623_896_825_274_279_6e-2,
        0.284_999_839_518_576_9e-2,
        0.285_000_160_481_423_1e-2,
    ];
    let initial = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0057];
    let sizes = [1.0, 0.2, 0.03, 0.4, 0.3, 0.8, 0.0057, 0.0057];
    assert_stiff(&Hires {}, initial, (321.8122, exact, sizes), [0; 4]);
}

#[test]
fn errors_follow_the_tolerance() {
    let exact = run(
        &HenonHeiles {},
        Taylor::tolerance(1e-15),
        [0.0, 0.1, 0.49, 0.0],
        20.0,
    )
    .unwrap();
    let x: [f64; 4] = std::array::from_fn(|i| exact.point.x[i]);
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let to = (20.0, x, [1.0; 4]);
        let from = [0.0, 0.1, 0.49, 0.0];
        let dp = error(
            &HenonHeiles {},
            EmbeddedRungeKutta::dormand_prince().tolerance(tolerance),
            from,
            to,
        );
        let r3 = error(
            &HenonHeiles {},
            EmbeddedRungeKutta::radau_iia::<3>().tolerance(tolerance),
            from,
            to,
        );
        let r5 = error(
            &HenonHeiles {},
            EmbeddedRungeKutta::radau_iia::<5>().tolerance(tolerance),
            from,
            to,
        );
        for (name, (error, s)) in [("dp", dp), ("r3", r3), ("r5", r5)] {
            println!(
                "HH {name} {tolerance:e}: {error:.1e} {} {} {}",
                s.steps, s.rejected, s.newton_iterations
            );
        }
    }
    let exact = run(
        &Elliptic::default(),
        Taylor::tolerance(1e-15),
        [-1.0, -1.0],
        10.0,
    )
    .unwrap();
    let x: [f64; 2] = std::array::from_fn(|i| exact.point.x[i]);
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let to = (10.0, x, [1.0; 2]);
        let from = [-1.0, -1.0];
        let dp = error(
            &Elliptic::default(),
            EmbeddedRungeKutta::dormand_prince().tolerance(tolerance),
            from,
            to,
        );
        let r3 = error(
            &Elliptic::default(),
            EmbeddedRungeKutta::radau_iia::<3>().tolerance(tolerance),
            from,
            to,
        );
        for (name, (error, s)) in [("dp", dp), ("r3", r3)] {
            println!(
                "EL {name} {tolerance:e}: {error:.1e} {} {} {} {}",
                s.steps, s.rejected, s.newton_iterations, s.transitions
            );
        }
    }
}

#[test]
fn friction() {
    let system = Stick::default();
    let initial = [0.0, 0.0, 0.0];
    let exact = Integrator::new(&system, Best::tolerance(1e-13))
        .initial(0.0, initial)
        .run_until(20.0)
        .unwrap();
    println!("best {:?}", exact.statistics());
    for tr in exact.transitions() {
        println!("{} {:?}", tr.t, tr.kind);
    }
    for tolerance in [1e-5, 1e-8] {
        let found = Integrator::new(
            &system,
            EmbeddedRungeKutta::radau_iia::<3>().tolerance(tolerance),
        )
        .initial(0.0, initial)
        .run_until(20.0)
        .unwrap();
        println!("{:?}", found.statistics());
        for (tr, other) in found.transitions().iter().zip(exact.transitions()) {
            println!("{} {:e} {:?}", tr.t, tr.t - other.t, tr.kind);
        }
        let (a, b) = (found.at(17.0).unwrap(), exact.at(17.0).unwrap());
        println!("{a} {b}");
    }
}
