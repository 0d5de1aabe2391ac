//! `pws show` on problems and on a user's own files.

use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;

/// Calls `pws show`: exit status, standard output, standard error.
fn show(arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::cargo_bin("pws").unwrap();
    let output = command.arg("show").args(arguments).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

fn file(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path
}

const OSCILLATOR: &str = "system Oscillator {
    state x, y;
    param k = 1;
    der(x) = y;
    der(y) = -k * x;
    conserved energy = (y^2 + k * x^2) / 2;
}
";

#[test]
fn a_problem_from_its_declaration_to_what_is_known() {
    let (status, text, _) = show(&["elliptic"]);
    assert_eq!(status, Some(0));
    let parts = [
        "pub system Elliptic {",
        "multiplier Λ = ∇ψ",
        "discrete multiplier Λ^τ",
        "discrete vector field f^τ",
        "residual F(x₁)",
        "Jacobian ∂F/∂x₁",
        "what is known",
    ];
    let places: Vec<_> = parts.iter().map(|part| text.find(part)).collect();
    assert!(places.iter().all(Option::is_some), "{places:?}");
    assert!(places.is_sorted());
}

#[test]
fn a_declaration_and_rust_with_declarations() {
    let folder = tempfile::tempdir().unwrap();
    let alone = file(folder.path(), "oscillator.pws", OSCILLATOR);
    let (status, text, _) = show(&[alone.to_str().unwrap()]);
    assert_eq!(status, Some(0));
    assert!(text.contains("f^τ[y] = -k*(x₁ + x₀)/2"), "{text}");
    let second = OSCILLATOR.replace("Oscillator", "Second");
    let rust = format!(
        "use dmm_runtime::pws;\nmod a {{ pws! {{ {OSCILLATOR} }} }}\npws! {{ {second} }}\n"
    );
    let path = file(folder.path(), "two.rs", &rust);
    let (status, text, _) = show(&[path.to_str().unwrap()]);
    assert_eq!(status, Some(0));
    let first = text.find("system Oscillator").unwrap();
    assert!(first < text.find("system Second").unwrap());
}

#[test]
fn mistakes_are_shown_where_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let wrong = OSCILLATOR
        .replace("-k * x;", "-k * z;")
        .replace("k = 1", "k = q");
    let path = file(folder.path(), "wrong.rs", &format!("pws! {{\n{wrong}}}\n"));
    let shown = path.to_str().unwrap();
    let (status, text, errors) = show(&[shown]);
    assert_eq!((status, text.as_str()), (Some(2), ""));
    assert!(errors.contains(&format!("{shown}:4:15: ")), "{errors}");
    assert!(errors.contains(&format!("{shown}:6:19: ")), "{errors}");
    assert!(
        errors.ends_with(&format!("pws: 2 errors in {shown}\n")),
        "{errors}"
    );
}

#[test]
fn files_that_declare_nothing_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (text, expected) in [("fn main() {}", "declares no system"), ("\n  )", ":2:3: ")] {
        let path = file(folder.path(), "other.rs", text);
        let (status, _, errors) = show(&[path.to_str().unwrap()]);
        assert_eq!(status, Some(2));
        assert!(errors.contains(expected), "{errors}");
    }
    let (status, _, errors) = show(&["missing.rs"]);
    assert!(
        status == Some(2) && errors.contains("cannot read missing.rs"),
        "{errors}"
    );
}

#[test]
fn latex_of_a_problem_and_of_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path(), "oscillator.pws", OSCILLATOR);
    for what in ["elliptic", path.to_str().unwrap()] {
        let (status, text, _) = show(&[what, "--latex"]);
        assert_eq!(status, Some(0));
        assert!(
            text.is_ascii() && text.contains(r"\begin{align*}"),
            "{text}"
        );
    }
}
