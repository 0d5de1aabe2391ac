//! Families of systems: what `pws!` makes of a declaration, and the same once more in the
//! formulas of the reference solution.
//!
//! The states are a position x and a velocity v (three numbers in one family), l times a number
//! u and w of the order of 1, and change s times as fast as in the unit of time.

use dmm_runtime::{System, pws};

use super::formula::{Formula, Formulas, Writer};
use super::random::Random;
use super::reference::Problem;

/// The scales of length and of rates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales {
    pub(super) l: f64,
    pub(super) s: f64,
}

/// A family of systems with N states.
pub(super) trait Family<const N: usize>: System<N> + Default {
    /// What its switching function is.
    const TITLE: &'static str;
    /// The order of the compositions that it is run with.
    const ORDER: usize;

    /// A member, and where it starts.
    fn draw(random: &mut Random, scales: Scales) -> (Self, [f64; N]);

    /// The member in formulas.
    fn problem(&self, initial: [f64; N]) -> Problem;
}

/// The formulas of a system, with its scales.
fn problem<const N: usize>(
    Scales { l, s }: Scales,
    initial: [f64; N],
    fields: Vec<Formulas>,
    switching: Formulas,
) -> Problem {
    Problem {
        fields,
        switching,
        initial: initial.to_vec(),
        size: l,
        rate: s,
    }
}

/// F(u, w, s t)
type Force = Box<dyn for<'w> Fn([Formula<'w>; 3]) -> Formula<'w>>;

/// ẋ = s v, v̇ = s l F(u, w, s t) for each F.
fn moving(Scales { l, s }: Scales, forces: Vec<Force>) -> Vec<Formulas> {
    let field = |force: Force| {
        Formulas::of(|w: &Writer| {
            let [x, v] = w.state();
            let force = force([x / l, v / l, w.time() * s]);
            vec![v * s, force * (s * l)]
        })
    };
    forces.into_iter().map(field).collect()
}

/// g(u, w, s t)
fn switching(
    Scales { l, s }: Scales,
    g: impl for<'w> Fn([Formula<'w>; 3]) -> Formula<'w>,
) -> Formulas {
    Formulas::of(|w: &Writer| {
        let [x, v] = w.state();
        vec![g([x / l, v / l, w.time() * s])]
    })
}

