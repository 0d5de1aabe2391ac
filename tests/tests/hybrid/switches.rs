//! Switches within formulas: `if`, `abs`, `sign`, `min`, `max` and `clamp`.

use dmm_runtime::{
    Best, Composed, Error, ErrorKind, Integrator, Symmetric, System, Taylor, TransitionKind, pws,
};

use super::{Failure, best, run, same_at_run_time, times};

pws! {
    /// A force of constant size towards the origin.
    pub system Constant {
        state x, v;
        der(x) = v;
        der(v) = -sign(x);
        conserved energy = v^2 / 2 + abs(x);
    }
}

#[test]
fn a_switch_is_crossed_like_an_interface() -> Result<(), Error> {
    // a quarter of the period takes √(2 x₀) = 1
    for times in [
        times(run(
            &Constant {},
            Best::tolerance(1e-12),
            [0.5, 0.0],
            100.0,
        )?),
        times(run(
            &Constant {},
            Taylor::tolerance(1e-12),
            [0.5, 0.0],
            100.0,
        )?),
        times(run(
            &Constant {},
            Symmetric::step_size(0.3),
            [0.5, 0.0],
            100.0,
        )?),
        times(run(
            &Constant {},
            Composed::<4>::step_size(0.7),
            [0.5, 0.0],
            100.0,
        )?),
    ] {
        assert_eq!(times.len(), 50);
        for (n, t) in times.iter().enumerate() {
            assert!((t - (2 * n + 1) as f64).abs() < 1e-12, "{n}: {t}");
        }
    }
    let solution = run(&Constant {}, Best::tolerance(1e-12), [0.5, 0.0], 2.0)?;
    let first = solution.transitions()[0];
    let system = Constant {};
    // one interface for both functions of x, by the name of its formula
    assert_eq!(system.metadata().interfaces, ["x"]);
    assert_eq!(first.kind, TransitionKind::Crossed);
    let statistics = solution.statistics();
    assert_eq!(
        (statistics.crossed, statistics.jumped),
        (statistics.transitions, 0)
    );
    for region in [first.from, first.to] {
        let psi = system.conserved(region, first.t, &first.x);
        assert!((psi[0] - 0.5).abs() < 1e-15);
    }
    Ok(())
}

pws! {
    /// Grains on a line that push and do not pull.
    pub system Grains {
        const n = 12;
        state q[n], p[n];
        param k = 1;
        fn overlap(r) = if r < 0 { r^2 / 2 } else { 0 };
        hamiltonian energy =
            sum(i in 0..n, p[i]^2 / 2) + k * sum(i in 0..n - 1, overlap(q[i + 1] - q[i])) in (q, p);
        conserved momentum = sum(i in 0..n, p[i]);
    }
}

#[test]
fn eleven_switches_are_one_field() -> Result<(), Failure> {
    let grains = Grains::default();
    assert_eq!(grains.metadata().regions.len(), 1);
    assert_eq!(grains.metadata().interfaces.len(), 11);
    assert_eq!(grains.metadata().interfaces[0], "q[0] - q[1]");
    let mut x0 = [0.0; 24];
    for (i, q) in x0[..12].iter_mut().enumerate() {
        *q = 0.3 * i as f64;
    }
    // the first grain is thrown at the others
    x0[12] = 1.0;
    let solution = Integrator::new(&grains, Taylor::tolerance(1e-14))
        .initial(0.0, x0)
        .run_until(60.0)?;
    assert!(
        solution.transitions().len() >= 22,
        "{}",
        solution.transitions().len()
    );
    let end = solution.last().ok_or("no end")?;
    let psi = grains.conserved(end.region, end.t, &end.x);
    assert!(
        (psi[0] - 0.5).abs() < 1e-14 && (psi[1] - 1.0).abs() < 1e-14,
        "{psi:?}"
    );
    // they fly apart, the last one fastest
    let speeds: Vec<f64> = (12..24).map(|i| end.x[i]).collect();
    assert!(
        speeds.windows(2).all(|pair| pair[0] <= pair[1] + 1e-12),
        "{speeds:?}"
    );
    Ok(())
}

pws! {
    /// A driven circuit whose gain saturates, as formulas …
    pub system Saturated {
        state x, y;
        param drive = 3;
        der(x) = y;
        der(y) = -clamp(2 * x, -1, 1) - y / 10 + drive * cos(t) / 2;
    }
}

