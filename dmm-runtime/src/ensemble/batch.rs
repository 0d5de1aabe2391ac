//! A batch of trajectories in lanes.
//!
//! The lanes of a register are in the same region, so that they all have the same formulas. Each
//! trajectory waits in a queue: of those that start, of those under way in a region, of those
//! that cross an interface in their next step, of those that have just entered a region at an
//! interface. A lane that leaves goes to its next queue and another trajectory takes its place.
//! What is rare, a step that comes close to an interface without a clear crossing, is made by
//! the scalar method.

use super::kernel::{Job, Kernel, LONGEST, ORDER, Settings};
use super::register::{Leave, Reached, Register, WIDTH, Wide};
use super::trajectory::Trajectory;
use super::{Member, Outcome};
use crate::arithmetic::Scalar;
use crate::arithmetic::lanes::Vectorised;
use crate::contract::System;
use crate::error::Error;
use crate::events::ends::Decay;
use crate::method::taylor::Taylor;
use crate::method::{Ended, Several};
use crate::output::{EndedBy, Halted};

/// What a queue waits for.
#[derive(Clone, Copy, Debug)]
struct Purpose {
    /// Of the region.
    region: usize,
    job: Job,
}

/// Where the trajectories of a batch wait.
#[derive(Debug)]
struct Queues {
    interfaces: usize,
    waiting: Vec<(Purpose, Vec<usize>)>,
}

impl Queues {
    fn new(regions: usize, interfaces: usize) -> Self {
        let jobs = |region| {
            let plain = [Job::Step, Job::Enter(None)].into_iter();
            let enter = (0..interfaces).map(|interface| Job::Enter(Some(interface)));
            let cross = (0..interfaces).map(Job::Cross);
            let jobs = plain.chain(enter).chain(cross);
            jobs.map(move |job| (Purpose { region, job }, Vec::new()))
        };
        Self {
            interfaces,
            waiting: (0..regions).flat_map(jobs).collect(),
        }
    }

    fn of(&mut self, region: usize, job: Job) -> &mut Vec<usize> {
        let place = match job {
            Job::Step => 0,
            Job::Enter(None) => 1,
            Job::Enter(Some(interface)) => 2 + interface,
            Job::Cross(interface) => 2 + self.interfaces + interface,
        };
        &mut self.waiting[region * (2 + 2 * self.interfaces) + place].1
    }

    fn is_longer_than(&self, length: usize) -> bool {
        self.waiting.iter().any(|(_, queue)| queue.len() > length)
    }

    /// The longest, if any trajectory waits.
    fn longest(&self) -> Option<Purpose> {
        let longest = self.waiting.iter().max_by_key(|(_, queue)| queue.len())?;
        (!longest.1.is_empty()).then_some(longest.0)
    }
}

/// The kernel in a region.
struct Work<'a, Sys: System<N>, const N: usize> {
    system: &'a Sys,
    region: Sys::Region,
    parameters: &'a [Wide],
    kernel: Kernel<'a, N>,
}

impl<Sys: System<N>, const N: usize> pulp::NullaryFnOnce for Work<'_, Sys, N> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let parameters = self.parameters;
        (self.system).visit_with(self.region, |index| parameters[index], self.kernel);
    }
}

/// A batch under way.
pub(super) struct Batch<'a, Sys: System<N>, const N: usize> {
    method: &'a Taylor,
    /// Of which the members differ in parameters.
    system: &'a Sys,
    settings: Settings,
    trajectories: Vec<Trajectory<Sys, N>>,
    /// The parameters of each trajectory.
    parameters: Vec<f64>,
    /// The members that the trajectories are of.
    members: Vec<usize>,
    outcomes: Vec<Option<Outcome<Sys::Region, N>>>,
    queues: Queues,
    /// By region and interface, the region on the other side, where no other interface decides on
    /// it.
    neighbours: Vec<Option<(usize, Sys::Region)>>,
    register: Register<N>,
    /// The parameters in the lanes.
    lanes: Vec<Wide>,
}

