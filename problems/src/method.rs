//! The schemes by name: a row of `methods!` is all that a scheme needs to be known to the
//! program, its studies and its measurements.

use dmm_runtime::dynamic::{AnyMap, InitialValue, MethodChoice, MethodVisitor, OutputTimes};
use dmm_runtime::{
    Adaptive, Best, Composed, EmbeddedRungeKutta, ErrorEstimate, NewtonLocator, RungeKutta,
    Symmetric, Taylor, Uniform,
};

use crate::perturbed::Perturbed;

/// An integration to be made from t = 0.
#[derive(Clone, PartialEq, Debug)]
pub struct Run {
    /// The scheme.
    pub method: MethodName,
    /// τ, if the scheme has uniform steps.
    pub step_size: f64,
    /// The tolerance, if the scheme has one.
    pub tolerance: f64,
    /// Whether the level of ψ is kept (as it is meant to be) or left to rounding.
    pub level_correction: bool,
    /// Initial state.
    pub initial: Vec<f64>,
    /// End time.
    pub t_end: f64,
    /// Times of output besides the steps.
    pub output_times: OutputTimes,
}

impl Run {
    /// The initial value problem.
    pub(crate) fn from(&self) -> InitialValue {
        InitialValue {
            initial: self.initial.clone(),
            t_end: self.t_end,
            output_times: self.output_times.clone(),
        }
    }
}

/// What decides the steps of a scheme.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Control {
    /// The step size τ, all steps being of that size; the error is O(τᵖ).
    StepSize {
        /// p
        order: i32,
    },
    /// A tolerance: steps of the scheme's own choice.
    Tolerance,
}

const fn order(order: i32) -> Control {
    Control::StepSize { order }
}

const TOLERANCE: Control = Control::Tolerance;

macro_rules! methods {
    (
        conserving { $(
            #[doc = $doc:literal]
            $variant:ident, $name:literal, $control:expr, $scheme:expr;
        )+ }
        runge_kutta { $(
            #[doc = $other_doc:literal]
            $other:ident, $other_name:literal, $other_control:expr, $other_scheme:expr;
        )+ }
        embedded { $(
            #[doc = $pair_doc:literal]
            $pair:ident, $pair_name:literal, $pair_scheme:expr;
        )+ }
    ) => {
        /// The scheme of a run.
        #[derive(Clone, Copy, PartialEq, Debug)]
        pub enum MethodName {
            $(#[doc = $doc] $variant,)+
            $(#[doc = $other_doc] $other,)+
            $(#[doc = $pair_doc] $pair,)+
            /// The scheme of order 2 with every crossing located too late.
            Perturbed(Perturbed),
        }

        impl MethodName {
            /// The schemes that conserve.
            pub const CONSERVING: &'static [Self] = &[$(Self::$variant),+];
            /// Runge–Kutta methods, which conserve by the correction of the level alone.
            pub const RUNGE_KUTTA: &'static [Self] = &[$(Self::$other),+];
            /// Runge–Kutta methods in steps by an estimate of their error.
            pub const EMBEDDED: &'static [Self] = &[$(Self::$pair),+];

            /// Its name on the command line. A scheme of uniform steps and its form with steps
            /// by a tolerance have the same.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)+
                    $(Self::$other => $other_name,)+
                    $(Self::$pair => $pair_name,)+
                    Self::Perturbed(_) => "perturbed",
                }
            }

            /// What it is.
            pub fn summary(self) -> &'static str {
                match self {
                    $(Self::$variant => $doc,)+
                    $(Self::$other => $other_doc,)+
                    $(Self::$pair => $pair_doc,)+
                    Self::Perturbed(_) => "crossings located too late",
                }
                .trim()
            }

            /// What decides its steps.
            pub fn control(self) -> Control {
                match self {
                    $(Self::$variant => $control,)+
                    $(Self::$other => $other_control,)+
                    $(Self::$pair => TOLERANCE,)+
                    Self::Perturbed(_) => order(2),
                }
            }

            /// The Runge–Kutta method that it is, if it is one.
            pub fn runge_kutta(self) -> Option<RungeKutta> {
                match self {
                    $(Self::$other => Some($other_scheme),)+
                    _ => None,
                }
            }
        }

        impl MethodChoice for Run {
            fn visit<V: MethodVisitor>(&self, visitor: V) -> V::Output {
                match self.method {
                    $(MethodName::$variant => visitor.visit(apply(self, $scheme)),)+
                    $(MethodName::$other => visitor.visit(uniform(self, $other_scheme, Perturbed::NOT)),)+
                    $(MethodName::$pair => visitor.visit(embedded(self, $pair_scheme)),)+
                    MethodName::Perturbed(late) => visitor.visit(uniform(self, Symmetric, late)),
                }
            }

            /// The fastest with uniform and with chosen steps.
            fn visit_unobserved<V: MethodVisitor>(&self, visitor: V) -> Option<V::Output> {
                let Self {
                    tolerance,
                    level_correction,
                    ..
                } = *self;
                Some(match self.method {
                    MethodName::Symmetric => visitor.visit(unobserved(self)),
                    MethodName::Taylor => visitor
                        .visit(Taylor::tolerance(tolerance).level_correction(level_correction)),
                    MethodName::Best => visitor
                        .visit(Best::tolerance(tolerance).level_correction(level_correction)),
                    _ => return None,
                })
            }
        }
    };
}

