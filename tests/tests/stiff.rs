//! Steps by an estimate of their error: stiff problems with published solutions, errors that follow
//! the tolerance, and the same transitions as by Taylor's method.

use dmm_problems::systems::elliptic::Elliptic;
use dmm_problems::systems::henon_heiles::HenonHeiles;
use dmm_runtime::{
    Best, EmbeddedRungeKutta, Integrator, Matrix, Method, Statistics, System, Taylor, Vector, pws,
};
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
    /// A block on a belt, held by a spring through a stiff actuator and pushed by a force that
    /// grows with its speed; it sticks and slips.
    pub system Stick {
        state x, v, z;
        param speed = 0.2, force = 0.4;
        der(x) = v;
        der(v) = 0.3 * v - z - force * (if v > speed sliding { 1 } else { -1 });
        der(z) = (x - z) / 1e-5;
    }
}

pws! {
    /// A relay that controls 1/(s (s + 1)(s + 2)) (Tsypkin, Relay Control Systems).
    pub system Relay {
        state y, v, a;
        interface output = y;
        der(y) = v;
        der(v) = a;
        region over where output > 0 { der(a) = -3 * a - 2 * v - 1; }
        region under where output < 0 { der(a) = -3 * a - 2 * v + 1; }
    }
}

const DORMAND_PRINCE: EmbeddedRungeKutta = EmbeddedRungeKutta::dormand_prince();
const RADAU_3: EmbeddedRungeKutta = EmbeddedRungeKutta::radau_iia::<3>();
const RADAU_5: EmbeddedRungeKutta = EmbeddedRungeKutta::radau_iia::<5>();

/// The largest difference of two states relative to `sizes`.
fn difference<const N: usize>(x: &Vector<f64, N>, exact: &[f64; N], sizes: &[f64; N]) -> f64 {
    let parts = (0..N).map(|i| (x[i] - exact[i]).abs() / sizes[i]);
    parts.fold(0.0, f64::max)
}

/// A stiff problem at two tolerances, by each method: errors, relative to the largest size that each
/// component has had, within a small factor of the tolerance, and the number of all attempts to
/// make a step.
fn assert_stiff<Sys: System<N>, const N: usize>(
    system: &Sys,
    initial: [f64; N],
    (t_end, exact, sizes): (f64, [f64; N], [f64; N]),
    most_attempts: [u64; 4],
) {
    let settings = [
        (RADAU_3, 1e-5),
        (RADAU_3, 1e-8),
        (RADAU_5, 1e-5),
        (RADAU_5, 1e-8),
    ];
    for ((method, tolerance), most) in settings.into_iter().zip(most_attempts) {
        let end = run(system, method.tolerance(tolerance), initial, t_end).unwrap();
        let error = difference(&end.point.x, &exact, &sizes);
        let made = end.statistics;
        // local errors add up, and grow where the problem is not stable
        assert!(error < 20.0 * tolerance, "{tolerance:e}: {error:e}");
        assert!(
            made.steps + made.rejected <= most,
            "{tolerance:e}: {made:?}"
        );
    }
}

#[test]
fn van_der_pol() {
    // the largest |y| is about 4/(3ε) between the slow motions
    let exact = [1.706_167_732_170_483, -0.892_809_701_024_797_5];
    let reference = (2.0, exact, [2.0, 1.0]);
    assert_stiff(&VanDerPol {}, [2.0, 0.0], reference, [300, 800, 200, 250]);
}

#[test]
fn robertson() {
    let exact = [
        2.083_340_149_701_255e-8,
        8.333_360_770_334_713e-14,
        0.999_999_979_166_505,
    ];
    let reference = (1e11, exact, [1.0, 3.6e-5, 1.0]);
    assert_stiff(
        &Robertson {},
        [1.0, 0.0, 0.0],
        reference,
        [150, 400, 100, 130],
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
    // rounded, from the solution
    let sizes = [1.0, 0.15, 0.04, 0.37, 0.29, 0.7, 0.0057, 0.0057];
    assert_stiff(
        &Hires {},
        initial,
        (321.8122, exact, sizes),
        [150, 300, 60, 80],
    );
}

#[test]
fn errors_follow_the_tolerance() {
    let henon = [0.0, 0.1, 0.49, 0.0];
    let smooth = run(&HenonHeiles {}, Taylor::tolerance(1e-15), henon, 20.0).unwrap();
    let elliptic = Elliptic::default();
    let switched = run(&elliptic, Taylor::tolerance(1e-15), [-1.0, -1.0], 10.0).unwrap();
    for method in [DORMAND_PRINCE, RADAU_3, RADAU_5] {
        for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
            let by = method.tolerance(tolerance);
            let end = run(&HenonHeiles {}, by, henon, 20.0).unwrap();
            let error = (end.point.x - smooth.point.x).norm();
            let statistics = end.statistics;
            assert!(error < 10.0 * tolerance, "{tolerance:e}: {error:e}");
            assert!(error > 1e-4 * tolerance, "{tolerance:e}: {error:e}");
            assert!(statistics.rejected <= 2 + statistics.steps / 10);

            // ten transitions, at which phase errors grow
            let end = run(&elliptic, by, [-1.0, -1.0], 10.0).unwrap();
            let error = (end.point.x - switched.point.x).norm();
            assert!(error < 50.0 * tolerance, "{tolerance:e}: {error:e}");
            assert_eq!(end.statistics.transitions, 10);
        }
    }
}

