//! The kernels, written out by hand.

use super::{END, Run, STEP_SIZE};

/// What differs between the two systems, for the side `above` of the interface.
pub(super) trait Kernel: Copy {
    /// The kernel of a region.
    fn region(above: bool) -> Self;
    /// Increment of a full step; `predicted` is the extrapolated increment.
    fn step(
        &self,
        x: [f64; 2],
        predicted: [f64; 2],
        sweeps: &mut Sweeps,
        iterations: &mut u64,
    ) -> [f64; 2];
    /// Increment and velocity of a step of any size.
    fn partial(&self, x: [f64; 2], tau: f64) -> ([f64; 2], [f64; 2]);
    /// ψ and ∇ψ.
    fn level(&self, x: [f64; 2]) -> (f64, [f64; 2]);
    /// g and ∇g.
    fn switching(x: [f64; 2]) -> (f64, [f64; 2]);
    /// Whether increments are extrapolated.
    const PREDICTS: bool;
}

/// y = 0; ẋ = y, ẏ = −k x.
#[derive(Clone, Copy)]
pub(super) struct Harmonic {
    k: f64,
    /// d = K x
    diagonal: f64,
    upper: f64,
    lower: f64,
}

impl Kernel for Harmonic {
    const PREDICTS: bool = false;

    fn region(above: bool) -> Self {
        let k = if above { 1.0 } else { 3.0 };
        let (diagonal, upper, lower) = propagator(k, STEP_SIZE);
        Self {
            k,
            diagonal,
            upper,
            lower,
        }
    }

    #[inline(always)]
    fn step(&self, [x, y]: [f64; 2], _: [f64; 2], _: &mut Sweeps, _: &mut u64) -> [f64; 2] {
        [
            self.diagonal * x + self.upper * y,
            self.lower * x + self.diagonal * y,
        ]
    }

    fn partial(&self, [x, y]: [f64; 2], tau: f64) -> ([f64; 2], [f64; 2]) {
        let (diagonal, upper, lower) = propagator(self.k, tau);
        let d = [diagonal * x + upper * y, lower * x + diagonal * y];
        (d, [y + d[1], -self.k * (x + d[0])])
    }

    #[inline(always)]
    fn level(&self, [x, y]: [f64; 2]) -> (f64, [f64; 2]) {
        let kx = self.k * x;
        (0.5 * (kx * x + y * y), [kx, y])
    }

    #[inline(always)]
    fn switching([_, y]: [f64; 2]) -> (f64, [f64; 2]) {
        (y, [0.0, 1.0])
    }
}

/// (I − τA/2)⁻¹ τA of the harmonic oscillator: diagonal, upper, lower.
fn propagator(k: f64, tau: f64) -> (f64, f64, f64) {
    let scale = 1.0 / (1.0 + 0.25 * k * tau * tau);
    (-0.5 * k * tau * tau * scale, tau * scale, -k * tau * scale)
}

/// x² + y² = 1; ẋ = 2y, ẏ = 3x² + a.
#[derive(Clone, Copy)]
pub(super) struct Elliptic {
    a: f64,
}

/// Fixed-point sweeps in place of Newton's method.
#[derive(Clone, Copy, Default)]
pub(super) struct Sweeps {
    /// Steps until Newton's method has another turn.
    left: u32,
    /// A last correction is as small as this.
    tolerance: [f64; 2],
}

impl Elliptic {
    /// The sweeps of the steps after one over `[d, e]`: the contraction of τ ∂f^τ/∂x₁ leaves
    /// of a last correction less than half a unit in the last place.
    #[inline(never)]
    fn sweeps(&self, [x, y]: [f64; 2], [d, e]: [f64; 2]) -> Sweeps {
        let scale = [d.abs() + x.abs() / 64.0, e.abs() + y.abs() / 64.0];
        let lower = STEP_SIZE * (2.0 * (x + d) + x).abs();
        let rows = [STEP_SIZE * scale[1] / scale[0], lower * scale[0] / scale[1]];
        let part = 0.25 * f64::EPSILON / rows[0].max(rows[1]);
        Sweeps {
            left: 31,
            tolerance: [scale[0] * part, scale[1] * part],
        }
    }

