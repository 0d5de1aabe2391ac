//! The scheme as readable mathematics: what was declared, what was derived from it and how,
//! and what was proved of it.

use std::fmt::Write;

use super::system::plain_text;
use crate::algebra::{Dag, Id, to_text};
use crate::model::{Model, Region, Sign};
use crate::scheme::{
    Evidence, Explicit, Obstacle, Pairing, Proofs, RegionScheme, Scheme, Solvability, Strategy,
};

/// The listing of a whole system.
pub(super) fn listing(scheme: &Scheme) -> String {
    let mut text = format!("{}\n", scheme.model.source.trim_end());
    interfaces(&mut text, scheme);
    for (region, derived) in scheme.model.regions.iter().zip(&scheme.regions) {
        let lister = Lister {
            model: &scheme.model,
            region,
            derived,
        };
        text.push_str(&lister.list());
    }
    text
}

fn interfaces(text: &mut String, scheme: &Scheme) {
    let dag = scheme.dag();
    for (interface, derived) in scheme.model.interfaces.iter().zip(&scheme.interfaces) {
        let name = plain_text(&interface.ident);
        let mut rows = vec![("g".to_owned(), to_text(dag, interface.switching_function))];
        if !dag.is_zero(derived.time_derivative) {
            rows.push(("∂g/∂t".to_owned(), to_text(dag, derived.time_derivative)));
        }
        for (state, &entry) in scheme.model.states.iter().zip(&derived.gradient) {
            if !dag.is_zero(entry) {
                rows.push((format!("∂g/∂{}", state.name), to_text(dag, entry)));
            }
        }
        text.push_str(&section(&format!("interface {name}"), "", &rows, 0));
    }
}

/// A heading with a remark, and aligned rows `left = right` below it.
fn section(heading: &str, remark: &str, rows: &[(String, String)], indent: usize) -> String {
    let margin = " ".repeat(indent);
    let width = rows
        .iter()
        .map(|(left, _)| left.chars().count())
        .max()
        .unwrap_or(0);
    let mut text = format!("\n{margin}{heading}");
    if !remark.is_empty() {
        let _ = write!(text, ": {remark}");
    }
    text.push('\n');
    for (left, right) in rows {
        let gap = " ".repeat(width - left.chars().count());
        let _ = writeln!(text, "{margin}  {left}{gap} = {right}");
    }
    text
}

/// Writes one region.
struct Lister<'a> {
    model: &'a Model,
    region: &'a Region,
    derived: &'a RegionScheme,
}

