//! Conditions of proofs that a run checks.

/// A condition under which quantities of a region were proved to be conserved, and beyond which
/// the emitted code has values nevertheless.
///
/// Of x^k the compiler knows that k is a parameter; for an integer k there is a value also where
/// x < 0. A proof that needs x > 0 says nothing there. Where neither the region nor a root or a
/// logarithm in the formulas keeps solutions from leaving the condition, a run checks it: at its
/// start, where it enters the region, and in each step, in which a guard is watched like an
/// interface. What comes to it ends as [`ErrorKind::ConditionFails`](crate::ErrorKind::ConditionFails),
/// and nothing is ever corrected towards a level beyond.
///
/// ```
/// use dmm_runtime::{ErrorKind, Integrator, Symmetric, System, pws};
///
/// pws! {
///     /// ẏ = |x| x: y − x³/3 is conserved where x > 0.
///     pub system Ramp {
///         state x, y;
///         param k = 2;
///         der(x) = 1;
///         der(y) = sqrt(x^2) * x^k / x^k * x;
///         conserved e = y - x^3 / 3;
///     }
/// }
///
/// let ramp = Ramp::default();
/// assert_eq!(ramp.metadata().conditions[0].condition, "x > 0");
/// let from = |x| Integrator::new(&ramp, Symmetric::step_size(0.01)).initial(0.0, [x, 0.5]);
/// assert!(from(1.0).run_until(0.5).is_ok());
/// let stopped = from(-1.0).run_until(0.5).unwrap_err();
/// assert!(matches!(stopped.error().kind, ErrorKind::ConditionFails { quantity: "e", .. }));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Condition {
    /// The index of the region in [`Metadata::regions`](crate::Metadata::regions).
    pub region: usize,
    /// The condition, as text.
    pub condition: &'static str,
    /// The names of the quantities.
    pub quantities: &'static str,
    /// Whether the condition is u ≠ 0, so that the sign of u is kept.
    pub keeps_sign: bool,
}
