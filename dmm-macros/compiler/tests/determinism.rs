//! The same declaration gives the same bytes: in other processes, in another order, and in
//! debug and release builds.
//!
//! `tests/determinism/digests.txt` holds a digest of the Rust and of the listing of every
//! declaration; each profile compares with it. After an intended change,
//! `DMM_UPDATE_DIGESTS=1 cargo test -p dmm-compiler --test determinism` writes it anew.

#[path = "support/corpus.rs"]
mod corpus;

use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use corpus::Sample;
use dmm_compiler::{compile, explain};
use proc_macro2::TokenStream;

/// Set in the processes that compile in the reverse order.
const REVERSED: &str = "DMM_DIGESTS_REVERSED";
/// What the lines of a process start with, among those of the test harness.
const MARK: &str = "digest ";

/// FNV-1a of 64 bits (Fowler, Noll & Vo 1991): the standard library's hash may change.
fn fnv(text: &str) -> u64 {
    text.bytes().fold(0xCBF2_9CE4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3)
    })
}

/// `name, digest of the Rust, digest of the listing`
fn digest(sample: &Sample) -> String {
    let tokens: TokenStream = sample.source.parse().expect("tokens");
    let rust = compile(tokens.clone()).to_string();
    let listing = explain(tokens).unwrap_or_else(|messages| messages.join("\n"));
    format!(
        "{:<28} rust {:016x} listing {:016x}",
        sample.name,
        fnv(&rust),
        fnv(&listing)
    )
}

/// Problems and corpus have some names in common, so the former are marked.
fn samples() -> Vec<Sample> {
    let mut samples = corpus::problems();
    for sample in &mut samples {
        sample.name.insert_str(0, "problems/");
    }
    samples.extend(corpus::sound());
    samples.extend(corpus::wrong());
    samples.extend(corpus::open());
    samples
}

/// The digests by name, compiled in the order of the samples or backwards.
fn digests(reversed: bool) -> Vec<String> {
    let mut samples = samples();
    if reversed {
        samples.reverse();
    }
    let mut lines: Vec<String> = samples.iter().map(digest).collect();
    lines.sort();
    lines
}

fn file() -> PathBuf {
    corpus::package().join("tests/determinism/digests.txt")
}

/// The lines of two lists that differ.
fn difference(left: &[String], right: &[String]) -> String {
    let name = |line: &&String| line.split(' ').next().unwrap_or_default().to_owned();
    let [left, right]: [BTreeMap<String, &String>; 2] =
        [left, right].map(|lines| lines.iter().map(|line| (name(&line), line)).collect());
    let names = left.keys().chain(right.keys());
    let differing: BTreeMap<&String, String> = names
        .filter(|name| left.get(*name) != right.get(*name))
        .map(|name| (name, format!("{:?}\n{:?}", left.get(name), right.get(name))))
        .collect();
    differing.into_values().collect::<Vec<_>>().join("\n")
}

#[test]
fn every_profile_gives_the_committed_digests() {
    let here = digests(false);
    if env::var_os("DMM_UPDATE_DIGESTS").is_some() {
        fs::write(file(), here.join("\n") + "\n").expect("a writable file");
    }
    let committed: Vec<String> = corpus::read(&file()).lines().map(str::to_owned).collect();
    assert!(
        here == committed,
        "what is emitted has changed; if it was meant to, run this test with \
         DMM_UPDATE_DIGESTS=1 and read the snapshots\n{}",
        difference(&here, &committed)
    );
}

#[test]
fn separate_processes_give_the_same_digests() {
    let runs = [false, true].map(|reversed| {
        let mut command = Command::new(env::current_exe().expect("this test's path"));
        command.args(["--exact", "print_digests", "--ignored", "--nocapture"]);
        command.env_remove(REVERSED);
        if reversed {
            command.env(REVERSED, "1");
        }
        let output = command.output().expect("this test runs");
        assert!(output.status.success(), "{output:?}");
        let text = String::from_utf8(output.stdout).expect("the digests are text");
        let lines = text.lines().filter_map(|line| line.split_once(MARK));
        lines.map(|(_, line)| line.to_owned()).collect::<Vec<_>>()
    });
    let [forwards, backwards] = runs;
    assert_eq!(forwards.len(), samples().len());
    assert!(
        forwards == backwards,
        "{}",
        difference(&forwards, &backwards)
    );
}

#[test]
#[ignore = "it prints what the test of separate processes compares"]
fn print_digests() {
    for line in digests(env::var_os(REVERSED).is_some()) {
        println!("{MARK}{line}");
    }
}
