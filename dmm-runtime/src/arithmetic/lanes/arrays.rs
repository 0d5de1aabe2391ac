//! Operations by lane as those of arrays, which the compiler turns into instructions for the vectors that
//! the function they are inlined into allows.

/// A truth value: all bits or none.
pub(super) type Bits = u64;

/// True or false.
#[inline(always)]
pub(super) fn bits(set: bool) -> Bits {
    if set { u64::MAX } else { 0 }
}

/// What an expression gives in every lane of its arguments.
macro_rules! in_lanes {
    ($($name:ident = $of:expr),*; $value:expr) => {
        std::array::from_fn(|i| {
            $(let $name = $of[i];)*
            $value
        })
    };
}
pub(super) use in_lanes;

/// Where a > b.
#[inline(always)]
pub(super) fn above(a: f64, b: f64) -> Bits {
    bits(a > b)
}

/// Where a = b.
#[inline(always)]
pub(super) fn equals(a: f64, b: f64) -> Bits {
    bits(a == b)
}

/// The larger of both; b if they cannot be compared.
#[inline(always)]
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller of both; b if they cannot be compared.
#[inline(always)]
pub(super) fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// One where the mask is true, the other elsewhere.
#[inline(always)]
pub(super) fn select(mask: Bits, one: f64, other: f64) -> f64 {
    f64::from_bits((one.to_bits() & mask) | (other.to_bits() & !mask))
}

/// Whether it is true in any lane.
#[inline(always)]
pub(super) fn any<const L: usize>(mask: &[Bits; L]) -> bool {
    mask.iter().fold(0, |any, lane| any | lane) != 0
}
