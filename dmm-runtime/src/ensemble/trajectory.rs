//! A trajectory of an ensemble, in a lane or by itself.

use std::ops::ControlFlow;

use super::Member;
use super::register::Register;
use crate::arithmetic::{State, Time};
use crate::contract::{System, Vector};
use crate::driver::{Accumulation, Run, enter};
use crate::error::Error;
use crate::method::taylor::{self, Taylor};
use crate::method::{Active, Cursor, Ended, Statistics};
use crate::output::{End, EndedBy, Halted, Point, TransitionKind};

/// A crossing that is still to be judged.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing<R> {
    /// The region that is left.
    pub(super) from: R,
    /// dg/dt there.
    pub(super) rate_from: f64,
}

/// A trajectory under way.
#[derive(Clone, Debug)]
pub(super) struct Trajectory<Sys: System<N>, const N: usize> {
    pub(super) system: Sys,
    pub(super) time: Time,
    pub(super) state: State<N>,
    pub(super) region: Sys::Region,
    /// The interfaces that it is on.
    pub(super) active: Active,
    /// How it came there, until the region entered has been found to take it.
    pub(super) crossing: Option<Crossing<Sys::Region>>,
    pub(super) memory: taylor::Memory<N>,
    pub(super) accumulation: Accumulation,
    pub(super) statistics: Statistics,
    /// The parts of the level in the region; see [`crate::level`].
    pub(super) level: [Vector<f64, N>; 3],
    /// Steps made since the scale of the level was taken.
    since: f64,
    /// So long after the start of its step g begins to fall.
    from: f64,
    /// About how long after the start of its step it meets an interface.
    pub(super) elapsed: f64,
    /// The size of that step.
    pub(super) tau: f64,
    /// dg/dt on the interface.
    rate: f64,
}

impl<Sys: System<N>, const N: usize> Trajectory<Sys, N> {
    /// The start of a member.
    pub(super) fn new(
        method: Taylor,
        member: Member<Sys, N>,
        t_end: f64,
    ) -> Result<Self, Halted<Sys::Region, N>> {
        let problem = member.problem(method);
        let (x0, start) = problem.start(t_end).map_err(Halted::at_start)?;
        Ok(Self {
            time: Time::new(member.t0),
            state: State::new(x0),
            region: start.region,
            active: start.on,
            crossing: None,
            memory: problem.memory(t_end),
            accumulation: Accumulation::new(Time::new(member.t0)),
            statistics: Statistics::default(),
            level: [Vector::zeros(); 3],
            since: 0.0,
            from: 0.0,
            elapsed: 0.0,
            tau: 0.0,
            rate: 0.0,
            system: member.system,
        })
    }

    /// Where it is.
    pub(super) fn end(&self, ended_by: EndedBy) -> End<Sys::Region, N> {
        End {
            point: Point {
                t: self.time.value,
                time: self.time,
                x: self.state.rounded(),
                region: self.region,
            },
            remainder: self.state.remainder,
            statistics: self.statistics,
            ended_by,
        }
    }

    /// Has come to an interface now, on the other side of which there is a region: its index.
    #[inline]
    pub(super) fn cross(
        &mut self,
        now: Time,
        interface: usize,
        other: Option<(usize, Sys::Region)>,
    ) -> Result<usize, Error> {
        let place = (interface, self.region);
        self.accumulation
            .count(&self.system, place, now, &self.state.x)?;
        self.active.clear();
        self.active.insert(interface);
        self.crossing = Some(Crossing {
            from: self.region,
            rate_from: self.rate,
        });
        match other {
            Some((index, region)) => {
                self.region = region;
                Ok(index)
            }
            // the other interfaces decide with it
            None => {
                self.judge()?;
                Ok(Sys::index(self.region))
            }
        }
    }

    /// The region entered has taken it.
    #[inline]
    pub(super) fn entered(&mut self) {
        if self.crossing.is_some() {
            TransitionKind::Crossed.count(&mut self.statistics);
        }
        self.crossing = None;
        self.active.clear();
    }

    /// Judges the crossing that brought it here, if that is still to be done.
    fn judge(&mut self) -> Result<(), Error> {
        if let (Some(crossing), Ok(Some(interface))) = (self.crossing, self.active.single()) {
            let left = (crossing.from, crossing.rate_from);
            self.region = crossing.from;
            let entered = enter(&self.system, left, interface, self.time, &self.state);
            let next = entered?;
            (self.region, self.active) = (next.mode, next.active);
            if let Some(kind) = next.kind {
                kind.count(&mut self.statistics);
            }
            self.crossing = None;
        }
        Ok(())
    }

