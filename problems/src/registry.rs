//! All problems, and finding one by name.

use dmm_runtime::Model;
#[cfg(feature = "compiled")]
use dmm_runtime::dynamic::Erased;

use crate::problem::{AnySystem, Description, Problem};
use crate::systems::*;

/// A problem that can be made.
struct Entry {
    description: &'static Description,
    /// Its system: of generated code with the feature `compiled`, for comparisons of it; else compiled
    /// at run time from the declaration.
    system: fn() -> Box<AnySystem>,
}

/// What is done with every system, by its type.
#[cfg(feature = "types")]
pub trait SystemVisitor {
    /// Does it.
    fn visit<Sys: dmm_runtime::System<N> + Default, const N: usize>(
        &mut self,
        description: &'static Description,
    );
}

macro_rules! entries {
    ($($system:ident $states:literal $module:ident;)*) => {
        /// Every problem, the piecewise-smooth ones first.
        const ENTRIES: &[Entry] = &[$(Entry {
            description: &$module::DESCRIPTION,
            #[cfg(feature = "compiled")]
            system: || Erased::<$module::$system, $states>::boxed(Default::default()),
            #[cfg(not(feature = "compiled"))]
            system: || declared($module::DECLARATION),
        }),*];

        /// Hands every system to `visitor`.
        #[cfg(feature = "types")]
        pub fn visit_systems(visitor: &mut impl SystemVisitor) {
            $(visitor.visit::<$module::$system, $states>(&$module::DESCRIPTION);)*
        }
    };
}

entries! {
    Harmonic 2 harmonic;
    Elliptic 2 elliptic;
    Pendulum 2 pendulum;
    LotkaVolterra 2 lotka_volterra_periodic;
    Damped 2 damped;
    Spiral 2 spiral;
    RigidBody 3 rigid_body;
    KeplerRefraction 4 kepler_refraction;
    SaturatingInductor 2 saturating_inductor;
    FoodChain 3 food_chain;
    FputChain 16 fput_chain;
    FputChain32 64 fput_chain_32;
    TodaChain 16 toda_chain;
    TodaChain32 64 toda_chain_32;
    Toda 6 toda;
    RelativisticOscillator 2 relativistic_oscillator;
    HenonHeiles 4 henon_heiles;
    PoschlTeller 2 poschl_teller;
    SaturatingSpring 2 saturating_spring;
    DoublePendulum 4 double_pendulum;
    ThreeBody 12 three_body;
}

impl Entry {
    fn problem(&self) -> Problem {
        Problem::new(*self.description, (self.system)())
    }
}

/// The problem of a system that is declared in this package.
pub(crate) fn of(description: Description, declaration: &str) -> Problem {
    Problem::new(description, declared(declaration))
}

/// The system of a declaration in this package, compiled at run time.
fn declared(declaration: &str) -> Box<AnySystem> {
    let system = Model::compile(declaration).map_err(|error| error.to_string());
    let system = system.and_then(|model| model.into_any().map_err(|error| error.to_string()));
    system.unwrap_or_else(|message| unreachable!("a test compiles it: {message}"))
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