pws! {
    /// … and as regions.
    pub system ByRegions {
        state x, y;
        param drive = 3;
        interface low = 2*x + 1;
        interface high = 2*x - 1;
        der(x) = y;
        region under where low < 0 and high < 0 { der(y) = 1 - y / 10 + drive * cos(t) / 2; }
        region between where low > 0 and high < 0 { der(y) = -2*x - y / 10 + drive * cos(t) / 2; }
        region above where low > 0 and high > 0 { der(y) = -1 - y / 10 + drive * cos(t) / 2; }
        region nowhere where low < 0 and high > 0 { der(y) = 0; }
    }
}

#[test]
fn a_clamp_is_three_regions() -> Result<(), Error> {
    let switched = run(
        &Saturated::default(),
        Taylor::tolerance(1e-14),
        [0.1, 0.0],
        50.0,
    )?;
    let regions = run(
        &ByRegions::default(),
        Taylor::tolerance(1e-14),
        [0.1, 0.0],
        50.0,
    )?;
    let (one, other) = (switched.at(50.0)?, regions.at(50.0)?);
    assert!((one - other).amax() < 1e-12, "{one} {other}");
    let crossed = |times: &[f64]| times.len();
    assert_eq!(crossed(&times(switched)), crossed(&times(regions)));
    Ok(())
}

pws! {
    /// The fastest of three decays.
    pub system Fastest {
        state x;
        der(x) = -max(max(x, 2 - x), x^2);
    }
}

#[test]
fn switches_within_switches_are_told_apart() -> Result<(), Error> {
    let solution = run(&Fastest {}, Taylor::tolerance(1e-14), [3.0], 2.0)?;
    // x² falls to 1 after 2/3, then 2 − x leads
    let t = 1.0 - 1.0 / 3.0;
    let first = solution.transitions()[0];
    assert!(
        (first.t - t).abs() < 1e-13 && (first.x[0] - 1.0).abs() < 1e-13,
        "{}",
        first.t
    );
    // d(2 − x)/dt = 2 − x from 1 on
    let later = solution.at(t + 0.5)?;
    assert!((later[0] - (2.0 - 0.5_f64.exp())).abs() < 1e-12, "{later}");
    Ok(())
}

pws! {
    /// A block on a belt.
    pub system Block {
        state x, v;
        param belt = 0.2, friction = 0.5;
        der(x) = v;
        der(v) = -x + if v > belt { -friction } else { friction };
    }
}

#[test]
fn a_block_that_sticks_slides_on_its_switch() {
    let stopped = run(
        &Block::default(),
        Taylor::tolerance(1e-12),
        [0.0, 0.0],
        10.0,
    );
    let error = stopped.map(|_| ()).unwrap_err();
    assert!(
        matches!(
            error.kind,
            ErrorKind::Sliding {
                interface: "v - belt",
                ..
            }
        ),
        "{error}"
    );
}

#[test]
fn systems_compiled_at_run_time_switch_alike() -> Result<(), Failure> {
    same_at_run_time(&Constant {}, [0.5, 0.0], 50.0)?;
    same_at_run_time(&Saturated::default(), [0.1, 0.0], 20.0)?;
    same_at_run_time(&Fastest {}, [3.0], 2.0)?;
    Ok(())
}

#[test]
fn a_branch_may_have_no_value_on_the_other_side() -> Result<(), Failure> {
    // a homogeneous sphere: the force is linear inside and Kepler's outside
    let declaration = "system Sphere {
        state x, y, u, v;
        let r = sqrt(x^2 + y^2);
        let pull = if r > 1 { 1/r^3 } else { 1 };
        let potential = if r > 1 { -1/r } else { r^2/2 - 3/2 };
        der(x) = u;
        der(y) = v;
        der(u) = -pull*x;
        der(v) = -pull*y;
        conserved angular_momentum = x*v - y*u;
        conserved energy = (u^2 + v^2)/2 + potential;
    }";
    let end = best(declaration, 1e-12, &[2.0, 0.0, 0.0, 0.1], 50.0)?;
    assert!(
        end.statistics.transitions > 10,
        "{}",
        end.statistics.transitions
    );
    let [x, y, u, v] = end.x[..] else {
        return Err("four states".into());
    };
    let r = x.hypot(y);
    let potential = if r > 1.0 { -1.0 / r } else { r * r / 2.0 - 1.5 };
    let energy = (u * u + v * v) / 2.0 + potential;
    assert!((energy - (0.005 - 0.5)).abs() < 1e-14, "{energy}");
    assert!((x * v - y * u - 0.2).abs() < 1e-15);
    Ok(())
}
