//! A segment: steps in one region until its boundary or the end time is reached.

use crate::error::{Error, StepFailure};
use crate::events::Path;
use crate::events::ends::Decay;
use crate::level::{Level, Weights};
use crate::linear::is_finite;
use crate::observer::{Observer, Point};
use crate::scheme::{Maps, OneStep, Step};
use crate::state::State;
use crate::statistics::Statistics;
use crate::system::{Boundary, Flow, System, Vector};
use crate::time::{Grid, Time};
use crate::transition::Locator;
use crate::transition::watch::{RESOLVED, UNRESOLVED, Watch};
use crate::walk::interfaces::{Dense, Watches, advance, is_near, readings, through_ends, watches};
use crate::walk::{SegmentEnd, Walk};

/// Steps between adaptions of the level's correction to the size of the state.
const RESCALING: u64 = 256;
/// Steps between looks at whether they resolve the solution.
const LOOKS: u64 = 64;
/// The coefficients of g along the cubic through the ends of a step fall off like powers of this.
const CUBIC_DECAY: f64 = 0.5;

impl<Sys, Sch, Loc, Obs, const N: usize> Walk<'_, Sys, Sch, Loc, Obs, N>
where
    Sys: System<N>,
    Sch: OneStep,
    Loc: Locator,
    Obs: Observer<Sys::Region, N>,
{
    /// Uniform steps, until the boundary of the region or the end time is reached.
    pub(crate) fn uniform_segment<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
    ) -> Result<SegmentEnd, Error> {
        let mut level = Level::enter(flow, self.time, &self.state);
        let mut watches = watches(flow, self.time.value, &self.state.x, self.fresh);
        loop {
            let end = match self.progress.at_node && self.progress.node < self.progress.grid.count {
                true => self.full_steps(flow, &mut level, &mut watches)?,
                false => self.partial_step(flow, &level, &mut watches)?,
            };
            if let Some(end) = end {
                return Ok(end);
            }
        }
    }

    /// Full steps, until the last node but one or whatever ends the segment.
    ///
    /// The state is a local variable, and the time is computed where it is used: the clock of
    /// an autonomous flow that nobody observes costs nothing.
    fn full_steps<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        level: &mut Level<N, M>,
        watches: &mut Watches<F, N, M>,
    ) -> Result<Option<SegmentEnd>, Error> {
        let grid = self.progress.grid;
        let corrects_level = self.scheme.corrects_level();
        let mut memory = self.scheme.begin(flow, self.time.value, &self.state.x);
        let mut counts = Statistics::default();
        let mut state = self.state;
        let mut node = self.progress.node;
        let mut watching = *watches;
        let mut resolution = Resolution::default();
        let mut reach = resolution.reach(flow, (self.time.value, &state.x), grid.step_size);
        // the last state known to be finite, where not every one is checked
        let mut finite = (state, node);
        let end = loop {
            if node >= grid.count {
                break Ok(None);
            }
            // up to the next correction; apart from what is seldom done, so that what steps work
            // with stays in registers
            let mask = Sch::correction_interval(&memory) - 1;
            let due = (node + mask) & !mask;
            let last = due.min(grid.count - 1);
            let stride = loop {
                let (t0, t1) = (grid.inner_value(node - 1), grid.inner_value(node));
                // telescoping sums need the very times that ψ(t, x) is evaluated at
                let tau = match F::AUTONOMOUS {
                    true => grid.step_size,
                    false => t1 - t0,
                };
                let step = Step {
                    flow,
                    t0,
                    x0: &state.x,
                    tau,
                };
                let increment = match self.scheme.full_step(&step, &mut memory, &mut counts) {
                    Ok(increment) => increment,
                    Err(failure) => break Err(failure),
                };
                let next = state.after(&increment);
                let values = readings::<N, M, F>(flow, t1, &next.x);
                let near = is_near(&watching, &values, reach);
                if near || Obs::LISTENS || node == last || self.has_output(t1) {
                    break Ok((tau, increment, next, values, near));
                }
                advance(&mut watching, &values, false);
                state = next;
                node += 1;
            };
            let (tau, increment, mut next, mut values, near) = match stride {
                Ok(stride) => stride,
                Err(failure) => break Err(failure),
            };
            let corrects = node == due;
            if (Obs::LISTENS || corrects) && !is_finite(&next.x) {
                (state, node) = if Obs::LISTENS { (state, node) } else { finite };
                break Err(StepFailure::NotFinite);
            }
            let t1 = grid.inner_value(node);
            if near || self.has_output(t1) {
                self.settle::<M, F>(state, node, &mut counts);
                *watches = watching;
                if near && let Some(end) = self.look_at(flow, level, watches, tau, &increment)? {
                    return Ok(Some(end));
                }
                self.outputs(flow, tau, self.node_time::<M, F>(node))?;
            }
            if corrects {
                next = match corrects_level {
                    true => on_level(flow, level, (state, increment), (grid, node)),
                    false => next.normalised(),
                };
                // ψ may leave the range of doubles where the state does not
                if !is_finite(&next.x) {
                    break Err(StepFailure::NotFinite);
                }
                finite = (next, node + 1);
                values = readings::<N, M, F>(flow, t1, &next.x);
                if node.is_multiple_of(LOOKS) {
                    reach = resolution.reach(flow, (t1, &next.x), grid.step_size);
                }
            }
            advance(&mut watching, &values, near);
            state = next;
            node += 1;
            let point = Point {
                t: t1,
                time: Time::new(t1),
                x: state.rounded(),
                region: self.region,
            };
            if self.observer.point(&point).is_break() {
                break Ok(Some(SegmentEnd::Stopped));
            }
        };
        self.settle::<M, F>(state, node, &mut counts);
        *watches = watching;
        end.map_err(|failure| self.failure(failure, grid.step_size))
    }

    /// A step that is not a full one, from a transition to the next node or to the end time.
    fn partial_step<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        level: &Level<N, M>,
        watches: &mut Watches<F, N, M>,
    ) -> Result<Option<SegmentEnd>, Error> {
        if self.progress.node > self.progress.grid.count {
            return Ok(Some(SegmentEnd::Finished));
        }
        let end = self.node_time::<M, F>(self.progress.node);
        let tau = end.since(self.time);
        // zero where a transition was at this node, negative where a locator moved it beyond
        if tau > 0.0 {
            let step = Step {
                flow,
                t0: self.time.value,
                x0: &self.state.x,
                tau,
            };
            let increment = self
                .scheme
                .step(&step, &mut self.statistics)
                .map_err(|failure| self.failure(failure, tau))?;
            if let Some(end) = self.look_at(flow, level, watches, tau, &increment)? {
                return Ok(Some(end));
            }
            self.outputs(flow, tau, end)?;
            self.accept(flow, level, &increment, tau, end)?;
            let values = readings::<N, M, F>(flow, end.value, &self.state.x);
            advance(watches, &values, true);
            watches.as_mut().iter_mut().for_each(Watch::restart);
            if self.tell_point().is_break() {
                return Ok(Some(SegmentEnd::Stopped));
            }
        }
        self.progress.node += 1;
        self.progress.at_node = tau >= 0.0;
        Ok(None)
    }

    /// Looks at the interfaces over a step along the cubic through its ends.
    #[cold]
    fn look_at<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        level: &Level<N, M>,
        watches: &mut Watches<F, N, M>,
        tau: f64,
        increment: &Vector<f64, N>,
    ) -> Result<Option<SegmentEnd>, Error> {
        if watches.as_ref().is_empty() {
            return Ok(None);
        }
        let (t0, x0) = (self.time.value, self.state.x);
        let step = Step {
            flow,
            t0,
            x0: &x0,
            tau,
        };
        let coefficients = through_ends(self.scheme, &step, increment);
        let dense = Dense {
            path: Path {
                t0,
                unit: 1.0,
                coefficients: std::array::from_fn(|i| &coefficients[i][..]),
            },
            tau,
            decay: Decay::new(CUBIC_DECAY),
        };
        self.look(flow, level, watches, &dense)
    }

    /// Whether the observer wants the solution at a time up to `end`.
    #[inline(always)]
    fn has_output(&self, end: f64) -> bool {
        self.observer.next_output().is_some_and(|t| t <= end)
    }

    /// Writes the local variables of [`Walk::full_steps`] back: the walk is at `state` at the
    /// node before `node`.
    #[cold]
    fn settle<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        state: State<N>,
        node: u64,
        counts: &mut Statistics,
    ) {
        self.state = state;
        self.statistics.steps += node - self.progress.node;
        self.progress.node = node;
        self.time = self.node_time::<M, F>(node - 1);
        self.statistics += std::mem::take(counts);
    }

    /// The time of a node: exact for an autonomous flow; for others the double that its
    /// formulas are evaluated at.
    fn node_time<const M: usize, F: Flow<f64, N, M>>(&self, node: u64) -> Time {
        if F::AUTONOMOUS {
            self.progress.grid.time(node)
        } else {
            Time::new(self.progress.grid.value(node))
        }
    }
}

