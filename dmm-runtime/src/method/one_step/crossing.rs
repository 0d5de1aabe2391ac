//! Locating a crossing: (t̂*, x̂*) with x̂* = x_k + (t̂* − t_k) f^τ(t_k, x_k, t̂*, x̂*) and
//! g(t̂*, x̂*) = 0, solved together (Hirani, Wan & Wojtalewicz, eqs. 2.4–2.5).
//!
//! The order of accuracy of a scheme survives a transition only if t̂* is as accurate as the
//! scheme (their Theorem 3.1). [`NewtonLocator`] solves to rounding; [`Uniform::locator`](super::Uniform::locator)
//! takes any other [`Locator`].

use super::map::{OneStep, Step};
use crate::arithmetic::State;
use crate::contract::{Dynamics, Guards, Vector};
use crate::events::cubic::Reading;
use crate::method::Statistics;
use crate::method::StepFailure;

/// A step in which an interface is crossed, as a locator sees it.
///
/// The sign of g is turned so that g is positive in the mode that is left: g falls through
/// zero between `lower` and `upper`.
#[derive(Debug)]
pub struct Crossing<'a, Map, F, const N: usize> {
    /// The one-step map.
    pub map: &'a Map,
    /// The dynamics of the mode that is left.
    pub dynamics: &'a F,
    /// Index of the guard: an interface, or the condition of a proof.
    pub guard: usize,
    /// Start of the step.
    pub t0: f64,
    /// State there.
    pub state: &'a State<N>,
    /// A time after `t0`, as a difference to it, at which g ≥ 0.
    pub lower: f64,
    /// A later one at which g ≤ 0.
    pub upper: f64,
    /// The step size τ of the scheme, of which the step may be a part.
    pub step_size: f64,
    pub(crate) sign: f64,
}

/// A located crossing.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Located<const N: usize> {
    /// t̂* − t₀
    pub elapsed: f64,
    /// x̂* − x₀
    pub increment: Vector<f64, N>,
}

/// Finds the point at which an interface is crossed.
pub trait Locator: Clone + Sync {
    /// Solves for (t̂*, x̂*), or returns nothing if it cannot.
    fn locate<Map: OneStep, const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        crossing: &Crossing<'_, Map, F, N>,
        statistics: &mut Statistics,
    ) -> Option<Located<N>>;
}

