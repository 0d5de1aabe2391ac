//! Ensembles: many initial states or parameter sets at once.
//!
//! On every core, and several trajectories at once in the lanes of its vector registers where
//! the scheme allows: see [`Ensemble`].

mod batch;
mod crossing;
mod kernel;
mod pool;
mod register;
mod trajectory;

use std::ops::ControlFlow;
use std::thread;

use crate::arithmetic::lanes::Vectorised;
use crate::contract::{Dynamics, DynamicsVisitor, Guards, InitialState, System, Vector};
use crate::driver::{InitialValueProblem, Integrator};
use crate::error::Error;
use crate::method::Method;
use crate::method::taylor::Taylor;
use crate::output::Observer;
use crate::output::{End, Halted};
use pool::Pool;
use register::WIDTH;

/// A member of an ensemble: an initial value problem with its parameters.
#[derive(Clone, Debug)]
pub struct Member<Sys: System<N>, const N: usize> {
    /// The system, with the parameters of this member.
    pub system: Sys,
    /// t₀
    pub t0: f64,
    /// x₀
    pub x0: Vector<f64, N>,
    /// The region to start in, if it has to be named.
    pub region: Option<Sys::Region>,
    /// Why x₀ was refused, if it was.
    refused: Option<Error>,
}

impl<Sys: System<N>, const N: usize> Member<Sys, N> {
    /// The initial value x(t₀) = x₀ of a system: an array, a vector or a slice, see
    /// [`InitialState`]. The outcome of a member with a slice of the wrong length is that error.
    pub fn new(system: Sys, t0: f64, x0: impl InitialState<Sys, N>) -> Self {
        let (x0, refused) = match x0.into_state(&system) {
            Ok(x0) => (x0, None),
            Err(error) => (Vector::from_element(f64::NAN), Some(error)),
        };
        Self {
            system,
            t0,
            x0,
            region: None,
            refused,
        }
    }

    fn problem<Met: Method>(&self, method: Met) -> InitialValueProblem<'_, Sys, Met, N> {
        let mut problem = Integrator::new(&self.system, method).initial(self.t0, self.x0);
        problem.region = self.region;
        if let Some(error) = &self.refused {
            problem.x0 = Err(error.clone());
        }
        problem
    }
}

/// What became of a member: where it ended, or what halted it.
pub type Outcome<R, const N: usize> = Result<End<R, N>, Halted<R, N>>;

/// Many initial value problems with one scheme.
///
/// The members come from an iterator and their results go to a sink, in the order of the input:
/// a batch for each core is in memory, never all. A member that fails does not disturb the
/// others; its result is the error, with the point that was reached.
///
/// [`Taylor`](crate::Taylor) integrates eight trajectories at once in the lanes of vector
/// registers, each with steps and transitions of its own, where the processor has what that takes
/// (x86-64 with AVX2 and FMA, aarch64; found out when the program runs). A build for the processor it runs on
/// (`-C target-cpu=native`) integrates 1.1 to 1.4 times as many in the same time with vectors of four doubles;
/// with vectors of eight (AVX-512) it steps sixteen at once, and integrates 1.5 to 2.7 times as many.
/// They are of order 18 at every tolerance, by the code of a single trajectory: where that order is [`Taylor`]'s too, from
/// 2·10⁻¹² up to 6·10⁻⁸, and the program is compiled for fused operations, results are those of an
/// [`Integrator`] to the last bit, but for rare steps next to an interface. Otherwise they are as
/// accurate. The other schemes, and systems with a [`Condition`](crate::Condition), are integrated
/// one trajectory at a time, on all cores.
///
/// ```
/// use dmm_runtime::{Ensemble, Member, Taylor, pws};
///
/// pws! {
///     /// A pendulum.
///     pub system Pendulum {
///         state q, p;
///         param k = 1.0;
///         der(q) = p;
///         der(p) = -k * sin(q);
///         conserved energy = p^2 / 2 - k * cos(q);
///     }
/// }
///
/// let lengths = [0.5, 1.0, 2.0, f64::NAN];
/// let members = lengths.map(|k| Member::new(Pendulum { k }, 0.0, [0.5, 1.0]));
/// let outcomes = Ensemble::new(Taylor::tolerance(1e-12)).collect_until(10.0, members);
/// for (k, outcome) in lengths.iter().zip(&outcomes).take(3) {
///     let end = outcome.as_ref().expect("a solution").point.x;
///     let energy = |x: &[f64]| x[1].powi(2) / 2.0 - k * x[0].cos();
///     assert!((energy(end.as_slice()) - energy(&[0.5, 1.0])).abs() < 1e-14);
/// }
/// assert!(outcomes[3].is_err());
/// ```
#[derive(Clone, Debug)]
pub struct Ensemble<Met> {
    method: Met,
    threads: Option<usize>,
    lanes: bool,
}

/// Whether the switching functions of every region follow the state, so that lanes tell as surely
/// as enclosures what they meet.
fn follow_state<Sys: System<N>, const N: usize>(system: &Sys) -> bool {
    let mut regions = system.regions();
    regions.all(|region| system.visit(region, FollowsState))
}

/// See [`Guards::follows_state`].
struct FollowsState;

impl<const N: usize> DynamicsVisitor<N> for FollowsState {
    type Output = bool;

