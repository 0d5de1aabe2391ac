//! The arguments at which errors are measured.

use std::f64::consts::PI;

/// A reproducible stream of numbers (Steele, Lea & Flood 2014: SplitMix).
pub(crate) struct Random(u64);

/// Gives the argument of an index.
pub(crate) type Sampler = fn(&mut Random, usize) -> (f64, f64);

impl Random {
    /// The stream of a case.
    pub(crate) fn new(name: &str, range: &str) -> Self {
        let seed = name.bytes().chain(range.bytes());
        Self(seed.fold(0, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        }))
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in (low, high).
    fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 * 2.0_f64.powi(-53))
    }

    /// Uniform in the logarithm, positive.
    fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        self.uniform(low.ln(), high.ln()).exp()
    }

    fn sign(&mut self) -> f64 {
        if self.bits().is_multiple_of(2) {
            1.0
        } else {
            -1.0
        }
    }

    /// Either sign, uniform in the logarithm.
    fn signed(&mut self, low: f64, high: f64) -> f64 {
        self.sign() * self.magnitude(low, high)
    }

    /// One sample in eight from the whole range of magnitudes, the others from a usual one.
    fn real(&mut self, index: usize) -> f64 {
        if index.is_multiple_of(8) {
            self.signed(1e-300, 1e300)
        } else {
            self.signed(1e-6, 1e6)
        }
    }

    /// As [`Self::real`], within the domain of asin.
    fn unit(&mut self, index: usize) -> f64 {
        match index % 4 {
            0 => self.signed(1e-300, 1.0),
            1 => self.sign() * (1.0 - self.magnitude(1e-16, 1.0)),
            _ => self.uniform(-1.0, 1.0),
        }
    }

    /// A number at a relative distance from `a` of 1e-17 to 0.1; `a` itself among them.
    fn near(&mut self, a: f64) -> f64 {
        a + a * self.signed(1e-17, 0.1)
    }
}

pub(crate) fn small(random: &mut Random, index: usize) -> (f64, f64) {
    let u = match index {
        0 => 0.0,
        _ if index % 8 == 1 => random.signed(1e-300, 0.25),
        _ => random.signed(1e-4, 0.25),
    };
    (u, 0.0)
}

pub(crate) fn moderate(random: &mut Random, _: usize) -> (f64, f64) {
    (random.signed(0.25, 4.0), 0.0)
}

pub(crate) fn large(random: &mut Random, index: usize) -> (f64, f64) {
    let high = if index.is_multiple_of(8) { 1e300 } else { 1e6 };
    (random.signed(4.0, high), 0.0)
}

pub(crate) fn sinc_zeros(random: &mut Random, index: usize) -> (f64, f64) {
    let high = if index.is_multiple_of(8) { 1e15 } else { 1e4 };
    let u = random.magnitude(1.0, high).floor() * PI;
    (random.sign() * u, 0.0)
}

/// The double next to a zero of sinc′, or one of its neighbours.
pub(crate) fn sinc_prime_zeros(random: &mut Random, index: usize) -> (f64, f64) {
    let high = if index.is_multiple_of(8) { 1e15 } else { 1e4 };
    let mut u = (random.magnitude(1.0, high).floor() + 0.5) * PI;
    let target = u;
    for _ in 0..60 {
        u = target - (1.0 / u).atan();
    }
    let neighbour = u.to_bits() + random.bits() % 5 - 2;
    (random.sign() * f64::from_bits(neighbour), 0.0)
}

pub(crate) fn sinc_prime_neighbourhoods(random: &mut Random, index: usize) -> (f64, f64) {
    let (u, _) = sinc_prime_zeros(random, index);
    (u + random.signed(1e-15, 1.0), 0.0)
}

pub(crate) fn hyperbolic(random: &mut Random, _: usize) -> (f64, f64) {
    (random.signed(4.0, 717.0), 0.0)
}

pub(crate) fn positive_coincident(random: &mut Random, index: usize) -> (f64, f64) {
    let a = random.real(index).abs();
    (a, a)
}

pub(crate) fn positive_nearby(random: &mut Random, index: usize) -> (f64, f64) {
    let a = random.real(index).abs();
    (a, random.near(a))
}

pub(crate) fn positive_moderate(random: &mut Random, index: usize) -> (f64, f64) {
    let a = random.real(index).abs();
    (a, a * random.signed(0.1, 4.0).exp())
}

