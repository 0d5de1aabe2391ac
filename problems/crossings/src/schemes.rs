//! The schemes that are tried, and runs by them.

use std::ops::ControlFlow;

use dmm_runtime::dynamic::AnyMap;
use dmm_runtime::{
    Adaptive, Best, Composed, Ensemble, Error, Integrator, Member, Method, Observer, Point,
    Symmetric, System, Taylor, Transition, Uniform, Vector,
};

use crate::families::Family;

/// A scheme.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Kind {
    Taylor,
    Best,
    Lanes,
    /// The conservative map of an order, in uniform steps.
    Uniform(usize),
    /// In steps by a tolerance.
    Adaptive(usize),
}

/// A scheme at a setting.
#[derive(Clone, Copy, Debug)]
pub(super) struct Setting {
    pub(super) name: &'static str,
    kind: Kind,
    /// The tolerance, or the step size in units of the time in which states change.
    value: f64,
    /// The error that may be expected of it where errors do not grow, relative to the size of
    /// states: what is less counts as that, what is more is wrong.
    pub(super) errors: [f64; 2],
}

const fn setting(name: &'static str, kind: Kind, value: f64, errors: [f64; 2]) -> Setting {
    Setting {
        name,
        kind,
        value,
        errors,
    }
}

/// All of them. A scheme of order p makes errors of the order of τᵖ times derivatives, of
/// fields that are stiffer than the unit by factors of 2 to 4; the steps by tolerance add up the
/// errors of some hundreds of them.
pub(super) const SETTINGS: [Setting; 13] = [
    setting("Taylor 1e-12", Kind::Taylor, 1e-12, [1e-12, 1e-9]),
    setting("Best 1e-12", Kind::Best, 1e-12, [1e-12, 1e-9]),
    setting("lanes 1e-12", Kind::Lanes, 1e-12, [1e-12, 1e-9]),
    setting("lanes 1e-6", Kind::Lanes, 1e-6, [1e-6, 1e-3]),
    setting("Taylor 1e-6", Kind::Taylor, 1e-6, [1e-6, 1e-3]),
    setting("Symmetric", Kind::Uniform(2), 0.01, [1e-5, 3e-2]),
    setting("Symmetric 1e-5", Kind::Adaptive(2), 1e-5, [1e-5, 3e-2]),
    setting("Composed<4>", Kind::Uniform(4), 0.02, [1e-8, 1e-3]),
    setting("Composed<4> 1e-7", Kind::Adaptive(4), 1e-7, [1e-7, 1e-3]),
    setting("Composed<6>", Kind::Uniform(6), 0.05, [1e-8, 1e-3]),
    setting("Composed<6> 1e-9", Kind::Adaptive(6), 1e-9, [1e-9, 1e-4]),
    setting("Composed<8>", Kind::Uniform(8), 0.1, [1e-8, 1e-3]),
    setting("Composed<8> 1e-10", Kind::Adaptive(8), 1e-10, [1e-10, 1e-5]),
];

/// Every system is run with the first of [`SETTINGS`]; then come those of the lanes; the others
/// take turns.
const ALWAYS: usize = 2;
const LANES: std::ops::Range<usize> = 2..4;
const TURNS: usize = 3;

/// The settings that the system `index` of a family is run with one by one.
pub(super) fn in_turn(index: usize) -> impl Iterator<Item = usize> {
    let others = LANES.end..SETTINGS.len();
    let first = index * TURNS % others.len();
    let turns = others.cycle().skip(first).take(TURNS);
    (0..ALWAYS).chain(turns)
}

/// The setting that the group `index` is run with in lanes.
pub(super) fn of_lanes(index: usize) -> usize {
    LANES.start + index % LANES.len()
}

/// A crossing that a run has told of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Told {
    pub(super) t: f64,
    pub(super) interface: usize,
    /// Whether g > 0 afterwards.
    pub(super) to_positive: bool,
}

