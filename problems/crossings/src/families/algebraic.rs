//! Polynomial, rational and square-root switching functions, bent, flat and bell-shaped ones.

use dmm_runtime::pws;

use super::{Family, Force, Scales, moving, problem, start, switching};
use crate::reference::Problem;
use dmm_problems::random::Random;

pws! {
    /// A cubic of position and velocity; Duffing's oscillator, driven.
    pub system Polynomial {
        state x, v;
        param l = 1, s = 1, c[7] = 1, k_low = 1, k_high = 2, q = 0, d = 0, a = 0, p = 1;
        let u = x / l;
        let w = v / l;
        interface border = c[0] + c[1]*u + c[2]*w + c[3]*u^2 + c[4]*u*w + c[5]*w^2 + c[6]*u^3;
        der(x) = s * v;
        region low where border < 0 {
            der(v) = s*l * (-k_low*u - q*u^3 - d*w + a*cos(p*s*t));
        }
        region high where border > 0 {
            der(v) = s*l * (-k_high*u - q*u^3 - d*w + a*cos(p*s*t));
        }
    }
}

impl Family<2> for Polynomial {
    const TITLE: &'static str = "polynomial";

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let mut c = random.array(1.0);
        if random.once_in(2) {
            // little of the velocity
            c[2] *= 0.05;
            c[4] *= 0.05;
            c[5] *= 0.05;
        }
        let system = Self {
            l,
            s,
            c,
            k_low: random.between(0.5, 3.0),
            k_high: random.between(0.5, 3.0),
            q: random.between(0.0, 1.0),
            d: random.between(0.0, 0.1),
            a: random.between(0.0, 0.3),
            p: random.between(0.3, 2.0),
        };
        (system, start(random, l))
    }

    fn problem(&self, initial: [f64; 2]) -> Problem {
        let Self {
            l,
            s,
            c,
            q,
            d,
            a,
            p,
            ..
        } = *self;
        let scales = Scales { l, s };
        let force = |k: f64| -> Force {
            Box::new(move |[u, w, t]| u * -k - u * u * u * q - w * d + (t * p).cos() * a)
        };
        let g = switching(scales, |[u, w, _]| {
            let linear = u * c[1] + w * c[2] + c[0];
            linear + u * u * c[3] + u * w * c[4] + w * w * c[5] + u * u * u * c[6]
        });
        let fields = moving(scales, vec![force(self.k_low), force(self.k_high)]);
        problem(scales, initial, fields, g)
    }
}

pws! {
    /// A quotient; pendulums.
    pub system Rational {
        state x, v;
        param l = 1, s = 1, a = 0, b = 1, c = 0, k_low = 1, k_high = 2;
        let u = x / l;
        let w = v / l;
        interface border = (u - a) / (b + u^2) + c * w / (1 + w^2);
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

impl Family<2> for Rational {
    const TITLE: &'static str = "rational";

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let system = Self {
            l,
            s,
            a: random.between(-0.8, 0.8),
            b: random.decades(1e-4, 2.0),
            c: random.between(-0.2, 0.2),
            k_low: random.between(1.0, 4.0),
            k_high: random.between(1.0, 4.0),
        };
        (system, start(random, l))
    }

    fn problem(&self, initial: [f64; 2]) -> Problem {
        let Self { l, s, a, b, c, .. } = *self;
        let scales = Scales { l, s };
        let force = |k: f64| -> Force { Box::new(move |[u, ..]| u.sin() * -k) };
        let g = switching(scales, |[u, w, _]| {
            (u - a) / (u.square() + b) + w * c / (w.square() + 1.0)
        });
        let fields = moving(scales, vec![force(self.k_low), force(self.k_high)]);
        problem(scales, initial, fields, g)
    }
}

pws! {
    /// The distance from a point; oscillators.
    pub system Root {
        state x, v;
        param l = 1, s = 1, a = 0, b = 0, e = 0, r = 1, k_inside = 1, k_outside = 3;
        let u = x / l;
        let w = v / l;
        interface border = sqrt((u - a)^2 + (w - b)^2 + e) - r;
        der(x) = s * v;
        region inside where border < 0 {
            der(v) = -s * k_inside * x;
            conserved energy = (w^2 + k_inside * u^2) / 2;
        }
        region outside where border > 0 {
            der(v) = -s * k_outside * x;
            conserved energy = (w^2 + k_outside * u^2) / 2;
        }
    }
}

impl Family<2> for Root {
    const TITLE: &'static str = "square root";

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let r = random.decades(0.02, 1.5);
        let system = Self {
            l,
            s,
            a: random.between(-1.0, 1.0),
            b: random.between(-1.0, 1.0),
            e: if random.once_in(2) {
                0.0
            } else {
                random.decades(1e-8, 0.5) * r * r
            },
            r,
            k_inside: random.between(0.5, 4.0),
            k_outside: random.between(0.5, 4.0),
        };
        (system, start(random, l))
    }

    fn problem(&self, initial: [f64; 2]) -> Problem {
        let Self {
            l, s, a, b, e, r, ..
        } = *self;
        let scales = Scales { l, s };
        let force = |k: f64| -> Force { Box::new(move |[u, ..]| u * -k) };
        let g = switching(scales, |[u, w, _]| {
            ((u - a).square() + (w - b).square() + e).sqrt() - r
        });
        let fields = moving(scales, vec![force(self.k_inside), force(self.k_outside)]);
        problem(scales, initial, fields, g)
    }
}

