//! Runge–Kutta methods keep their order through sliding motions on one surface and on two
//! (Nurkanović, Sperl, Albrecht & Diehl, Numer. Math. 156, 2024, theorem 17), and hold the surfaces.
//!
//! Sliding modes are vector fields of their own here, so that Gauss–Legendre methods have their full
//! order as well, which they lose on systems of index 2.

use std::ops::ControlFlow;

use dmm_problems::fit::fitted_order;
use dmm_runtime::{Integrator, Observer, Point, RungeKutta, System, Taylor, Vector, pws};
use dmm_tests::systems::Bead;

use super::Failure;

pws! {
    /// A point that two switches lead to two curved surfaces, and that moves along both.
    pub system Track {
        state x, y, z;
        let first = if x - 0.4*sin(2*z) > 0 sliding { 1 } else { -1 };
        let second = if y - 0.1*z^2 > 0 sliding { 1 } else { -1 };
        der(x) = -2*first + 0.3*y;
        der(y) = -2*second - x;
        der(z) = 1 + 0.2*first - 0.1*second + 0.3*sin(z);
    }
}

/// The largest |g| of surfaces that are slid on, and the number of steps there.
struct Surfaces<'a, Sys> {
    system: &'a Sys,
    largest: f64,
    steps: u32,
}

impl<Sys: System<N>, const N: usize> Observer<Sys::Region, N> for Surfaces<'_, Sys> {
    fn point(&mut self, point: &Point<Sys::Region, N>) -> ControlFlow<()> {
        let system = self.system;
        let on = (0..2).filter(|&interface| system.slides_on(point.region, interface));
        for interface in on {
            let g = system.switching_function(interface, point.t, &point.x);
            self.largest = self.largest.max(g.unwrap_or(f64::NAN).abs());
            self.steps += 1;
        }
        ControlFlow::Continue(())
    }
}

/// The error at the end, and the largest |g| with the number of steps that it is of.
fn error<Sys: System<N>, const N: usize>(
    system: &Sys,
    method: RungeKutta,
    (initial, t_end, exact): ([f64; N], f64, &Vector<f64, N>),
    steps: f64,
) -> Result<(f64, f64, u32), Failure> {
    let mut surfaces = Surfaces {
        system,
        largest: 0.0,
        steps: 0,
    };
    let run = Integrator::new(system, method.step_size(t_end / steps)).initial(0.0, initial);
    let end = run.observe_until(t_end, &mut surfaces)?;
    let error = (end.point.x - exact).amax();
    Ok((error, surfaces.largest, surfaces.steps))
}

/// Prints the slopes of the methods and asserts that they are their orders.
fn assert_orders<Sys: System<N>, const N: usize>(
    system: &Sys,
    initial: [f64; N],
    t_end: f64,
) -> Result<(), Failure> {
    let exact = Integrator::new(system, Taylor::tolerance(1e-15))
        .initial(0.0, initial)
        .run_until(t_end)?;
    let exact = exact.last().ok_or("no point")?.x;
    let methods = [
        ("Radau IIA 1", RungeKutta::radau_iia::<1>(), 1.0, 400.0),
        ("Radau IIA 2", RungeKutta::radau_iia::<2>(), 3.0, 80.0),
        ("Radau IIA 3", RungeKutta::radau_iia::<3>(), 5.0, 45.0),
        ("Radau IIA 4", RungeKutta::radau_iia::<4>(), 7.0, 16.0),
        (
            "Gauss–Legendre 2",
            RungeKutta::gauss_legendre::<2>(),
            4.0,
            40.0,
        ),
        (
            "Gauss–Legendre 3",
            RungeKutta::gauss_legendre::<3>(),
            6.0,
            20.0,
        ),
        ("Lobatto IIIC 3", RungeKutta::lobatto_iiic::<3>(), 4.0, 40.0),
        ("Heun 3", RungeKutta::explicit::<3>(), 3.0, 120.0),
    ];
    for (name, method, order, steps) in methods {
        let (mut sizes, mut errors) = (Vec::new(), Vec::new());
        for refinement in [1.0, 1.5, 2.0, 3.0, 4.0] {
            let (given, steps) = ((initial, t_end, &exact), steps * refinement);
            let (error, largest, slid) = error(system, method, given, steps)?;
            assert!(
                f64::from(slid) > steps / 2.0,
                "{name}: {slid} steps on surfaces"
            );
            assert!(largest < 1e-15, "{name}: |g| = {largest:e}");
            // of others rounding is a part
            if error > 1e-14 {
                sizes.push(t_end / steps);
                errors.push(error);
            }
        }
        let slope = fitted_order(&sizes, &errors);
        println!("{name:<18} {order} {slope:.2}");
        assert!((slope - order).abs() < 0.5, "{name}: {slope} {errors:?}");
    }
    Ok(())
}

#[test]
fn on_one_surface() -> Result<(), Failure> {
    assert_orders(&Bead {}, [1.5, 0.0], 4.0)
}

#[test]
fn on_the_intersection_of_two() -> Result<(), Failure> {
    assert_orders(&Track {}, [0.5, -0.4, 0.1], 2.0)
}