#[test]
fn conserved_quantities_are_kept_to_rounding() {
    for method in [DORMAND_PRINCE, RADAU_3, RADAU_5] {
        let kept = |corrects| {
            let by = method.tolerance(1e-4).level_correction(corrects);
            let solution = Integrator::new(&HenonHeiles {}, by)
                .initial(0.0, [0.0, 0.1, 0.49, 0.0])
                .run_until(50.0)
                .unwrap();
            let energies = solution.points().iter();
            let energies = energies
                .map(|p| HenonHeiles {}.conserved(p.region, p.t, &p.x)[0] - energy_at_start());
            energies.fold(0.0, |largest: f64, error| largest.max(error.abs()))
        };
        // its terms are below 1/8
        assert!(kept(true) < 1e-16, "{:e}", kept(true));
        assert!(kept(false) > 1e-8, "{:e}", kept(false));
    }
}

/// u²/2 + y²/2 − y³/3
fn energy_at_start() -> f64 {
    0.49 * 0.49 / 2.0 + 0.005 - 0.001 / 3.0
}

/// The same transitions at the same times as another method, and the same solution between them.
fn assert_same<Sys: System<N>, const N: usize>(
    system: &Sys,
    (method, other): (impl Method, impl Method),
    (initial, t_end): ([f64; N], f64),
    allowed: f64,
) -> Statistics {
    let found = Integrator::new(system, method)
        .initial(0.0, initial)
        .run_until(t_end)
        .unwrap();
    let exact = Integrator::new(system, other)
        .initial(0.0, initial)
        .run_until(t_end)
        .unwrap();
    assert_eq!(found.transitions().len(), exact.transitions().len());
    for (one, other) in found.transitions().iter().zip(exact.transitions()) {
        assert_eq!(one.kind, other.kind);
        assert_eq!((one.from, one.to), (other.from, other.to));
        let error = (one.t - other.t).abs();
        assert!(error < allowed, "{}: {error:e}", other.t);
    }
    for part in 1..=7 {
        let t = t_end * f64::from(part) / 7.0;
        let error = (found.at(t).unwrap() - exact.at(t).unwrap()).norm();
        assert!(error < allowed, "{t}: {error:e}");
    }
    *found.statistics()
}

#[test]
fn a_relay_switches_where_taylors_method_does() {
    let from = ([0.0, 0.3, -0.1], 50.0);
    for method in [DORMAND_PRINCE, RADAU_3, RADAU_5] {
        for tolerance in [1e-5, 1e-8] {
            let methods = (method.tolerance(tolerance), Taylor::tolerance(1e-13));
            let made = assert_same(&Relay {}, methods, from, 20.0 * tolerance);
            assert!(made.transitions > 15, "{made:?}");
        }
    }
}

#[test]
fn stiff_friction_sticks_and_slips() {
    // its flow is known
    let exact = Best::tolerance(1e-13);
    for (method, tolerance) in [(RADAU_3, 1e-5), (RADAU_3, 1e-8), (RADAU_5, 1e-8)] {
        let methods = (method.tolerance(tolerance), exact);
        let made = assert_same(
            &Stick::default(),
            methods,
            ([0.0; 3], 30.0),
            50.0 * tolerance,
        );
        assert!(made.began_to_slide > 3 && made.left_slide > 3, "{made:?}");
        // the actuator alone would allow an explicit method a step of 3·10⁻⁵
        assert!(made.steps + made.rejected < 1000, "{made:?}");
    }
}

#[test]
fn outputs_are_as_good_as_steps() {
    let solution = Integrator::new(&VanDerPol {}, RADAU_3.tolerance(1e-7))
        .initial(0.0, [2.0, 0.0])
        .output_times([0.5, 1.0, 2.0])
        .run_until(2.0)
        .unwrap();
    let x = solution.points()[1].x;
    assert!((x[0] + 1.863_646_254_808_13).abs() < 1e-6, "{x}");
    assert!((x[1] - 0.753_543_086_543_546).abs() < 1e-6, "{x}");
    let between = solution.at(1.0).unwrap();
    assert!((between - x).norm() < 1e-6);
}

/// ∂x(10)/∂x₀ of the Hénon–Heiles potential.
fn derivatives(method: impl Method) -> Matrix<f64, 4, 4> {
    let solution = Integrator::new(&HenonHeiles {}, method)
        .initial(0.0, [0.0, 0.1, 0.49, 0.0])
        .run_until(10.0)
        .unwrap();
    solution.sensitivities().unwrap().last().unwrap().by_initial
}

#[test]
fn sensitivities_are_those_of_the_flow() {
    let exact = derivatives(Taylor::tolerance(1e-15));
    for (method, tolerance) in [(DORMAND_PRINCE, 1e-8), (RADAU_3, 1e-8), (RADAU_5, 1e-11)] {
        let error = (derivatives(method.tolerance(tolerance)) - exact).norm();
        assert!(error < 100.0 * tolerance * exact.norm(), "{error:e}");
    }
}
