//! Several sliding interfaces at once, and sliding on curved ones.

use dmm_runtime::{Integrator, Method, Point, Symmetric, Taylor, on_point, pws};

use super::{Failure, assert_close, story, taylor};

#[test]
fn a_solution_slides_on_a_circle() -> Result<(), Failure> {
    let declaration = include_str!("../../../problems/hybrid/circle.pws");
    let way = taylor(declaration, &[], &[-1.0, 0.1], 3.0)?;
    assert_eq!(story(&way), ["slides on rim", "leaves rim"]);
    // |x| = √2 where exp(t) |x₀| is; then the angle falls by tan
    assert_close(way.passed[0].t, 0.5 * (2.0_f64 / 1.01).ln(), 1e-15);
    assert_close(way.passed[1].t, 1.828_629_780_832, 1e-12);
    assert_close(way.passed[1].x[0], -1.0, 1e-15);
    assert_close(way.passed[1].x[1], -1.0, 1e-15);
    Ok(())
}

#[test]
fn two_curved_surfaces_lead_to_their_intersection() -> Result<(), Failure> {
    use std::f64::consts::PI;
    let declaration = include_str!("../../../problems/hybrid/surfaces.pws");
    let way = taylor(declaration, &[], &[2.0 * PI / 3.0, PI / 3.0], 4.0)?;
    let expected = ["slides on y - x^3/20", "slides on x + 3*y^2/20"];
    assert_eq!(story(&way), expected);
    for value in &way.end {
        assert!(value.abs() < 1e-15, "{way:?}");
    }
    Ok(())
}

#[test]
fn three_regions_meet_in_one_mean() -> Result<(), Failure> {
    // θ of Stewart's form: the mean of three fields that is at rest in the plane and moves in z
    let declaration = "system Three {
        state x, y, z;
        interface right = x, sliding;
        interface up = y, sliding;
        region a where right > 0 { der(x) = -1; der(y) = 0.25; der(z) = 1; }
        region b where right < 0 and up > 0 { der(x) = 1; der(y) = -1; der(z) = 2; }
        region c where right < 0 and up < 0 { der(x) = 1; der(y) = 0.5; der(z) = 4; }
    }";
    let way = taylor(declaration, &[], &[0.0, 0.0, 0.0], 1.0)?;
    assert!(way.passed.is_empty());
    // θ_a = 1/2, then θ_b = 5/12 and θ_c = 1/12 from 1/8 − θ_b + θ_c/2 = 0
    assert_close(way.end[2], 0.5 + 2.0 * 0.25 + 4.0 * 0.25, 1e-15);
    Ok(())
}

#[test]
fn both_interfaces_are_left_at_once() -> Result<(), Failure> {
    // b leaves the mean at t = 0.6, where a and c lead away from `right`; dg/dt of `up` is zero for the
    // mean of both alone: c leads back to `up`, so that the solution goes on in a
    let declaration = "system Three {
        state x, y;
        interface right = x, sliding;
        interface up = y, sliding;
        region a where right > 0 { der(x) = t - 0.4; der(y) = 4*t/3 - 1; }
        region b where right < 0 and up > 0 { der(x) = 5; der(y) = -3; }
        region c where right < 0 and up < 0 { der(x) = -1; der(y) = 1; }
    }";
    let way = taylor(declaration, &[], &[0.0, 0.0], 1.0)?;
    assert_eq!(story(&way), ["leaves up"]);
    assert_eq!(way.passed[0].to, "a");
    assert_close(way.passed[0].t, 0.6, 1e-15);
    assert_close(way.end[0], 0.16, 1e-14);
    assert_close(way.end[1], 2.0 / 75.0, 1e-14);
    Ok(())
}

#[test]
fn four_fields_without_one_mean_are_refused() {
    let declaration = "system Four {
        state x, y, z;
        interface right = x, sliding;
        interface up = y, sliding;
        region pp where right > 0 and up > 0 { der(x) = -1; der(y) = -1; der(z) = 1; }
        region pm where right > 0 and up < 0 { der(x) = -1; der(y) = 1; der(z) = 0; }
        region mp where right < 0 and up > 0 { der(x) = 1; der(y) = -1; der(z) = 0; }
        region mm where right < 0 and up < 0 { der(x) = 1; der(y) = 1; der(z) = 0; }
    }";
    let error = taylor(declaration, &[], &[0.5, 1.0, 0.0], 2.0).unwrap_err();
    let text = error.to_string();
    assert!(text.contains("`right`, `up` at once"), "{text}");
}

pws! {
    /// A bead that is pressed onto a moving ellipse and driven along it.
    pub system Bead {
        state x, y;
        interface ring = (x - 0.1*sin(t))^2 + 2*y^2 - 1, sliding;
        region outside where ring > 0 { der(x) = -x - 2*y; der(y) = x - y; }
        region inside where ring < 0 { der(x) = x - 2*y; der(y) = x + y; }
    }
}

#[test]
fn rounding_errors_of_a_hundred_thousand_sliding_steps_do_not_add_up() -> Result<(), Failure> {
    /// The largest |g| on the ring by its terms, and how many steps end there.
    fn look<Met: Method + 'static>(method: Met, t_end: f64) -> Result<(f64, u32), Failure> {
        let (mut largest, mut steps) = (0.0_f64, 0);
        let mut on_ring = on_point(|point: &Point<BeadRegion, 2>| {
            if point.region == BeadRegion::SlidingRing {
                let (x, y) = (point.x[0] - 0.1 * point.t.sin(), point.x[1]);
                let size = x * x + 2.0 * x.abs() * point.x[0].abs() + 2.0 * y * y + 1.0;
                let g = x * x + 2.0 * y * y - 1.0;
                largest = largest.max(g.abs() / size);
                steps += 1;
            }
        });
        let run = Integrator::new(&Bead {}, method).initial(0.0, [1.5, 0.0]);
        run.observe_until(t_end, &mut on_ring)?;
        Ok((largest, steps))
    }

    let runs = [
        look(Taylor::tolerance(1e-12), 60_000.0)?,
        look(Symmetric::step_size(0.01), 1200.0)?,
    ];
    for (largest, steps) in runs {
        assert!(steps > 100_000, "{steps}");
        assert!(largest <= 4.0 * f64::EPSILON, "{largest:e}");
    }
    Ok(())
}
