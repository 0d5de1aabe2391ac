//! Rounding errors over many steps.

use dmm_runtime::{Integrator, Method, Point, Symmetric, Taylor, on_point};
use dmm_tests::run;
use dmm_tests::systems::{Bead, BeadRegion, Walls};

use super::Failure;

#[test]
fn a_million_elastic_impacts_keep_the_energy() -> Result<(), Failure> {
    let x0 = [0.2, 0.3, 0.7, 1.1];
    let solution = run(&Walls {}, Taylor::tolerance(1e-12), x0, 1e6 / 1.8)?;
    assert!(solution.statistics.transitions > 999_000);
    let [_, _, u, v] = solution.point.x.into();
    assert_eq!((u * u + v * v) / 2.0, (0.7 * 0.7 + 1.1 * 1.1) / 2.0);
    Ok(())
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
