//! What is known of a region, in words: the lines that every form of the listing shows.

use crate::algebra::{Dag, Id, to_text};
use crate::model::{Conserved, Region};
use crate::proofs::{Conservation, Independence};
use crate::scheme::{CheckedCondition, Evidence, Proofs, RegionScheme, Scheme};

/// How a statement is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Grounds {
    /// It was proved symbolically.
    Proved,
    /// It holds because of how f was made.
    ByConstruction,
    /// It was evaluated at points and accepted on the user's word.
    Assumed,
    /// It could be neither proved nor refuted.
    NotProved,
    /// It is checked while a solution is computed.
    Checked,
}

impl Grounds {
    /// The word that the listing uses.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Proved => "proved",
            Self::ByConstruction => "by construction",
            Self::Assumed => "assumed",
            Self::NotProved => "not proved",
            Self::Checked => "checked",
        }
    }
}

/// One statement about a region, and how it is known.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Finding {
    /// How it is known.
    pub(super) grounds: Grounds,
    /// The statement, in the notation of the listing.
    pub(super) statement: String,
    /// What it depends on or where it fails; may be empty.
    pub(super) remark: String,
}

/// What is known of a region of `scheme`: conservation of every ψ, their independence,
/// interfaces that are constant along the flow, the identities of f^τ, and the conditions that a
/// run checks.
pub(super) fn findings(scheme: &Scheme, region: &Region, derived: &RegionScheme) -> Vec<Finding> {
    let dag = scheme.dag();
    let proved = &derived.proved;
    let mut findings: Vec<Finding> = (region.conserved.iter())
        .zip(&proved.evidence)
        .map(|(psi, evidence)| conservation(dag, psi, evidence))
        .collect();
    findings.extend(independence(dag, region, &proved.independence));
    for &level in &derived.levels {
        if let Some(interface) = scheme.model.interfaces.get(level) {
            let (name, own) = (&interface.ident, &region.ident);
            findings.push(Finding {
                grounds: Grounds::Proved,
                statement: format!("d{name}/dt = 0"),
                remark: format!(
                    "the flow of `{own}` never crosses `{name}`: what enters can never leave through it"
                ),
            });
        }
    }
    findings.extend(identities(region, &derived.proofs));
    let checks = derived.checked.iter();
    findings.extend(checks.map(|condition| checked(dag, region, condition)));
    findings
}

/// A condition that a run checks.
fn checked(dag: &Dag, region: &Region, condition: &CheckedCondition) -> Finding {
    Finding {
        grounds: Grounds::Checked,
        statement: condition.condition.statement(dag),
        remark: format!(
            "needed by {}: a run ends where this fails",
            condition.names(region)
        ),
    }
}

fn conservation(dag: &Dag, psi: &Conserved, evidence: &Conservation) -> Finding {
    let name = &psi.ident;
    let (grounds, remark) = match evidence {
        Conservation::Proved(conditions) => {
            let conditions: Vec<String> = conditions
                .iter()
                .map(|condition| condition.statement(dag))
                .collect();
            (Grounds::Proved, conditions.join(", "))
        }
        Conservation::ByConstruction => (Grounds::ByConstruction, String::new()),
        Conservation::Assumed { points, largest } => (
            Grounds::Assumed,
            format!("|d{name}/dt| ≤ {largest:.1e} of its terms at {points} points"),
        ),
    };
    Finding {
        grounds,
        statement: format!("d{name}/dt = 0"),
        remark,
    }
}

/// Independence of the gradients, nothing without a ψ.
fn independence(dag: &Dag, region: &Region, known: &Independence) -> Option<Finding> {
    let statement = match region.conserved.as_slice() {
        [] => return None,
        [_] => "∇ψ ≠ 0",
        _ => "the gradients ∇ψ are linearly independent",
    };
    let (grounds, statement, remark) = match known {
        Independence::Undecided => (
            Grounds::NotProved,
            statement.to_owned(),
            "it could not be decided".to_owned(),
        ),
        Independence::Generic => (
            Grounds::Proved,
            format!("{statement} at generic points"),
            "the set where this fails was not found".to_owned(),
        ),
        Independence::Proved { factors, minors } => (
            Grounds::Proved,
            statement.to_owned(),
            exceptions(dag, factors, minors),
        ),
    };
    Some(Finding {
        grounds,
        statement,
        remark,
    })
}

