//! Solutions in closed form between events.

use dmm_runtime::TransitionKind;

/// A solution between two events.
struct Piece {
    start: f64,
    /// The state by the time since the start.
    flow: Box<dyn Fn(f64) -> Vec<f64>>,
    /// The event at its end.
    end: TransitionKind,
}

/// A solution from t = 0 with its events.
#[derive(Default)]
pub(crate) struct Solution {
    pieces: Vec<Piece>,
    /// The time of the last event.
    t: f64,
}

impl Solution {
    /// Goes on along a flow for some time, until an event.
    pub(crate) fn go(
        &mut self,
        time: f64,
        end: TransitionKind,
        flow: impl Fn(f64) -> Vec<f64> + 'static,
    ) {
        let (start, flow) = (self.t, Box::new(flow));
        self.pieces.push(Piece { start, flow, end });
        self.t += time;
    }

    /// The number of events.
    pub(crate) fn len(&self) -> usize {
        self.pieces.len()
    }

    /// The time of the last event.
    pub(crate) fn t(&self) -> f64 {
        self.t
    }

    /// The time of an event, from 1; of 0 that of the start.
    pub(crate) fn event(&self, k: usize) -> f64 {
        self.pieces.get(k).map_or(self.t, |piece| piece.start)
    }

    /// The kinds of the events.
    pub(crate) fn kinds(&self) -> Vec<TransitionKind> {
        self.pieces.iter().map(|piece| piece.end).collect()
    }

    /// A time between event `k` and the next, by the share of the time between them.
    pub(crate) fn between(&self, k: usize, share: f64) -> f64 {
        self.event(k) + share * (self.event(k + 1) - self.event(k))
    }

    /// The state at a time that is not one of an event.
    pub(crate) fn at(&self, t: f64) -> Vec<f64> {
        let next = self.pieces.partition_point(|piece| piece.start <= t);
        let piece = &self.pieces[next - 1];
        (piece.flow)(t - piece.start)
    }
}

/// ẍ = 2 growth ẋ − stiffness (x − centre), below the critical damping.
#[derive(Clone, Copy)]
pub(crate) struct Spring {
    pub(crate) growth: f64,
    pub(crate) stiffness: f64,
    pub(crate) centre: f64,
}

impl Spring {
    /// x and ẋ a time after those given.
    pub(crate) fn flow(self, [x, v]: [f64; 2], time: f64) -> [f64; 2] {
        let Self {
            growth,
            stiffness,
            centre,
        } = self;
        let frequency = (stiffness - growth * growth).sqrt();
        let a = x - centre;
        let b = (v - growth * a) / frequency;
        let (sin, cos) = (frequency * time).sin_cos();
        let size = (growth * time).exp();
        let at = size * (a * cos + b * sin);
        [
            centre + at,
            growth * at + size * frequency * (b * cos - a * sin),
        ]
    }
}

/// The solution of ẋ = x (rate − x).
pub(crate) fn logistic(rate: f64, x: f64, time: f64) -> f64 {
    let factor = (rate * time).exp();
    rate * x * factor / (rate + x * (factor - 1.0))
}

/// When it has come from x to `end`.
pub(crate) fn logistic_time(rate: f64, x: f64, end: f64) -> f64 {
    (end * (rate - x) / (x * (rate - end))).ln() / rate
}

/// The first zero of a function behind 0, where it may have another: by bisection to the last bit.
pub(crate) fn first_zero(g: impl Fn(f64) -> f64) -> f64 {
    const STEP: f64 = 1.0 / 64.0;
    let mut low = STEP;
    let is_positive = g(low) > 0.0;
    while (g(low + STEP) > 0.0) == is_positive {
        low += STEP;
        assert!(low < 100.0, "no zero");
    }
    let mut high = low + STEP;
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        if (g(middle) > 0.0) == is_positive {
            low = middle;
        } else {
            high = middle;
        }
    }
}
