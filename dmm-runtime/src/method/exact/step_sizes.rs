//! The step sizes of a mode, h/16, h/8 … 2h, 4h …, with their propagators and bounds,
//! computed when they are first needed and kept for the run.
//!
//! A segment starts with h, about 3/|λ| of the largest eigenvalue: over h everything is smooth,
//! and g⁗ is bounded by |f| at the start of the step. After a step the fastest modes of a stiff
//! region have decayed, and the next one may be twice as long: for a step longer than h the bound of g⁗
//! is a row times |f| *before the last step*, max |c A³ exp(sA)| over the times s that this step
//! is later than that. It is small where what is fast has decayed, or is not seen by g, and large
//! where something oscillates: then the step remains as short as that demands.

use super::propagator::{Coefficients, Propagator, Rows, times};
use super::short::{Powers, Short, powers};
use crate::arithmetic::State;
use crate::arithmetic::linear::is_finite;
use crate::contract::{Dynamics, Guards, Vector};

/// h times the spectral radius of A: from an interface to the next one, half a turn of an
/// oscillator, in one step that ends next to it.
const REACH: f64 = 3.2;
/// The exponent of h.
pub(crate) const FIRST: usize = 4;
/// There are no larger ones from here on.
const HIGHEST: usize = 64;
/// The smallest step is so many times smaller than h.
pub(super) const PARTS: usize = 1 << FIRST;
/// Halvings of a first step whose series does not converge.
const MOST_HALVINGS: u32 = 64;

/// Terms of the series of g next to a root.
pub(super) const TERMS: usize = 8;

/// A switching function g = c·x + γt + d.
#[derive(Clone, Debug)]
pub(super) struct Switching<const N: usize> {
    /// c
    pub(super) gradient: Vector<f64, N>,
    /// c Aᵏ⁻¹/k!, k from 1.
    pub(super) terms: [Vector<f64, N>; TERMS],
    /// max |c A³ exp(sA)| over h.
    pub(super) early: Vector<f64, N>,
    /// The same, s from half a step to two steps, on the sizes above h.
    pub(super) later: Vec<Vector<f64, N>>,
    /// Σ|cᵢ||Aᵢⱼ|, and |γ| + Σ|cᵢ bᵢ|: |dg/dt| is made of such terms.
    pub(super) rate: Vector<f64, N>,
    pub(super) offset: f64,
    /// How long after the start of its step the last crossing was.
    pub(super) expected: f64,
}

/// The step sizes of a mode.
#[derive(Clone, Debug)]
pub(crate) struct StepSizes<const N: usize> {
    pub(super) coefficients: Coefficients<N>,
    /// h/16
    pub(super) lowest: f64,
    /// 16/h
    per_part: f64,
    /// By exponent.
    pub(super) flows: Vec<Propagator<N>>,
    /// Aᵏ⁻¹/k!
    pub(super) powers: Box<Powers<N>>,
    /// Over those sixteenths of h that are no step sizes; empty until one is needed.
    sixteenths: Vec<Option<Propagator<N>>>,
    pub(super) switching: Vec<Switching<N>>,
}

impl<const N: usize> StepSizes<N> {
    /// The step sizes of an affine field for steps of at most `longest` > 0; nothing if a coefficient
    /// is not finite or so large that no step is.
    pub(crate) fn new<const M: usize, F: Dynamics<f64, N, M>>(
        dynamics: &F,
        longest: f64,
    ) -> Option<Self> {
        let coefficients = coefficients::<N, M, F>(dynamics)?;
        let rate = spectral_radius(&coefficients.matrix);
        let mut step = longest.min(REACH / rate);
        let mut first = None;
        for _ in 0..MOST_HALVINGS {
            step = short_mantissa(step);
            first = Propagator::series(&coefficients, step / PARTS as f64);
            if first.as_ref().is_some_and(Propagator::is_finite) {
                break;
            }
            step *= 0.5;
        }
        let mut flows = Vec::with_capacity(FIRST + 2);
        flows.push(first.filter(Propagator::is_finite)?);
        for exponent in 0..FIRST {
            flows.push(flows[exponent].after(&flows[exponent]));
        }
        let mut sizes = Self {
            powers: Box::new(powers(&coefficients.matrix)),
            coefficients,
            lowest: step / PARTS as f64,
            per_part: PARTS as f64 / step,
            flows,
            sixteenths: Vec::new(),
            switching: Vec::new(),
        };
        let sides = dynamics.sides();
        let switching = sides.iter().map(|&(interface, _)| {
            let origin = Vector::zeros();
            let gradient = dynamics
                .guards()
                .switching_gradient(interface, 0.0, &origin);
            sizes.switching(gradient)
        });
        sizes.switching = switching.collect();
        Some(sizes)
    }

    /// The step size of an exponent.
    #[inline(always)]
    pub(crate) fn size(&self, exponent: usize) -> f64 {
        self.lowest * (1u64 << exponent) as f64
    }

