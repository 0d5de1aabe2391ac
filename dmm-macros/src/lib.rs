//! The [`pws!`] macro: a shell around the compiler `dmm-compiler`.
//!
//! Depend on `dmm-runtime`, which re-exports the macro and holds what emitted code refers to.

use proc_macro::TokenStream;

/// Declares a piecewise-smooth system and derives its conservative integrator.
///
/// The system is ẋ = fᵣ(t, x) on regions r, the sign patterns of switching functions g, each
/// region with quantities ψ(t, x) that f conserves: ∂ₜψ + ∇ψ·f = 0. The macro proves that they
/// are conserved, derives the discrete multiplier Λ^τ and a discrete vector field f^τ that
/// conserve them exactly from step to step (the Discrete Multiplier Method of Wan, Bihlo and
/// Nave, 2017), and emits straight-line code for them and their derivatives. A declaration that
/// is wrong does not compile.
///
/// ```
/// use dmm_runtime::pws;
///
/// pws! {
///     /// Oscillator whose spring stiffens below y = 0.
///     pub system Harmonic {
///         state x, y;
///         param k_above = 1, k_below = 3;
///         interface spring = y;
///         region above where spring > 0 {
///             der(x) = y;
///             der(y) = -k_above * x;
///             conserved energy = (y^2 + k_above * x^2) / 2;
///         }
///         region below where spring < 0 {
///             der(x) = y;
///             der(y) = -k_below * x;
///             conserved energy = (y^2 + k_below * x^2) / 2;
///         }
///     }
/// }
///
/// let system = Harmonic { k_below: 2.0, ..Default::default() };
/// assert_eq!(system.k_above, 1.0);
/// ```
///
/// # Items
///
/// | item | meaning |
/// |---|---|
/// | `state x, y;` | the states, in the order of the vectors that the integrator takes and gives |
/// | `param k = 1, m = 2.5;` | parameters with their defaults; public fields of the struct |
/// | `const c = 2*pi;` | a constant: a formula of numbers and constants |
/// | `let r = sqrt(x^2 + y^2);` | a shared sub-expression |
/// | `interface name = g;` | an interface, the zero set of the switching function g |
/// | `region name where i > 0 { … }` | where the fields and conserved quantities in the block hold; `i > 0 and j < 0` for several interfaces |
/// | `der(x) = formula;` | ẋ, once a state in every region |
/// | `conserved name = formula;` | a conserved quantity ψ, any number a region |
///
/// Without an interface `der` and `conserved` stand in the system itself. Documentation
/// comments carry over to what is emitted.
///
/// # Formulas
///
/// | | |
/// |---|---|
/// | operators | `+ - * / ^`; `^` is the power: it binds tighter than the unary minus, and from the right |
/// | functions | `sqrt exp ln sin cos tan sinh cosh tanh asin acos atan` |
/// | names | states, parameters, constants, `let`s, the time `t`, `pi` |
/// | numbers | `2`, `0.1`, `1e-3`: exact rationals until code is emitted |
///
/// # What is emitted
///
/// For `pub system Harmonic`: a struct `Harmonic` with a public `f64` field a parameter and
/// `Default`, an enumeration `HarmonicRegion` of its regions (`HarmonicRegion::Above`;
/// `Everywhere` without interfaces), and the traits that the runtime's integrators use. The
/// derived mathematics is the constant `System::LISTING`.
#[proc_macro]
pub fn pws(input: TokenStream) -> TokenStream {
    dmm_compiler::compile(input.into()).into()
}
