//! All problems, and finding one by name.

use dmm_runtime::dynamic::Erased;
use dmm_runtime::{Model, System};

use crate::problem::{AnySystem, Description, Problem};
use crate::systems::*;

/// A problem that can be made.
struct Entry {
    description: &'static Description,
    /// Its system, compiled at run time from the declaration.
    tape: fn() -> Box<AnySystem>,
    /// Its system, compiled with the program.
    compiled: Option<fn() -> Box<AnySystem>>,
}

/// The system of a declaration, compiled at run time.
fn tape(declaration: &str) -> Result<Box<AnySystem>, String> {
    let model = Model::compile(declaration).map_err(|error| error.to_string())?;
    model.into_any().map_err(|error| error.to_string())
}

/// What is done with every system, by its type.
pub trait SystemVisitor {
    /// Does it.
    fn visit<Sys: System<N> + Default, const N: usize>(
        &mut self,
        description: &'static Description,
    );
}

macro_rules! entries {
    ($($system:ident $states:literal $module:ident $compiled:expr;)*) => {
        /// Every problem, the piecewise-smooth ones first.
        const ENTRIES: &[Entry] = &[$(Entry {
            description: &$module::DESCRIPTION,
            tape: || declared(&$system::default()),
            compiled: $compiled,
        }),*];

        /// Hands every system to `visitor`.
        pub fn visit_systems(visitor: &mut impl SystemVisitor) {
            $(visitor.visit::<$system, $states>(&$module::DESCRIPTION);)*
        }
    };
}

/// A system that the program has compiled.
macro_rules! compiled {
    ($system:ident $states:literal) => {
        Some(|| Erased::<$system, $states>::boxed($system::default()))
    };
}

/// A system that is compiled with the feature `compiled` alone, for comparisons of generated code.
#[cfg(feature = "compiled")]
macro_rules! seldom {
    ($system:ident $states:literal) => {
        compiled!($system $states)
    };
}
#[cfg(not(feature = "compiled"))]
macro_rules! seldom {
    ($system:ident $states:literal) => {
        None
    };
}

entries! {
    Harmonic 2 harmonic compiled!(Harmonic 2);
    Elliptic 2 elliptic compiled!(Elliptic 2);
    Pendulum 2 pendulum seldom!(Pendulum 2);
    LotkaVolterra 2 lotka_volterra_periodic seldom!(LotkaVolterra 2);
    Damped 2 damped seldom!(Damped 2);
    Spiral 2 spiral seldom!(Spiral 2);
    RigidBody 3 rigid_body seldom!(RigidBody 3);
    KeplerRefraction 4 kepler_refraction seldom!(KeplerRefraction 4);
    SaturatingInductor 2 saturating_inductor seldom!(SaturatingInductor 2);
    FoodChain 3 food_chain seldom!(FoodChain 3);
    FputChain 16 fput_chain seldom!(FputChain 16);
    FputChain32 64 fput_chain_32 seldom!(FputChain32 64);
    TodaChain 16 toda_chain seldom!(TodaChain 16);
    TodaChain32 64 toda_chain_32 seldom!(TodaChain32 64);
    Toda 6 toda seldom!(Toda 6);
    RelativisticOscillator 2 relativistic_oscillator seldom!(RelativisticOscillator 2);
    HenonHeiles 4 henon_heiles seldom!(HenonHeiles 4);
    PoschlTeller 2 poschl_teller seldom!(PoschlTeller 2);
    SaturatingSpring 2 saturating_spring seldom!(SaturatingSpring 2);
    DoublePendulum 4 double_pendulum seldom!(DoublePendulum 4);
    ThreeBody 12 three_body seldom!(ThreeBody 12);
}

impl Entry {
    /// The problem, of the system that was compiled with the program if there is one.
    fn problem(&self) -> Problem {
        let system = self.compiled.unwrap_or(self.tape);
        Problem::new(*self.description, system())
    }
}

/// The problem of a system, which is compiled at run time from its declaration.
pub(crate) fn of<Sys: System<N>, const N: usize>(
    description: Description,
    system: &Sys,
) -> Problem {
    Problem::new(description, declared(system))
}

/// A system compiled at run time from its declaration.
fn declared<Sys: System<N>, const N: usize>(system: &Sys) -> Box<AnySystem> {
    tape(system.declaration())
        .unwrap_or_else(|message| unreachable!("`pws!` has compiled the same: {message}"))
}

/// Every problem, the piecewise-smooth ones first.
pub fn all() -> Vec<Problem> {
    ENTRIES.iter().map(Entry::problem).collect()
}

/// The descriptions of all problems.
pub fn descriptions() -> impl Iterator<Item = &'static Description> {
    ENTRIES.iter().map(|entry| entry.description)
}

/// The names of all problems.
pub fn names() -> impl Iterator<Item = &'static str> {
    descriptions().map(|description| description.name)
}

/// The problem of that name; `-` and `_` are the same, and so are capitals and small letters.
///
/// # Errors
/// [`Unknown`], with the closest name.
pub fn find(name: &str) -> Result<Problem, Unknown> {
    Ok(entry(name)?.problem())
}

fn entry(name: &str) -> Result<&'static Entry, Unknown> {
    let wanted = name.to_lowercase().replace('-', "_");
    let mut entries = ENTRIES.iter();
    let found = entries.find(|entry| entry.description.name == wanted);
    found.ok_or_else(|| Unknown {
        kind: "problem",
        name: name.to_owned(),
        closest: closest(&wanted, names()),
    })
}

/// A name that does not exist.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("unknown {kind} `{name}`{}", suggestion(closest))]
pub struct Unknown {
    /// What it should name.
    pub kind: &'static str,
    /// The name.
    pub name: String,
    /// The closest name that exists, if any is close.
    pub closest: Option<String>,
}

fn suggestion(closest: &Option<String>) -> String {
    match closest {
        Some(name) => format!("; did you mean `{name}`?"),
        None => String::new(),
    }
}

/// The candidate that resembles `name` most, if any does.
pub fn closest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<String> {
    candidates
        .map(|candidate| (strsim::jaro_winkler(name, candidate), candidate))
        .filter(|(similarity, _)| *similarity > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate.to_owned())
}
