//! differential-equations: Verner's method of order 9, with crossings found on its dense output
//! and the solution continued there. (The crate's own search for events can return points that
//! are not on the interface, and the dense output of its method of order 8 is too coarse.)

use differential_equations::ode::{OrdinaryNumericalMethod, solve_ode};
use differential_equations::prelude::{
    ControlFlag, ExplicitRungeKutta, Interpolation, ODE, Solout, Solution,
};
use dmm_runtime::System;

use crate::sides::Sides;
use crate::{End, Outcome};

/// At tolerances below rounding its steps come to nothing.
const MOST_STEPS: usize = 2_000_000;
/// Corrections of a crossing.
const MOST_CORRECTIONS: usize = 60;

struct Equations<'a, 's, Sys: System<N>, const N: usize>(&'a Sides<'s, Sys, N>);

impl<Sys: System<N>, const N: usize> ODE<f64, [f64; N]> for Equations<'_, '_, Sys, N> {
    fn diff(&self, t: f64, x: &[f64; N], dx: &mut [f64; N]) {
        *dx = self.0.field(t, x);
    }
}

/// Finds crossings in the steps, by false position (the Illinois variant).
struct Crossings<'a, 's, Sys: System<N>, const N: usize> {
    sides: &'a Sides<'s, Sys, N>,
    count: u64,
    x: [f64; N],
}

impl<Sys: System<N>, const N: usize> Solout<f64, [f64; N]> for Crossings<'_, '_, Sys, N> {
    fn solout<I>(
        &mut self,
        t: f64,
        t_before: f64,
        x: &[f64; N],
        x_before: &[f64; N],
        interpolation: &mut I,
        _: &mut Solution<f64, [f64; N]>,
    ) -> ControlFlag<f64, [f64; N]>
    where
        I: Interpolation<f64, [f64; N]> + ?Sized,
    {
        self.x = *x;
        let sign = self.sides.sign();
        let g = |t: f64, x: &[f64; N]| sign * self.sides.switching(t, x);
        if t <= t_before || g(t, x) > 0.0 {
            return ControlFlag::Continue;
        }
        let (mut low, mut high, mut between) = (t_before, t, *x);
        let (mut g_low, mut g_high) = (g(t_before, x_before), g(t, x));
        if g_low <= 0.0 {
            g_low = f64::MIN_POSITIVE;
        }
        for _ in 0..MOST_CORRECTIONS {
            let secant = low + (high - low) * g_low / (g_low - g_high);
            let middle = if secant > low && secant < high {
                secant
            } else {
                0.5 * (low + high)
            };
            if middle <= low || middle >= high {
                break;
            }
            let Ok(x) = interpolation.interpolate(middle) else {
                break;
            };
            between = x;
            let value = g(middle, &between);
            if value > 0.0 {
                (low, g_low, g_high) = (middle, value, 0.5 * g_high);
            } else {
                (high, g_high, g_low) = (middle, value, 0.5 * g_low);
            }
            if value == 0.0 {
                break;
            }
        }
        self.sides.cross();
        self.count += 1;
        self.x = between;
        ControlFlag::ModifyState(high, between)
    }
}

fn method<const N: usize>(
    tolerance: f64,
) -> impl OrdinaryNumericalMethod<f64, [f64; N]> + Interpolation<f64, [f64; N]> {
    ExplicitRungeKutta::rkv989e()
        .rtol(tolerance)
        .atol(tolerance)
        .max_steps(MOST_STEPS)
}

pub fn rkv989e<Sys: System<N>, const N: usize>(
    sides: &Sides<'_, Sys, N>,
    initial: [f64; N],
    t_end: f64,
    tolerance: f64,
) -> Outcome<End<N>> {
    let mut crossings = Crossings {
        sides,
        count: 0,
        x: initial,
    };
    let equations = Equations(sides);
    let mut method = method(tolerance);
    let solution = solve_ode(
        &mut method,
        &equations,
        0.0,
        t_end,
        &initial,
        &mut crossings,
    )
    .map_err(|error| format!("{error:?}"))?;
    Ok(End {
        x: crossings.x,
        steps: solution.steps.accepted as u64,
        crossings: crossings.count,
    })
}
