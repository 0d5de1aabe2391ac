//! What a run keeps: points and transitions, up to a limit of memory.

use std::mem::size_of;
use std::ops::ControlFlow;

use super::{Observer, Point, Transition};
use crate::contract::System;
use crate::error::{Error, ErrorKind};

/// Keeps points and transitions, of at most so many bytes.
#[derive(Clone, Debug)]
pub(crate) struct Recorder<R, const N: usize> {
    start: Option<Point<R, N>>,
    last: Option<Point<R, N>>,
    points: Vec<Point<R, N>>,
    transitions: Vec<Transition<R, N>>,
    every: u64,
    /// Points since the last one that was kept.
    skipped: u64,
    output_times: Option<Vec<f64>>,
    /// How many of them are served.
    served: usize,
    /// Bytes that points and transitions may take.
    memory_limit: usize,
    /// Whether there was no room for one of them.
    is_full: bool,
}

impl<R: Copy, const N: usize> Recorder<R, N> {
    pub(crate) fn new(every: u64, output_times: Option<Vec<f64>>, memory_limit: usize) -> Self {
        Self {
            start: None,
            last: None,
            points: Vec::new(),
            transitions: Vec::new(),
            every,
            skipped: 0,
            output_times,
            served: 0,
            memory_limit,
            is_full: false,
        }
    }

    pub(crate) fn start(&self) -> Option<&Point<R, N>> {
        self.start.as_ref()
    }

    pub(crate) fn last(&self) -> Option<&Point<R, N>> {
        self.last.as_ref()
    }

    pub(crate) fn points(&self) -> &[Point<R, N>] {
        &self.points
    }

    pub(crate) fn transitions(&self) -> &[Transition<R, N>] {
        &self.transitions
    }

    /// The error of a run for which there was no room, if there was none.
    pub(crate) fn out_of_memory<Sys: System<N, Region = R>>(&self, system: &Sys) -> Option<Error> {
        let last = self.last.as_ref().filter(|_| self.is_full)?;
        let kind = ErrorKind::MemoryLimit {
            bytes: self.memory_limit,
            points: self.points.len(),
            transitions: self.transitions.len(),
        };
        Some(kind.at(
            last.t,
            last.x.as_slice(),
            system.of_region(last.region).name,
        ))
    }

    /// Keeps a point.
    #[inline]
    fn keep(&mut self, point: Point<R, N>) {
        let room = self.has_room::<Point<R, N>>();
        if room && self.points.try_reserve(1).is_ok() {
            self.points.push(point);
        } else {
            self.is_full = true;
        }
    }

    /// Whether one more value is within the limit.
    #[inline]
    fn has_room<T>(&self) -> bool {
        let points = self.points.len() * size_of::<Point<R, N>>();
        let transitions = self.transitions.len() * size_of::<Transition<R, N>>();
        points + transitions + size_of::<T>() <= self.memory_limit
    }

    /// `Break` once there is no more room.
    fn while_room(&self) -> ControlFlow<()> {
        if self.is_full {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    /// Closes the record: the last point is kept even where every `every`-th is.
    pub(crate) fn finish(&mut self)
    where
        R: PartialEq,
    {
        if self.output_times.is_none()
            && let Some(last) = self.last
            && self.points.last() != Some(&last)
            && self.points.try_reserve(1).is_ok()
        {
            self.points.push(last);
        }
    }

    /// The latest known point at or before `t`: a point or the far side of a transition.
    pub(crate) fn anchor(&self, t: f64, start: Point<R, N>) -> Point<R, N> {
        let mut anchor = start;
        let points = self.points.partition_point(|point| point.t <= t);
        if let Some(point) = self.points[..points].last() {
            anchor = *point;
        }
        let transitions = self
            .transitions
            .partition_point(|transition| transition.t <= t);
        if let Some(transition) = self.transitions[..transitions].last()
            && transition.t >= anchor.t
        {
            anchor = Point {
                t: transition.t,
                time: transition.time,
                x: transition.after,
                region: transition.to,
            };
        }
        anchor
    }
}

impl<R: Copy, const N: usize> Observer<R, N> for Recorder<R, N> {
    #[inline]
    fn point(&mut self, point: &Point<R, N>) -> ControlFlow<()> {
        self.last = Some(*point);
        if self.start.is_none() {
            self.start = Some(*point);
            self.skipped = self.every;
        } else {
            self.skipped += 1;
        }
        if self.skipped >= self.every && self.output_times.is_none() {
            self.skipped = 0;
            self.keep(*point);
        }
        self.while_room()
    }

    fn transition(&mut self, transition: &Transition<R, N>) -> ControlFlow<()> {
        let room = self.has_room::<Transition<R, N>>();
        if room && self.transitions.try_reserve(1).is_ok() {
            self.transitions.push(*transition);
        } else {
            self.is_full = true;
        }
        if self.output_times.is_none() {
            // the near side, if it was skipped; the far side is the next point
            if self.skipped > 0
                && let Some(last) = self.last
            {
                self.keep(last);
            }
            self.skipped = self.every - 1;
        }
        self.while_room()
    }

    #[inline]
    fn next_output(&self) -> Option<f64> {
        if self.is_full {
            return None;
        }
        self.output_times.as_ref()?.get(self.served).copied()
    }

    fn output(&mut self, point: &Point<R, N>) {
        self.served += 1;
        self.keep(*point);
    }
}