/// A start in the plane.
fn start(random: &mut Random, l: f64) -> [f64; 2] {
    let angle = random.between(0.0, std::f64::consts::TAU);
    let radius = random.between(0.3, 1.6);
    [l * radius * angle.cos(), l * radius * angle.sin()]
}

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
    const ORDER: usize = 4;

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
    const ORDER: usize = 6;

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
    const ORDER: usize = 8;

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let r = random.decades(0.02, 1.5);
        let system = Self {
            l,
            s,
            a: random.between(-1.0, 1.0),
            b: random.between(-1.0, 1.0),
            e: match random.once_in(2) {
                true => 0.0,
                false => random.decades(1e-8, 0.5) * r * r,
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
    const ORDER: usize = 6;

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let system = Self {
            l,
            s,
            a: random.between(-0.15, 0.15),
            b: random.between(-0.7, 0.7),
            e: match random.once_in(2) {
                true => 0.0,
                false => random.decades(1e-8, 0.5),
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
    const ORDER: usize = 8;

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
    const ORDER: usize = 6;

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
            c: match random.once_in(2) {
                true => 0.0,
                false => random.between(-0.3, 0.3),
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
    const ORDER: usize = 4;

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let size = random.decades(0.1, 30.0);
        let a = random.signed(size);
        let system = Self {
            l,
            s,
            a,
            b: random.between(-0.1, 0.1) * a,
            c: (a * random.between(-0.8, 0.8)).exp(),
            d: match random.once_in(2) {
                true => 0.0,
                false => random.between(-0.5, 0.5),
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
    const ORDER: usize = 6;

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
    const ORDER: usize = 4;

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let system = Self {
            l,
            s,
            a: random.decades(0.3, 200.0),
            b: random.between(-0.7, 0.7),
            c: match random.once_in(3) {
                true => 0.0,
                false => random.between(-0.3, 0.3),
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
    const ORDER: usize = 8;

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let e = random.decades(1e-9, 1.0);
        let system = Self {
            l,
            s,
            b: random.between(-0.7, 0.7),
            e,
            c: match random.once_in(2) {
                true => 0.0,
                false => random.between(-0.01, 0.01) * e,
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
    const ORDER: usize = 8;

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
            d: match random.once_in(2) {
                true => 0.0,
                false => random.between(0.0, 0.1),
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
    const ORDER: usize = 4;

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

/// An affine system in formulas: the rows of A and b of each side, and those of g.
fn affine<const N: usize>(
    scales: Scales,
    initial: [f64; N],
    sides: [([[f64; N]; N], [f64; N]); 2],
    (n, offset): ([f64; N], f64),
) -> Problem {
    let Scales { l, s } = scales;
    let fields = sides.map(|(a, b)| {
        Formulas::of(|w: &Writer| {
            let x = w.state::<N>();
            let row = |i: usize| {
                let terms = x.iter().zip(a[i]).map(|(x, a)| *x * a);
                terms.fold(w.number(l * b[i]), |sum, term| sum + term) * s
            };
            (0..N).map(row).collect()
        })
    });
    let g = Formulas::of(|w: &Writer| {
        let x = w.state::<N>();
        let terms = x.iter().zip(n).map(|(x, n)| *x * n);
        vec![terms.fold(w.number(-l * offset), |sum, term| sum + term)]
    });
    problem(scales, initial, fields.to_vec(), g)
}

/// A matrix whose flow turns and hardly grows.
fn turning<const N: usize>(random: &mut Random) -> [[f64; N]; N] {
    let mut a = [[0.0; N]; N];
    let below = |i: usize| (0..i).map(move |j| (i, j));
    for (i, j) in (0..N).flat_map(below) {
        let size = random.between(0.3, 2.0);
        let turn = random.signed(size);
        a[i][j] = turn + random.between(-0.2, 0.2);
        a[j][i] = -turn + random.between(-0.2, 0.2);
    }
    for (i, row) in a.iter_mut().enumerate() {
        row[i] = random.between(-0.2, 0.05);
    }
    a
}

pws! {
    /// Affine fields in the plane and a line.
    pub system Plane {
        state x, y;
        param l = 1, s = 1, a[4] = 0, b[2] = 0, c[4] = 0, d[2] = 0, n[2] = 1, r = 0;
        interface line = n[0]*x + n[1]*y - l*r;
        region low where line < 0 {
            der(x) = s * (a[0]*x + a[1]*y + l*b[0]);
            der(y) = s * (a[2]*x + a[3]*y + l*b[1]);
        }
        region high where line > 0 {
            der(x) = s * (c[0]*x + c[1]*y + l*d[0]);
            der(y) = s * (c[2]*x + c[3]*y + l*d[1]);
        }
    }
}

impl Family<2> for Plane {
    const TITLE: &'static str = "affine, plane";
    const ORDER: usize = 4;

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let [[a0, a1], [a2, a3]] = turning(random);
        let [[c0, c1], [c2, c3]] = turning(random);
        let system = Self {
            l,
            s,
            a: [a0, a1, a2, a3],
            b: random.array(0.5),
            c: [c0, c1, c2, c3],
            d: random.array(0.5),
            n: random.array(1.0),
            r: random.between(-0.5, 0.5),
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
            n,
            r,
        } = *self;
        let rows = |a: [f64; 4]| [[a[0], a[1]], [a[2], a[3]]];
        let sides = [(rows(a), b), (rows(c), d)];
        affine(Scales { l, s }, initial, sides, (n, r))
    }
}

pws! {
    /// Affine fields in space and a plane.
    pub system Space {
        state x, y, z;
        param l = 1, s = 1, a[9] = 0, b[3] = 0, c[9] = 0, d[3] = 0, n[3] = 1, r = 0;
        interface plane = n[0]*x + n[1]*y + n[2]*z - l*r;
        region low where plane < 0 {
            der(x) = s * (a[0]*x + a[1]*y + a[2]*z + l*b[0]);
            der(y) = s * (a[3]*x + a[4]*y + a[5]*z + l*b[1]);
            der(z) = s * (a[6]*x + a[7]*y + a[8]*z + l*b[2]);
        }
        region high where plane > 0 {
            der(x) = s * (c[0]*x + c[1]*y + c[2]*z + l*d[0]);
            der(y) = s * (c[3]*x + c[4]*y + c[5]*z + l*d[1]);
            der(z) = s * (c[6]*x + c[7]*y + c[8]*z + l*d[2]);
        }
    }
}

impl Family<3> for Space {
    const TITLE: &'static str = "affine, space";
    const ORDER: usize = 8;

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 3]) {
        let flat = |rows: [[f64; 3]; 3]| std::array::from_fn(|k| rows[k / 3][k % 3]);
        let system = Self {
            l,
            s,
            a: flat(turning(random)),
            b: random.array(0.5),
            c: flat(turning(random)),
            d: random.array(0.5),
            n: random.array(1.0),
            r: random.between(-0.5, 0.5),
        };
        (system, random.array::<3>(1.5).map(|x| l * x))
    }

    fn problem(&self, initial: [f64; 3]) -> Problem {
        let Self {
            l,
            s,
            a,
            b,
            c,
            d,
            n,
            r,
        } = *self;
        let rows = |a: [f64; 9]| std::array::from_fn(|i| std::array::from_fn(|j| a[3 * i + j]));
        let sides = [(rows(a), b), (rows(c), d)];
        affine(Scales { l, s }, initial, sides, (n, r))
    }
}
