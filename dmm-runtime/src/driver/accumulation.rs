//! Transitions that accumulate (Zeno).

use crate::arithmetic::{Time, Vector};
use crate::contract::System;
use crate::error::{Error, ErrorKind};

/// Transitions that are seen together.
const TOGETHER: u64 = 1000;
/// So many of the last ones explain why the next one cannot be found.
const LAST: usize = 16;

/// Whether transitions accumulate: so many within so short a time that doubles do not tell it from
/// none, as a part of the time since the start of the run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Accumulation {
    start: Time,
    /// The time of the first of those that are seen together.
    first: Time,
    count: u64,
    /// The times of the last ones.
    last: [Time; LAST],
}

impl Accumulation {
    /// At the start of a run.
    pub(crate) fn new(start: Time) -> Self {
        Self {
            start,
            first: start,
            count: 0,
            last: [start; LAST],
        }
    }

    /// What a failure to find the next transition is instead, if the last ones accumulate: they
    /// followed one another faster than the time can tell.
    #[cold]
    pub(crate) fn explains(&self, time: Time, kind: &ErrorKind) -> Option<ErrorKind> {
        let (ErrorKind::LocationFailed { interface } | ErrorKind::Undecided { interface }) = *kind
        else {
            return None;
        };
        let oldest = self.last[self.count as usize % LAST];
        let within = time.since(oldest);
        let accumulate =
            self.count >= LAST as u64 && within <= f64::EPSILON * time.since(self.start);
        accumulate.then_some(ErrorKind::Zeno {
            interface,
            transitions: LAST as u64,
            within,
        })
    }

    /// Counts a transition.
    #[inline]
    pub(crate) fn count<Sys: System<N>, const N: usize>(
        &mut self,
        system: &Sys,
        place: (usize, Sys::Region),
        time: Time,
        x: &Vector<f64, N>,
    ) -> Result<(), Error> {
        self.last[self.count as usize % LAST] = time;
        self.count += 1;
        if self.count.is_multiple_of(TOGETHER) {
            self.check(system, place, time, x)
        } else {
            Ok(())
        }
    }

    /// Refuses transitions that accumulate.
    #[cold]
    fn check<Sys: System<N>, const N: usize>(
        &mut self,
        system: &Sys,
        (interface, region): (usize, Sys::Region),
        time: Time,
        x: &Vector<f64, N>,
    ) -> Result<(), Error> {
        let within = time.since(self.first);
        if within <= f64::EPSILON * time.since(self.start) {
            let kind = ErrorKind::Zeno {
                interface: system.metadata().guard_name(interface),
                transitions: TOGETHER,
                within,
            };
            return Err(kind.at(time.value, x.as_slice(), system.of_region(region).name));
        }
        self.first = time;
        Ok(())
    }
}
