//! The files of the library are layers: what a file imports stands before it.

use std::fs;
use std::path::Path;

/// From the bottom to the top.
const LAYERS: [&str; 19] = [
    "declaration",
    "random",
    "threads",
    "fit",
    "growth",
    "standard",
    "perturbed",
    "method",
    "problem",
    "systems",
    "registry",
    "reference",
    "accurate",
    "truth",
    "conservation",
    "convergence",
    "work_precision",
    "stress",
    "lib",
];

/// The modules that a text names after `crate::`; tests may name what they like.
fn imports(text: &str) -> impl Iterator<Item = &str> {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    lines
        .flat_map(|line| line.split("crate::").skip(1))
        .map(|path| {
            let end = path.find(|c: char| !(c.is_alphanumeric() || c == '_'));
            &path[..end.unwrap_or(path.len())]
        })
}

/// Checks the files of a layer; returns how many imports there are.
fn check(layer: usize, path: &Path) -> usize {
    if path.is_dir() {
        let entries = fs::read_dir(path).expect("a folder");
        return entries
            .map(|entry| check(layer, &entry.expect("an entry").path()))
            .sum();
    }
    let text = fs::read_to_string(path).expect("a file");
    let mut count = 0;
    for import in imports(&text) {
        let below = LAYERS.iter().position(|other| *other == import);
        let below = below.unwrap_or_else(|| panic!("{}: crate::{import}", path.display()));
        assert!(below <= layer, "{} imports {import}", path.display());
        count += 1;
    }
    count
}

#[test]
fn imports_go_down() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut count = 0;
    for entry in fs::read_dir(&source).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().and_then(|name| name.to_str());
        let layer = LAYERS.iter().position(|layer| Some(*layer) == name);
        match layer {
            Some(layer) => count += check(layer, &path),
            None => assert_eq!(name, Some("bin"), "{}", path.display()),
        }
    }
    assert!(count > 60, "{count}");
}