    /// The flow over a step.
    #[inline(always)]
    pub(crate) fn flow(&self, exponent: usize) -> &Propagator<N> {
        &self.flows[exponent]
    }

    /// Makes the exponent, if there is none yet and its flow is finite.
    #[cold]
    pub(crate) fn reaches(&mut self, exponent: usize) -> bool {
        if exponent < self.flows.len() {
            return true;
        }
        let highest = &self.flows[self.flows.len() - 1];
        let flow = highest.after(highest);
        if exponent >= HIGHEST || exponent > self.flows.len() || !flow.is_finite() {
            return false;
        }
        self.flows.push(flow);
        self.settle(exponent);
        true
    }

    /// The flow over the multiple of h/16 nearest to 0 ≤ τ ≤ h, and what is left of τ.
    pub(crate) fn node(&mut self, state: &State<N>, tau: f64) -> (State<N>, f64, f64) {
        let number = ((tau * self.per_part + 0.5) as usize).min(PARTS);
        let offset = number as f64 * self.lowest;
        let state = match number {
            0 => *state,
            _ if number.is_power_of_two() => self.flows[number.ilog2() as usize].apply(state),
            _ => match self.sixteenths.get(number) {
                Some(Some(flow)) => flow.apply(state),
                _ => self.compose(number).apply(state),
            },
        };
        (state, offset, tau - offset)
    }

    /// The flow over a multiple of h/16 that is no step size.
    #[cold]
    fn compose(&mut self, number: usize) -> &Propagator<N> {
        if self.sixteenths.is_empty() {
            self.sixteenths.resize_with(PARTS, || None);
        }
        let flows = &self.flows;
        self.sixteenths[number].get_or_insert_with(|| composed(flows, number))
    }

    /// Whether a short time is so short that the node is the nearest one, or about that.
    #[inline(always)]
    pub(crate) fn is_next_to(&self, rest: f64) -> bool {
        rest.abs() <= 1.25 * self.lowest
    }

    /// Whether a step is one over h, and its end the node nearest to τ.
    #[inline(always)]
    pub(crate) fn ends_next_to(&self, step: f64, tau: f64) -> bool {
        step == self.size(FIRST) && (tau - step).abs() <= 0.5 * self.lowest
    }

    /// The flow over short times.
    #[inline(always)]
    pub(crate) fn short(&self, at: State<N>) -> Short<N> {
        Short::new(&self.coefficients, &self.powers, at)
    }

    /// The state a time τ ≥ 0 later.
    pub(crate) fn reach(&mut self, state: &State<N>, tau: f64) -> State<N> {
        let mut state = *state;
        let mut rest = tau;
        for exponent in (FIRST..self.flows.len()).rev() {
            let size = self.size(exponent);
            while rest >= size {
                state = self.flow(exponent).apply(&state);
                rest -= size;
            }
        }
        let (node, _, rest) = self.node(&state, rest);
        self.short(node).after(rest)
    }
}

/// The flow over `number` times the lowest step, of those over its powers of two.
fn composed<const N: usize>(flows: &[Propagator<N>], number: usize) -> Propagator<N> {
    let mut bits = (0..flows.len()).filter(|bit| number >> bit & 1 == 1);
    let first = bits.next().unwrap_or_default();
    bits.fold(flows[first].clone(), |flow, bit| flows[bit].after(&flow))
}

/// A = ∂f/∂x and b = f(0) of an affine field; nothing if an entry is not finite.
fn coefficients<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
    dynamics: &F,
) -> Option<Coefficients<N>> {
    let origin = Vector::zeros();
    let jacobian = dynamics.jacobian(0.0, &origin);
    let offset = dynamics.vector_field(0.0, &origin);
    let finite = is_finite(&offset) && jacobian.iter().all(|entry| entry.is_finite());
    finite.then(|| Coefficients {
        matrix: std::array::from_fn(|i| std::array::from_fn(|j| jacobian[(i, j)])),
        offset: offset.into(),
    })
}

/// About the spectral radius of A, not below it: ‖A¹⁶‖^(1/16); zero of a nilpotent one.
fn spectral_radius<const N: usize>(a: &Rows<f64, N>) -> f64 {
    let mut power = *a;
    let mut logarithm = 0.0;
    for doubling in 0..=4 {
        if doubling > 0 {
            let factor = power;
            power = std::array::from_fn(|i| times(&factor, &factor[i]));
            logarithm *= 2.0;
        }
        let norms = power
            .iter()
            .map(|row| row.iter().map(|entry| entry.abs()).sum::<f64>());
        let norm = norms.fold(0.0, f64::max);
        if norm == 0.0 {
            return 0.0;
        }
        power = power.map(|row| row.map(|entry| entry / norm));
        logarithm += norm.ln();
    }
    (logarithm / 16.0).exp()
}

/// `step` with so few digits that its multiples are exact.
fn short_mantissa(step: f64) -> f64 {
    f64::from_bits(step.to_bits() & !((1 << 32) - 1))
}
