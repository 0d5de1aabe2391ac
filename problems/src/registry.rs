//! All problems, and finding one by name.

use crate::entry::Entry;
use crate::problem::Problem;
use crate::systems::*;

/// Every problem, the piecewise-smooth ones first.
pub fn all() -> Vec<Box<dyn Problem>> {
    vec![
        Entry::<Harmonic, 2>::boxed(&harmonic::DESCRIPTION),
        Entry::<Elliptic, 2>::boxed(&elliptic::DESCRIPTION),
        Entry::<Pendulum, 2>::boxed(&pendulum::DESCRIPTION),
        Entry::<LotkaVolterra, 2>::boxed(&lotka_volterra_periodic::DESCRIPTION),
        Entry::<Damped, 2>::boxed(&damped::DESCRIPTION),
        Entry::<Spiral, 2>::boxed(&spiral::DESCRIPTION),
        Entry::<RigidBody, 3>::boxed(&rigid_body::DESCRIPTION),
        Entry::<KeplerRefraction, 4>::boxed(&kepler_refraction::DESCRIPTION),
        Entry::<SaturatingInductor, 2>::boxed(&saturating_inductor::DESCRIPTION),
        Entry::<FoodChain, 3>::boxed(&food_chain::DESCRIPTION),
        Entry::<FputChain, 16>::boxed(&fput_chain::DESCRIPTION),
        Entry::<FputChain32, 64>::boxed(&fput_chain_32::DESCRIPTION),
        Entry::<TodaChain, 16>::boxed(&toda_chain::DESCRIPTION),
        Entry::<TodaChain32, 64>::boxed(&toda_chain_32::DESCRIPTION),
        Entry::<Toda, 6>::boxed(&toda::DESCRIPTION),
        Entry::<RelativisticOscillator, 2>::boxed(&relativistic_oscillator::DESCRIPTION),
        Entry::<HenonHeiles, 4>::boxed(&henon_heiles::DESCRIPTION),
        Entry::<PoschlTeller, 2>::boxed(&poschl_teller::DESCRIPTION),
        Entry::<SaturatingSpring, 2>::boxed(&saturating_spring::DESCRIPTION),
        Entry::<DoublePendulum, 4>::boxed(&double_pendulum::DESCRIPTION),
        Entry::<ThreeBody, 12>::boxed(&three_body::DESCRIPTION),
    ]
}

/// The problem of that name; `-` and `_` are the same, and so are capitals and small letters.
///
/// # Errors
/// [`Unknown`], with the closest name.
pub fn find(name: &str) -> Result<Box<dyn Problem>, Unknown> {
    let wanted = name.to_lowercase().replace('-', "_");
    let problems = all();
    let closest = closest(
        &wanted,
        problems.iter().map(|problem| problem.description().name),
    );
    problems
        .into_iter()
        .find(|problem| problem.description().name == wanted)
        .ok_or_else(|| Unknown {
            kind: "problem",
            name: name.to_owned(),
            closest,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_found() {
        let names: Vec<_> = all()
            .iter()
            .map(|problem| problem.description().name)
            .collect();
        for (i, name) in names.iter().enumerate() {
            assert!(!names[..i].contains(name));
            assert_eq!(
                find(&name.replace('_', "-")).unwrap().description().name,
                *name
            );
        }
    }

    #[test]
    fn unknown_names_have_a_suggestion() {
        let suggestion = |name| find(name).err().and_then(|unknown| unknown.closest);
        assert_eq!(suggestion("harmonc").as_deref(), Some("harmonic"));
        assert_eq!(suggestion("kepler").as_deref(), Some("kepler_refraction"));
        assert_eq!(suggestion("qqq"), None);
    }

    #[test]
    fn cards_fit_their_systems() {
        for problem in all() {
            let description = problem.description();
            assert_eq!(
                description.initial.len(),
                problem.states().len(),
                "{}",
                description.name
            );
            assert!(
                problem.is_reference_run(description.initial) == description.reference.is_some()
            );
        }
    }
}
