//! Operations by lane as those of [`wide`]'s vectors of eight doubles, whose instructions are chosen when
//! [`wide`] is compiled.

pub(super) use wide::f64x8;

/// A truth value: all bits or none.
pub(super) type Bits = f64;

/// True or false.
#[inline(always)]
pub(super) fn bits(set: bool) -> Bits {
    f64::from_bits(if set { u64::MAX } else { 0 })
}

/// What an expression gives in every lane of its arguments, whose number, the caller's L, is a multiple of
/// eight. It is a closure that does it: inlined where nothing is optimised, its variables would fill the stack.
macro_rules! in_lanes {
    ($($name:ident = $of:expr),*; $value:expr) => {{
        let lanes = |mut lanes: [f64; L]| {
            for (at, eight) in lanes.as_chunks_mut().0.iter_mut().enumerate() {
                $(let $name = $crate::arithmetic::lanes::parts::f64x8::new($of.as_chunks().0[at]);)*
                *eight = ($value).to_array();
            }
            lanes
        };
        lanes([0.0; L])
    }};
}
pub(super) use in_lanes;

/// Where a > b.
#[inline(always)]
pub(super) fn above(a: f64x8, b: f64x8) -> f64x8 {
    a.simd_gt(b)
}

/// Where a = b.
#[inline(always)]
pub(super) fn equals(a: f64x8, b: f64x8) -> f64x8 {
    a.simd_eq(b)
}

/// The larger of both; b if they cannot be compared.
#[inline(always)]
pub(super) fn larger(a: f64x8, b: f64x8) -> f64x8 {
    a.fast_max(b)
}

/// The smaller of both; b if they cannot be compared.
#[inline(always)]
pub(super) fn smaller(a: f64x8, b: f64x8) -> f64x8 {
    a.fast_min(b)
}

/// One where the mask is true, the other elsewhere.
#[inline(always)]
pub(super) fn select(mask: f64x8, one: f64x8, other: f64x8) -> f64x8 {
    mask.bitselect(one, other)
}

/// Whether it is true in any lane.
#[inline(always)]
pub(super) fn any<const L: usize>(mask: &[Bits; L]) -> bool {
    let mut any = false;
    for &eight in mask.as_chunks().0 {
        any |= f64x8::new(eight).any();
    }
    any
}