/// Integrates members until `t_end`.
pub(super) fn run<Sys: System<N>, const N: usize>(
    vectorised: Vectorised,
    method: &Taylor,
    members: Vec<Member<Sys, N>>,
    t_end: f64,
) -> Vec<Outcome<Sys::Region, N>> {
    let Some(first) = members.first() else {
        return Vec::new();
    };
    let system = first.system.clone();
    let mut batch = Batch::new(vectorised, method, &system, members, t_end);
    while let Some(purpose) = batch.queues.longest() {
        batch.serve(purpose);
    }
    batch.outcomes.into_iter().flatten().collect()
}

/// By region and interface, the region on the other side, where no other interface decides on it.
fn neighbours<Sys: System<N>, const N: usize>(system: &Sys) -> Vec<Option<(usize, Sys::Region)>> {
    let interfaces = system.metadata().interfaces.len();
    let of = |region| {
        (0..interfaces).map(move |interface| {
            let other = system
                .neighbour(region, interface)
                .filter(|_| interfaces == 1)?;
            Some((Sys::index(other), other))
        })
    };
    system.regions().flat_map(of).collect()
}

impl<'a, Sys: System<N>, const N: usize> Batch<'a, Sys, N> {
    fn new(
        vectorised: Vectorised,
        method: &'a Taylor,
        system: &'a Sys,
        members: Vec<Member<Sys, N>>,
        t_end: f64,
    ) -> Self {
        let count = members.len();
        let fraction = method.fraction_at(ORDER).min(LONGEST);
        let metadata = system.metadata();
        let (interfaces, parameters) = (metadata.interfaces.len(), metadata.parameters.len());
        let mut batch = Self {
            method,
            system,
            settings: Settings {
                vectorised,
                end: t_end,
                fraction,
                decay: Decay::new(fraction),
                corrects: method.corrects_level(),
                near: method.near(),
            },
            trajectories: Vec::with_capacity(count),
            parameters: Vec::with_capacity(count * parameters),
            members: Vec::with_capacity(count),
            outcomes: (0..count).map(|_| None).collect(),
            queues: Queues::new(metadata.regions.len(), interfaces),
            neighbours: neighbours(system),
            register: Register::new(),
            lanes: vec![Wide::from_f64(0.0); parameters],
        };
        for (index, member) in members.into_iter().enumerate() {
            match Trajectory::new(*method, member, t_end) {
                Err(halted) => batch.outcomes[index] = Some(Err(halted)),
                Ok(trajectory) => {
                    let number = batch.trajectories.len();
                    batch.parameters.extend(trajectory.system.parameters());
                    batch.trajectories.push(trajectory);
                    batch.members.push(index);
                    batch.place(number);
                }
            }
        }
        batch
    }

    /// Works on a queue, until lanes are free for a longer one.
    fn serve(
        &mut self,
        Purpose {
            mut region,
            mut job,
        }: Purpose,
    ) {
        for lane in 0..WIDTH {
            let next = self.queues.of(region, job).pop();
            self.load(lane, next);
        }
        loop {
            let Some(of_lanes) = self.system.region(region) else {
                return;
            };
            self.settings.vectorised.run(Work {
                system: self.system,
                region: of_lanes,
                parameters: &self.lanes,
                kernel: Kernel {
                    register: &mut self.register,
                    settings: &self.settings,
                    job,
                },
            });
            let reached = self.register.reached();
            if let Some(Reached { interface, by_all }) = reached
                && by_all
                && let Some(next) = self.enter(region, interface)
            {
                (region, job) = (next, Job::Enter(Some(interface)));
                continue;
            }
            let refills = reached.is_none() && !matches!(job, Job::Cross(_));
            let mut used = 0;
            for lane in 0..WIDTH {
                if self.register.is_idle(lane) {
                    continue;
                }
                let leave = self.register.leave(lane);
                if leave != Leave::Not {
                    self.release(lane, region, leave);
                    let next = if refills {
                        self.queues.of(region, Job::Step).pop()
                    } else {
                        None
                    };
                    self.load(lane, next);
                }
                used += usize::from(!self.register.is_idle(lane));
            }
            if used < WIDTH && self.queues.is_longer_than(used) || used == 0 {
                return self.put_back(region);
            }
            job = Job::Step;
        }
    }

