//! The declaration language: the macro [`pws!`](crate::pws) and its page.

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
/// | `state x, q[3];` | the states, in the order of the vectors that the integrator takes and gives; `q[3]` is a group of three |
/// | `param k = 1, m[3] = [1, 2, 3];` | parameters with their defaults, one for all elements of a group or one each; public fields of the struct |
/// | `const n = 3;` | a constant: a formula of numbers and constants |
/// | `let r = sqrt(x^2 + y^2);` | a shared sub-expression |
/// | `fn V(q, k) = k * q^2/2;` | a function, written out wherever it is called; in its formula an argument hides what else has its name |
/// | `interface name = g;` | an interface, the zero set of the switching function g |
/// | `region name where i > 0 and j < 0 { … }` | where the fields and conserved quantities in the block hold: a sign pattern, from which an interface that does not matter is left out |
/// | `discrete u = 1;` | a discrete state with its initial value: constant between events, changed by them |
/// | `on name falling where u < 3 { x = …; u = …; }` | an event: what changes where g falls (or `rising`, or neither for both) through zero and a condition holds, see [Events](#events) |
/// | `every T { … }`, `at t1 { … }` | events at the times T, 2T, … and t1 |
/// | `der(x) = formula;` | ẋ, once a state in every region |
/// | `hamiltonian H = formula in (q, p), …;` | q̇ = ∂H/∂p and ṗ = −∂H/∂q for each canonical pair, which conserve H unless it depends on `t` |
/// | `conserved name = formula;` | a conserved quantity ψ, any number a region |
/// | `assume conserved name = formula;` | the same where the proof is out of the compiler's reach: it is checked at many points instead, and said so in the listing |
/// | `for i in 0..n { … }` | repeats `der`, `conserved` and `for` items for i = 0, …, n − 1 |
///
/// A region has `let`, `der`, `hamiltonian`, `conserved`, `on` and `for` items. What of them stands at
/// the top level belongs to every region: a system without interface has all of them there.
/// Names are declared in front of their use. Documentation comments carry over to what is
/// emitted.
///
/// # Formulas
///
/// | | |
/// |---|---|
/// | operators | `+ - * / ^`; `^` is the power: it binds tighter than the unary minus, and from the right |
/// | functions | `sqrt exp ln sin cos tan sinh cosh tanh asin acos atan`, and those declared with `fn` |
/// | switches | `if a > b { u } else { v }`, `abs(u)`, `sign(u)`, `min(u, v)`, `max(u, v)`, `clamp(u, low, high)`: see [Switches](#switches) |
/// | names | states, parameters, constants, `let`s, the time `t`, `pi` |
/// | numbers | `2`, `0.1`, `1e-3`: exact rationals until code is emitted |
/// | elements | `q[0]`, `q[i + 1]`, `q[(i + 1) % n]`: an index is a formula of integer constants, counted from 0; `%` is the remainder of such |
/// | sums | `sum(i in 0..n, q[i]^2)`: the term for i = 0, …, n − 1, added up |
///
/// # Groups, loops and sums
///
/// A ring of masses as it is written on paper, mᵢ q̈ᵢ = k (qᵢ₊₁ − 2 qᵢ + qᵢ₋₁):
///
/// ```
/// use dmm_runtime::{Integrator, Symmetric, System, pws};
///
/// pws! {
///     /// Masses on a ring of springs.
///     pub system Ring {
///         const n = 3;
///         state q[n], p[n];
///         param m[n] = [1, 2, 4], k = 1;
///         for i in 0..n {
///             der(q[i]) = p[i] / m[i];
///             der(p[i]) = k * (q[(i + 1) % n] - 2 * q[i] + q[(i + n - 1) % n]);
///         }
///         conserved energy = sum(i in 0..n, p[i]^2 / (2 * m[i]) + k/2 * (q[(i + 1) % n] - q[i])^2);
///         conserved momentum = sum(i in 0..n, p[i]);
///     }
/// }
///
/// let ring = Ring { k: 2.0, ..Default::default() };
/// assert_eq!(ring.m, [1.0, 2.0, 4.0]);
/// assert_eq!(ring.metadata().states, ["q[0]", "q[1]", "q[2]", "p[0]", "p[1]", "p[2]"]);
///
/// let solution = Integrator::new(&ring, Symmetric::step_size(0.1))
///     .initial(0.0, [1.0, 0.0, 0.0, 0.0, 1.0, -1.0])
///     .run_until(10.0)?;
/// let end = solution.last().ok_or("no solution")?;
/// assert!((end.x[3] + end.x[4] + end.x[5]).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Functions and Hamiltonians
///
/// The vector field of a Hamiltonian is derived, and H is conserved by construction. A pair is
/// made of two states, two elements, or two groups of the same length.
///
/// The formula of a function sees its arguments, and of the names declared above it those that no
/// argument has: a potential is `fn V(q) = k * q^2/2;` also where `q` is a state, and `V(q[1])` is
/// its value at another one.
///
/// ```
/// use dmm_runtime::{Integrator, Symmetric, pws};
///
/// pws! {
///     /// Two masses between walls, with springs that harden.
///     pub system Springs {
///         state q[2], p[2];
///         param beta = 0.5;
///         fn V(r) = r^2/2 + beta * r^4/4;
///         hamiltonian energy =
///             sum(i in 0..2, p[i]^2/2) + V(q[0]) + V(q[1] - q[0]) + V(q[1]) in (q, p);
///     }
/// }
///
/// let springs = Springs::default();
/// let potential = |r: f64| r.powi(2) / 2.0 + springs.beta * r.powi(4) / 4.0;
/// let energy = |x: [f64; 4]| {
///     (x[2].powi(2) + x[3].powi(2)) / 2.0
///         + potential(x[0]) + potential(x[1] - x[0]) + potential(x[1])
/// };
/// let start = [1.0, -0.5, 0.0, 0.0];
/// let solution = Integrator::new(&springs, Symmetric::step_size(0.1))
///     .initial(0.0, start)
///     .run_until(100.0)?;
/// let end = solution.last().ok_or("no solution")?;
/// assert!((energy(end.x.into()) - energy(start)).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # What regions share
///
/// ```
/// use dmm_runtime::{System, pws};
///
/// pws! {
///     /// A mass on a spring that is stiffer outside of the unit circle.
///     pub system Shell {
///         state x, y, u, v;
///         param k_inside = 1, k_outside = 4;
///         let r_squared = x^2 + y^2;
///         fn energy_with(k) = (u^2 + v^2 + k * r_squared) / 2;
///         interface shell = r_squared - 1;
///         der(x) = u;
///         der(y) = v;
///         conserved angular_momentum = x * v - y * u;
///         region inside where shell < 0 {
///             der(u) = -k_inside * x;
///             der(v) = -k_inside * y;
///             conserved energy = energy_with(k_inside);
///         }
///         region outside where shell > 0 {
///             der(u) = -k_outside * x;
///             der(v) = -k_outside * y;
///             conserved energy = energy_with(k_outside);
///         }
///     }
/// }
///
/// for region in Shell::default().metadata().regions {
///     assert_eq!(region.conserved, ["angular_momentum", "energy"]);
/// }
/// ```
///
/// # Switches
///
/// What a formula switches at is an interface of its own, which has the name of its formula: a − b of
/// `if a > b`, u of `abs(u)`. It is located and crossed like any other. On which side of it a solution
/// is belongs to the mode, so that there is one field however many switches there are; conserved
/// quantities may switch as well, and are proved on both sides.
///
/// ```
/// use dmm_runtime::{Integrator, System, Taylor, pws};
///
/// pws! {
///     /// Grains on a line that push, and do not pull.
///     pub system Grains {
///         const n = 3;
///         state q[n], p[n];
///         fn overlap(r) = if r < 0 { r^2 / 2 } else { 0 };
///         hamiltonian energy =
///             sum(i in 0..n, p[i]^2 / 2) + sum(i in 1..n, overlap(q[i] - q[i - 1])) in (q, p);
///     }
/// }
///
/// let grains = Grains {};
/// assert_eq!(grains.metadata().interfaces, ["q[0] - q[1]", "q[1] - q[2]"]);
/// let solution = Integrator::new(&grains, Taylor::tolerance(1e-12))
///     .initial(0.0, [0.0, 0.5, 1.0, 1.0, 0.0, 0.0])
///     .run_until(20.0)?;
/// let end = solution.last().expect("an end");
/// let energy = grains.conserved(end.region, end.t, &end.x)[0];
/// assert!((energy - 0.5).abs() < 1e-15);
/// # Ok::<(), dmm_runtime::Error>(())
/// ```
///
/// Both branches are computed, and the one that does not hold counts nothing. Where it would have no
/// value, under a root, a logarithm or in a denominator, something else is computed there; where it
/// costs much, regions are the faster way.
///
/// # Sliding
///
/// Where the fields on both sides of an interface point at it, a solution goes on along the interface,
/// by the mean of the fields that stays on it (Filippov): ẋ = θ f₊ + (1 − θ) f₋ with ∂ₜg + ∇g·ẋ = 0.
/// It leaves where one of the fields begins to point away, θ = 0 or θ = 1. That has to be meant:
/// `interface … = …, sliding;`, or `if … sliding { … } else { … }` in a formula.
///
/// ```
/// use dmm_runtime::{Best, Integrator, System, TransitionKind, pws};
///
/// pws! {
///     /// A mass on a moving belt: it sticks to the belt until the spring is stronger than friction.
///     pub system Mass {
///         state x, v;
///         param friction = 0.4, belt = 0.2;
///         der(x) = v;
///         der(v) = -x - friction * (if v > belt sliding { 1 } else { -1 });
///     }
/// }
///
/// let mass = Mass::default();
/// let solution = Integrator::new(&mass, Best::tolerance(1e-13))
///     .initial(0.0, [0.0, 0.2])
///     .run_until(3.0)?;
/// // it sticks at once, and slips where x = friction
/// let [slip] = solution.transitions() else {
///     panic!("{:?}", solution.transitions());
/// };
/// assert_eq!(slip.kind, TransitionKind::LeftSlide);
/// assert!((slip.t - 2.0).abs() < 1e-13 && (slip.x[0] - 0.4).abs() < 1e-15);
/// # Ok::<(), dmm_runtime::Error>(())
/// ```
///
/// - While it slides, g is a conserved quantity and stays zero to rounding errors. What the fields on
///   both sides conserve, the motion conserves; what it conserves besides is declared in a block of
///   its own, `sliding contact { conserved energy = …; }`, and proved.
/// - A motion on interfaces is a region like any other to a program: `sliding_contact`, in Rust the
///   variant `SlidingContact`. Switches that slide belong to the mode: [`Mode`](crate::Mode) has no
///   side for them.
/// - Any number of switches may slide at once, where f is a sum of what they switch, and so may two
///   interfaces of regions. The weights are solved for together where they depend on one another, up
///   to 16 of them. Where four regions meet whose fields are no such sum, the mean is not
///   determined; a solution that comes there ends as
///   [`ErrorKind::Intersection`](crate::ErrorKind::Intersection).
/// - A solution that would slide where that is not declared ends as
///   [`ErrorKind::Sliding`](crate::ErrorKind::Sliding).
///
/// # Events
///
/// An event changes states and discrete states in an instant; every new value is computed from the
/// values before. A bouncing ball, and a thermostat that remembers which bound it met last:
///
/// ```
/// use dmm_runtime::{Best, Integrator, TransitionKind, pws};
///
/// pws! {
///     /// A ball that loses speed where it bounces, and is thrown up again from time to time.
///     pub system Ball {
///         state y, v;
///         param e = 0.9;
///         discrete bounces = 0;
///         interface floor = y;
///         der(y) = v;
///         der(v) = -1;
///         conserved energy = v^2/2 + y;
///         on floor falling where bounces < 3 {
///             v = -e * v;
///             bounces = bounces + 1;
///         }
///         on floor falling where bounces > 2 {
///             v = -v;
///             bounces = bounces + 1;
///             conserves energy;
///         }
///         every 10 { v = v + 1; }
///     }
/// }
///
/// let solution = Integrator::new(&Ball::default(), Best::tolerance(1e-12))
///     .initial(0.0, [0.5, 0.0])
///     .run_until(15.0)?;
/// let first = solution.transitions()[0];
/// assert_eq!(first.kind, TransitionKind::Jumped);
/// assert!((first.t - 1.0).abs() < 1e-14 && (first.after[1] - 0.9).abs() < 1e-14);
/// let throw = solution.transitions().iter().find(|one| one.interface == 1);
/// assert_eq!(throw.map(|one| one.t), Some(10.0));
/// assert!(solution.last().is_some_and(|end| end.region.discrete[0] > 6.0));
/// # Ok::<(), dmm_runtime::Error>(())
/// ```
///
/// - The level of each conserved quantity is taken anew behind an event. What an event claims to
///   conserve, `conserves energy;`, is proved at the points of its interface, or it does not compile.
/// - The mode behind an event is decided as at a start: by the signs of all interfaces, and by dg/dt
///   on those that the new state is on. An event does not happen again at the point it has led to.
/// - An event asks for a direction: crossed the other way, its interface is passed in silence.
/// - Events that happen at once all see the values before. If they give a state different values, the
///   run ends with [`ErrorKind::Conflict`](crate::ErrorKind::Conflict).
/// - Events that follow one another faster than the time can tell end a run as
///   [`ErrorKind::Zeno`](crate::ErrorKind::Zeno), with all that came before.
/// - `every T` happens at the multiples of T behind the initial time, `at t1` if t1 is behind it.
/// - The mode of a system with events is a [`Mode`](crate::Mode): its region, with the discrete states.
///
/// # Where a proof holds
///
/// A proof of ∂ₜψ + ∇ψ·f = 0 holds in the region, where ψ, its derivatives and f have values. The
/// listing names the conditions: x > 0 where one of them has ln x. Most of them end a run by
/// themselves, because the formulas have no value beyond. The others are `checked`, at the start
/// of a run, where it enters the region, and in each step like an interface:
///
/// - of x^k with a parameter k there is a value also where x < 0, if k is an integer; the
///   condition x > 0 is left if the proof does not hold there, for even and for odd k;
/// - a quantity that jumps where it divides by zero, as atan(y/x) does at x = 0, is conserved on
///   each side, and not across.
///
/// A run that comes to such a condition ends with an error that names it, and the solution up to
/// there is kept; nothing is corrected towards a level that is not conserved. To go on, declare
/// an interface there, and beyond it a region without the quantity, or with what is conserved
/// there. A region that implies a condition makes the check superfluous:
///
/// ```
/// use dmm_runtime::{ErrorKind, Integrator, System, Taylor, pws};
///
/// pws! {
///     /// A rotation with its angle.
///     pub system Rotation {
///         state x, y;
///         der(x) = -y;
///         der(y) = x;
///         conserved angle = atan(y / x) - t;
///     }
/// }
///
/// pws! {
///     /// The same, which goes on without the angle where x < 0.
///     pub system Half {
///         state x, y;
///         interface side = x;
///         der(x) = -y;
///         der(y) = x;
///         region right where side > 0 {
///             conserved angle = atan(y / x) - t;
///         }
///         region left where side < 0 {}
///     }
/// }
///
/// let stopped = Integrator::new(&Rotation {}, Taylor::tolerance(1e-9))
///     .initial(0.0, [1.0, 0.5])
///     .run_until(3.0)
///     .unwrap_err();
/// let ErrorKind::ConditionFails { condition, quantity } = &stopped.error().kind else {
///     panic!("{}", stopped.error());
/// };
/// assert_eq!((*condition, *quantity), ("x ≠ 0", "angle"));
/// assert_eq!(Rotation {}.metadata().conditions.len(), 1);
/// assert!(Half {}.metadata().conditions.is_empty());
/// ```
///
/// # What is emitted
///
/// For `pub system Harmonic`: a struct `Harmonic` with a public field a parameter (`f64`, or
/// `[f64; n]` for a group) and `Default`, an enumeration `HarmonicRegion` of its regions
/// (`HarmonicRegion::Above`; `Everywhere` without interfaces), and the traits that the runtime's
/// integrators use. The derived mathematics is `System::listing`.
///
/// It may be declared wherever an item may stand, also in a function, under whatever name the
/// runtime has in `Cargo.toml`, and through a crate that re-exports the macro. Names around it
/// change nothing.
///
/// # Messages
///
/// An error says what is wrong, on the formula or name that is, and what to write instead; its number
/// is explained below. What is declared and never used is a warning. Stable Rust lets a macro warn
/// in one way only, as if something deprecated were used, so that it begins with ``use of
/// deprecated constant `_::PWS205` ``. A name that begins with `_` is meant to be unused, and
/// `#[allow(deprecated)]` on the module around a declaration silences all of its warnings.
///
/// A declaration is made of Rust's tokens, which rustc reads before it calls the macro. It knows
/// nothing of the language and has words of its own for what is no token:
///
/// | written | what rustc says | what to write |
/// |---|---|---|
/// | `x' = y` | ``prefix `x` is unknown`` (a letter in front of a quotation mark) | `der(x) = y` |
/// | `V'(q)` | ``prefix `V` is unknown`` | a function of its own, `fn dV(q) = …`, or a `hamiltonian` |
/// | `x²`, `x₀` | `unknown start of token: \u{b2}` | `x^2`, `x_0` |
/// | `−x`, `2·x`, `√x`, `x ≥ 0` | `unknown start of token`, and which sign it looks like | `-x`, `2*x`, `sqrt(x)`, a region |
/// | `# it's`, `% it's` | ``prefix `it` is unknown`` | `// it's` |
/// | a bracket without its other one | `this file contains an unclosed delimiter`, `mismatched closing delimiter` | the other one |
///
/// Declarations in a text, which `Model::compile` and the program `pws` read, are told what to write
/// for these as well.
///
#[doc = include_str!("../DIAGNOSTICS.md")]
#[cfg(feature = "macros")]
#[macro_export]
macro_rules! pws {
    // The path of this crate goes with the declaration, so that emitted code finds it under
    // whatever name and through whatever other crate the macro was called.
    ($($declaration:tt)*) => {
        $crate::support::pws! { [$crate] $($declaration)* }
    };
}
