//! The one-step maps as one type.

use crate::arithmetic::Scalar;
use crate::contract::{Dynamics, Vector};
use crate::method::one_step::{Correction, OneStep, RungeKutta, Step, SubSteps, Symmetric};
use crate::method::{Statistics, StepFailure, Variation};

/// A one-step map that is chosen at run time. It is one type for all of them, so that what steps are
/// made with (their level, crossings, outputs) is compiled once for a system, and not for each map;
/// that takes some instructions a step.
///
/// ```
/// use dmm_runtime::dynamic::AnyMap;
/// use dmm_runtime::{Composed, Integrator, RungeKutta, Symmetric, Uniform, pws};
///
/// pws! {
///     /// An oscillator.
///     pub system Oscillator {
///         state q, p;
///         der(q) = p;
///         der(p) = -q;
///         conserved energy = (q^2 + p^2) / 2;
///     }
/// }
///
/// let maps: [AnyMap; 3] = [
///     Symmetric.into(),
///     Composed::<8>::SUB_STEPS.into(),
///     RungeKutta::gauss_legendre::<4>().into(),
/// ];
/// for map in maps {
///     let solution = Integrator::new(&Oscillator {}, Uniform::new(map, 1e-3))
///         .initial(0.0, [1.0, 0.0])
///         .run_until(1.0)?;
///     assert!((solution.at(1.0)?[0] - 1.0f64.cos()).abs() < 1e-6);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum AnyMap {
    /// [`Symmetric`]
    Symmetric(Symmetric),
    /// [`Composed`](crate::Composed)
    Composed(SubSteps),
    /// [`RungeKutta`]
    RungeKutta(RungeKutta),
}

impl From<Symmetric> for AnyMap {
    fn from(map: Symmetric) -> Self {
        Self::Symmetric(map)
    }
}

impl From<SubSteps> for AnyMap {
    fn from(map: SubSteps) -> Self {
        Self::Composed(map)
    }
}

impl From<RungeKutta> for AnyMap {
    fn from(map: RungeKutta) -> Self {
        Self::RungeKutta(map)
    }
}

/// The map by its type.
macro_rules! each {
    ($any:expr, $map:ident => $value:expr) => {
        match $any {
            AnyMap::Symmetric($map) => $value,
            AnyMap::Composed($map) => $value,
            AnyMap::RungeKutta($map) => $value,
        }
    };
}

/// The map with its memory.
macro_rules! remembering {
    ($any:expr, $memory:expr, ($map:ident, $its:ident) => $value:expr, else $other:expr) => {
        match ($any, $memory) {
            (AnyMap::Symmetric($map), Memory::Symmetric($its)) => $value,
            (AnyMap::Composed($map), Memory::Composed($its)) => $value,
            (AnyMap::RungeKutta($map), Memory::RungeKutta($its)) => $value,
            _ => $other,
        }
    };
}

/// What [`AnyMap`] remembers within a segment: what its map does.
#[derive(Clone, Debug)]
pub enum Memory<const N: usize> {
    /// Of [`Symmetric`]
    Symmetric(<Symmetric as OneStep>::Memory<N>),
    /// Of [`SubSteps`]
    Composed(<SubSteps as OneStep>::Memory<N>),
    /// Of [`RungeKutta`]
    RungeKutta(<RungeKutta as OneStep>::Memory<N>),
}

impl OneStep for AnyMap {
    type Memory<const N: usize> = Memory<N>;

    fn conserves(&self) -> bool {
        each!(self, map => map.conserves())
    }

    fn has_exact_velocity(&self) -> bool {
        each!(self, map => map.has_exact_velocity())
    }

    fn order(&self) -> usize {
        each!(self, map => map.order())
    }

    fn begin<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        dynamics: &F,
        step_size: Option<f64>,
    ) -> Memory<N> {
        match self {
            Self::Symmetric(map) => Memory::Symmetric(map.begin(dynamics, step_size)),
            Self::Composed(map) => Memory::Composed(map.begin(dynamics, step_size)),
            Self::RungeKutta(map) => Memory::RungeKutta(map.begin(dynamics, step_size)),
        }
    }

    fn correction_interval<const N: usize>(memory: &Memory<N>) -> u64 {
        match memory {
            Memory::Symmetric(memory) => Symmetric::correction_interval(memory),
            Memory::Composed(memory) => SubSteps::correction_interval(memory),
            Memory::RungeKutta(memory) => RungeKutta::correction_interval(memory),
        }
    }

    fn full_step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        memory: &mut Memory<N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        remembering!(
            self, memory,
            (map, memory) => map.full_step(step, memory, statistics),
            else self.step(step, statistics)
        )
    }

    fn varied_step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        memory: &mut Memory<N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        remembering!(
            self, memory,
            (map, memory) => map.varied_step(step, memory, statistics),
            else self.step(step, statistics)
        )
    }

    fn step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        each!(self, map => map.step(step, statistics))
    }

    fn differentiate<D, S, const N: usize, const M: usize>(
        &self,
        step: &Variation<'_, D, S, N>,
    ) -> Option<Vector<S, N>>
    where
        D: Dynamics<S, N, M>,
        S: Scalar,
    {
        each!(self, map => map.differentiate::<D, S, N, M>(step))
    }

    fn correction<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        increment: &Vector<f64, N>,
    ) -> Option<Correction<N>> {
        each!(self, map => map.correction(step, increment))
    }
}
