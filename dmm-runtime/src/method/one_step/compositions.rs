//! The compositions of [`Composed`](super::Composed): weights γᵢ of symmetric sub-steps.
//!
//! A symmetric composition, γᵢ = γ_{s+1−i}, of a symmetric method of order 2 has even order;
//! it is 4 if Σγ = 1 and Σγ³ = 0, and 6 and 8 with Σγ⁵ = 0, Σγ⁷ = 0 and conditions on nested
//! sums (Hairer, Lubich & Wanner, Geometric Numerical Integration, sections V.3.1–V.3.2).

#![allow(clippy::excessive_precision, reason = "the digits of the sources")]

use super::Composed;

/// An order for which there is a composition; implemented for 4, 6 and 8.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no scheme: compositions have the order 4, 6 or 8",
    label = "write `Composed::<4>`, `Composed::<6>` or `Composed::<8>`"
)]
pub trait Composition: sealed::Sealed {
    /// γ₁ … γₛ
    const WEIGHTS: &'static [f64];
}

mod sealed {
    /// Nothing else implements [`Composition`](super::Composition).
    pub trait Sealed {}
}

/// Implements [`Composition`] for an order with the first half of its weights and the middle.
macro_rules! composition {
    ($order:literal: $($weight:ident = $value:expr),+; $middle:ident = $centre:expr; [$($all:ident)+]) => {
        impl sealed::Sealed for Composed<$order> {}

        impl Composition for Composed<$order> {
            const WEIGHTS: &'static [f64] = {
                $(const $weight: f64 = $value;)+
                const $middle: f64 = $centre;
                &[$($all),+]
            };
        }
    };
}

// γ₁ = 1/(4 − ∛4), γ₃ = 1 − 4γ₁ (Suzuki, Phys. Lett. A 146, 1990)
composition! {
    4:
    G1 = 0.414_490_771_794_375_737_142_354_062_861;
    G3 = -0.657_963_087_177_502_948_569_416_251_443;
    [G1 G1 G3 G1 G1]
}

// Kahan & Li, Math. Comp. 66, 1997, as in Hairer, Lubich & Wanner, eq. V.3.11
composition! {
    6:
    G1 = 0.392_161_444_007_314_139_279_250_56,
    G2 = 0.332_599_136_789_359_438_599_748_64,
    G3 = -0.706_246_172_557_639_359_809_964_82,
    G4 = 0.082_213_596_293_550_800_231_490_45;
    G5 = 0.798_543_990_934_829_963_398_950_35;
    [G1 G2 G3 G4 G5 G4 G3 G2 G1]
}

// Kahan & Li, Math. Comp. 66, 1997, as in Hairer, Lubich & Wanner, eq. V.3.12
composition! {
    8:
    G1 = 0.130_202_483_088_890_080_878_817_63,
    G2 = 0.561_162_981_775_108_384_561_964_41,
    G3 = -0.389_474_962_644_847_286_408_078_60,
    G4 = 0.158_841_906_555_155_600_896_210_75,
    G5 = -0.395_903_894_133_237_577_336_231_54,
    G6 = 0.184_539_640_978_315_707_091_832_54,
    G7 = 0.258_374_387_686_322_047_293_979_11,
    G8 = 0.295_011_723_609_310_298_870_966_24;
    G9 = -0.605_508_533_830_034_511_698_921_08;
    [G1 G2 G3 G4 G5 G6 G7 G8 G9 G8 G7 G6 G5 G4 G3 G2 G1]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Σγᵏ = 0 for odd k below the order, Σγ = 1 and symmetry; the nested conditions are
    /// those that the fitted orders tell of.
    fn assert_sums(weights: &[f64], order: i32) {
        let sum = |k: i32| weights.iter().map(|weight| weight.powi(k)).sum::<f64>();
        assert!((sum(1) - 1.0).abs() < 1e-15);
        for k in (3..order).step_by(2) {
            assert!(sum(k).abs() < 1e-15, "order {order}, power {k}: {}", sum(k));
        }
        assert!(sum(order + 1).abs() > 1e-4, "of higher order than {order}");
        assert!(weights.iter().eq(weights.iter().rev()));
    }

    #[test]
    fn weights_fulfil_the_order_conditions() {
        assert_sums(Composed::<4>::WEIGHTS, 4);
        assert_sums(Composed::<6>::WEIGHTS, 6);
        assert_sums(Composed::<8>::WEIGHTS, 8);
    }
}