impl<Map: OneStep, F, const N: usize> Crossing<'_, Map, F, N> {
    /// The part of the step until `elapsed`.
    fn part(&self, elapsed: f64) -> Step<'_, F, N> {
        Step {
            dynamics: self.dynamics,
            t0: self.t0,
            x0: &self.state.x,
            tau: elapsed,
        }
    }

    /// x(t₀ + elapsed) − x₀ by one step of the scheme.
    ///
    /// # Errors
    /// If the step cannot be made.
    pub fn increment<const M: usize>(
        &self,
        elapsed: f64,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure>
    where
        F: Dynamics<f64, N, M>,
    {
        if elapsed == 0.0 {
            return Ok(Vector::zeros());
        }
        self.map.step(&self.part(elapsed), statistics)
    }

    /// g (positive in the mode that is left), ∂ₜg and ∇g after `increment`, the state's
    /// remainder taken into account.
    pub fn switching<const M: usize>(
        &self,
        elapsed: f64,
        increment: &Vector<f64, N>,
    ) -> (f64, f64, Vector<f64, N>)
    where
        F: Dynamics<f64, N, M>,
    {
        let t = self.t0 + elapsed;
        let end = self.state.after(increment);
        let guards = self.dynamics.guards();
        let value = guards.switching_function(self.guard, t, &end.x);
        let (rate, gradient) = guards.switching_gradient(self.guard, t, &end.x);
        (
            self.sign * (value + gradient.dot(&end.remainder)),
            self.sign * rate,
            gradient * self.sign,
        )
    }

    /// g (positive in the mode that is left) and dg/dt along the one-step map; nothing if the step
    /// cannot be made, or g is not finite.
    pub(crate) fn reading<const M: usize>(
        &self,
        elapsed: f64,
        statistics: &mut Statistics,
    ) -> Option<Reading>
    where
        F: Dynamics<f64, N, M>,
    {
        let increment = self.increment::<M>(elapsed, statistics).ok()?;
        let (value, by_time, gradient) = self.switching(elapsed, &increment);
        let x = self.state.x + increment;
        let field = self.dynamics.vector_field(self.t0 + elapsed, &x);
        let rate = by_time + gradient.dot(&field);
        value.is_finite().then_some(Reading { value, rate })
    }

    /// Widens the bracket, which is one of the dense output of a step over `tau`, until g ≥ 0 at
    /// its lower end and g ≤ 0 at its upper end on the one-step map, which is close to it: false if
    /// g returns before, nothing if it has no finite value. A step on an active guard starts at a root that
    /// does not count.
    pub(crate) fn bracket_on_map<const M: usize>(
        &mut self,
        tau: f64,
        is_active: bool,
        statistics: &mut Statistics,
    ) -> Option<bool>
    where
        F: Dynamics<f64, N, M>,
    {
        /// Of the step.
        const NARROW: f64 = 1e-12;
        /// Halvings of the step in search of the inside.
        const MOST_HALVINGS: u32 = 60;
        let widening = Widening {
            least: NARROW * tau,
            most: (self.upper - self.lower).max(NARROW * tau),
        };
        // the dense output ends where the map does
        let ends = self.upper >= tau;
        let mut later = widening;
        while self.upper < tau {
            let reading = self.reading(self.upper, statistics)?;
            if reading.value <= 0.0 {
                break;
            }
            self.upper = (self.upper + later.next(reading)).min(tau);
        }
        if !ends && self.upper >= tau && value_at(self, tau, statistics)?.0 > 0.0 {
            return Some(false);
        }
        let mut earlier = widening;
        while self.lower > 0.0 {
            let reading = self.reading(self.lower, statistics)?;
            if reading.value > 0.0 {
                break;
            }
            self.lower = (self.lower - earlier.next(reading)).max(0.0);
        }
        if self.lower > 0.0 || !is_active {
            return Some(true);
        }
        let mut middle = self.upper;
        for _ in 0..MOST_HALVINGS {
            middle *= 0.5;
            if value_at(self, middle, statistics)?.0 > 0.0 {
                self.lower = middle;
                return Some(true);
            }
            self.upper = middle;
        }
        // an excursion that no point resolves
        None
    }
}

/// How far an end of a bracket is moved, from one attempt to the next.
#[derive(Clone, Copy)]
struct Widening {
    least: f64,
    most: f64,
}

impl Widening {
    /// Twice as far as where g falls it has its zero along the tangent, so that the next zero but
    /// one is not taken for it.
    fn next(&mut self, Reading { value, rate }: Reading) -> f64 {
        let width = if rate < 0.0 {
            (2.0 * (value / rate).abs()).clamp(self.least, self.most)
        } else {
            self.most
        };
        (self.least, self.most) = (4.0 * self.least, 4.0 * self.most);
        width
    }
}

/// Newton's method in (t̂*, x̂*) together with generated derivatives, safeguarded by the
/// bracket in time; where it does not converge, bracketing on g along the one-step map.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct NewtonLocator;

impl NewtonLocator {
    const LARGEST_ITERATIONS: u32 = 12;
    /// With an approximate velocity: the iteration converges linearly.
    const LARGEST_LINEAR: u32 = 40;
    const LARGEST_BISECTIONS: u32 = 200;
    /// A correction of time smaller than this part of the step is the last.
    const CONVERGED: f64 = 1e-9;

