//! The point where all lanes of a register meet an interface, in their next step.

use super::kernel::{Run, is_finite};
use super::level::{Place, vector};
use super::register::Wide;
use crate::arithmetic::Scalar;
use crate::contract::{Dynamics, Guards, Vector};

/// Corrections of a crossing.
const MOST_CORRECTIONS: u32 = 12;
/// A correction of the time smaller than this part of the step is made along the field.
const SMALL: f64 = 1e-8;

/// g at a place, and how it changes there.
pub(super) struct Approach<const N: usize> {
    value: Wide,
    gradient: Vector<Wide, N>,
    field: Vector<Wide, N>,
    /// dg/dt
    pub(super) rate: Wide,
}

impl<F: Dynamics<Wide, N, M>, const N: usize, const M: usize> Run<'_, F, N, M> {
    /// Moves every lane to the interface: t̂* and x̂* such that g = 0 and ψ keeps its level.
    #[inline(always)]
    pub(super) fn cross(&mut self, interface: usize) {
        let n = Wide::from_f64;
        let used = self.register.used();
        let tau = self.register.tau;
        let mut elapsed = self.register.elapsed;
        let start = self.approach(interface, &self.register.place());
        let mut place = self.after(elapsed);
        let mut located = used.not();
        for _ in 0..MOST_CORRECTIONS {
            let Approach { value, rate, .. } = self.approach(interface, &place);
            let inverse = n(1.0) / elapsed;
            let chord = (start.value - value) * inverse;
            let bend = inverse * (n(6.0) * chord + n(2.0) * start.rate + n(4.0) * rate);
            let delta = -(value * rate) / (rate * rate - n(0.5) * value * bend);
            located = (n(SMALL) * tau).above(delta.abs()).or(used.not());
            if !located.not().any() {
                break;
            }
            elapsed = (elapsed + delta).max(n(0.0)).min(tau);
            place = self.after(elapsed);
        }
        let mut settled = used.not();
        for _ in 0..MOST_CORRECTIONS {
            let approach = self.approach(interface, &place);
            let off = match self.settings.corrects {
                true => self.register.correction(self.dynamics, &place),
                false => Vector::from_element(n(0.0)),
            };
            let value = (0..N).fold(approach.value, |sum, i| {
                approach.gradient[i].fused(off[i], sum)
            });
            let delta = -value / approach.rate;
            let displacement: Vector<Wide, N> = vector(|i| approach.field[i].fused(delta, off[i]));
            for i in 0..N {
                place.remainder[i] += displacement[i];
            }
            place.normalise();
            place.add_time(delta);
            self.register.rate = approach.rate;
            let coarse = self.register.coarse(&displacement, &place);
            settled = coarse.not().or(used.not());
            if !settled.not().any() {
                break;
            }
        }
        let crossed = located.and(settled).and(is_finite(&place));
        self.register.move_to(crossed, &place);
        self.register.before = crossed.select(tau, self.register.before);
        self.register.steps += crossed.select(n(1.0), n(0.0));
        self.register.note_crossed(crossed, interface);
    }

    /// g at a place, all of it.
    #[inline(always)]
    pub(super) fn approach(&self, interface: usize, place: &Place<N>) -> Approach<N> {
        let guards = self.dynamics.guards();
        let value = guards.switching_function(interface, place.t, &place.x);
        let (by_time, gradient) = guards.switching_gradient(interface, place.t, &place.x);
        let field = self.dynamics.vector_field(place.t, &place.x);
        let value = by_time.fused(place.t_remainder, value);
        Approach {
            value: (0..N).fold(value, |sum, i| gradient[i].fused(place.remainder[i], sum)),
            rate: (0..N).fold(by_time, |sum, i| gradient[i].fused(field[i], sum)),
            gradient,
            field,
        }
    }
}
