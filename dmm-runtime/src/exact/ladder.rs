//! The ladder of step sizes of a region, h/16, h/8 … 2h, 4h …, with their propagators and bounds,
//! computed when they are first needed and kept for the run.
//!
//! A segment starts with h, about 3/|λ| of the largest eigenvalue: over h everything is smooth,
//! and g⁗ is bounded by |f| at the start of the step. After a step the fastest modes of a stiff
//! region have decayed, and the next one may be twice as long: on a rung above h the bound of g⁗
//! is a row times |f| *before the last step*, max |c A³ exp(sA)| over the times s that this step
//! is later than that. It is small where what is fast has decayed, or is not seen by g, and large
//! where something oscillates: then the step remains as short as that demands.

use std::any::Any;
use std::fmt;

use super::propagator::{Coefficients, Propagator, Rows, times};
use super::short::{Powers, Short, powers};
use super::switching::Switching;
use crate::linear::is_finite;
use crate::state::State;
use crate::system::{Boundary, Flow, Vector};

/// h times the spectral radius of A: from an interface to the next one, half a turn of an
/// oscillator, in one step.
const REACH: f64 = 3.25;
/// The rung of h.
pub(crate) const FIRST: usize = 4;
/// There are no rungs from here on.
const HIGHEST: usize = 64;
/// The lowest rung is so many times smaller.
pub(super) const PARTS: usize = 1 << FIRST;
/// Halvings of a first step whose series does not converge.
const MOST_HALVINGS: u32 = 64;

/// The ladder of a region.
#[derive(Clone, Debug)]
pub(crate) struct Ladder<const N: usize> {
    pub(super) coefficients: Coefficients<N>,
    /// h/16
    pub(super) lowest: f64,
    /// By rung.
    sizes: [f64; HIGHEST],
    /// 16/h
    per_part: f64,
    /// By rung.
    pub(super) flows: Vec<Propagator<N>>,
    /// Aᵏ⁻¹/k!
    pub(super) powers: Box<Powers<N>>,
    /// Over those sixteenths of h that are no rungs.
    sixteenths: [Option<Propagator<N>>; PARTS],
    pub(super) switching: Vec<Switching<N>>,
}

impl<const N: usize> Ladder<N> {
    /// The ladder of an affine flow for steps of at most `longest` > 0; nothing if a coefficient
    /// is not finite or so large that no step is.
    pub(crate) fn new<const M: usize, F: Flow<f64, N, M>>(flow: &F, longest: f64) -> Option<Self> {
        let coefficients = coefficients::<N, M, F>(flow)?;
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
        let mut flows = vec![first.filter(Propagator::is_finite)?];
        for rung in 0..FIRST {
            flows.push(flows[rung].after(&flows[rung]));
        }
        let mut ladder = Self {
            powers: Box::new(powers(&coefficients.matrix)),
            coefficients,
            lowest: step / PARTS as f64,
            sizes: std::array::from_fn(|rung| step / PARTS as f64 * (1u64 << rung) as f64),
            per_part: PARTS as f64 / step,
            flows,
            sixteenths: [const { None }; PARTS],
            switching: Vec::new(),
        };
        let sides = <F::Boundary as Boundary<f64, N>>::SIDES;
        let switching = sides.iter().map(|&(interface, _)| {
            let origin = Vector::zeros();
            let gradient = flow.boundary().switching_gradient(interface, 0.0, &origin);
            ladder.switching(gradient)
        });
        ladder.switching = switching.collect();
        Some(ladder)
    }

    /// The step on a rung.
    #[inline(always)]
    pub(crate) fn size(&self, rung: usize) -> f64 {
        self.sizes[rung]
    }

    /// The flow over a step.
    #[inline(always)]
    pub(crate) fn flow(&self, rung: usize) -> &Propagator<N> {
        &self.flows[rung]
    }

