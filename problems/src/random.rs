//! Random numbers that are the same on every machine (SplitMix64; Steele, Lea & Flood, 2014).

/// A stream of numbers.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The stream of an index in a family, of a seed.
    pub fn new(family: &str, seed: u64, index: usize) -> Self {
        let mut start = 0xcbf2_9ce4_8422_2325_u64 ^ seed;
        for byte in family.bytes() {
            start = (start ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
        let mut random = Self(start);
        random.0 ^= random.next().wrapping_add(index as u64);
        random.next();
        random
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// Between two numbers, evenly.
    pub fn between(&mut self, lower: f64, upper: f64) -> f64 {
        let unit = (self.next() >> 11) as f64 * f64::EPSILON / 2.0;
        lower + (upper - lower) * unit
    }

    /// Between two positive numbers, evenly in their decades.
    pub fn decades(&mut self, lower: f64, upper: f64) -> f64 {
        self.between(lower.ln(), upper.ln()).exp()
    }

    /// True once in `often`.
    pub fn once_in(&mut self, often: u64) -> bool {
        self.next().is_multiple_of(often)
    }

    /// A number of that size with either sign.
    pub fn signed(&mut self, size: f64) -> f64 {
        if self.once_in(2) { size } else { -size }
    }

    /// Numbers between −size and size.
    pub fn array<const N: usize>(&mut self, size: f64) -> [f64; N] {
        std::array::from_fn(|_| self.between(-size, size))
    }

    /// One of 0, …, count − 1.
    pub fn up_to(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }
}
