//! The verdicts on the corpus: what holds is proved with its domain, what is wrong is refuted
//! with a residual and a point.
//!
//! `cargo bench --profile dev -p dmm-compiler --bench proof_table` prints them with their times.

#[path = "support/corpus.rs"]
mod corpus;
#[path = "support/judgement.rs"]
mod judgement;

use std::fmt::Write as _;

use corpus::Sample;
use insta::assert_snapshot;
use judgement::{Verdict, judge};

/// A line a statement.
fn table(samples: &[Sample]) -> String {
    let mut table = String::new();
    for sample in samples {
        for statement in judge(&sample.source).statements {
            let (about, verdict) = (&statement.about, statement.verdict.word());
            let line = format!("{}, {about}: {verdict}: {}", sample.name, statement.remark);
            writeln!(table, "{}", line.trim_end_matches([':', ' '])).expect("text");
        }
    }
    table
}

/// The samples whose verdict is not among `expected`.
fn others(samples: &[Sample], expected: &[Verdict]) -> Vec<String> {
    let is_other = |sample: &&Sample| {
        let verdict = judge(&sample.source).verdict();
        verdict.is_none_or(|verdict| !expected.contains(&verdict))
    };
    let names = samples.iter().filter(is_other);
    names.map(|sample| sample.name.clone()).collect()
}

#[test]
fn what_holds_is_proved() {
    let proved = [Verdict::Proved, Verdict::ByConstruction];
    let none = Vec::<String>::new();
    assert_eq!(others(&corpus::sound(), &proved), none);
    assert_eq!(others(&corpus::problems(), &proved), none);
    assert_snapshot!("sound", table(&corpus::sound()));
}

#[test]
fn what_is_wrong_is_refuted() {
    assert_eq!(
        others(&corpus::wrong(), &[Verdict::Refuted]),
        Vec::<String>::new()
    );
    assert_snapshot!("wrong", table(&corpus::wrong()));
}

#[test]
fn what_is_hard_to_prove() {
    assert_snapshot!("open", table(&corpus::open()));
}

#[test]
fn the_corpus_is_large_enough() {
    assert!(corpus::sound().len() >= 24);
    assert!(corpus::wrong().len() >= 12);
    let mut names: Vec<String> = corpus::sound().into_iter().map(|s| s.name).collect();
    names.dedup();
    assert_eq!(names.len(), corpus::sound().len());
}