    fn newton<Map: OneStep, const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        crossing: &Crossing<'_, Map, F, N>,
        statistics: &mut Statistics,
    ) -> Option<Located<N>> {
        let (g_lower, _) = value_at(crossing, crossing.lower, statistics)?;
        let (g_upper, upper) = value_at(crossing, crossing.upper, statistics)?;
        let width = crossing.upper - crossing.lower;
        let share = (g_lower / (g_lower - g_upper)).clamp(0.0, 1.0);
        let mut elapsed = crossing.lower + width * if share.is_finite() { share } else { 0.5 };
        // x₀ + f θ + c θ² through both ends
        let velocity = crossing
            .dynamics
            .vector_field(crossing.t0, &crossing.state.x);
        let part = elapsed / crossing.upper;
        let mut increment =
            velocity * elapsed + (upper - velocity * crossing.upper) * (part * part);
        let iterations = if crossing.map.has_exact_velocity() {
            Self::LARGEST_ITERATIONS
        } else {
            Self::LARGEST_LINEAR
        };
        let mut before = f64::INFINITY;
        for _ in 0..iterations {
            statistics.locator_iterations += 1;
            let step = crossing.part(elapsed);
            let correction = crossing.map.correction(&step, &increment)?;
            let (value, rate, gradient) = crossing.switching(elapsed, &increment);
            let slope = rate + gradient.dot(&correction.velocity);
            let delta = -(value + gradient.dot(&correction.delta)) / slope;
            elapsed += delta;
            increment += correction.delta + correction.velocity * delta;
            let slack = Self::CONVERGED * width;
            if !(crossing.lower - slack..=crossing.upper + slack).contains(&elapsed) {
                return None;
            }
            let settled = correction.delta.amax() <= Self::CONVERGED * increment.amax();
            let is_last = crossing.map.has_exact_velocity()
                || delta.abs() <= f64::EPSILON * elapsed.abs()
                || delta.abs() >= before;
            before = delta.abs();
            if delta.abs() <= slack && settled && is_last {
                // a root at which g rises is the end of an excursion, not its beginning
                return (slope < 0.0 && elapsed >= 0.0).then_some(Located { elapsed, increment });
            }
        }
        None
    }

    /// Illinois' modification of regula falsi: superlinear, and the bracket never opens.
    fn bracket<Map: OneStep, const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        crossing: &Crossing<'_, Map, F, N>,
        statistics: &mut Statistics,
    ) -> Option<Located<N>> {
        statistics.bracketed += 1;
        let (mut lower, mut upper) = (crossing.lower, crossing.upper);
        let (mut g_lower, _) = value_at(crossing, lower, statistics)?;
        let (mut g_upper, mut increment) = value_at(crossing, upper, statistics)?;
        for iteration in 0..Self::LARGEST_BISECTIONS {
            let secant = lower + (upper - lower) * (g_lower / (g_lower - g_upper));
            let inside = secant > lower && secant < upper;
            // every third point bisects, so that a flat g cannot hold the search up
            let middle = if inside && iteration % 3 != 2 {
                secant
            } else {
                0.5 * (lower + upper)
            };
            if middle <= lower || middle >= upper {
                break;
            }
            let (g, at_middle) = value_at(crossing, middle, statistics)?;
            if g > 0.0 {
                (lower, g_lower) = (middle, g);
                g_upper *= 0.5;
            } else {
                (upper, g_upper, increment) = (middle, g, at_middle);
                g_lower *= 0.5;
                if g == 0.0 {
                    break;
                }
            }
        }
        Some(Located {
            elapsed: upper,
            increment,
        })
    }
}

/// g along the one-step map, and the increment there.
fn value_at<Map: OneStep, const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
    crossing: &Crossing<'_, Map, F, N>,
    elapsed: f64,
    statistics: &mut Statistics,
) -> Option<(f64, Vector<f64, N>)> {
    let increment = crossing.increment::<M>(elapsed, statistics).ok()?;
    let (value, ..) = crossing.switching(elapsed, &increment);
    value.is_finite().then_some((value, increment))
}

impl Locator for NewtonLocator {
    fn locate<Map: OneStep, const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        crossing: &Crossing<'_, Map, F, N>,
        statistics: &mut Statistics,
    ) -> Option<Located<N>> {
        Self::newton(crossing, statistics).or_else(|| Self::bracket(crossing, statistics))
    }
}