pws! {
    /// A curve x = −a v|v|, or nearly; a force that changes its direction, and a spring.
    pub system Bent {
        state x, v;
        param l = 1, s = 1, a = 0.3, b = 0, e = 0, k = 1, f_low = 1, f_high = -1, d = 0;
        let u = x / l;
        let w = v / l;
        interface border = u + a * w * sqrt(w^2 + e) - b;
        der(x) = s * v;
        region low where border < 0 {
            der(v) = s*l * (f_low - k*u - k*u^3/8 - d*w);
        }
        region high where border > 0 {
            der(v) = s*l * (f_high - k*u - k*u^3/8 - d*w);
        }
    }
}

impl Family<2> for Bent {
    const TITLE: &'static str = "root with a sign";

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let system = Self {
            l,
            s,
            a: random.between(-0.15, 0.15),
            b: random.between(-0.7, 0.7),
            e: if random.once_in(2) {
                0.0
            } else {
                random.decades(1e-8, 0.5)
            },
            k: random.between(0.5, 3.0),
            f_low: random.between(-0.5, 1.0),
            f_high: random.between(-1.0, 0.5),
            d: random.between(0.0, 0.1),
        };
        (system, start(random, l))
    }

    fn problem(&self, initial: [f64; 2]) -> Problem {
        let Self {
            l,
            s,
            a,
            b,
            e,
            k,
            d,
            ..
        } = *self;
        let scales = Scales { l, s };
        let force = |f: f64| -> Force {
            Box::new(move |[u, w, _]| u * -k - u * u * u * k / 8.0 - w * d + f)
        };
        let g = switching(scales, |[u, w, _]| u + w * a * (w.square() + e).sqrt() - b);
        let fields = moving(scales, vec![force(self.f_low), force(self.f_high)]);
        problem(scales, initial, fields, g)
    }
}

pws! {
    /// A fifth power, nearly flat where it is crossed; driven oscillators.
    pub system Flat {
        state x, v;
        param l = 1, s = 1, b = 0, e = 0.01, c = 0, k_low = 1, k_high = 2, a = 0, p = 1;
        let u = x / l;
        let w = v / l;
        interface border = (u - b)^5 + e*(u - b) + c*w^3;
        der(x) = s * v;
        region low where border < 0 {
            der(v) = s*l * (a*cos(p*s*t) - k_low*u);
        }
        region high where border > 0 {
            der(v) = s*l * (a*cos(p*s*t) - k_high*u);
        }
    }
}

impl Family<2> for Flat {
    const TITLE: &'static str = "nearly flat";

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let e = random.decades(1e-9, 1.0);
        let system = Self {
            l,
            s,
            b: random.between(-0.7, 0.7),
            e,
            c: if random.once_in(2) {
                0.0
            } else {
                random.between(-0.01, 0.01) * e
            },
            k_low: random.between(0.5, 3.0),
            k_high: random.between(0.5, 3.0),
            a: random.between(0.0, 0.3),
            p: random.between(0.3, 2.0),
        };
        (system, start(random, l))
    }

    fn problem(&self, initial: [f64; 2]) -> Problem {
        let Self {
            l,
            s,
            b,
            e,
            c,
            a,
            p,
            ..
        } = *self;
        let scales = Scales { l, s };
        let force = |k: f64| -> Force { Box::new(move |[u, _, t]| u * -k + (t * p).cos() * a) };
        let g = switching(scales, |[u, w, _]| {
            let y = u - b;
            y.square().square() * y + y * e + w * w * w * c
        });
        let fields = moving(scales, vec![force(self.k_low), force(self.k_high)]);
        problem(scales, initial, fields, g)
    }
}

pws! {
    /// A bell whose far slopes are crossed where they are nearly flat; Duffing's oscillators.
    pub system Bell {
        state x, v;
        param l = 1, s = 1, a = 1, b = 0, c = 0.1, q = 0, k_low = 1, k_high = 2, d = 0;
        let u = x / l;
        let w = v / l;
        interface border = exp(-a*((u - b)^2 + d*w^2)) - c;
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

impl Family<2> for Bell {
    const TITLE: &'static str = "bell";

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let a = random.decades(0.5, 400.0);
        let half_width = random.between(0.1, 1.2);
        let system = Self {
            l,
            s,
            a,
            b: random.between(-1.0, 1.0),
            // not below 10⁻³⁰
            c: (-(a * half_width * half_width).min(69.0)).exp(),
            q: random.between(0.0, 1.0),
            k_low: random.between(0.5, 3.0),
            k_high: random.between(0.5, 3.0),
            d: if random.once_in(2) {
                0.0
            } else {
                random.between(0.0, 0.1)
            },
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
            q,
            d,
            ..
        } = *self;
        let scales = Scales { l, s };
        let force = |k: f64| -> Force { Box::new(move |[u, ..]| u * -k - u * u * u * q) };
        let g = switching(scales, |[u, w, _]| {
            (((u - b).square() + w.square() * d) * -a).exp() - c
        });
        let fields = moving(scales, vec![force(self.k_low), force(self.k_high)]);
        problem(scales, initial, fields, g)
    }
}
