//! The standard Runge–Kutta discretisation of a system of two regions, a baseline: uniform steps
//! that do not look for switches (Nurkanović, Sperl, Albrecht & Diehl, *Finite elements with switch
//! detection for direct optimal control of nonsmooth systems*, eqs 25 and 26).
//!
//! The stages of a step are
//!
//! xᵢ = x₀ + τ Σⱼ aᵢⱼ vⱼ, vᵢ = (1 − θᵢ) f₁(tᵢ, xᵢ) + θᵢ f₂(tᵢ, xᵢ), x₁ = x₀ + τ Σᵢ bᵢ vᵢ,
//!
//! with θᵢ = 0 where g(tᵢ, xᵢ) < 0, θᵢ = 1 where g(tᵢ, xᵢ) > 0, and 0 ≤ θᵢ ≤ 1 where g(tᵢ, xᵢ) = 0:
//! Stewart's complementarity conditions (8) for two regions. An explicit method takes the field of
//! the side that the stage is on. For an implicit one each stage is put below, on or above the
//! surface, and the smooth equations of that pattern are solved; the first pattern whose solution has
//! its stages there is the step. (There may be others: the conditions have several solutions
//! where the fields point apart.)
//!
//! A step that contains a switch is off by O(τ), whatever the order of the method.

use dmm_runtime::RungeKutta;
use dmm_runtime::nalgebra::{DMatrix, DVector};
use thiserror::Error;

/// Iterations of Newton's method for a pattern.
const MOST_ITERATIONS: u32 = 30;
/// A relative correction that is the last: the next one is smaller by the error of the Jacobian, 1e-8.
const CONVERGED: f64 = 1e-9;
/// What g and θ may be off by on the sides of a pattern.
const TOLERANCE: f64 = 1e-12;
/// Of difference quotients, relative.
const INCREMENT: f64 = 1e-7;
/// What θ is tried from on the surface: there may be a solution on either side of 1/2, and none that is
/// found from there.
const STARTS: [f64; 4] = [0.25, 0.75, 0.0, 1.0];

/// f(t, x)
pub type Field<'a> = dyn Fn(f64, &[f64]) -> Vec<f64> + 'a;

/// A system of two regions.
#[derive(Clone, Copy)]
pub struct TwoRegions<'a> {
    /// f₁, where g < 0.
    pub below: &'a Field<'a>,
    /// f₂, where g > 0.
    pub above: &'a Field<'a>,
    /// g(t, x)
    pub switching_function: &'a dyn Fn(f64, &[f64]) -> f64,
}

/// A step whose equations were not solved.
#[derive(Clone, Copy, PartialEq, Debug, Error)]
#[error("the equations of the standard step at t = {t} have no solution that was found")]
pub struct Unsolved {
    /// Its start.
    pub t: f64,
}

/// Where a stage is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Side {
    Below,
    On,
    Above,
}

/// x(T) from x(0) = `initial`, by `steps` uniform steps.
///
/// # Errors
/// [`Unsolved`]
pub fn integrate(
    system: &TwoRegions<'_>,
    method: RungeKutta,
    initial: &[f64],
    t_end: f64,
    steps: u32,
) -> Result<Vec<f64>, Unsolved> {
    let (a, b, c) = method.coefficients();
    let is_explicit = a.iter().enumerate().all(|(i, row)| is_zero(&row[i..]));
    let tau = t_end / f64::from(steps);
    let mut x = initial.to_vec();
    let mut before = None;
    for k in 0..steps {
        let t = f64::from(k) * tau;
        let step = Step {
            system,
            a: &a,
            times: c.iter().map(|c| t + c * tau).collect(),
            tau,
            x: &x,
        };
        let velocities = if is_explicit {
            step.explicit()
        } else {
            let (velocities, sides) = step.implicit(before).ok_or(Unsolved { t })?;
            before = sides.last().copied();
            velocities
        };
        x = step.moved(b, &velocities);
    }
    Ok(x)
}

/// A step of a method.
struct Step<'a> {
    system: &'a TwoRegions<'a>,
    a: &'a [Vec<f64>],
    /// tᵢ
    times: Vec<f64>,
    tau: f64,
    x: &'a [f64],
}

/// What the equations of a stage are made of.
struct Stage {
    t: f64,
    x: Vec<f64>,
    theta: f64,
}

