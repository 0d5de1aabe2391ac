//! Waves, clocks, exponentials, logarithms, hyperbolic functions and sheets close together.

use dmm_runtime::pws;

use super::{Family, Force, Scales, moving, problem, start, switching};
use crate::reference::Problem;
use dmm_problems::random::Random;

pws! {
    /// Stripes that are up to a thousandth wide; pendulums.
    pub system Wave {
        state x, v;
        param l = 1, s = 1, m = 3, p = 0, b = 0, c = 0, k_low = 1, k_high = 2;
        let u = x / l;
        let w = v / l;
        interface border = sin(m*u + p) - c + b*w;
        der(x) = s * v;
        region low where border < 0 {
            der(v) = -s*l * k_low * sin(u);
            conserved energy = w^2 / 2 - k_low * cos(u);
        }
        region high where border > 0 {
            der(v) = -s*l * k_high * sin(u);
            conserved energy = w^2 / 2 - k_high * cos(u);
        }
    }
}

impl Family<2> for Wave {
    const TITLE: &'static str = "stripes";

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let m = random.decades(1.0, 600.0);
        let system = Self {
            l,
            s,
            m,
            p: random.between(0.0, 6.3),
            b: random.between(-0.1, 0.1),
            c: random.between(-0.8, 0.8),
            k_low: random.between(1.0, 3.0),
            k_high: random.between(1.0, 3.0),
        };
        (system, start(random, l))
    }

    fn problem(&self, initial: [f64; 2]) -> Problem {
        let Self {
            l, s, m, p, b, c, ..
        } = *self;
        let scales = Scales { l, s };
        let force = |k: f64| -> Force { Box::new(move |[u, ..]| u.sin() * -k) };
        let g = switching(scales, |[u, w, _]| (u * m + p).sin() - c + w * b);
        let fields = moving(scales, vec![force(self.k_low), force(self.k_high)]);
        problem(scales, initial, fields, g)
    }
}

pws! {
    /// A clock with up to a hundred periods in the time that a step takes; affine fields.
    pub system Clock {
        state x, v;
        param l = 1, s = 1, m = 3, p = 0, c = 0, k_low = 1, k_high = 2, f_low = 0, f_high = 0;
        interface tick = sin(m*s*t + p) - c * x / l;
        der(x) = s * v;
        region low where tick < 0 {
            der(v) = s * (l*f_low - k_low*x);
        }
        region high where tick > 0 {
            der(v) = s * (l*f_high - k_high*x);
        }
    }
}

impl Family<2> for Clock {
    const TITLE: &'static str = "clock";

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let is_free = random.once_in(3);
        let mut stiffness = || {
            if is_free {
                0.0
            } else {
                random.between(0.5, 3.0)
            }
        };
        let (k_low, k_high) = (stiffness(), stiffness());
        let system = Self {
            l,
            s,
            m: random.decades(1.0, 250.0),
            p: random.between(0.0, 6.3),
            c: if random.once_in(2) {
                0.0
            } else {
                random.between(-0.3, 0.3)
            },
            k_low,
            k_high,
            f_low: random.between(-1.0, 1.0),
            f_high: random.between(-1.0, 1.0),
        };
        (system, start(random, l))
    }

    fn problem(&self, initial: [f64; 2]) -> Problem {
        let Self { l, s, m, p, c, .. } = *self;
        let scales = Scales { l, s };
        let force = |k: f64, f: f64| -> Force { Box::new(move |[u, ..]| u * -k + f) };
        let g = switching(scales, |[u, _, t]| (t * m + p).sin() - u * c);
        let (low, high) = (
            force(self.k_low, self.f_low),
            force(self.k_high, self.f_high),
        );
        problem(scales, initial, moving(scales, vec![low, high]), g)
    }
}

pws! {
    /// An exponential; Duffing's oscillators.
    pub system Exponential {
        state x, v;
        param l = 1, s = 1, a = 1, b = 0, c = 1, d = 0, q = 0, k_low = 1, k_high = 2;
        let u = x / l;
        let w = v / l;
        interface border = exp(a*u + b*w) - c - d*u;
        der(x) = s * v;
        region low where border < 0 {
            der(v) = -s*l * (k_low*u + q*u^3);
            conserved energy = w^2 / 2 + k_low * u^2 / 2 + q * u^4 / 4;
        }
        region high where border > 0 {
            der(v) = -s*l * (k_high*u + q*u^3);
            conserved energy = w^2 / 2 + k_high * u^2 / 2 + q * u^4 / 4;
        }
    }
}

impl Family<2> for Exponential {
    const TITLE: &'static str = "exponential";

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let size = random.decades(0.1, 30.0);
        let a = random.signed(size);
        let system = Self {
            l,
            s,
            a,
            b: random.between(-0.1, 0.1) * a,
            c: (a * random.between(-0.8, 0.8)).exp(),
            d: if random.once_in(2) {
                0.0
            } else {
                random.between(-0.5, 0.5)
            },
            q: random.between(0.0, 1.0),
            k_low: random.between(0.5, 3.0),
            k_high: random.between(0.5, 3.0),
        };
        (system, start(random, l))
    }

    fn problem(&self, initial: [f64; 2]) -> Problem {
        let Self {
            l,
            s,
            a,
            b,
            c,
            d,
            q,
            ..
        } = *self;
        let scales = Scales { l, s };
        let force = |k: f64| -> Force { Box::new(move |[u, ..]| u * -k - u * u * u * q) };
        let g = switching(scales, |[u, w, _]| (u * a + w * b).exp() - c - u * d);
        let fields = moving(scales, vec![force(self.k_low), force(self.k_high)]);
        problem(scales, initial, fields, g)
    }
}