    #[inline(always)]
    fn newton(
        &self,
        [x, y]: [f64; 2],
        tau: f64,
        predicted: [f64; 2],
        iterations: &mut u64,
    ) -> [f64; 2] {
        let [mut d, mut e] = predicted;
        loop {
            *iterations += 1;
            let (x1, y1) = (x + d, y + e);
            let f = [y1 + y, x1 * x1 + x1 * x + x * x + self.a];
            let (r, s) = (d - tau * f[0], e - tau * f[1]);
            // I − τ [[0, 1], [2x₁ + x, 0]]
            let lower = -tau * (x1 + x1 + x);
            let scale = 1.0 / (1.0 + tau * lower);
            let (u, v) = ((r + tau * s) * scale, (s - lower * r) * scale);
            (d, e) = (d - u, e - v);
            let small = |c: f64, d: f64, x: f64| c.abs() <= 7.5e-9 * (d.abs() + 2.4e-4 * x.abs());
            if small(u, d, x) && small(v, e, y) {
                return [d, e];
            }
        }
    }
}

impl Kernel for Elliptic {
    const PREDICTS: bool = true;

    fn region(above: bool) -> Self {
        Self {
            a: if above { -2.0 } else { -3.0 },
        }
    }

    #[inline(always)]
    fn step(
        &self,
        [x, y]: [f64; 2],
        predicted: [f64; 2],
        sweeps: &mut Sweeps,
        iterations: &mut u64,
    ) -> [f64; 2] {
        let [mut d, mut e] = predicted;
        if sweeps.left > 0 {
            sweeps.left -= 1;
            for _ in 0..3 {
                let x1 = x + d;
                let (u, v) = (
                    STEP_SIZE * (y + e + y),
                    STEP_SIZE * (x1 * x1 + x1 * x + x * x + self.a),
                );
                let small =
                    (u - d).abs() <= sweeps.tolerance[0] && (v - e).abs() <= sweeps.tolerance[1];
                (d, e) = (u, v);
                if small {
                    return [d, e];
                }
            }
            return self.newton([x, y], STEP_SIZE, [d, e], iterations);
        }
        let [u, v] = self.newton([x, y], STEP_SIZE, predicted, iterations);
        *sweeps = self.sweeps([x, y], [u, v]);
        [u, v]
    }

    fn partial(&self, [x, y]: [f64; 2], tau: f64) -> ([f64; 2], [f64; 2]) {
        let field = [2.0 * y, 3.0 * x * x + self.a];
        let d = self.newton([x, y], tau, [tau * field[0], tau * field[1]], &mut 0);
        let (x1, y1) = (x + d[0], y + d[1]);
        (d, [2.0 * y1, 3.0 * x1 * x1 + self.a])
    }

    #[inline(always)]
    fn level(&self, [x, y]: [f64; 2]) -> (f64, [f64; 2]) {
        let q = x * x;
        (y * y - x * (q + self.a), [-(3.0 * q + self.a), y + y])
    }

    #[inline(always)]
    fn switching([x, y]: [f64; 2]) -> (f64, [f64; 2]) {
        (x * x + y * y - 1.0, [x + x, y + y])
    }
}

#[inline(always)]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let c = s - a;
    (s, (a - (s - c)) + (b - c))
}

/// State with remainder.
#[derive(Clone, Copy)]
struct State {
    x: [f64; 2],
    rest: [f64; 2],
}

impl State {
    #[inline(always)]
    fn after(self, d: [f64; 2], more: [f64; 2]) -> Self {
        let one = |i: usize| {
            let (x, error) = two_sum(self.x[i], d[i]);
            let (x, rest) = two_sum(x, self.rest[i] + more[i]);
            (x, error + rest)
        };
        let (a, b) = (one(0), one(1));
        Self {
            x: [a.0, b.0],
            rest: [a.1, b.1],
        }
    }

    #[inline(always)]
    fn normalised(self, more: [f64; 2]) -> Self {
        let a = two_sum(self.x[0], self.rest[0] + more[0]);
        let b = two_sum(self.x[1], self.rest[1] + more[1]);
        Self {
            x: [a.0, b.0],
            rest: [a.1, b.1],
        }
    }

