//! Several interfaces: regions of sign patterns, points of several interfaces at once, and that
//! nothing depends on the order in which they are declared.

use dmm_runtime::{
    Best, Composed, Ensemble, Error, ErrorKind, Integrator, Member, Method, Symmetric, System,
    Taylor, pws,
};

pws! {
    /// An oscillator whose stiffness and inertia change from quadrant to quadrant.
    pub system Quadrants {
        state q, p;
        param ne = 1, nw = 2, sw = 3, se = 4;
        interface right = q;
        interface up = p;
        region first where right > 0 and up > 0 {
            der(q) = p;
            der(p) = -ne * q;
            conserved energy = (p^2 + ne * q^2) / 2;
        }
        region second where right < 0 and up > 0 {
            der(q) = p;
            der(p) = -nw * q;
            conserved energy = (p^2 + nw * q^2) / 2;
        }
        region third where right < 0 and up < 0 {
            der(q) = p;
            der(p) = -sw * q;
            conserved energy = (p^2 + sw * q^2) / 2;
        }
        region fourth where right > 0 and up < 0 {
            der(q) = p;
            der(p) = -se * q;
            conserved energy = (p^2 + se * q^2) / 2;
        }
    }
}

/// The times at which the oscillator crosses an axis: from one to the next it takes π / (2 √k).
fn crossings(count: usize) -> Vec<f64> {
    let stiffness = [1.0_f64, 4.0, 3.0, 2.0];
    let mut times = vec![std::f64::consts::FRAC_PI_2];
    for number in 1..count {
        let last = times[number - 1];
        times.push(last + std::f64::consts::FRAC_PI_2 / stiffness[number % 4].sqrt());
    }
    times
}

#[test]
fn each_quadrant_is_a_region() -> Result<(), Box<dyn std::error::Error>> {
    let system = Quadrants::default();
    let solution = Integrator::new(&system, Best::tolerance(1e-14))
        .initial(0.0, [0.0, 1.0])
        .run_until(40.0)?;
    let expected = crossings(solution.transitions().len());
    for (transition, expected) in solution.transitions().iter().zip(expected) {
        assert!((transition.t - expected).abs() < 1e-12, "{}", transition.t);
    }
    let order: Vec<_> = solution.transitions().iter().map(|one| one.to).collect();
    use QuadrantsRegion::{First, Fourth, Second, Third};
    assert_eq!(order[..5], [Fourth, Third, Second, First, Fourth]);
    Ok(())
}

/// The time of the twentieth transition.
fn twentieth(system: &Quadrants, method: impl Method, t_end: f64) -> Result<f64, Error> {
    Integrator::new(system, method)
        .initial(0.0, [0.0, 1.0])
        .run_until(t_end)
        .map(|solution| solution.transitions()[19].t)
        .map_err(|stopped| stopped.error().clone())
}

#[test]
fn every_scheme_goes_through_the_quadrants_at_its_order() -> Result<(), Error> {
    let system = Quadrants::default();
    let last = crossings(20)[19];
    let error = |tau: f64| {
        let symmetric = twentieth(&system, Symmetric::step_size(tau), last + 0.01)?;
        let composed = twentieth(&system, Composed::<4>::step_size(tau), last + 0.01)?;
        Ok::<_, Error>([symmetric, composed].map(|t| (t - last).abs()))
    };
    let (coarse, fine) = (error(0.04)?, error(0.01)?);
    let orders = [0, 1].map(|scheme| (coarse[scheme] / fine[scheme]).log2() / 2.0);
    assert!(
        (orders[0] - 2.0).abs() < 0.1 && (orders[1] - 4.0).abs() < 0.2,
        "{orders:?}"
    );
    Ok(())
}

pws! {
    /// A point that moves on a straight line in each of eight octants.
    pub system Octants {
        state x, y, z;
        param inside = 1, outside = 2;
        interface a = x;
        interface b = y - x^3;
        interface c = z + x * y;
        region far where a > 0 and b > 0 and c > 0 {
            der(x) = outside;
            der(y) = outside;
            der(z) = outside;
        }
        region near where a < 0 and b < 0 and c < 0 {
            der(x) = inside;
            der(y) = inside;
            der(z) = inside;
        }
        region side_a where a > 0 and b < 0 {
            der(x) = inside;
            der(y) = outside;
            der(z) = inside;
        }
        region side_b where b > 0 and c < 0 {
            der(x) = inside;
            der(y) = outside;
            der(z) = inside;
        }
        region side_c where c > 0 and a < 0 {
            der(x) = inside;
            der(y) = outside;
            der(z) = inside;
        }
    }
}

pws! {
    /// The same with everything in another order.
    pub system Reordered {
        state x, y, z;
        param inside = 1, outside = 2;
        interface c = z + x * y;
        interface b = y - x^3;
        interface a = x;
        region side_c where c > 0 and a < 0 {
            der(x) = inside;
            der(y) = outside;
            der(z) = inside;
        }
        region side_b where b > 0 and c < 0 {
            der(x) = inside;
            der(y) = outside;
            der(z) = inside;
        }
        region side_a where a > 0 and b < 0 {
            der(x) = inside;
            der(y) = outside;
            der(z) = inside;
        }
        region near where a < 0 and b < 0 and c < 0 {
            der(x) = inside;
            der(y) = inside;
            der(z) = inside;
        }
        region far where a > 0 and b > 0 and c > 0 {
            der(x) = outside;
            der(y) = outside;
            der(z) = outside;
        }
    }
}

