//! Transitions of Taylor's method add nothing to the level: g and ψ hold there beyond the digits
//! of a double. Evaluated here, at the points with their remainders, by sums and products of
//! pairs of doubles of the test's own.

use std::ops::{Add, ControlFlow, Mul, Neg, Sub};

use dmm_runtime::{Integrator, Observer, System, Taylor, Transition, pws};

/// An unevaluated sum of two doubles.
#[derive(Clone, Copy)]
struct Pair(f64, f64);

impl Add for Pair {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let sum = self.0 + other.0;
        let part = sum - self.0;
        let error = (self.0 - (sum - part)) + (other.0 - part) + (self.1 + other.1);
        Self(sum + error, error - ((sum + error) - sum))
    }
}

impl Neg for Pair {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl Sub for Pair {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Pair {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = self.0 * other.0;
        let error = self.0.mul_add(other.0, -product) + (self.0 * other.1 + self.1 * other.0);
        Self(product + error, error - ((product + error) - product))
    }
}

fn number(value: f64) -> Pair {
    Pair(value, 0.0)
}

/// What is evaluated at a transition: g, and ψ of the region that is left or entered.
struct Evaluated {
    g: Pair,
    psi: Pair,
}

/// The largest |g| and |ψ − ψ_ref| at the transitions.
struct Worst<E> {
    evaluate: E,
    reference: Option<Pair>,
    g: f64,
    level: f64,
}

impl<R: Copy, const N: usize, E> Observer<R, N> for Worst<E>
where
    E: Fn(R, [Pair; N]) -> Option<Evaluated>,
{
    fn transition(&mut self, transition: &Transition<R, N>) -> ControlFlow<()> {
        let x = std::array::from_fn(|i| Pair(transition.x[i], transition.remainder[i]));
        if let Some(Evaluated { g, psi }) = (self.evaluate)(transition.to, x) {
            let reference = *self.reference.get_or_insert(psi);
            self.g = self.g.max(g.0.abs());
            self.level = self.level.max((psi - reference).0.abs());
        }
        ControlFlow::Continue(())
    }
}

/// (transitions, largest |g|, largest |ψ − ψ_ref|) until `t_end`.
fn worst<Sys: System<N>, const N: usize>(
    system: &Sys,
    x0: [f64; N],
    tolerance: f64,
    t_end: f64,
    evaluate: impl Fn(Sys::Region, [Pair; N]) -> Option<Evaluated>,
) -> (u64, f64, f64) {
    let mut worst = Worst {
        evaluate,
        reference: None,
        g: 0.0,
        level: 0.0,
    };
    let end = Integrator::new(system, Taylor::tolerance(tolerance))
        .initial(0.0, x0)
        .observe_until(t_end, &mut worst)
        .unwrap();
    (end.statistics.transitions, worst.g, worst.level)
}

pws! {
    /// Motion along elliptic curves, with another curve inside the unit circle.
    system Elliptic {
        state x, y;
        interface circle = x^2 + y^2 - 1;
        region inside where circle < 0 {
            der(x) = 2 * y;
            der(y) = 3 * x^2 - 3;
            conserved curve = y^2 - x^3 + 3 * x;
        }
        region outside where circle > 0 {
            der(x) = 2 * y;
            der(y) = 3 * x^2 - 2;
            conserved curve = y^2 - x^3 + 2 * x;
        }
    }
}

#[test]
fn levels_of_a_closed_orbit_stay() {
    for tolerance in [1e-3, 1e-6, 1e-15] {
        let (transitions, g, level) =
            worst(&Elliptic {}, [-1.0, -1.0], tolerance, 1e4, |to, [x, y]| {
                let g = x * x + y * y - number(1.0);
                let psi = y * y - x * x * x + number(2.0) * x;
                (to == EllipticRegion::Outside).then_some(Evaluated { g, psi })
            });
        assert!(transitions > 10_000);
        // of terms of the size 1, some units of 2⁻¹⁰⁴
        assert!(g <= 1e-30, "{tolerance:e}: {g:e}");
        assert!(level <= 1e-28, "{tolerance:e}: {level:e}");
    }
}

pws! {
    /// Hénon and Heiles' problem, twice as fast below y = 0: a chaotic orbit that never closes.
    system Rushing {
        state x, y, u, v;
        interface line = y;
        region above where line > 0 {
            der(x) = u;
            der(y) = v;
            der(u) = -x - 2 * x * y;
            der(v) = -y - x^2 + y^2;
            conserved energy = (u^2 + v^2 + x^2 + y^2) / 2 + x^2 * y - y^3 / 3;
        }
        region below where line < 0 {
            der(x) = 2 * u;
            der(y) = 2 * v;
            der(u) = 2 * (-x - 2 * x * y);
            der(v) = 2 * (-y - x^2 + y^2);
            conserved energy = (u^2 + v^2 + x^2 + y^2) / 2 + x^2 * y - y^3 / 3;
        }
    }
}

#[test]
fn the_level_of_an_orbit_that_never_closes_stays() {
    for tolerance in [1e-3, 1e-6, 1e-15] {
        let (transitions, g, level) = worst(
            &Rushing {},
            [0.0, 0.1, 0.48, 0.1],
            tolerance,
            2e4,
            |_, [x, y, u, v]| {
                // 6H
                let squares = u * u + v * v + x * x + y * y;
                let psi =
                    number(3.0) * squares + number(6.0) * (x * x * y) - number(2.0) * (y * y * y);
                Some(Evaluated { g: y, psi })
            },
        );
        assert!(transitions > 5_000);
        assert!(g <= 1e-30, "{tolerance:e}: {g:e}");
        assert!(level <= 1e-27, "{tolerance:e}: {level:e}");
    }
}