methods! {
    conserving {
        /// order 2, uniform steps
        Symmetric, "symmetric", order(2), |run| uniform(run, Symmetric, Perturbed::NOT);
        /// its composition of order 4, uniform steps
        Composed4, "composed-4", order(4), |run| uniform(run, Composed::<4>::SUB_STEPS, Perturbed::NOT);
        /// its composition of order 6, uniform steps
        Composed6, "composed-6", order(6), |run| uniform(run, Composed::<6>::SUB_STEPS, Perturbed::NOT);
        /// its composition of order 8, uniform steps
        Composed8, "composed-8", order(8), |run| uniform(run, Composed::<8>::SUB_STEPS, Perturbed::NOT);
        /// order 2, steps by a tolerance
        SymmetricAdaptive, "symmetric", TOLERANCE, |run| adaptive(run, Symmetric);
        /// composition of order 8, steps by a tolerance
        Composed8Adaptive, "composed-8", TOLERANCE, |run| adaptive(run, Composed::<8>::SUB_STEPS);
        /// Taylor's method of high order, steps by a tolerance
        Taylor, "taylor", TOLERANCE, |run| Taylor::tolerance(run.tolerance).level_correction(run.level_correction);
        /// the exact flow where the field is affine, elsewhere Taylor's method
        Best, "best", TOLERANCE, |run| Best::tolerance(run.tolerance).level_correction(run.level_correction);
    }
    runge_kutta {
        /// Euler's method
        Euler, "euler", order(1), RungeKutta::explicit::<1>();
        /// the explicit midpoint rule
        ExplicitMidpoint, "explicit-midpoint", order(2), RungeKutta::explicit::<2>();
        /// Heun's method of order 3
        Heun3, "heun-3", order(3), RungeKutta::explicit::<3>();
        /// the classical Runge–Kutta method of order 4
        Classical4, "classical-4", order(4), RungeKutta::explicit::<4>();
        /// the method of order 5 of Dormand and Prince
        DormandPrince5, "dormand-prince-5", order(5), RungeKutta::dormand_prince();
        /// Gauss–Legendre of one stage, order 2
        GaussLegendre1, "gauss-legendre-1", order(2), RungeKutta::gauss_legendre::<1>();
        /// Gauss–Legendre of two stages, order 4
        GaussLegendre2, "gauss-legendre-2", order(4), RungeKutta::gauss_legendre::<2>();
        /// Gauss–Legendre of three stages, order 6
        GaussLegendre3, "gauss-legendre-3", order(6), RungeKutta::gauss_legendre::<3>();
        /// Gauss–Legendre of four stages, order 8
        GaussLegendre4, "gauss-legendre-4", order(8), RungeKutta::gauss_legendre::<4>();
        /// Radau IIA of one stage, order 1
        RadauIia1, "radau-iia-1", order(1), RungeKutta::radau_iia::<1>();
        /// Radau IIA of two stages, order 3
        RadauIia2, "radau-iia-2", order(3), RungeKutta::radau_iia::<2>();
        /// Radau IIA of three stages, order 5
        RadauIia3, "radau-iia-3", order(5), RungeKutta::radau_iia::<3>();
        /// Radau IIA of four stages, order 7
        RadauIia4, "radau-iia-4", order(7), RungeKutta::radau_iia::<4>();
        /// Radau IIA of five stages, order 9
        RadauIia5, "radau-iia-5", order(9), RungeKutta::radau_iia::<5>();
        /// Lobatto IIIC of two stages, order 2
        LobattoIiic2, "lobatto-iiic-2", order(2), RungeKutta::lobatto_iiic::<2>();
        /// Lobatto IIIC of three stages, order 4
        LobattoIiic3, "lobatto-iiic-3", order(4), RungeKutta::lobatto_iiic::<3>();
        /// Lobatto IIIC of four stages, order 6
        LobattoIiic4, "lobatto-iiic-4", order(6), RungeKutta::lobatto_iiic::<4>();
    }
    embedded {
        /// the pair of orders 5 and 4 of Dormand and Prince, steps by a tolerance
        DormandPrince5Adaptive, "dormand-prince-5", EmbeddedRungeKutta::dormand_prince();
        /// Radau IIA of three stages, steps by a tolerance
        RadauIia3Adaptive, "radau-iia-3", EmbeddedRungeKutta::radau_iia::<3>();
        /// Radau IIA of five stages, steps by a tolerance
        RadauIia5Adaptive, "radau-iia-5", EmbeddedRungeKutta::radau_iia::<5>();
    }
}

