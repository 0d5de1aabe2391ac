//! The homogeneous sphere, beside its arcs in closed form.

use super::{Failure, Scheme, assert_close, model, run};

const SPHERE: &str = include_str!("../../../problems/hybrid/sphere.pws");
/// From the point nearest to the centre, at (r₀, 0), with the velocity (0, v₀).
const NEAREST: f64 = 0.5;
const FASTEST: f64 = 1.2;

/// Times and angles from the nearest point to the surface, and from there to the surface again.
///
/// Inside, r = (r₀ cos t, v₀ sin t). Outside, an ellipse with a = −1/(2E), e² = 1 + 2EL², and
/// Kepler's equation M = η − e sin η with 1 = a (1 − e cos η) at the surface.
fn arcs() -> [(f64, f64); 2] {
    let (r, v) = (NEAREST, FASTEST);
    let inside = ((1.0 - r * r) / (v * v - r * r)).sqrt().asin();
    let angle = (v * inside.sin()).atan2(r * inside.cos());
    let (energy, momentum) = ((v * v + r * r - 3.0) / 2.0, r * v);
    let axis = -0.5 / energy;
    let eccentricity = (1.0 + 2.0 * energy * momentum * momentum).sqrt();
    let eta = ((1.0 - 1.0 / axis) / eccentricity).acos();
    let mean = eta - eccentricity * eta.sin();
    let anomaly = ((momentum * momentum - 1.0) / eccentricity).acos();
    let pi = std::f64::consts::PI;
    let outside = 2.0 * (pi - mean) * axis.powf(1.5);
    [(inside, angle), (outside, 2.0 * (pi - anomaly))]
}

#[test]
fn both_arcs_are_met() -> Result<(), Failure> {
    let sphere = model(SPHERE, &[])?;
    let way = run(
        &sphere,
        Scheme::Taylor,
        &[NEAREST, 0.0, 0.0, FASTEST],
        100.0,
    )?;
    let [inside, outside] = arcs();
    let (mut t, mut angle) = (0.0, 0.0);
    assert!(way.passages.len() > 20, "{}", way.passages.len());
    for (number, passage) in way.passages.iter().enumerate() {
        let (time, swept) = match number {
            0 => inside,
            _ if number % 2 == 1 => outside,
            _ => (2.0 * inside.0, 2.0 * inside.1),
        };
        t += time;
        angle += swept;
        assert_close("time", &[passage.t], &[t], 1e-12);
        let [x, y] = [angle.cos(), angle.sin()];
        assert_close("place", &passage.before[..2], &[x, y], 1e-12);
        let [u, v] = [passage.before[2], passage.before[3]];
        let speed = (FASTEST * FASTEST + NEAREST * NEAREST - 1.0).sqrt();
        let conserved = [u.hypot(v), x * v - y * u];
        assert_close(
            "speed, momentum",
            &conserved,
            &[speed, NEAREST * FASTEST],
            1e-12,
        );
    }
    Ok(())
}