    /// Makes the rung, if there is none yet and its flow is finite.
    #[cold]
    pub(crate) fn climbs_to(&mut self, rung: usize) -> bool {
        if rung < self.flows.len() {
            return true;
        }
        let highest = &self.flows[self.flows.len() - 1];
        let flow = highest.after(highest);
        if rung >= HIGHEST || rung > self.flows.len() || !flow.is_finite() {
            return false;
        }
        self.flows.push(flow);
        self.settle(rung);
        true
    }

    /// The flow over the multiple of h/16 nearest to 0 ≤ τ ≤ h, and what is left of τ.
    pub(crate) fn node(&mut self, state: &State<N>, tau: f64) -> (State<N>, f64, f64) {
        let number = ((tau * self.per_part + 0.5) as usize).min(PARTS);
        let offset = number as f64 * self.lowest;
        let state = match number {
            0 => *state,
            _ if number.is_power_of_two() => self.flows[number.ilog2() as usize].apply(state),
            _ => {
                let flows = &self.flows;
                let flow = self.sixteenths[number].get_or_insert_with(|| composed(flows, number));
                flow.apply(state)
            }
        };
        (state, offset, tau - offset)
    }

    /// Whether a short time is so short that the node is the nearest one, or about that.
    #[inline(always)]
    pub(crate) fn is_next_to(&self, rest: f64) -> bool {
        rest.abs() <= 1.25 * self.lowest
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
        for rung in (FIRST..self.flows.len()).rev() {
            let size = self.size(rung);
            while rest >= size {
                state = self.flow(rung).apply(&state);
                rest -= size;
            }
        }
        let (node, _, rest) = self.node(&state, rest);
        self.short(node).after(rest)
    }
}

/// The flow over `number` times the lowest step, of those over its powers of two.
#[cold]
fn composed<const N: usize>(flows: &[Propagator<N>], number: usize) -> Propagator<N> {
    let mut bits = (0..flows.len()).filter(|bit| number >> bit & 1 == 1);
    let first = bits.next().unwrap_or_default();
    bits.fold(flows[first].clone(), |flow, bit| flows[bit].after(&flow))
}

/// A and b of an affine field: b = f(0), and column j of A is f far out on axis j, where b is
/// below the rounding errors.
fn coefficients<const N: usize, const M: usize, F: Flow<f64, N, M>>(
    flow: &F,
) -> Option<Coefficients<N>> {
    // 2⁵⁰⁰
    const FAR: f64 = f64::from_bits((1023 + 500) << 52);
    let origin = flow.vector_field(0.0, &Vector::zeros());
    let mut matrix = [[0.0; N]; N];
    let mut finite = is_finite(&origin);
    for j in 0..N {
        let mut x = Vector::zeros();
        x[j] = FAR;
        let column = (flow.vector_field(0.0, &x) - origin) / FAR;
        finite &= is_finite(&column);
        for (row, entry) in matrix.iter_mut().zip(&column) {
            row[j] = *entry;
        }
    }
    let offset = origin.into();
    finite.then_some(Coefficients { matrix, offset })
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

/// The ladders of a run, by region. A copy starts without them: they are made again when needed.
#[derive(Default)]
pub(crate) struct Ladders(Vec<Option<Box<dyn Any + Send + Sync>>>);

impl Ladders {
    /// That of a region, made if there is none; nothing if it cannot be.
    #[inline(always)]
    pub(crate) fn of<const N: usize>(
        &mut self,
        region: usize,
        make: impl FnOnce() -> Option<Ladder<N>>,
    ) -> Option<&mut Ladder<N>> {
        // of a run all have the same N
        let known = matches!(self.0.get(region), Some(Some(_)));
        if !known {
            self.keep(region, make()?);
        }
        self.0[region].as_mut()?.downcast_mut()
    }

    #[cold]
    fn keep<const N: usize>(&mut self, region: usize, ladder: Ladder<N>) {
        if self.0.len() <= region {
            self.0.resize_with(region + 1, || None);
        }
        self.0[region] = Some(Box::new(ladder));
    }
}

impl Clone for Ladders {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl fmt::Debug for Ladders {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let known = self.0.iter().flatten().count();
        f.debug_tuple("Ladders").field(&known).finish()
    }
}
