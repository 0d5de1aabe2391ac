//! What a quantity that could not be proved is evaluated at.

/// `assume` wants this many points in the domain …
pub(super) const FEWEST_POINTS: usize = 64;
/// … is content with this many …
pub(super) const ENOUGH_POINTS: usize = 128;
/// … and gives up after this many.
pub(super) const MOST_TRIALS: usize = 2048;
/// The largest residual that `assume` accepts, relative to the size of the terms that cancel:
/// far above what rounding leaves, far below a wrong coefficient.
pub(super) const SMALL: f64 = 1e-9;

/// The points at which ∂ₜψ + ∇ψ·f was evaluated.
#[derive(Default)]
pub(super) struct Trials {
    /// Where the residual says something.
    pub(super) usable: usize,
    /// Where ψ, f or a derivative has no value.
    pub(super) undefined: usize,
    /// Where every term is zero, or is as small as its rounding error.
    pub(super) without_terms: usize,
}

impl Trials {
    /// The residual and the size of its terms at a point where it says something; `values` are
    /// the `terms` terms, their sum, and everything else that has to be defined.
    pub(super) fn judge(&mut self, values: &[(f64, f64)], terms: usize) -> Option<(f64, f64)> {
        if values.iter().any(|(value, _)| !value.is_finite()) {
            self.undefined += 1;
            return None;
        }
        let size: f64 = values
            .iter()
            .take(terms)
            .map(|(value, _)| value.abs())
            .sum();
        let &(residual, error) = values.get(terms)?;
        // a value without digits says nothing
        if size == 0.0 || error.is_nan() || error > SMALL * size {
            self.without_terms += 1;
            return None;
        }
        self.usable += 1;
        Some((residual, size))
    }
}