impl<Sys, Sch, Loc, Obs, const N: usize> Walk<'_, Sys, Sch, Loc, Obs, N>
where
    Sys: System<N>,
    Sch: Maps,
    Loc: Locator,
    Obs: Observer<Sys::Region, N>,
{
    /// Moves over `increment` to `time`, corrected towards the level.
    pub(super) fn accept<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        level: &Level<N, M>,
        increment: &Vector<f64, N>,
        tau: f64,
        time: Time,
    ) -> Result<(), Error> {
        let mut state = self.state.after(increment);
        if self.scheme.map().corrects_level() {
            let weights = Weights::new(&state.x, increment);
            state.remainder += level.correction(flow, time, &state, &weights);
        }
        let state = state.normalised();
        // neither the step nor the correction has left the range of doubles
        if !is_finite(&state.x) {
            return Err(self.failure(StepFailure::NotFinite, tau));
        }
        self.state = state;
        self.time = time;
        self.statistics.steps += 1;
        Ok(())
    }

    /// Serves the output times up to `end`, the end of a step over `tau`.
    pub(super) fn outputs<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        tau: f64,
        end: Time,
    ) -> Result<(), Error> {
        while let Some(t) = self.observer.next_output()
            && t <= end.value
        {
            let elapsed = Time::new(t).since(self.time).max(0.0).min(tau);
            let step = Step {
                flow,
                t0: self.time.value,
                x0: &self.state.x,
                tau: elapsed,
            };
            let increment = match elapsed > 0.0 {
                true => self
                    .scheme
                    .map()
                    .step(&step, &mut Statistics::default())
                    .map_err(|failure| self.failure(failure, elapsed))?,
                false => Vector::zeros(),
            };
            let point = Point {
                t,
                time: Time::new(t),
                x: self.state.after(&increment).rounded(),
                region: self.region,
            };
            self.observer.output(&point);
        }
        Ok(())
    }
}

