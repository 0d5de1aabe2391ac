//! What an affine switching function does in a step, from its values and rates at both ends.
//!
//! Along x' = A x + b let g = c·x + γt + d. The cubic H through g and g′ at both ends of a step
//! h has the error
//!
//! g − H = g⁗(ξ)/24 s²(1 − s)² h⁴, s the part of the step,
//!
//! and g⁗ = c A³ f with f(t) = exp(tA) f(0), so that |g⁗| is bounded by a constant row times
//! |f| at an earlier time. As s²(1 − s)² ≤ 3s(1 − s)²/12 and 3s²(1 − s)/12, the error enters the
//! two inner Bernstein coefficients of H with |g⁗| h⁴/288 each. If all four are then positive,
//! g is; and if H falls faster than the error of its slope, at most |g⁗| h³/(72√3) (Birkhoff &
//! Priver, J. Math. and Phys. 46, 1967), g falls and has one root.

/// g and dg/dt at a point, positive inside the region.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Reading {
    pub(crate) value: f64,
    pub(crate) rate: f64,
}

/// How far g may be from the cubic through its ends, in units of g.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bend {
    /// |g⁗| h⁴/288
    pub(crate) truncation: f64,
    /// The rounding error of g.
    pub(crate) noise: f64,
}

/// What is known of an interface in a step.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Glance {
    /// It is not reached, and perhaps not for a while.
    Out {
        /// Whether the cubic goes on well inside for twice the step.
        room: bool,
    },
    /// It is crossed once, about here.
    Once(f64),
    /// It may be reached.
    Near,
}

/// A switching function over a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Curve {
    pub(crate) start: Reading,
    pub(crate) end: Reading,
    /// h
    pub(crate) tau: f64,
}

impl Curve {
    /// A glance at the step; it is `fresh` if it starts on the interface.
    #[inline(always)]
    pub(crate) fn glance(&self, bend: Bend, fresh: bool) -> Glance {
        /// 288/(72√3), and the noise of three values, rounded up.
        const SLOPE: f64 = 6.0;
        /// A step twice as long bends so many times as much.
        const TWICE: f64 = 16.0;
        let h = self.tau;
        let (g0, g3) = (self.start.value, self.end.value);
        let (d0, d3) = (self.start.rate * h, self.end.rate * h);
        let (g1, g2) = (g0 + d0 * (1.0 / 3.0), g3 - d3 * (1.0 / 3.0));
        let error = bend.truncation + bend.noise;
        let inside = g1.min(g2) > error && g3 > bend.noise;
        if inside && (fresh || g0 > bend.noise) {
            let rise = g3 - g0;
            let (square, cube) = (3.0 * rise - 2.0 * d0 - d3, d0 + d3 - 2.0 * rise);
            let double = g0 + 2.0 * (d0 + 2.0 * (square + 2.0 * cube));
            let triple = g0 + 3.0 * (d0 + 3.0 * (square + 3.0 * cube));
            let room = double.min(triple) > TWICE * error;
            return Glance::Out { room };
        }
        let slowest = -d0.max(3.0 * (g2 - g1)).max(d3);
        if g0 > bend.noise && g3 < -bend.noise && slowest > SLOPE * error && !fresh {
            return Glance::Once(self.fall());
        }
        Glance::Near
    }

    /// About where g falls through zero: the cubic of the inverse function.
    #[inline(always)]
    fn fall(&self) -> f64 {
        let h = self.tau;
        let (g0, change) = (self.start.value, self.end.value - self.start.value);
        let (d0, d1) = (self.start.rate, self.end.rate);
        let u = -g0 / change;
        let v = 1.0 - u;
        let fall = h * (u * u * (3.0 - 2.0 * u)) + change * (u * v) * (v / d0 - u / d1);
        if fall > 0.0 && fall < h { fall } else { h * u }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glance(g: impl Fn(f64) -> (f64, f64), tau: f64, fourth: f64, fresh: bool) -> Glance {
        let [start, end] = [0.0, tau].map(|t| {
            let (value, rate) = g(t);
            Reading { value, rate }
        });
        let bend = Bend {
            truncation: fourth * tau.powi(4) / 288.0,
            noise: 1e-15,
        };
        Curve { start, end, tau }.glance(bend, fresh)
    }

    #[test]
    fn a_dip_between_the_ends_is_never_overlooked() {
        // cos(t − phase) + shift dips to shift − 1 at t = phase + π; every position, every depth
        for i in 0..200 {
            for j in 0..200 {
                let (phase, shift) = (f64::from(i) * 0.03 - 3.0, f64::from(j) * 0.01);
                let tau = 1.3;
                let g = |t: f64| ((t - phase).cos() + shift, -(t - phase).sin());
                let lowest = (0..=1000).map(|k| g(tau * f64::from(k) / 1000.0).0);
                let lowest = lowest.fold(f64::INFINITY, f64::min);
                match glance(g, tau, 1.0, false) {
                    Glance::Out { .. } => assert!(lowest > 0.0, "{phase} {shift}"),
                    Glance::Once(at) => {
                        assert!(g(0.0).0 > 0.0 && g(tau).0 < 0.0);
                        assert!((0.0..=tau).contains(&at), "{phase} {shift}: {at}");
                    }
                    Glance::Near => {}
                }
            }
        }
    }

    #[test]
    fn what_is_far_is_told_at_once() {
        let far = glance(|t| (2.0 + t.sin(), t.cos()), 0.5, 1.0, false);
        assert_eq!(far, Glance::Out { room: true });
        let leaving = glance(|t| (t.sin(), t.cos()), 1.0, 1.0, true);
        assert_eq!(leaving, Glance::Out { room: false });
        let touching = glance(
            |t| (1.0 - (t + 1.0).sin(), -(t + 1.0).cos()),
            1.0,
            1.0,
            false,
        );
        assert_eq!(touching, Glance::Near);
    }
}
