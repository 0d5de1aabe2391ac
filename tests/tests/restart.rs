//! Runs that start again next to an interface, in the region that is named.

use dmm_runtime::{Best, Composed, ErrorKind, Integrator, Method, Symmetric, System, Taylor, pws};
use dmm_tests::systems::{Springs, SpringsRegion};

pws! {
    /// The same on a circle that the solution crosses.
    pub system Circle {
        state x, y;
        interface circle = x^2 + y^2 - 1;
        region outside where circle > 0 {
            der(x) = y; der(y) = -2*x - x^3;
            conserved energy = y^2/2 + x^2 + x^4/4;
        }
        region inside where circle < 0 {
            der(x) = y; der(y) = -3*x;
            conserved energy = (y^2 + 3*x^2)/2;
        }
    }
}

/// Every transition point is a start in the region entered: the rest has the transitions that came
/// after, and ends where the whole ends.
fn starts_again<Sys: System<2>>(system: &Sys, x0: [f64; 2], method: impl Method, bound: f64) {
    const END: f64 = 20.0;
    let from = |t, x| Integrator::new(system, method.clone()).initial(t, x);
    let whole = from(0.0, x0.into()).run_until(END).unwrap();
    assert!(whole.transitions().len() >= 5);
    let end = whole.last().unwrap();
    for (index, transition) in whole.transitions().iter().enumerate() {
        let start = from(transition.t, transition.x).region(transition.to);
        let rest = start.run_until(END).unwrap();
        let left = whole.transitions().len() - index - 1;
        assert_eq!(rest.transitions().len(), left, "{}", transition.t);
        let difference = (rest.last().unwrap().x - end.x).amax();
        assert!(difference < bound, "{}: {difference:e}", transition.t);
    }
}

#[test]
fn every_transition_point_is_a_start_in_the_region_entered() {
    starts_again(&Springs {}, [0.3, 1.0], Best::tolerance(1e-12), 1e-12);
    starts_again(&Springs {}, [0.3, 1.0], Taylor::tolerance(1e-14), 1e-11);
    starts_again(&Springs {}, [0.3, 1.0], Symmetric::step_size(1e-2), 1e-3);
    starts_again(&Circle {}, [0.7, 0.7], Taylor::tolerance(1e-14), 1e-11);
    starts_again(&Circle {}, [0.7, 0.7], Composed::<6>::tolerance(1e-9), 1e-5);
    starts_again(&Circle {}, [0.7, 0.7], Symmetric::step_size(1e-2), 1e-2);
}

/// A start off the interface by so little that the run cannot tell, on either side of it.
#[test]
fn what_rounding_leaves_of_g_does_not_count() {
    fn is_first_half<Met: Method>(y: f64, t0: f64, method: Met) {
        // ẏ = −x > 0: above is entered; y = sin t there
        let problem = Integrator::new(&Springs {}, method).initial(t0, [-1.0, y]);
        let solution = problem
            .region(SpringsRegion::Above)
            .run_until(t0 + 4.0)
            .unwrap();
        let first = solution.transitions()[0];
        let half = std::f64::consts::PI;
        assert!((first.t - t0 - half).abs() < 1e-4, "{y:e} {}", first.t);
        assert_eq!(first.from, SpringsRegion::Above);
    }
    for y in [
        1e-33, -1e-33, 1e-300, -1e-300, 5e-324, -5e-324, -0.0, 1e-17, -1e-17, -5e-16,
    ] {
        is_first_half(y, 0.0, Best::tolerance(1e-12));
        is_first_half(y, 0.0, Taylor::tolerance(1e-12));
        is_first_half(y, 0.0, Symmetric::step_size(1e-2));
        is_first_half(y, 0.0, Composed::<6>::tolerance(1e-8));
    }
    for y in [-2e-12, -1e-13] {
        is_first_half(y, 1e4, Best::tolerance(1e-12));
        is_first_half(y, 1e4, Taylor::tolerance(1e-12));
        is_first_half(y, 1e4, Symmetric::step_size(1e-2));
        is_first_half(y, 1e4, Composed::<6>::tolerance(1e-8));
    }
}

#[test]
fn a_region_that_the_start_does_not_lie_in_is_refused() {
    for (x, y) in [(-1.0, -1e-12), (-1.0, -1.0), (1.0, -1e-33)] {
        let problem = Integrator::new(&Springs {}, Best::tolerance(1e-12)).initial(0.0, [x, y]);
        let refused = problem.region(SpringsRegion::Above).run_until(4.0);
        let error = refused.unwrap_err();
        let is_region = matches!(
            error.error().kind,
            ErrorKind::InvalidInput { what: "region", .. }
        );
        assert!(is_region, "{y:e}: {error}");
    }
}