impl Lister<'_> {
    fn list(&self) -> String {
        let sides: Vec<String> = self
            .region
            .sides
            .iter()
            .map(|side| {
                let interface = plain_text(&self.model.interfaces[side.interface].ident);
                let sign = match side.sign {
                    Sign::Positive => '>',
                    Sign::Negative => '<',
                };
                format!("{interface} {sign} 0")
            })
            .collect();
        let mut text = format!("\nregion {}", plain_text(&self.region.ident));
        if !sides.is_empty() {
            let _ = write!(text, " where {}", sides.join(", "));
        }
        text.push('\n');
        text.push_str(&self.fields());
        text.push_str(&self.multipliers());
        text.push_str(&self.strategy());
        text.push_str(&self.step());
        text.push_str(&proofs(
            &self.derived.proofs,
            !self.region.conserved.is_empty(),
        ));
        text
    }

    fn dag(&self) -> &Dag {
        &self.model.dag
    }

    /// A column with an entry a state.
    fn column(&self, symbol: &str, entries: &[Id]) -> Vec<(String, String)> {
        self.model
            .states
            .iter()
            .zip(entries)
            .map(|(state, &entry)| {
                (
                    format!("{symbol}[{}]", state.name),
                    to_text(self.dag(), entry),
                )
            })
            .collect()
    }

    /// f and ψ.
    fn fields(&self) -> String {
        let mut text = section(
            "vector field f",
            "",
            &self.column("f", &self.region.field),
            2,
        );
        if !self.region.conserved.is_empty() {
            let rows: Vec<(String, String)> = self
                .region
                .conserved
                .iter()
                .map(|one| (plain_text(&one.ident), to_text(self.dag(), one.psi)))
                .collect();
            text.push_str(&section("conserved quantities ψ", "", &rows, 2));
        }
        text
    }

    /// Λ and ∂ₜψ, Λ^τ and ∂ₜ^τψ.
    fn multipliers(&self) -> String {
        if self.region.conserved.is_empty() {
            return String::new();
        }
        let derived = self.derived;
        let exact = self.rows("Λ", "∂ₜψ", &derived.multiplier, &derived.time_derivative);
        let discrete = self.rows(
            "Λ^τ",
            "∂ₜ^τψ",
            &derived.discrete_multiplier,
            &derived.discrete_time_derivative,
        );
        section("multiplier Λ = ∇ψ", "", &exact, 2)
            + &section(
                "discrete multiplier Λ^τ",
                "ψ's divided differences",
                &discrete,
                2,
            )
    }

    fn rows(
        &self,
        symbol: &str,
        time_symbol: &str,
        rows: &[Vec<Id>],
        by_time: &[Id],
    ) -> Vec<(String, String)> {
        let mut lines = Vec::new();
        for ((conserved, row), &by_time) in self.region.conserved.iter().zip(rows).zip(by_time) {
            let name = plain_text(&conserved.ident);
            for (state, &entry) in self.model.states.iter().zip(row) {
                let left = format!("{symbol}[{name}, {}]", state.name);
                lines.push((left, to_text(self.dag(), entry)));
            }
            if !self.dag().is_zero(by_time) {
                lines.push((
                    format!("{time_symbol}[{name}]"),
                    to_text(self.dag(), by_time),
                ));
            }
        }
        lines
    }

    /// How f^τ is made, why not otherwise, and f^τ.
    fn strategy(&self) -> String {
        let (name, explicit) = match &self.derived.strategy {
            Strategy::Midpoint { field } => {
                ("f at the midpoint, nothing being conserved".into(), field)
            }
            Strategy::SkewPairing {
                pairs,
                alone,
                field,
            } => (self.pairing(pairs, alone), field),
            Strategy::CrossProduct { alpha, field } => {
                let alpha = to_text(self.dag(), *alpha);
                (
                    format!("cross product of the rows of Λ^τ with α = {alpha} at the midpoint"),
                    field,
                )
            }
            Strategy::MinimalNorm { mean, .. } => return self.minimal_norm(mean),
        };
        let rows = self.column("f^τ", &explicit.value);
        section("strategy", &name, &[], 2)
            + &self.refusals()
            + &section("discrete vector field f^τ", "", &rows, 2)
    }

    fn pairing(&self, pairs: &[Pairing], alone: &[usize]) -> String {
        let state = |index: usize| self.model.states[index].name.as_str();
        let mut parts: Vec<String> = pairs
            .iter()
            .map(|pair| {
                let (first, second) = (state(pair.first), state(pair.second));
                let alpha = to_text(self.dag(), pair.alpha);
                let place = if self.dag().as_constant(pair.alpha).is_some() {
                    ""
                } else {
                    " at the midpoint"
                };
                format!("({first}, {second}) with α = {alpha}{place}")
            })
            .collect();
        parts.extend(alone.iter().map(|&index| format!("{} alone", state(index))));
        format!("skew pairing {}", parts.join(", "))
    }

    fn minimal_norm(&self, mean: &Explicit) -> String {
        let rows = self.column("f̄", &mean.value);
        let names: Vec<String> = self
            .region
            .conserved
            .iter()
            .map(|one| plain_text(&one.ident))
            .collect();
        let at = self
            .derived
            .refusals
            .iter()
            .find_map(|refusal| match refusal.obstacle {
                Obstacle::Denominator(factor) => Some(format!(
                    ", as they are where {} = 0",
                    to_text(self.dag(), factor)
                )),
                Obstacle::Condition(_) => None,
            })
            .unwrap_or_default();
        let singular = match &names[..] {
            [one] => format!("the gradient of {one} vanishes"),
            names => format!("the gradients of {} are dependent{at}", names.join(", ")),
        };
        section("strategy", "minimal norm", &[], 2)
            + &self.refusals()
            + &section(
                "discrete vector field f^τ = f̄ − Λ^τᵀ λ",
                "(Λ^τ Λ^τᵀ) λ = Λ^τ f̄ + ∂ₜ^τψ, solved at run time",
                &rows,
                2,
            )
            + &format!("    Λ^τ Λ^τᵀ is singular where {singular}; what is dependent is left out\n")
    }

    fn refusals(&self) -> String {
        let mut text = String::new();
        for refusal in &self.derived.refusals {
            let reason = match &refusal.obstacle {
                Obstacle::Condition(reason) => reason.clone(),
                Obstacle::Denominator(factor) => format!(
                    "α has the denominator {}, which vanishes where f and ∇ψ are finite",
                    to_text(self.dag(), *factor)
                ),
            };
            let _ = writeln!(text, "    not {}: {reason}", refusal.strategy);
        }
        text
    }

    fn step(&self) -> String {
        let how = match self.derived.solvability {
            Solvability::Linear => {
                "linear in both ends with constant coefficients; the propagator is computed once"
            }
            Solvability::Affine => "affine in x₁; one linear solve, no iteration",
            Solvability::Nonlinear => "Newton's method with the exact Jacobian ∂f^τ/∂x₁",
        };
        let rows = [("x₁".to_owned(), "x₀ + τ f^τ".to_owned())];
        section("step", how, &rows, 2)
    }
}

fn proofs(proofs: &Proofs, conserves: bool) -> String {
    let mut identities = Vec::new();
    if conserves {
        identities.push((
            proofs.telescopes,
            "Λ^τ (x₁ − x₀) + ∂ₜ^τψ (t₁ − t₀) = ψ(t₁, x₁) − ψ(t₀, x₀)",
        ));
        identities.push((
            proofs.conserves,
            "Λ^τ f^τ + ∂ₜ^τψ = 0 whatever the entries of Λ^τ are",
        ));
    }
    identities.push((proofs.consistent, "f^τ(t, x, t, x) = f(t, x)"));
    let mut text = "\n  identities\n".to_owned();
    for (evidence, identity) in identities {
        let word = match evidence {
            Evidence::Proved => "proved    ",
            Evidence::NotProved => "not proved",
        };
        let _ = writeln!(text, "    {word}  {identity}");
    }
    text
}