    fn visit<const M: usize, F: Dynamics<f64, N, M>>(self, dynamics: &F) -> bool {
        dynamics.guards().follows_state()
    }
}

/// Of larger systems the coefficients of several trajectories do not fit the fastest memory.
const MOST_STATES: usize = 8;

impl<Met: Method> Ensemble<Met> {
    /// An ensemble that is integrated by `scheme`.
    pub fn new(method: Met) -> Self {
        Self {
            method,
            threads: None,
            lanes: true,
        }
    }

    /// The number of threads (default: one for each core that the process may use; always one in
    /// WebAssembly).
    #[must_use]
    pub fn threads(self, threads: usize) -> Self {
        Self {
            threads: Some(threads.max(1)),
            ..self
        }
    }

    /// Whether trajectories are integrated in lanes where that is possible (default: yes).
    #[must_use]
    pub fn lanes(self, lanes: bool) -> Self {
        Self { lanes, ..self }
    }

    /// Integrates every member until `t_end` and hands the results to `sink`, each with the
    /// number of its member, in order. The sink runs in the calling thread; its
    /// `ControlFlow::Break` ends the run. Returns how many results it was given.
    pub fn run_until<Sys: System<N>, const N: usize>(
        &self,
        t_end: f64,
        members: impl IntoIterator<Item = Member<Sys, N>>,
        sink: impl FnMut(usize, Outcome<Sys::Region, N>) -> ControlFlow<()>,
    ) -> usize {
        let mut members = members.into_iter().peekable();
        let in_lanes = members.peek().is_some_and(|first| {
            let system = &first.system;
            let metadata = system.metadata();
            let is_plain = metadata.conditions.is_empty() && !metadata.has_constants();
            let mut regions = metadata.regions.iter();
            let fits = regions.all(|region| region.conserved.len() <= N);
            let may = self.lanes && N <= MOST_STATES && is_plain;
            may && fits && follow_state(system)
        });
        let vectorised = match (in_lanes, self.method.in_lanes()) {
            (true, Some(settings)) => {
                let taylor = Taylor::tolerance(settings.tolerance);
                let taylor = taylor.level_correction(settings.level_correction);
                Vectorised::new().map(|how| (how, taylor))
            }
            _ => None,
        };
        let least = vectorised.map_or(1, |_| WIDTH);
        let pool = self.pool(members.size_hint(), least);
        match vectorised {
            Some((how, taylor)) if const { N <= MOST_STATES } => pool.run(
                members,
                |batch| batch::run(how, &taylor, batch, t_end),
                sink,
            ),
            _ => pool.run(members, |batch| self.one_by_one(batch, t_end), sink),
        }
    }

    /// Integrates every member until `t_end` and returns the results in order.
    pub fn collect_until<Sys: System<N>, const N: usize>(
        &self,
        t_end: f64,
        members: impl IntoIterator<Item = Member<Sys, N>>,
    ) -> Vec<Outcome<Sys::Region, N>> {
        let mut outcomes = Vec::new();
        self.run_until(t_end, members, |_, outcome| {
            outcomes.push(outcome);
            ControlFlow::Continue(())
        });
        outcomes
    }

    /// The same as [`Ensemble::run_until`] with an observer for each member, which the sink is
    /// given back. Observed trajectories are integrated one at a time, on all cores.
    pub fn observe_until<Sys: System<N>, Obs, const N: usize>(
        &self,
        t_end: f64,
        members: impl IntoIterator<Item = (Member<Sys, N>, Obs)>,
        mut sink: impl FnMut(usize, Obs, Outcome<Sys::Region, N>) -> ControlFlow<()>,
    ) -> usize
    where
        Obs: Observer<Sys::Region, N> + Send,
    {
        let members = members.into_iter();
        let observe = |(member, mut observer): (Member<Sys, N>, Obs)| {
            let problem = member.problem(self.method.clone());
            let outcome = problem.observe_until(t_end, &mut observer);
            (observer, outcome)
        };
        self.pool(members.size_hint(), 1).run(
            members,
            |batch| batch.into_iter().map(observe).collect(),
            |index, (observer, outcome)| sink(index, observer, outcome),
        )
    }

    fn one_by_one<Sys: System<N>, const N: usize>(
        &self,
        batch: Vec<Member<Sys, N>>,
        t_end: f64,
    ) -> Vec<Outcome<Sys::Region, N>> {
        let one = |member: Member<Sys, N>| {
            let problem = member.problem(self.method.clone());
            problem.observe_until(t_end, &mut ())
        };
        batch.into_iter().map(one).collect()
    }

    /// The threads, and batches of at least `smallest` that occupy all of them.
    fn pool(&self, (least, most): (usize, Option<usize>), smallest: usize) -> Pool {
        /// With so many the lanes are hardly ever empty.
        const LARGEST: usize = 256;
        let cores = || thread::available_parallelism().map_or(1, usize::from);
        let threads = self.threads.unwrap_or_else(cores);
        // a thread cannot be started there
        let threads = if cfg!(target_family = "wasm") {
            1
        } else {
            threads
        };
        let count = most.map_or(usize::MAX, |most| most.max(least));
        Pool {
            threads: threads.min(count.div_ceil(smallest)),
            batch: (count / (4 * threads)).clamp(smallest, LARGEST),
        }
    }
}