/// Whether steps resolve the solution.
struct Resolution<const N: usize> {
    /// The largest |f| of each component so far.
    sizes: Vector<f64, N>,
}

impl<const N: usize> Default for Resolution<N> {
    fn default() -> Self {
        Self {
            sizes: Vector::zeros(),
        }
    }
}

impl<const N: usize> Resolution<N> {
    /// The reach of the watches over steps τ from here: f changes by less than half of its size in
    /// one, twelve steps a turn. A parabola for g is exact enough if g is affine.
    #[inline(always)]
    fn reach<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        (t, x): (f64, &Vector<f64, N>),
        tau: f64,
    ) -> f64 {
        const HALF: f64 = 0.5;
        if const { <F::Boundary as Boundary<f64, N>>::AFFINE } {
            return RESOLVED;
        }
        if const { !<F::Boundary as Boundary<f64, N>>::FOLLOWS_STATE } {
            return UNRESOLVED;
        }
        let field = flow.vector_field(t, x);
        let later = flow.vector_field(t + tau, &(x + field * tau));
        self.sizes = self.sizes.sup(&field.abs());
        let mut resolved = true;
        for i in 0..N {
            resolved &= (later[i] - field[i]).abs() <= HALF * self.sizes[i];
        }
        if resolved { RESOLVED } else { UNRESOLVED }
    }
}

/// The state after an increment, put back on its level.
#[inline(never)]
fn on_level<const N: usize, const M: usize, F: Flow<f64, N, M>>(
    flow: &F,
    level: &mut Level<N, M>,
    (state, increment): (State<N>, Vector<f64, N>),
    (grid, node): (Grid, u64),
) -> State<N> {
    // here, as registers that hold the time in the loop over steps make that a tenth longer
    let t = grid.inner_value(node);
    let mut state = state.after(&increment).normalised();
    if node.is_multiple_of(RESCALING) {
        level.rescale(flow, t, &state);
    }
    // into x at once: left in the remainder, which the flow does not turn, it would later be
    // taken off along a Λ that has turned away
    let weights = Weights::new(&state.x, &increment);
    state.remainder += level.correction(flow, Time::new(t), &state, &weights);
    state.normalised()
}