/// `except where x = 0, or y = z = 0`
fn exceptions(dag: &Dag, factors: &[Id], minors: &[Id]) -> String {
    let mut sets: Vec<String> = factors
        .iter()
        .map(|&factor| format!("{} = 0", to_text(dag, factor)))
        .collect();
    if !minors.is_empty() {
        let minors: Vec<String> = minors.iter().map(|&minor| to_text(dag, minor)).collect();
        sets.push(format!("{} = 0", minors.join(" = ")));
    }
    if sets.is_empty() {
        return String::new();
    }
    format!("except where {}", sets.join(", or "))
}

/// The identities of f^τ.
fn identities(region: &Region, proofs: &Proofs) -> Vec<Finding> {
    let mut findings = Vec::new();
    let mut identity = |evidence: Evidence, statement: &str| {
        findings.push(Finding {
            grounds: match evidence {
                Evidence::Proved => Grounds::Proved,
                Evidence::NotProved => Grounds::NotProved,
            },
            statement: statement.into(),
            remark: String::new(),
        });
    };
    if !region.conserved.is_empty() {
        identity(
            proofs.telescopes,
            "Λ^τ (x₁ − x₀) + ∂ₜ^τψ (t₁ − t₀) = ψ(t₁, x₁) − ψ(t₀, x₀)",
        );
        identity(
            proofs.conserves,
            "Λ^τ f^τ + ∂ₜ^τψ = 0 whatever the entries of Λ^τ are",
        );
    }
    identity(proofs.consistent, "f^τ(t, x, t, x) = f(t, x)");
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said about the rate of the interface `wall` in each of two regions.
    fn levels(left: &str, right: &str) -> [Vec<Finding>; 2] {
        let text = format!(
            "system S {{ state x, y; interface wall = x^2 - y;
                region left where wall < 0 {{ {left} }} region right where wall > 0 {{ {right} }} }}"
        );
        let scheme = crate::read(text.parse().expect("tokens")).expect("a scheme");
        [0, 1].map(|region| {
            let mut findings = findings(
                &scheme,
                &scheme.model.regions[region],
                &scheme.regions[region],
            );
            findings.retain(|finding| finding.statement.contains("wall"));
            findings
        })
    }

    #[test]
    fn a_flow_along_an_interface_is_found() {
        let along = "der(x) = 1; der(y) = 2*x;";
        let across = "der(x) = 1; der(y) = 1;";
        let found = |region: &str| Finding {
            grounds: Grounds::Proved,
            statement: "dwall/dt = 0".into(),
            remark: format!(
                "the flow of `{region}` never crosses `wall`: what enters can never leave through it"
            ),
        };
        assert_eq!(levels(along, across), [vec![found("left")], vec![]]);
        assert_eq!(levels(across, along), [vec![], vec![found("right")]]);
        assert_eq!(levels(across, "der(x) = 1; der(y) = -1;"), [vec![], vec![]]);
    }

    #[test]
    fn the_listing_shows_a_flow_along_an_interface() {
        let text = "system S { state x, y; interface wall = x;
            region left where wall < 0 { der(x) = 0; der(y) = 1; }
            region right where wall > 0 { der(x) = 1; der(y) = 0; } }";
        let scheme = crate::read(text.parse().expect("tokens")).expect("a scheme");
        for listing in [crate::emit::listing(&scheme), crate::emit::latex(&scheme)] {
            assert_eq!(listing.matches("never crosses").count(), 1, "{listing}");
        }
    }
}