    /// Integrates until `until` or the first transition by the scalar method.
    pub(super) fn go_on(&mut self, method: &Taylor, until: f64) -> Result<Ended, Error> {
        self.judge()?;
        let active = std::mem::take(&mut self.active);
        let cursor = Cursor::new(self.time, self.state, 0, active);
        let mut run = Run {
            statistics: self.statistics,
            accumulation: self.accumulation,
            ..Run::at(&self.system, cursor, self.region)
        };
        run.cursor.level = Some(self.kept_level());
        // as of a run that is not observed, whose code there is
        let moving = (method, &mut self.memory);
        let ended = run.segment(&self.system, moving, until, &mut ());
        let ended = ended.and_then(|ended| {
            if let Ended::AtGuard { guard, rate } = ended {
                let told = |_: &_| ControlFlow::Continue(());
                run.next_mode(&self.system, (guard, rate), told).map(drop)?;
                self.active = run.cursor.active.clone();
            }
            Ok(ended)
        });
        (self.time, self.state) = (run.cursor.time, run.cursor.state);
        self.region = run.region;
        (self.statistics, self.accumulation) = (run.statistics, run.accumulation);
        ended
    }

    /// The level that the lane had, for a segment that goes on.
    fn kept_level(&self) -> Vec<[f64; 2]> {
        let [reference, remainder, _] = &self.level;
        let pairs = reference.iter().zip(remainder);
        let count = self.system.of_region(self.region).conserved.len();
        pairs.take(count).map(|(&high, &low)| [high, low]).collect()
    }
}

impl<const N: usize> Register<N> {
    /// Puts a trajectory into a lane.
    #[inline]
    pub(super) fn load<Sys: System<N>>(&mut self, lane: usize, from: &Trajectory<Sys, N>) {
        for i in 0..N {
            self.state.x[i].0[lane] = from.state.x[i];
            self.state.remainder[i].0[lane] = from.state.remainder[i];
            for (wide, level) in self.level.iter_mut().zip(&from.level) {
                wide[i].0[lane] = level[i];
            }
        }
        self.time.value.0[lane] = from.time.value;
        self.time.remainder.0[lane] = from.time.remainder;
        self.before.0[lane] = from.memory.step;
        self.since.0[lane] = from.since;
        self.free.0[lane] = from.memory.free;
        self.from.0[lane] = from.from;
        self.elapsed.0[lane] = from.elapsed;
        self.tau.0[lane] = from.tau;
        self.steps.0[lane] = 0.0;
    }

    /// Tells a trajectory of the crossing in its lane, where it stays, and returns the time.
    #[inline]
    pub(super) fn pass_on<Sys: System<N>>(
        &mut self,
        lane: usize,
        to: &mut Trajectory<Sys, N>,
    ) -> Time {
        let time = Time {
            value: self.time.value.0[lane],
            remainder: self.time.remainder.0[lane],
        };
        to.time = time;
        to.tau = self.tau.0[lane];
        to.rate = self.rate.0[lane];
        to.statistics.steps += self.steps.0[lane] as u64;
        self.steps.0[lane] = 0.0;
        time
    }

    /// Takes a trajectory out of a lane, and tells whether it has moved.
    #[inline]
    pub(super) fn store<Sys: System<N>>(&self, lane: usize, to: &mut Trajectory<Sys, N>) -> bool {
        for i in 0..N {
            to.state.x[i] = self.state.x[i].0[lane];
            to.state.remainder[i] = self.state.remainder[i].0[lane];
            for (level, wide) in to.level.iter_mut().zip(&self.level) {
                level[i] = wide[i].0[lane];
            }
        }
        to.time.value = self.time.value.0[lane];
        to.time.remainder = self.time.remainder.0[lane];
        to.memory.step = self.before.0[lane];
        to.since = self.since.0[lane];
        to.memory.free = self.free.0[lane];
        to.from = self.from.0[lane];
        to.elapsed = self.elapsed.0[lane];
        to.tau = self.tau.0[lane];
        to.rate = self.rate.0[lane];
        let steps = self.steps.0[lane] as u64;
        to.statistics.steps += steps;
        steps > 0
    }
}