pub(crate) fn positive_apart(random: &mut Random, index: usize) -> (f64, f64) {
    (random.real(index).abs(), random.real(index / 2).abs())
}

/// The second argument is beside the first, moderate, or at the other extreme.
pub(crate) fn positive_extreme(random: &mut Random, index: usize) -> (f64, f64) {
    let largest = random.magnitude(1e300, f64::MAX);
    let subnormal = random.magnitude(1e-308, 1e-300);
    match index % 6 {
        0 => (largest, random.near(largest).min(f64::MAX)),
        1 => (largest, random.magnitude(1e-6, 1e6)),
        2 => (subnormal, random.near(subnormal)),
        3 => (subnormal, random.magnitude(1e-6, 1e6)),
        4 => (subnormal, largest),
        _ => (
            random.magnitude(1e-320, 1e-308),
            random.magnitude(1e-320, 1e-300),
        ),
    }
}

pub(crate) fn unit_coincident(random: &mut Random, index: usize) -> (f64, f64) {
    let a = random.unit(index);
    (a, a)
}

pub(crate) fn unit_nearby(random: &mut Random, index: usize) -> (f64, f64) {
    let a = random.unit(index);
    (a, random.near(a).clamp(-1.0 + 1e-16, 1.0 - 1e-16))
}

pub(crate) fn unit_uniform(random: &mut Random, _: usize) -> (f64, f64) {
    (random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0))
}

pub(crate) fn unit_ends(random: &mut Random, index: usize) -> (f64, f64) {
    (random.unit(index % 2), random.unit(index / 2 % 2))
}

pub(crate) fn unit_opposite(random: &mut Random, index: usize) -> (f64, f64) {
    let a = random.unit(index);
    (a, -a)
}

/// Near the curve on which ∂ asin_dd(a, b)/∂b changes its sign.
pub(crate) fn asin_dd_prime_zeros(random: &mut Random, index: usize) -> (f64, f64) {
    let least = if index.is_multiple_of(8) { 1e-80 } else { 1e-6 };
    let a = random.signed(least, 0.999);
    let b = zero(a, dmm_runtime::special::asin_dd_prime, a.abs());
    near_zero(random, index, a, b)
}

/// b = −a/2, where the leading term of a derivative's series vanishes.
pub(crate) fn half_opposite(random: &mut Random, index: usize) -> (f64, f64) {
    let least = if index.is_multiple_of(4) {
        1e-100
    } else {
        1e-9
    };
    let a = random.signed(least, 0.1);
    (a, -0.5 * a)
}

/// Where asin_dd and its derivative change their form: at w² = 1/256 and 0.1112.
pub(crate) fn unit_seams(random: &mut Random, index: usize) -> (f64, f64) {
    let w = if index.is_multiple_of(2) {
        0.0625
    } else {
        0.333_47
    };
    let alpha = random.uniform(-1.57, 1.57 - 2.0 * w);
    let a = alpha.sin();
    let b = (alpha + 2.0 * f64::atan(w)).sin();
    (a, shifted(random, b).min(1.0 - 1e-16))
}

pub(crate) fn real_coincident(random: &mut Random, index: usize) -> (f64, f64) {
    let a = random.real(index);
    (a, a)
}

pub(crate) fn real_nearby(random: &mut Random, index: usize) -> (f64, f64) {
    let a = random.real(index);
    (a, random.near(a))
}

pub(crate) fn real_moderate(random: &mut Random, _: usize) -> (f64, f64) {
    (random.signed(0.01, 100.0), random.signed(0.01, 100.0))
}

pub(crate) fn real_apart(random: &mut Random, index: usize) -> (f64, f64) {
    (random.real(index), random.real(index / 2))
}

pub(crate) fn real_opposite(random: &mut Random, index: usize) -> (f64, f64) {
    let a = random.real(index);
    (a, -a)
}

pub(crate) fn real_orthogonal(random: &mut Random, index: usize) -> (f64, f64) {
    let a = random.real(index);
    (a, random.near(-1.0 / a))
}

/// Near the curve on which ∂ atan_dd(a, b)/∂b changes its sign.
pub(crate) fn atan_dd_prime_zeros(random: &mut Random, index: usize) -> (f64, f64) {
    let (least, largest) = match index % 8 {
        0 => (1e-80, 1e80),
        1 => (1e80, 1e154),
        _ => (1e-6, 1e6),
    };
    let a = random.signed(least, largest);
    let b = zero(a, dmm_runtime::special::atan_dd_prime, a.abs());
    near_zero(random, index, a, b)
}