type Way = (Vec<(f64, &'static str)>, [f64; 3]);

/// The way that a system takes: times, names of regions and the end.
fn way<Sys: System<3>>(system: &Sys, x0: [f64; 3]) -> Result<Way, Error> {
    let solution = Integrator::new(system, Taylor::tolerance(1e-14))
        .initial(0.0, x0)
        .run_until(2.0)
        .map_err(|stopped| stopped.error().clone())?;
    let way = solution.transitions().iter();
    let way = way
        .map(|one| (one.t, system.of_region(one.to).name))
        .collect();
    let end = solution.last().map(|point| point.x.into());
    Ok((way, end.unwrap_or_default()))
}

#[test]
fn three_interfaces_are_crossed_at_once() -> Result<(), Error> {
    let (way, end) = way(&Octants::default(), [-1.0, -1.0, -1.0])?;
    // z + x y and y − x³ are zero at the origin and, before it, at x = −1
    assert!(
        way.iter()
            .any(|&(t, name)| name == "far" && (t - 1.0).abs() < 1e-14),
        "{way:?}"
    );
    // y = x³ again at (1, 1, 1)
    let differences = [end[0] - 1.5, end[1] - 2.0, end[2] - 1.5];
    assert!(
        differences
            .iter()
            .all(|difference| difference.abs() < 1e-13),
        "{end:?}"
    );
    Ok(())
}

#[test]
fn nothing_depends_on_the_order_of_declaration() {
    let (one, other) = (Octants::default(), Reordered::default());
    let mut finished = 0;
    for number in 0..500_u32 {
        let place = |k: u32| f64::from((number * k) % 89) / 30.0 - 1.5;
        let x0 = [place(7), place(13), place(29)];
        match (way(&one, x0), way(&other, x0)) {
            (Ok(one), Ok(other)) => {
                assert_eq!(one, other, "{x0:?}");
                finished += 1;
            }
            (Err(one), Err(other)) => assert_eq!(
                std::mem::discriminant(&one.kind),
                std::mem::discriminant(&other.kind),
                "{one} and {other}"
            ),
            (one, other) => panic!("{one:?} and {other:?} from {x0:?}"),
        }
    }
    assert!(finished > 300, "{finished}");
}

pws! {
    /// Four fields that lead out of the corner where the quadrants meet, or turn around it.
    pub system Corner {
        state x, y;
        param out = 1;
        interface right = x;
        interface up = y;
        region first where right > 0 and up > 0 {
            der(x) = out;
            der(y) = out;
        }
        region second where right < 0 and up > 0 {
            der(x) = -out;
            der(y) = out;
        }
        region third where right < 0 and up < 0 {
            der(x) = 1;
            der(y) = 1;
        }
        region fourth where right > 0 and up < 0 {
            der(x) = -1;
            der(y) = 1;
        }
    }
}

#[test]
fn a_corner_that_several_fields_or_none_lead_away_from_is_an_error() {
    let from = |out: f64, x0: [f64; 2]| {
        let corner = Corner { out };
        let stopped = Integrator::new(&corner, Taylor::tolerance(1e-12))
            .initial(0.0, x0)
            .run_until(3.0);
        stopped
            .map(|_| ())
            .map_err(|stopped| stopped.error().clone())
    };
    for x0 in [[-1.0, -1.0], [0.0, 0.0]] {
        let error = from(1.0, x0).unwrap_err();
        let ErrorKind::Ambiguous {
            interfaces,
            regions,
        } = error.kind
        else {
            panic!("{error}");
        };
        assert_eq!(
            (interfaces.as_str(), regions.as_str()),
            ("`right`, `up`", "`first`, `second`")
        );
        let error = from(-1.0, x0).unwrap_err();
        assert!(
            matches!(error.kind, ErrorKind::Intersection { .. }),
            "{error}"
        );
    }
    // named, it is where the solution goes on
    let corner = Corner { out: 1.0 };
    let named = Integrator::new(&corner, Taylor::tolerance(1e-12))
        .initial(0.0, [0.0, 0.0])
        .region(CornerRegion::Second)
        .run_until(3.0);
    assert_eq!(
        named.ok().and_then(|run| run.last().map(|end| end.x)),
        Some([-3.0, 3.0].into())
    );
}

#[test]
fn lanes_take_the_same_way() {
    let members: Vec<Member<Reordered, 3>> = (0..97_u32)
        .map(|number| {
            let place = |k: u32| f64::from((number * k) % 89) / 30.0 - 1.5;
            Member::new(Reordered::default(), 0.0, [place(7), place(13), place(29)])
        })
        .collect();
    let ensemble = Ensemble::new(Taylor::tolerance(1e-10)).threads(1);
    let lanes = ensemble.clone().collect_until(2.0, members.clone());
    let scalar = ensemble.lanes(false).collect_until(2.0, members);
    for (one, other) in lanes.iter().zip(&scalar) {
        match (one, other) {
            (Ok(one), Ok(other)) => {
                assert_eq!(one.point.region, other.point.region);
                assert!((one.point.x - other.point.x).amax() < 1e-9);
                assert_eq!(one.statistics.transitions, other.statistics.transitions);
            }
            (Err(one), Err(other)) => assert_eq!(
                std::mem::discriminant(&one.error().kind),
                std::mem::discriminant(&other.error().kind)
            ),
            (one, other) => panic!("{one:?} and {other:?}"),
        }
    }
}