    #[inline(always)]
    fn after_quickly(self, d: [f64; 2]) -> Self {
        let (a, b) = (two_sum(self.x[0], d[0]), two_sum(self.x[1], d[1]));
        Self {
            x: [a.0, b.0],
            rest: [self.rest[0] + a.1, self.rest[1] + b.1],
        }
    }
}

#[inline(always)]
fn correction<K: Kernel>(kernel: &K, level: f64, state: State) -> [f64; 2] {
    let (psi, [a, b]) = kernel.level(state.x);
    let r = (psi - level + (a * state.rest[0] + b * state.rest[1])) / (a * a + b * b);
    [-a * r, -b * r]
}

/// T = END in steps of STEP_SIZE from `x`.
pub(super) fn run<K: Kernel>(x: [f64; 2]) -> Run {
    let count = (END / STEP_SIZE).round() as u64;
    let mut state = State { x, rest: [0.0; 2] };
    let mut above = K::switching(x).0 >= 0.0;
    // the elliptic start is outside; the harmonic one has y > 0
    let mut run = Run {
        x,
        steps: 0,
        iterations: 0,
        transitions: 0,
    };
    let mut node = 0;
    // the part of the current step that a transition left
    let mut left = 0.0;
    while node < count {
        let kernel = K::region(above);
        let sign = if above { 1.0 } else { -1.0 };
        let (psi, [a, b]) = kernel.level(state.x);
        let level = psi + (a * state.rest[0] + b * state.rest[1]);
        if left > 0.0 {
            state = state.after(kernel.partial(state.x, left).0, [0.0; 2]);
            run.steps += 1;
            node += 1;
        }
        let mut g = sign * K::switching(state.x).0;
        let mut change = f64::INFINITY;
        let mut recent = [[0.0f64; 2]; 6];
        let mut sweeps = Sweeps::default();
        let mut known = 0;
        loop {
            if node >= count {
                break;
            }
            let predicted = if !K::PREDICTS {
                [0.0; 2]
            } else if known >= 6 {
                let [p, q, r, s, t, u] = recent;
                let one =
                    |i: usize| (p[i] + t[i]) * 6.0 - (q[i] + s[i]) * 15.0 + (r[i] * 20.0 - u[i]);
                [one(0), one(1)]
            } else {
                kernel.partial(state.x, STEP_SIZE).0
            };
            if known < 6 {
                sweeps.left = 0;
            }
            let d = kernel.step(state.x, predicted, &mut sweeps, &mut run.iterations);
            if K::PREDICTS {
                let [p, q, r, s, t, _] = recent;
                recent = [d, p, q, r, s, t];
                known += 1;
            }
            let next = state.after_quickly(d);
            let end = sign * K::switching(next.x).0;
            let lowest = if end < g { end } else { g };
            if lowest <= 2.0 * ((end - g).abs() + change) && end <= 0.0 {
                let (theta, point) = locate(&kernel, sign, state, g, end);
                state = point;
                left = STEP_SIZE - theta;
                run.steps += 1;
                run.transitions += 1;
                above = !above;
                break;
            }
            change = (end - g).abs();
            g = end;
            state = next;
            if node % 32 == 31 {
                state = state.normalised([0.0; 2]);
                state = state.normalised(correction(&kernel, level, state));
            }
            node += 1;
            run.steps += 1;
            left = 0.0;
        }
    }
    run.x = [state.x[0] + state.rest[0], state.x[1] + state.rest[1]];
    run
}

/// The crossing between g > 0 and `end` ≤ 0, by Newton's method in time.
fn locate<K: Kernel>(kernel: &K, sign: f64, state: State, g: f64, end: f64) -> (f64, State) {
    let mut theta = STEP_SIZE * g / (g - end);
    let mut point = state;
    for _ in 0..10 {
        let (d, velocity) = kernel.partial(state.x, theta);
        point = state.after(d, [0.0; 2]);
        let (value, [a, b]) = K::switching(point.x);
        let value = sign * (value + a * point.rest[0] + b * point.rest[1]);
        let delta = -value / (sign * (a * velocity[0] + b * velocity[1]));
        theta += delta;
        if delta.abs() <= 1e-9 * STEP_SIZE {
            return (
                theta,
                state.after(kernel.partial(state.x, theta).0, [0.0; 2]),
            );
        }
    }
    (theta, point)
}