/// Where atan_dd and its derivative change their form: at w² = 1/256 and 0.1112, at w = 1, and
/// at arguments of 1e140.
pub(crate) fn real_seams(random: &mut Random, index: usize) -> (f64, f64) {
    let a = match index % 4 {
        3 => return (shifted(random, 1e140), random.signed(1e-12, 1e12)),
        _ => random.uniform(-20.0, 20.0),
    };
    let w = [0.0625, 0.333_47, 1.0][index % 4];
    (a, shifted(random, (a.atan() + f64::atan(w)).tan()))
}

/// `u` or one of its neighbours.
fn shifted(random: &mut Random, u: f64) -> f64 {
    f64::from_bits(u.to_bits() + random.bits() % 9 - 4)
}

/// The zero (a, b) of a derivative itself, next to it, and around it.
fn near_zero(random: &mut Random, index: usize, a: f64, b: f64) -> (f64, f64) {
    match index % 3 {
        0 => (a, shifted(random, b)),
        1 => (a, b + b * random.signed(1e-16, 1e-8)),
        _ => (a, b + b * random.signed(1e-8, 0.1)),
    }
}

/// The double next to the zero b, of the sign opposite to a and no greater than `limit`, by
/// bisection of the doubles.
fn zero(a: f64, prime: fn(f64, f64) -> f64, limit: f64) -> f64 {
    let at = |bits: u64| f64::from_bits(bits).copysign(-a);
    let (mut low, mut high) = (0, limit.to_bits());
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if (prime(a, at(middle)) > 0.0) == (prime(a, 0.0) > 0.0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    at(high)
}

/// Exponents a·b of every size, the factors of any.
pub(crate) fn exponents(random: &mut Random, index: usize) -> (f64, f64) {
    let a = random.real(index);
    let product = match index % 3 {
        0 => random.signed(1e-20, 1.0),
        _ => random.uniform(-745.0, 709.7),
    };
    (a, product / a)
}

/// Exponents at which the exponential overflows or becomes subnormal, and factors that are
/// nearly the largest.
pub(crate) fn extreme_exponents(random: &mut Random, index: usize) -> (f64, f64) {
    let product = match index % 4 {
        0 => random.uniform(709.78, 709.782_712_893_384),
        1 => random.uniform(-745.13, -708.0),
        _ => random.uniform(-700.0, 700.0),
    };
    let a = match index % 4 {
        2 | 3 => random.magnitude(1e298, f64::MAX),
        _ => random.magnitude(1e-3, 1e3),
    };
    (a, product / a)
}

/// Subnormal numbers and the least normal ones.
pub(crate) fn least(random: &mut Random, _: usize) -> (f64, f64) {
    let tiny = |random: &mut Random| {
        let top = random.bits() % 52;
        random.sign() * f64::from_bits(random.bits() >> (11 + top) | 1)
    };
    (tiny(random), tiny(random))
}

/// The largest numbers.
pub(crate) fn largest(random: &mut Random, index: usize) -> (f64, f64) {
    let b = match index % 3 {
        0 => random.signed(1e290, f64::MAX),
        1 => random.signed(1e-8, 1e16),
        _ => random.signed(1e60, 1e160),
    };
    let a = random.signed(1e150, f64::MAX);
    if index.is_multiple_of(2) {
        (a, b)
    } else {
        (b, a)
    }
}

/// Where the functions of one argument change their form.
pub(crate) fn seams(random: &mut Random, index: usize) -> (f64, f64) {
    const SEAMS: [f64; 8] = [0.25, 1.0, 2.5, 3.5, 4.0, 700.0, 717.2, 720.0];
    (random.sign() * shifted(random, SEAMS[index % 8]), 0.0)
}

/// Where ln_dd and its derivative change their form: at ratios of the arguments with z² = 1/256
/// and 0.1112, and of 64.
pub(crate) fn positive_seams(random: &mut Random, index: usize) -> (f64, f64) {
    const RATIOS: [f64; 3] = [17.0 / 15.0, 2.000_649, 64.0];
    let a = random.real(index).abs();
    let b = shifted(random, a * RATIOS[index % 3]);
    if index.is_multiple_of(2) {
        (a, b)
    } else {
        (b, a)
    }
}
