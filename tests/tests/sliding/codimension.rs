//! Several sliding interfaces at once, and sliding on curved ones.

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

#[test]
fn what_is_left_beside_another_slide_is_not_met_at_once() -> Result<(), Failure> {
    // on both of v and w until v is left, where the solution touches it: g is zero but for rounding
    // errors there, and so is dg/dt; then w is left too. The times are those of a solution in 40 digits
    let declaration = "system Relays {
        state x, y, z;
        param a0 = -0.29989133801825685, a1 = -0.8435454702738576, a2 = -0.4336571839921467, a3 = 1.1015508193574954;
        param b0 = 0.027381504310079685, b1 = 0.9870675801642637, b2 = 0.996406908907155, b3 = 0.037660458247485096;
        param d0 = -0.6468049669795718, d1 = 0.9271244502485982, d2 = 1.084036973346245, d3 = 0.973136545184105;
        param p0 = 1.166183686018353, p1 = -0.2498239367471371, p2 = 0.5550278087955637;
        param q0 = 0.9690519682187702, q1 = -0.07434480380742658, r0 = 0.9052644277916699, r1 = 0.4088427675071282;
        param ux = -2.1139963824665355, vx = -0.5633460164401596, vy = -1.679258890111627, wy = 0.5215887924959464, wz = -1.5212216028112717;
        let u = if p0*x + p1 + p2*z > 0 sliding { 1 } else { -1 };
        let v = if q0*y + q1 > 0 sliding { 1 } else { -1 };
        let w = if r0*z + r1 > 0 sliding { 1 } else { -1 };
        der(x) = a0*x + a1 + a2*y + a3*z + u*ux + v*vx;
        der(y) = b0*y + b1 + b2*x + b3*z + v*vy + w*wy;
        der(z) = d0*z + d1 + d2*x + d3*y + w*wz;
    }";
    let expected = [
        "slides on q0*y + q1",
        "slides on r0*z + r1",
        "leaves q0*y + q1",
        "leaves r0*z + r1",
        "slides on p0*x + p1 + p2*z",
    ];
    let x0 = [
        -1.111_847_423_399_155_8,
        -0.282_008_138_032_407_54,
        0.535_037_996_594_400_3,
    ];
    let way = taylor(declaration, &[], &x0, 4.0)?;
    assert_eq!(story(&way), expected);
    let times = [
        2.313_589_732_098_636,
        2.449_639_108_215_513,
        3.788_353_373_664_772,
    ];
    for (one, expected) in way.passed[2..].iter().zip(times) {
        assert_close(one.t, expected, 1e-13);
    }
    // rounding errors have either sign
    for k in 1..32 {
        let moved = [x0[0] + f64::from(k) * 1e-3, x0[1], x0[2]];
        let way = taylor(declaration, &[], &moved, 4.0)?;
        assert_eq!(story(&way), expected, "{k}");
    }
    Ok(())
}