    /// Puts a trajectory into a lane, or nothing.
    fn load(&mut self, lane: usize, number: Option<usize>) {
        self.register.set_idle(lane, number.is_none());
        let Some(number) = number else { return };
        let count = self.lanes.len();
        let parameters = &self.parameters[number * count..];
        for (wide, &parameter) in self.lanes.iter_mut().zip(parameters) {
            wide.0[lane] = parameter;
        }
        self.register.slots[lane] = number;
        self.register.load(lane, &self.trajectories[number]);
    }

    /// Takes the lanes out of the register, to go on later.
    fn put_back(&mut self, region: usize) {
        for lane in 0..WIDTH {
            if !self.register.is_idle(lane) {
                self.release(lane, region, Leave::Not);
                self.register.set_idle(lane, true);
            }
        }
    }

    /// Sends the trajectory in a lane to where it goes next.
    fn release(&mut self, lane: usize, region: usize, leave: Leave) {
        let number = self.register.slots[lane];
        let trajectory = &mut self.trajectories[number];
        let started = self.register.store(lane, trajectory);
        if started || leave != Leave::Hard {
            trajectory.entered();
        }
        match leave {
            Leave::Not => self.queues.of(region, Job::Step).push(number),
            Leave::Finished => self.finish(number, Ok(())),
            Leave::Crosses(interface) => {
                self.queues.of(region, Job::Cross(interface)).push(number);
            }
            Leave::Crossed(interface) => self.cross(number, region, interface),
            Leave::Hard => self.step_alone(number),
        }
    }

    /// All lanes have come to the interface and stay together: the region that they enter.
    fn enter(&mut self, region: usize, interface: usize) -> Option<usize> {
        let other = self.neighbours[region * self.queues.interfaces + interface];
        let index = other?.0;
        let mut stay = false;
        for lane in 0..WIDTH {
            if self.register.is_idle(lane) {
                continue;
            }
            let number = self.register.slots[lane];
            let trajectory = &mut self.trajectories[number];
            let now = self.register.pass_on(lane, trajectory);
            trajectory.entered();
            if let Err(error) = trajectory.cross(now, interface, other) {
                self.register.store(lane, trajectory);
                self.register.set_idle(lane, true);
                self.finish(number, Err(error));
            } else {
                stay = true;
            }
        }
        stay.then_some(index)
    }

    /// A trajectory has come to an interface.
    fn cross(&mut self, number: usize, region: usize, interface: usize) {
        let trajectory = &mut self.trajectories[number];
        let other = self.neighbours[region * self.queues.interfaces + interface];
        match trajectory.cross(trajectory.time, interface, other) {
            Ok(_) => self.place(number),
            Err(error) => self.finish(number, Err(error)),
        }
    }

    /// Puts a trajectory where a region is entered into its queue.
    fn place(&mut self, number: usize) {
        let trajectory = &self.trajectories[number];
        match trajectory.active.single() {
            Ok(active) => {
                let region = Sys::index(trajectory.region);
                self.queues.of(region, Job::Enter(active)).push(number);
            }
            Err(Several) => self.step_alone(number),
        }
    }

    /// Goes on by the scalar method, to the next transition or the end.
    fn step_alone(&mut self, number: usize) {
        loop {
            let trajectory = &mut self.trajectories[number];
            match trajectory.go_on(self.method, self.settings.end) {
                Ok(Ended::AtGuard { .. }) if trajectory.active.single().is_err() => {}
                Ok(Ended::AtGuard { .. }) => return self.place(number),
                Ok(Ended::Finished | Ended::Stopped) => return self.finish(number, Ok(())),
                Err(error) => return self.finish(number, Err(error)),
            }
        }
    }

    fn finish(&mut self, number: usize, result: Result<(), Error>) {
        let trajectory = &self.trajectories[number];
        self.outcomes[self.members[number]] = Some(match result {
            Ok(()) => Ok(trajectory.end(EndedBy::EndTime)),
            Err(error) => Err(Halted::new(error, trajectory.end(EndedBy::Error))),
        });
    }
}