/// What a run has told.
#[derive(Debug)]
pub(super) struct Run {
    pub(super) points: Vec<(f64, Vec<f64>)>,
    pub(super) crossings: Vec<Told>,
    /// Nothing if it came to its end.
    pub(super) error: Option<Error>,
}

/// Listens to a run.
struct Listener<'a, Sys: System<N>, const N: usize> {
    points: Vec<(f64, Vector<f64, N>)>,
    crossings: Vec<Told>,
    system: &'a Sys,
}

/// A run that would make more crossings is endless.
const MOST_CROSSINGS: usize = 5000;

impl<Sys: System<N>, const N: usize> Observer<Sys::Region, N> for Listener<'_, Sys, N> {
    fn point(&mut self, point: &Point<Sys::Region, N>) -> ControlFlow<()> {
        self.points.push((point.t, point.x));
        ControlFlow::Continue(())
    }

    fn transition(&mut self, transition: &Transition<Sys::Region, N>) -> ControlFlow<()> {
        let side = self.system.side(transition.to, transition.interface);
        let told = Told {
            t: transition.t,
            interface: transition.interface,
            to_positive: side.is_some_and(|side| side.sign() > 0.0),
        };
        self.crossings.push(told);
        if self.crossings.len() < MOST_CROSSINGS {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    }
}

fn observe<Sys: System<N>, const N: usize>(
    system: &Sys,
    scheme: impl Method,
    initial: [f64; N],
    t_end: f64,
) -> Run {
    let mut listener = Listener {
        points: Vec::new(),
        crossings: Vec::new(),
        system,
    };
    let result = Integrator::new(system, scheme)
        .initial(0.0, initial)
        .observe_until(t_end, &mut listener);
    let points = listener.points.into_iter();
    Run {
        points: points.map(|(t, x)| (t, x.as_slice().to_vec())).collect(),
        crossings: listener.crossings,
        error: result.err().map(Error::from),
    }
}

/// Makes a run of a system of a family; `rate` is the inverse of the time in which states
/// change.
pub(super) fn run<Sys: Family<N>, const N: usize>(
    setting: &Setting,
    system: &Sys,
    rate: f64,
    initial: [f64; N],
    t_end: f64,
) -> Run {
    let value = setting.value;
    let tau = value / rate;
    macro_rules! by {
        ($scheme:expr) => {
            observe(system, $scheme, initial, t_end)
        };
    }
    match setting.kind {
        Kind::Taylor | Kind::Lanes => by!(Taylor::tolerance(value)),
        Kind::Best => by!(Best::tolerance(value)),
        Kind::Uniform(order) => by!(Uniform::new(map(order), tau)),
        Kind::Adaptive(order) => by!(Adaptive::new(map(order), value)),
    }
}

/// The conservative map of an order.
fn map(order: usize) -> AnyMap {
    match order {
        2 => Symmetric.into(),
        4 => Composed::<4>::SUB_STEPS.into(),
        6 => Composed::<6>::SUB_STEPS.into(),
        _ => Composed::<8>::SUB_STEPS.into(),
    }
}

/// The end of a run in lanes, and how many crossings it made.
pub(super) type End = Result<(Vec<f64>, u64), Error>;

/// Makes runs of systems in lanes.
pub(super) fn run_in_lanes<Sys: System<N>, const N: usize>(
    setting: &Setting,
    members: impl IntoIterator<Item = (Sys, [f64; N])>,
    t_end: f64,
) -> Vec<End> {
    let members = members.into_iter();
    let members: Vec<_> = members
        .map(|(system, initial)| Member::new(system, 0.0, initial))
        .collect();
    let ensemble = Ensemble::new(Taylor::tolerance(setting.value)).threads(1);
    let outcomes = ensemble.collect_until(t_end, members).into_iter();
    outcomes
        .map(|outcome| {
            let end = outcome.map_err(Error::from)?;
            let x = end.point.x.as_slice().to_vec();
            Ok((x, end.statistics.transitions))
        })
        .collect()
}
