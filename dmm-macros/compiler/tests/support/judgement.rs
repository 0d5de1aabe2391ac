//! What the proofs say of a declaration.

#![allow(dead_code, reason = "the table shows times, which the test does not")]

use std::time::{Duration, Instant};

use dmm_compiler::diagnostics::Diagnostics;
use dmm_compiler::model::Model;
use dmm_compiler::proofs::{Conservation, DomainCondition, Proved};
use dmm_compiler::{check, proofs, syntax};

/// What is known of one conserved quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// It was proved, or holds by construction.
    Proved,
    /// It holds because the vector field was made from it.
    ByConstruction,
    /// It was sampled, and is accepted on the user's word.
    Assumed,
    /// It is not conserved.
    Refuted,
    /// It could be neither proved nor refuted.
    Undecided,
    /// The declaration is wrong in another way.
    Other,
}

impl Verdict {
    /// The word of the table.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Proved => "proved",
            Self::ByConstruction => "by construction",
            Self::Assumed => "assumed",
            Self::Refuted => "refuted",
            Self::Undecided => "undecided",
            Self::Other => "other error",
        }
    }
}

/// One line of the table.
#[derive(Debug, Clone)]
pub(crate) struct Statement {
    /// The quantity, with the region where there are several.
    pub(crate) about: String,
    /// What is known of it.
    pub(crate) verdict: Verdict,
    /// Where the proof holds; or the message with the residual and the point.
    pub(crate) remark: String,
}

/// What the proofs say of a declaration, and how long they took.
#[derive(Debug, Clone)]
pub(crate) struct Judgement {
    /// A line a quantity; of a declaration that is refused, a line an error.
    pub(crate) statements: Vec<Statement>,
    /// The time of the stage of the proofs.
    pub(crate) time: Duration,
}

impl Judgement {
    /// The least that is known of any of the quantities.
    pub(crate) fn verdict(&self) -> Option<Verdict> {
        let rank = |verdict: &Verdict| match verdict {
            Verdict::ByConstruction => 0,
            Verdict::Proved => 1,
            Verdict::Assumed => 2,
            Verdict::Undecided => 3,
            Verdict::Refuted => 4,
            Verdict::Other => 5,
        };
        let verdicts = self.statements.iter().map(|statement| statement.verdict);
        verdicts.max_by_key(rank)
    }
}

/// Runs the stages up to the proofs.
pub(crate) fn judge(source: &str) -> Judgement {
    let mut diagnostics = Diagnostics::new();
    let tokens = source.parse().expect("a declaration is made of tokens");
    let model = syntax::parse(tokens, &mut diagnostics)
        .filter(|_| diagnostics.is_empty())
        .and_then(|declaration| check::resolve(declaration, &mut diagnostics));
    let start = Instant::now();
    let proved = model.and_then(|model| proofs::prove(model, &mut diagnostics));
    let time = start.elapsed();
    let statements = match proved {
        Some(proved) => known(&proved),
        None => diagnostics.messages().into_iter().map(refused).collect(),
    };
    Judgement { statements, time }
}

/// A line a quantity of a declaration that is accepted.
fn known(proved: &Proved) -> Vec<Statement> {
    let model = &proved.model;
    let mut statements = Vec::new();
    for (region, proved) in model.regions.iter().zip(&proved.regions) {
        for (psi, evidence) in region.conserved.iter().zip(&proved.evidence) {
            let (verdict, remark) = match evidence {
                Conservation::Proved(conditions) => (Verdict::Proved, domain(model, conditions)),
                Conservation::ByConstruction => (Verdict::ByConstruction, String::new()),
                Conservation::Assumed { points, largest } => (
                    Verdict::Assumed,
                    format!("at {points} points, at most {largest:.0e} of its terms"),
                ),
            };
            let about = if model.regions.len() == 1 {
                psi.ident.to_string()
            } else {
                format!("{} in {}", psi.ident, region.ident)
            };
            statements.push(Statement {
                about,
                verdict,
                remark,
            });
        }
    }
    statements
}

/// `x > 0, y ≠ 0`
fn domain(model: &Model, conditions: &[DomainCondition]) -> String {
    let conditions: Vec<String> = conditions
        .iter()
        .map(|condition| condition.statement(&model.dag))
        .collect();
    conditions.join(", ")
}

/// The line of an error.
fn refused(message: String) -> Statement {
    let about = message.split('`').nth(1).unwrap_or_default().to_owned();
    let verdict = if message.contains("is not conserved") {
        Verdict::Refuted
    } else if message.contains("could not be proved") {
        Verdict::Undecided
    } else {
        Verdict::Other
    };
    Statement {
        about,
        verdict,
        remark: message,
    }
}