impl Step<'_> {
    /// x₀ + τ Σⱼ wⱼ vⱼ
    fn moved(&self, weights: &[f64], velocities: &[Vec<f64>]) -> Vec<f64> {
        let mut x = self.x.to_vec();
        for (weight, v) in weights.iter().zip(velocities) {
            for (x, v) in x.iter_mut().zip(v) {
                *x += self.tau * weight * v;
            }
        }
        x
    }

    /// The field of a side; on the surface that of above.
    fn field(&self, side: Side, t: f64, x: &[f64]) -> Vec<f64> {
        match side {
            Side::Below => (self.system.below)(t, x),
            Side::On | Side::Above => (self.system.above)(t, x),
        }
    }

    /// Where a state is.
    fn side(&self, t: f64, x: &[f64]) -> Side {
        if (self.system.switching_function)(t, x) < 0.0 {
            Side::Below
        } else {
            Side::Above
        }
    }

    /// The velocities of the stages of an explicit method.
    fn explicit(&self) -> Vec<Vec<f64>> {
        let mut velocities = Vec::with_capacity(self.a.len());
        for (row, &t) in self.a.iter().zip(&self.times) {
            let x = self.moved(row, &velocities);
            velocities.push(self.field(self.side(t, &x), t, &x));
        }
        velocities
    }

    /// Those of an implicit method, and where its stages are; `before` is where the step before ended.
    fn implicit(&self, before: Option<Side>) -> Option<(Vec<Vec<f64>>, Vec<Side>)> {
        let stages = self.a.len();
        let predicted = match before {
            Some(Side::On) => vec![Side::On; stages],
            _ => self.predicted(),
        };
        if let Some(velocities) = self.solved(&predicted) {
            return Some((velocities, predicted));
        }
        let mut others = patterns(stages);
        let distance = |pattern: &Vec<Side>| {
            let pairs = pattern.iter().zip(&predicted);
            pairs.filter(|(side, predicted)| side != predicted).count()
        };
        others.sort_by_key(distance);
        let mut others = others.into_iter().skip(1);
        others.find_map(|pattern| Some((self.solved(&pattern)?, pattern)))
    }

    /// Where the stages are if the velocity is that at the start.
    fn predicted(&self) -> Vec<Side> {
        let start = self.times.first().copied().unwrap_or_default();
        let velocity = self.field(self.side(start, self.x), start, self.x);
        let sides = self.a.iter().zip(&self.times).map(|(row, &t)| {
            let time: f64 = row.iter().sum();
            self.side(t, &self.moved(&[time], std::slice::from_ref(&velocity)))
        });
        sides.collect()
    }

    /// The velocities of a pattern, if its equations have a solution whose stages are where it says.
    fn solved(&self, pattern: &[Side]) -> Option<Vec<Vec<f64>>> {
        let count = if pattern.contains(&Side::On) {
            STARTS.len()
        } else {
            1
        };
        let starts = STARTS.iter().take(count);
        starts
            .copied()
            .find_map(|theta| self.solved_from(pattern, theta))
    }

    /// The same by Newton's method, from that θ of the stages on the surface.
    fn solved_from(&self, pattern: &[Side], theta: f64) -> Option<Vec<Vec<f64>>> {
        let size = self.x.len() + 1;
        // vᵢ and θᵢ, stage by stage
        let mut unknowns = DVector::zeros(pattern.len() * size);
        for (i, (&side, &t)) in pattern.iter().zip(&self.times).enumerate() {
            let theta = match side {
                Side::Below => 0.0,
                Side::On => theta,
                Side::Above => 1.0,
            };
            let start = self.mean(t, theta, self.x);
            unknowns
                .rows_mut(i * size, size - 1)
                .copy_from_slice(&start);
            unknowns[i * size + size - 1] = theta;
        }
        for _ in 0..MOST_ITERATIONS {
            let (residual, jacobian) = self.equations(pattern, &unknowns);
            let correction = jacobian.lu().solve(&residual)?;
            unknowns -= &correction;
            let size = correction.amax();
            if !size.is_finite() {
                return None;
            }
            if size <= CONVERGED * (1.0 + unknowns.amax()) {
                return self.accepted(pattern, &unknowns);
            }
        }
        None
    }

    /// The velocities, if every stage is where the pattern says.
    fn accepted(&self, pattern: &[Side], unknowns: &DVector<f64>) -> Option<Vec<Vec<f64>>> {
        let (velocities, stages) = self.stages(unknowns);
        let mut places = pattern.iter().zip(&stages);
        let fits = places.all(|(side, stage)| {
            let g = (self.system.switching_function)(stage.t, &stage.x);
            match side {
                Side::Below => g <= TOLERANCE,
                Side::On => (-TOLERANCE..=1.0 + TOLERANCE).contains(&stage.theta),
                Side::Above => g >= -TOLERANCE,
            }
        });
        fits.then_some(velocities)
    }

    /// vᵢ, and the stages.
    fn stages(&self, unknowns: &DVector<f64>) -> (Vec<Vec<f64>>, Vec<Stage>) {
        let parts = unknowns.as_slice().chunks(self.x.len() + 1);
        let (velocities, thetas): (Vec<Vec<f64>>, Vec<f64>) = parts
            .map(|part| (part[..self.x.len()].to_vec(), part[self.x.len()]))
            .unzip();
        let stage = |((row, &t), theta): ((&Vec<f64>, &f64), f64)| Stage {
            t,
            x: self.moved(row, &velocities),
            theta,
        };
        let rows = self.a.iter().zip(&self.times).zip(thetas);
        let stages = rows.map(stage).collect();
        (velocities, stages)
    }

    /// The residual of the equations of a pattern, and its Jacobian.
    fn equations(&self, pattern: &[Side], unknowns: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let n = self.x.len();
        let (velocities, stages) = self.stages(unknowns);
        let mut residual = DVector::zeros(unknowns.len());
        let mut jacobian = DMatrix::identity(unknowns.len(), unknowns.len());
        for (i, (&side, stage)) in pattern.iter().zip(&stages).enumerate() {
            let row = i * (n + 1);
            // the field, and in the last place what is zero on the side
            let equation = |x: &[f64]| -> Vec<f64> {
                let mut values = match side {
                    Side::On => self.mean(stage.t, stage.theta, x),
                    side => self.field(side, stage.t, x),
                };
                values.push(match side {
                    Side::On => (self.system.switching_function)(stage.t, x),
                    _ => 0.0,
                });
                values
            };
            let values = equation(&stage.x);
            for k in 0..n {
                residual[row + k] = velocities[i][k] - values[k];
            }
            residual[row + n] = -values[n];
            if side == Side::On {
                let (below, above) = self.both(stage.t, &stage.x);
                for k in 0..n {
                    jacobian[(row + k, row + n)] = below[k] - above[k];
                }
                jacobian[(row + n, row + n)] = 0.0;
            }
            for l in 0..n {
                let mut x = stage.x.clone();
                let increment = INCREMENT * (1.0 + x[l].abs());
                x[l] += increment;
                let changed = equation(&x);
                for k in 0..=n {
                    let slope = (changed[k] - values[k]) / increment;
                    for (j, a) in self.a[i].iter().enumerate() {
                        jacobian[(row + k, j * (n + 1) + l)] -= self.tau * a * slope;
                    }
                }
            }
        }
        (residual, jacobian)
    }

    /// f₁ and f₂
    fn both(&self, t: f64, x: &[f64]) -> (Vec<f64>, Vec<f64>) {
        ((self.system.below)(t, x), (self.system.above)(t, x))
    }

    /// (1 − θ) f₁ + θ f₂
    fn mean(&self, t: f64, theta: f64, x: &[f64]) -> Vec<f64> {
        let (below, above) = self.both(t, x);
        let pairs = below.iter().zip(&above);
        pairs.map(|(f1, f2)| f1 + theta * (f2 - f1)).collect()
    }
}

fn is_zero(row: &[f64]) -> bool {
    row.iter().all(|a| *a == 0.0)
}

/// Every pattern of so many stages.
fn patterns(stages: usize) -> Vec<Vec<Side>> {
    let mut all = vec![Vec::new()];
    for _ in 0..stages {
        let longer = all.iter().flat_map(|pattern: &Vec<Side>| {
            let sides = [Side::Below, Side::On, Side::Above].into_iter();
            sides.map(|side| [&pattern[..], &[side]].concat())
        });
        all = longer.collect();
    }
    all
}
