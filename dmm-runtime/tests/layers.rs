//! The folders of the library are layers: what a file imports lies in its own layer or below.

use std::fs;
use std::path::Path;

/// From the bottom to the top.
const LAYERS: [&str; 20] = [
    "error",
    "arithmetic",
    "special",
    "series",
    "contract",
    "tape",
    "expansion",
    "events",
    "level",
    "method",
    "output",
    "driver",
    "sensitivity",
    "ensemble",
    "dynamic",
    "model",
    "guide",
    "rules",
    "language",
    "lib",
];

/// The modules of the crate that a line of code names.
fn imports(line: &str) -> impl Iterator<Item = &str> {
    let code = line.split("//").next().unwrap_or_default();
    let paths = code.split("crate::").skip(1);
    paths.map(|path| {
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
    // what a macro names is imported where it is called
    let lines = text.lines().filter(|line| !line.contains("$crate::"));
    for import in lines.flat_map(imports) {
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
    for (layer, name) in LAYERS.iter().enumerate() {
        for path in [source.join(name), source.join(format!("{name}.rs"))] {
            if path.exists() {
                count += check(layer, &path);
            }
        }
    }
    assert!(count > 200, "{count}");
    // nothing lies outside of the layers
    for entry in fs::read_dir(&source).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().and_then(|name| name.to_str());
        let is_layer = name.is_some_and(|name| LAYERS.contains(&name));
        assert!(is_layer || name == Some("support"), "{}", path.display());
    }
}
