//! A hash for tables of nodes. That of the standard library withstands chosen keys, at a price
//! that shows where nothing is inlined; here the keys are the compiler's own.

use std::hash::{BuildHasherDefault, Hasher};

/// Builds [`Quick`].
pub(crate) type BuildQuick = BuildHasherDefault<Quick>;

/// Multiplicative hashing (Knuth, *The Art of Computer Programming* 3, §6.4) of words.
#[derive(Clone, Copy, Default)]
pub(crate) struct Quick(u64);

/// An odd number near 2⁶⁴/φ.
const FACTOR: u64 = 0x9e37_79b9_7f4a_7c15;

impl Hasher for Quick {
    fn write_u64(&mut self, word: u64) {
        self.0 = (self.0.rotate_left(23) ^ word).wrapping_mul(FACTOR);
    }

    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            self.write_u64(u64::from_le_bytes(word));
        }
    }

    fn write_u8(&mut self, word: u8) {
        self.write_u64(word.into());
    }

    fn write_u32(&mut self, word: u32) {
        self.write_u64(word.into());
    }

    fn write_usize(&mut self, word: usize) {
        self.write_u64(word as u64);
    }

    fn write_isize(&mut self, word: isize) {
        self.write_u64(word as u64);
    }

    fn finish(&self) -> u64 {
        // tables take the low bits, a product has its mixed ones at the top
        self.0.rotate_left(26)
    }
}
