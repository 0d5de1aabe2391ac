//! The README's example is the program `quickstart`, and what it shows is what comes out.

use std::process::Command;

const README: &str = include_str!("../../README.md");

/// The first block of the README fenced as `language`.
fn block(language: &str) -> &'static str {
    let fence = format!("```{language}\n");
    let start = README.find(&fence).map(|at| at + fence.len());
    let rest = &README[start.expect("the README has such a block")..];
    &rest[..rest.find("```").expect("the block ends")]
}

#[test]
fn the_example_is_the_quickstart() {
    assert_eq!(block("rust"), include_str!("../src/bin/quickstart.rs"));
}

#[test]
fn the_output_is_what_comes_out() {
    let output = Command::new(env!("CARGO_BIN_EXE_quickstart"))
        .output()
        .unwrap();
    assert!(output.status.success());
    assert_eq!(block("text"), String::from_utf8(output.stdout).unwrap());
}

#[test]
fn the_larger_system_compiles() {
    let tokens: proc_macro2::TokenStream = block("pws").parse().unwrap();
    let listing = dmm_compiler::explain(tokens).unwrap();
    assert!(listing.contains("momentum") && listing.contains("energy"));
}

#[test]
fn the_picture_is_there() {
    for line in README.lines().filter(|line| line.starts_with("![")) {
        let path = line.split(['(', ')']).nth(1).unwrap();
        let file = format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"));
        assert!(std::path::Path::new(&file).is_file(), "{path}");
    }
}

#[test]
fn the_message_is_what_the_macro_says() {
    let wrong = block("rust").replace("(y^2 + k_below * x^2) / 2", "(y^2 + x^2) / 2");
    let declaration = wrong
        .split_once("pws! {")
        .and_then(|(_, rest)| rest.split_once("\n}\n"))
        .map(|(declaration, _)| declaration)
        .expect("the example declares a system");
    let tokens: proc_macro2::TokenStream = declaration.parse().unwrap();
    let messages = dmm_compiler::explain(tokens).unwrap_err();
    let shown = block("console").trim_start_matches("error: ").trim_end();
    assert_eq!(messages, [shown]);
}

#[test]
fn the_rules_name_tests_that_are_there() {
    let rules = include_str!("../../dmm-runtime/src/rules.rs");
    let rows = rules.lines().filter_map(|line| line.strip_prefix("//! | "));
    let last = rows.filter_map(|row| row.trim_end_matches(" |").rsplit(" | ").next());
    let names: Vec<&str> = last
        .flat_map(|cell| cell.split('`').skip(1).step_by(2))
        .collect();
    assert!(names.len() > 30, "{names:?}");
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut tests = String::new();
    let mut folders = vec![root.join("tests"), root.join("long/tests")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                tests += &std::fs::read_to_string(path).unwrap_or_default();
            }
        }
    }
    for name in names {
        assert!(tests.contains(&format!("fn {name}()")), "{name}");
    }
}