pws! {
    /// A logarithm, whose domain may end a little beyond the orbit; damped oscillators.
    pub system Logarithm {
        state x, v;
        param l = 1, s = 1, a = 2, b = 0, c = 0, k = 1, d = 0, f_low = 0, f_high = 0.5;
        let u = x / l;
        let w = v / l;
        interface border = ln(a + u) - c - b*w;
        der(x) = s * v;
        region low where border < 0 {
            der(v) = s*l * (f_low - k*u - d*w);
        }
        region high where border > 0 {
            der(v) = s*l * (f_high - k*u - d*w);
        }
    }
}

impl Family<2> for Logarithm {
    const TITLE: &'static str = "logarithm";

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let [x, v] = start(random, l);
        let k = random.between(0.5, 2.0);
        let (f_low, f_high) = (random.between(0.0, 0.4), random.between(-0.4, 0.0));
        // no orbit goes farther than this from its middle, and the force pulls back
        let reach = (x.powi(2) + v.powi(2) / k).sqrt() / l + 2.0 / k;
        let a = reach * (1.0 + random.decades(1e-3, 1.0));
        let system = Self {
            l,
            s,
            a,
            b: random.between(-0.1, 0.1),
            c: (a + random.between(-0.7, 0.7) * reach.min(1.0)).ln(),
            k,
            d: random.between(0.02, 0.1),
            f_low,
            f_high,
        };
        (system, [x, v])
    }

    fn problem(&self, initial: [f64; 2]) -> Problem {
        let Self {
            l,
            s,
            a,
            b,
            c,
            k,
            d,
            ..
        } = *self;
        let scales = Scales { l, s };
        let force = |f: f64| -> Force { Box::new(move |[u, w, _]| u * -k - w * d + f) };
        let g = switching(scales, |[u, w, _]| (u + a).ln() - c - w * b);
        let fields = moving(scales, vec![force(self.f_low), force(self.f_high)]);
        problem(scales, initial, fields, g)
    }
}

pws! {
    /// Steep steps of a hyperbolic tangent and an arctangent; pendulums with a load.
    pub system Hyperbolic {
        state x, v;
        param l = 1, s = 1, a = 1, b = 0, c = 0, m = 1, k = 1, f_low = 0, f_high = 0.5;
        let u = x / l;
        let w = v / l;
        interface border = tanh(a*(u - b)) + c * atan(m*w);
        der(x) = s * v;
        region low where border < 0 {
            der(v) = s*l * (f_low - k*sin(u));
            conserved energy = w^2 / 2 - k * cos(u) - f_low * u;
        }
        region high where border > 0 {
            der(v) = s*l * (f_high - k*sin(u));
            conserved energy = w^2 / 2 - k * cos(u) - f_high * u;
        }
    }
}

impl Family<2> for Hyperbolic {
    const TITLE: &'static str = "hyperbolic";

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let system = Self {
            l,
            s,
            a: random.decades(0.3, 200.0),
            b: random.between(-0.7, 0.7),
            c: if random.once_in(3) {
                0.0
            } else {
                random.between(-0.3, 0.3)
            },
            m: random.decades(0.3, 30.0),
            k: random.between(1.5, 4.0),
            f_low: random.between(-0.2, 0.5),
            f_high: random.between(-0.5, 0.2),
        };
        (system, start(random, l))
    }

    fn problem(&self, initial: [f64; 2]) -> Problem {
        let Self {
            l,
            s,
            a,
            b,
            c,
            m,
            k,
            ..
        } = *self;
        let scales = Scales { l, s };
        let force = |f: f64| -> Force { Box::new(move |[u, ..]| u.sin() * -k + f) };
        let g = switching(scales, |[u, w, _]| {
            ((u - b) * a).tanh() + (w * m).atan() * c
        });
        let fields = moving(scales, vec![force(self.f_low), force(self.f_high)]);
        problem(scales, initial, fields, g)
    }
}

pws! {
    /// Three walls close to each other; damped oscillators with a load.
    pub system Sheets {
        state x, v;
        param l = 1, s = 1, b = 0, gap = 0.1, k = 1, d = 0, f_low = 0, f_high = 0.5;
        let u = x / l;
        let w = v / l;
        interface border = (u - b) * (u - b - gap) * (u - b + gap);
        der(x) = s * v;
        region low where border < 0 {
            der(v) = s*l * (f_low - k*u - d*w);
        }
        region high where border > 0 {
            der(v) = s*l * (f_high - k*u - d*w);
        }
    }
}

impl Family<2> for Sheets {
    const TITLE: &'static str = "three sheets";

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let system = Self {
            l,
            s,
            b: random.between(-0.7, 0.7),
            gap: random.decades(1e-5, 0.5),
            k: random.between(0.5, 3.0),
            d: random.between(0.0, 0.1),
            f_low: random.between(-0.7, 0.7),
            f_high: random.between(-0.7, 0.7),
        };
        (system, start(random, l))
    }

    fn problem(&self, initial: [f64; 2]) -> Problem {
        let Self {
            l, s, b, gap, k, d, ..
        } = *self;
        let scales = Scales { l, s };
        let force = |f: f64| -> Force { Box::new(move |[u, w, _]| u * -k - w * d + f) };
        let g = switching(scales, |[u, ..]| (u - b) * (u - b - gap) * (u - b + gap));
        let fields = moving(scales, vec![force(self.f_low), force(self.f_high)]);
        problem(scales, initial, fields, g)
    }
}
