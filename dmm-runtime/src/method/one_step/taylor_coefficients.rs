//! Steps as long as the Taylor coefficients of the solution allow.

use super::map::{OneStep, Step};
use super::step_size::{COEFFICIENTS, Expansion, StepSizeControl};
use super::step_sizes::{Carried, DENSE, Output, StepSizes, Trial};
use crate::arithmetic::linear::is_finite;
use crate::arithmetic::{State, Time};
use crate::contract::{Dynamics, Vector};
use crate::method::{Cursor, Failure, Statistics, StepFailure};

/// A step is too long if at its end steps this many times shorter are asked for.
const TOO_LONG: f64 = 2.0;

/// A step from x is as long as the Taylor coefficients of the solution at x allow; see
/// [`Adaptive`](crate::Adaptive).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct TaylorCoefficients;

/// What goes from step to step.
#[derive(Clone, Debug)]
pub struct Run<T, const N: usize> {
    memory: T,
    control: StepSizeControl<N>,
    /// The solution at the start of the next step.
    expansion: Expansion<N>,
    /// The solution at its end, of a step that was made: kept here, so that it is not moved from
    /// function to function.
    end: Expansion<N>,
}

impl<Map: OneStep> StepSizes<Map> for TaylorCoefficients {
    type Run<const N: usize> = Run<Map::Memory<N>, N>;
    type Known<const N: usize> = ();

    fn begin<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
        (map, tolerance): (&Map, f64),
        dynamics: &D,
        (t, x): (f64, &Vector<f64, N>),
        carried: &Carried<N>,
    ) -> Self::Run<N> {
        let mut control = StepSizeControl::new(map.order(), tolerance, carried.sizes.as_slice());
        let expansion = control.expand(dynamics, t, x, carried.step);
        Run {
            memory: map.begin(dynamics, None),
            expansion,
            end: expansion,
            control,
        }
    }

    fn wanted<const N: usize>(run: &Self::Run<N>) -> f64 {
        1.0 / run.expansion.rate
    }

    fn sizes<const N: usize>(run: &Self::Run<N>) -> &[f64] {
        run.control.sizes()
    }

    #[inline]
    fn attempt<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
        map: &Map,
        run: &mut Self::Run<N>,
        step: &Step<'_, D, N>,
        end: f64,
        statistics: &mut Statistics,
    ) -> Result<Trial<(), N>, StepFailure> {
        let increment = if run.expansion.is_at_rest {
            Vector::zeros()
        } else {
            map.varied_step(step, &mut run.memory, statistics)?
        };
        let x1 = step.x0 + increment;
        run.end = run.control.expand(step.dynamics, end, &x1, step.tau);
        if !(is_finite(&x1) && run.end.rate.is_finite()) {
            return Err(StepFailure::NotFinite);
        }
        Ok(if run.end.rate * step.tau <= TOO_LONG {
            Trial::Made {
                increment,
                known: (),
            }
        } else {
            Trial::TooLong(None)
        })
    }

    fn restart<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
        map: &Map,
        run: &mut Self::Run<N>,
        dynamics: &D,
        _failed: bool,
    ) {
        run.memory = map.begin(dynamics, None);
    }

    /// The Taylor polynomial of order p + 1 at the start of the step, and a term of the next order
    /// that leads to its end.
    fn dense<const N: usize>(
        map: &Map,
        run: &Self::Run<N>,
        _known: &(),
        (_, increment, tau): (&Vector<f64, N>, &Vector<f64, N>, f64),
    ) -> Output<N> {
        let expansion = &run.expansion;
        let s = tau / expansion.unit;
        let last = (map.order() + 2).min(COEFFICIENTS);
        let coefficients = std::array::from_fn(|i| {
            let mut dense = [0.0; DENSE];
            dense[..last].copy_from_slice(&expansion.coefficients[i][..last]);
            let reached = dense[1..last].iter().rev().fold(0.0, |sum, c| sum * s + c) * s;
            let power = s.powi(last as i32);
            let rest = (increment[i] - reached) / power;
            dense[last] = if rest.is_finite() { rest } else { 0.0 };
            dense
        });
        Output {
            unit: expansion.unit,
            coefficients,
        }
    }

    /// The part of the radius of convergence that a step takes.
    fn decay(map: &Map, tolerance: f64) -> f64 {
        tolerance.powf(1.0 / (map.order() + 1) as f64)
    }

    fn advance<const N: usize>(run: &mut Self::Run<N>, _known: ()) {
        run.expansion = run.end;
    }

    fn reach<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
        (map, tolerance): (&Map, f64),
        carried: &Carried<N>,
        dynamics: &D,
        cursor: &mut Cursor<N>,
        to: f64,
    ) -> Result<(), Failure> {
        let mut control = StepSizeControl::new(map.order(), tolerance, carried.sizes.as_slice());
        let (mut t, mut x) = (cursor.time.value, cursor.state.rounded());
        let mut before = 0.0;
        while t < to {
            let wanted = 1.0 / control.expand(dynamics, t, &x, before).rate;
            // NaN too ends there: the step then fails
            let end = if t + wanted < to { t + wanted } else { to };
            let tau = end - t;
            let step = Step {
                dynamics,
                t0: t,
                x0: &x,
                tau,
            };
            let increment = map.step(&step, &mut Statistics::default());
            let increment = increment.map_err(|failure| failure.over(tau))?;
            if !(tau > 0.0 && is_finite(&increment)) {
                return Err(StepFailure::NotFinite.over(tau));
            }
            x += increment;
            t = end;
            before = tau;
            (cursor.time, cursor.state) = (Time::new(t), State::new(x));
        }
        Ok(())
    }
}