/// Helps the compiler to see what a closure takes.
fn apply<Sch>(run: &Run, scheme: impl Fn(&Run) -> Sch) -> Sch {
    scheme(run)
}

/// Uniform steps of a run by a one-step map: one type for all of them, compiled once.
fn uniform(run: &Run, map: impl Into<AnyMap>, locator: Perturbed) -> Uniform<AnyMap, Perturbed> {
    Uniform::new(map.into(), run.step_size)
        .level_correction(run.level_correction)
        .locator(locator)
}

/// The steps of [`Symmetric`] of a run that is not observed: of generated code by the type of the map.
#[cfg(feature = "compiled")]
fn unobserved(run: &Run) -> Uniform<Symmetric> {
    Symmetric::step_size(run.step_size).level_correction(run.level_correction)
}

#[cfg(not(feature = "compiled"))]
fn unobserved(run: &Run) -> Uniform<AnyMap, Perturbed> {
    uniform(run, Symmetric, Perturbed::NOT)
}

/// Steps of a run by its tolerance, as well.
fn adaptive(run: &Run, map: impl Into<AnyMap>) -> Adaptive<AnyMap> {
    Adaptive::new(map.into(), run.tolerance).level_correction(run.level_correction)
}

/// A Runge–Kutta method with an error estimate: one type for all of them, compiled once.
fn embedded(
    run: &Run,
    method: EmbeddedRungeKutta,
) -> Adaptive<EmbeddedRungeKutta, NewtonLocator, ErrorEstimate> {
    (method.tolerance(run.tolerance)).level_correction(run.level_correction)
}

impl MethodName {
    /// Every scheme that has a name on the command line.
    pub fn all() -> impl Iterator<Item = Self> {
        let families = [Self::CONSERVING, Self::RUNGE_KUTTA, Self::EMBEDDED];
        families.into_iter().flatten().copied()
    }

    /// The schemes that ensembles are integrated by.
    pub const OF_ENSEMBLES: &'static [Self] = &[Self::Symmetric, Self::Taylor, Self::Best];

    /// The scheme of that name, by a tolerance if there is such a form and it is `adaptive`.
    pub fn find(name: &str, adaptive: bool) -> Option<Self> {
        let named = || Self::all().filter(|method| method.name() == name);
        let wanted = |method: &Self| (method.control() == Control::Tolerance) == adaptive;
        named().find(wanted).or_else(|| named().next())
    }
}
