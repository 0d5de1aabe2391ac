//! Multipliers of published periodic orbits, as eigenvalues of the derivative of the return map.

use dmm_runtime::nalgebra::{Complex, SMatrix, SVector};
use dmm_runtime::{Best, Integrator, Taylor, pws};

use super::Failure;

pws! {
    /// The simplest walking model (Garcia, Chatterjee, Ruina & Coleman 1998).
    system Walker {
        state theta, phi, omega, phi_dot;
        param gamma = 0.009;
        interface contact = phi - 2 * theta;
        der(theta) = omega;
        der(phi) = phi_dot;
        der(omega) = sin(theta - gamma);
        der(phi_dot) = sin(theta - gamma) + omega^2 * sin(phi) - cos(theta - gamma) * sin(phi);
        on contact rising where theta < -0.05 {
            theta = -theta;
            phi = -2 * theta;
            omega = cos(2 * theta) * omega;
            phi_dot = cos(2 * theta) * (1 - cos(2 * theta)) * omega;
        }
    }
}

pws! {
    /// A voltage-mode controlled buck converter (Fossas & Olivar 1996).
    system BuckConverter {
        state v, i, clock;
        param v_in = 24, r = 22, c = 47e-6, l = 20e-3;
        param gain = 8.4, v_ref = 11.3, low = 3.8, high = 8.2, period = 400e-6;
        interface control = gain * (v - v_ref) - low - (high - low) * clock / period;
        der(v) = i / c - v / (r * c);
        der(clock) = 1;
        region closed where control < 0 { der(i) = (v_in - v) / l; }
        region open where control > 0 { der(i) = -v / l; }
        every period { clock = 0; }
    }
}

/// The pair of complex eigenvalues of a matrix whose others are zero.
fn pair<const N: usize>(map: &SMatrix<f64, N, N>) -> Complex<f64> {
    // of λ, λ̄, 0, …: λ + λ̄ = tr, and tr² − tr(M²) = 2 λ λ̄
    let (trace, square) = (map.trace(), (map * map).trace());
    let product = 0.5 * (trace * trace - square);
    let real = 0.5 * trace;
    Complex::new(real, (product - real * real).sqrt())
}

#[test]
fn the_walker() -> Result<(), Failure> {
    let (theta, omega) = (0.200_310_900_544_247_09_f64, -0.199_832_473_004_952_35);
    let start = [
        theta,
        2.0 * theta,
        omega,
        (1.0 - (2.0 * theta).cos()) * omega,
    ];
    let solution = Integrator::new(&Walker::default(), Taylor::tolerance(1e-15))
        .initial(0.0, start)
        .run_until(4.5)?;
    let sensitivities = solution.sensitivities()?;
    let step = sensitivities.transitions().last().ok_or("no step")?;
    assert!((step.t - 3.882_463_752_851_37).abs() < 1e-12);
    let found = pair(&step.after.by_initial);
    let expected = Complex::new(-0.190_099_841_065_888, 0.557_598_776_682_068);
    assert!((found - expected).norm() < 1e-11, "{found}");
    // by the slope: the fixed point moves by (1 − M)⁻¹ ∂P/∂γ, as differences of fixed points do
    let one = SMatrix::<f64, 4, 4>::identity();
    let inverse = (one - step.after.by_initial)
        .try_inverse()
        .ok_or("singular")?;
    let by_slope: SVector<f64, 4> = inverse * step.after.by_parameters.column(0);
    let other = fixed_point(0.009 + 1e-5, start)? - fixed_point(0.009 - 1e-5, start)?;
    assert!((other / 2e-5 - by_slope).amax() < 1e-4 * by_slope.amax());
    Ok(())
}

/// The fixed point of the walker's step at a slope, by Newton's method with its derivative.
fn fixed_point(gamma: f64, start: [f64; 4]) -> Result<SVector<f64, 4>, Failure> {
    let mut x = SVector::from(start);
    for _ in 0..6 {
        let solution = Integrator::new(&Walker { gamma }, Taylor::tolerance(1e-15))
            .initial(0.0, x)
            .run_until(4.5)?;
        let sensitivities = solution.sensitivities()?;
        let step = sensitivities.transitions().last().ok_or("no step")?;
        let after = solution.transitions().last().ok_or("no step")?.after;
        let matrix = SMatrix::<f64, 4, 4>::identity() - step.after.by_initial;
        x += matrix.try_inverse().ok_or("singular")? * (after - x);
    }
    Ok(x)
}

#[test]
fn the_buck_converter() -> Result<(), Failure> {
    let converter = BuckConverter::default();
    let period = converter.period;
    let run = |start: SVector<f64, 3>| {
        Integrator::new(&converter, Best::tolerance(1e-15))
            .initial(0.0, start)
            .run_until(1.2 * period)
    };
    let mut x = SVector::from([12.0, 0.55, 0.0]);
    let mut map = SMatrix::zeros();
    for _ in 0..8 {
        let solution = run(x)?;
        let sensitivities = solution.sensitivities()?;
        let mut both = solution
            .transitions()
            .iter()
            .zip(sensitivities.transitions());
        let (event, step) = both
            .find(|(event, _)| (event.t - period).abs() < 1e-12)
            .ok_or("no ramp")?;
        map = step.after.by_initial;
        let matrix = SMatrix::<f64, 3, 3>::identity() - map;
        x += matrix.try_inverse().ok_or("singular")? * (event.after - x);
    }
    let found = pair(&map);
    let expected = Complex::new(-0.821_086_5, 0.070_794_3);
    // seven digits are given
    assert!((found - expected).norm() < 1e-7, "{found}");
    Ok(())
}
