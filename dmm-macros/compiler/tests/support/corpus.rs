//! The declarations that the tests are about: the files under `tests/declarations`, and the
//! problems of this repository.

#![allow(
    dead_code,
    reason = "every test that includes this module uses a part of it"
)]

use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};

/// A declaration in the corpus.
#[derive(Debug, Clone)]
pub(crate) struct Sample {
    /// The name of its file, or the module of the problem.
    pub(crate) name: String,
    /// What stands between the braces of `pws!`.
    pub(crate) source: String,
}

/// Declarations that hold.
pub(crate) fn sound() -> Vec<Sample> {
    declarations("sound")
}

/// Declarations with a quantity that is not conserved.
pub(crate) fn wrong() -> Vec<Sample> {
    declarations("wrong")
}

/// Declarations that claim what may be true and is hard to prove.
pub(crate) fn open() -> Vec<Sample> {
    declarations("open")
}

/// The problems of this repository.
pub(crate) fn problems() -> Vec<Sample> {
    let mut samples = Vec::new();
    for file in files(&package().join("../../problems/src/systems"), "rs") {
        let tokens: TokenStream = read(&file).parse().expect("the problems are Rust");
        let mut bodies = Vec::new();
        find(tokens, &mut bodies);
        for body in bodies {
            samples.push(Sample {
                name: stem(&file),
                source: body.to_string(),
            });
        }
    }
    assert!(!samples.is_empty(), "the problems have moved");
    samples
}

/// Everything that compiles: the problems, and the declarations that hold.
pub(crate) fn all_sound() -> Vec<Sample> {
    let mut samples = problems();
    samples.extend(sound());
    samples
}

/// The directory of this package.
pub(crate) fn package() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The files in `directory` with this extension, by name.
pub(crate) fn files(directory: &Path, extension: &str) -> Vec<PathBuf> {
    let entries =
        fs::read_dir(directory).unwrap_or_else(|error| panic!("{}: {error}", directory.display()));
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("a readable directory").path())
        .filter(|path| path.extension().is_some_and(|found| found == extension))
        .collect();
    files.sort();
    files
}

/// The text of a file.
pub(crate) fn read(file: &Path) -> String {
    fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// The name of a file without its directory and extension.
pub(crate) fn stem(file: &Path) -> String {
    file.file_stem()
        .map(|stem| stem.to_string_lossy().into_owned())
        .unwrap_or_default()
}

fn declarations(kind: &str) -> Vec<Sample> {
    let directory = package().join("tests/declarations").join(kind);
    files(&directory, "pws")
        .iter()
        .map(|file| Sample {
            name: stem(file),
            source: read(file),
        })
        .collect()
}

/// The bodies of `pws! { … }`, however deep they stand.
fn find(tokens: TokenStream, bodies: &mut Vec<TokenStream>) {
    let mut before = [String::new(), String::new()];
    for token in tokens {
        if let TokenTree::Group(group) = &token {
            if before == ["pws", "!"] {
                bodies.push(group.stream());
            } else {
                find(group.stream(), bodies);
            }
        }
        before.swap(0, 1);
        before[1] = token.to_string();
    }
}
