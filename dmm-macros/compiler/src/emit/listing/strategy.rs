//! How f^τ is made, why not otherwise, and f^τ.

use super::compose::{Entry, words};
use super::document::{Part, Phrase, Piece, Section};
use super::lister::{Lister, symbol, titled};
use crate::algebra::to_text;
use crate::model::plain_text;
use crate::scheme::{Conditional, Explicit, Obstacle, Pairing, Refusal, Strategy};

/// Pairs are listed as rows if there are more than this.
const FEW_PAIRS: usize = 3;
/// No more states than this are named in a sentence.
const MOST_NAMED: usize = 8;

/// The strategy and f^τ of a region.
pub(super) fn section(lister: &mut Lister<'_>) {
    let derived = lister.derived;
    let mut rows = Vec::new();
    let (remark, explicit) = match &derived.strategy {
        Strategy::Midpoint { field } => (
            words("f at the midpoint, nothing being conserved"),
            Some(field),
        ),
        Strategy::SkewPairing {
            pairs,
            alone,
            field,
        } => {
            let remark = if pairs.len() > FEW_PAIRS {
                rows = pair_rows(lister, pairs);
                words(format!(
                    "skew pairing with α at the midpoint{}",
                    apart(lister, alone)
                ))
            } else {
                pairing(lister, pairs, alone)
            };
            (remark, Some(field))
        }
        Strategy::CrossProduct { alpha, field } => {
            let alpha = lister.composer.formula(lister.dag(), *alpha);
            let remark = vec![
                "cross product of the rows of Λ^τ with α = ".into(),
                alpha.into(),
                " at the midpoint".into(),
            ];
            (remark, Some(field))
        }
        Strategy::MinimalNorm { .. } => (words("minimal norm"), None),
    };
    let section = Section {
        remark,
        reasons: refusals(lister),
        ..titled("strategy", "")
    };
    lister.composer.add(section, rows);
    match (explicit, &derived.strategy) {
        (Some(field), _) => {
            let rows = lister.column("f^τ[", &field.value);
            lister
                .composer
                .add(titled("discrete vector field ", "f^τ"), rows);
        }
        (None, Strategy::MinimalNorm { mean, .. }) => minimal_norm(lister, mean),
        (None, _) => {}
    }
}

fn pairing(lister: &mut Lister<'_>, pairs: &[Pairing], alone: &[usize]) -> Phrase {
    let states: Vec<&str> = lister.states().map(|name| name.as_str()).collect();
    let mut phrase = words("skew pairing ");
    for (place, pair) in pairs.iter().enumerate() {
        let comma = if place == 0 { "" } else { ", " };
        let (first, second) = (states[pair.first], states[pair.second]);
        let alpha = lister.composer.formula(lister.dag(), pair.alpha);
        phrase.push(format!("{comma}({first}, {second}) with α = ").into());
        phrase.push(alpha.into());
        if lister.dag().as_constant(pair.alpha).is_none() {
            phrase.push(" at the midpoint".into());
        }
    }
    phrase.extend(words(apart(lister, alone)));
    phrase
}

/// The states that are in no pair.
fn apart(lister: &Lister<'_>, alone: &[usize]) -> String {
    let states: Vec<&str> = lister.states().map(|name| name.as_str()).collect();
    let mut text: String = alone
        .iter()
        .take(MOST_NAMED)
        .map(|&index| format!(", {} alone", states[index]))
        .collect();
    if alone.len() > MOST_NAMED {
        text.push_str(&format!(", {} more alone", alone.len() - MOST_NAMED));
    }
    text
}

fn pair_rows(lister: &mut Lister<'_>, pairs: &[Pairing]) -> Vec<Entry> {
    let states: Vec<_> = lister.states().collect();
    pairs
        .iter()
        .map(|pair| {
            let left = vec![
                Part::Sign("α("),
                symbol(states[pair.first]),
                Part::Sign(", "),
                symbol(states[pair.second]),
                Part::Sign(")"),
            ];
            (left, lister.composer.formula(lister.dag(), pair.alpha))
        })
        .collect()
}

fn minimal_norm(lister: &mut Lister<'_>, mean: &Explicit) {
    let rows = lister.column("f̄[", &mean.value);
    let names: Vec<String> = lister
        .region
        .conserved
        .iter()
        .map(|one| plain_text(&one.ident))
        .collect();
    let mut note = words("Λ^τ Λ^τᵀ is singular where ");
    match &names[..] {
        [one] => note.push(format!("the gradient of {one} vanishes").into()),
        names => {
            note.push(format!("the gradients of {} are dependent", names.join(", ")).into());
            let refusals = &lister.derived.refusals;
            let denominator = refusals.iter().find_map(|refusal| match refusal.obstacle {
                Obstacle::Denominator(factor) => Some(factor),
                _ => None,
            });
            if let Some(factor) = denominator {
                note.push(", as they are where ".into());
                note.push(lister.composer.formula(lister.dag(), factor).into());
                note.push(" = 0".into());
            }
        }
    }
    note.push("; what is dependent is left out".into());
    let section = Section {
        remark: vec![
            Piece::Signs("(Λ^τ Λ^τᵀ) λ = Λ^τ f̄ + ∂ₜ^τψ"),
            ", solved at run time".into(),
        ],
        notes: vec![note],
        ..titled("discrete vector field ", "f^τ = f̄ − Λ^τᵀ λ")
    };
    lister.composer.add(section, rows);
}

/// Why the strategies before the one that is used do not fit.
fn refusals(lister: &mut Lister<'_>) -> Vec<Phrase> {
    let refusals = lister.derived.refusals.iter();
    refusals.map(|refusal| reason(lister, refusal)).collect()
}

fn reason(lister: &mut Lister<'_>, refusal: &Refusal) -> Phrase {
    let name = match refusal.strategy {
        Conditional::SkewPairing => "skew pairing",
        Conditional::CrossProduct => "cross product",
    };
    let reason = match refusal.obstacle {
        Obstacle::Count { states, conserved } => match refusal.strategy {
            Conditional::SkewPairing => {
                format!("it takes one conserved quantity, and there are {conserved}")
            }
            Conditional::CrossProduct => format!(
                "it takes N ≥ 3 states with N − 1 conserved quantities, and here N = {states}, M = {conserved}"
            ),
        },
        Obstacle::Cost { conserved } => format!(
            "the minors of {conserved} conserved quantities cost more than the minimal-norm solve"
        ),
        Obstacle::Time => "ψ depends on the time".into(),
        Obstacle::NoPairs => "the states do not fall into pairs with fᵢ ∂ᵢψ + fⱼ ∂ⱼψ = 0".into(),
        Obstacle::Dependent => "the conserved quantities are dependent everywhere".into(),
        Obstacle::NotParallel => "f is not proved to be parallel to the cross product of ∇ψ".into(),
        Obstacle::NoNormalForm {
            numerator,
            denominator,
        } => {
            let dag = lister.dag();
            let [numerator, denominator] = [numerator, denominator].map(|id| to_text(dag, id));
            format!("α = ({numerator})/({denominator}) has no normal form")
        }
        Obstacle::Denominator(factor) => {
            return vec![
                format!("not {name}: α has the denominator ").into(),
                lister.composer.formula(lister.dag(), factor).into(),
                ", which vanishes where f and ∇ψ are finite".into(),
            ];
        }
    };
    words(format!("not {name}: {reason}"))
}
