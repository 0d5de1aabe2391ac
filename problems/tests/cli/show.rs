//! `pws show` on problems and on a user's own files.

use std::fs;
use std::path::{Path, PathBuf};

use super::{pws, refusal, said, texts};

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
    let text = said(&["show", "elliptic"]);
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
    let text = said(&["show", alone.to_str().unwrap()]);
    assert!(text.contains("f^τ[y] = -k*(x₁ + x₀)/2"), "{text}");
    let second = OSCILLATOR.replace("Oscillator", "Second");
    let rust = format!(
        "use dmm_runtime::pws;\nmod a {{ pws! {{ {OSCILLATOR} }} }}\npws! {{ {second} }}\n"
    );
    let path = file(folder.path(), "two.rs", &rust);
    let text = said(&["show", path.to_str().unwrap()]);
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
    let [text, errors] = texts(pws(&["show", shown]), 2);
    assert_eq!(text, "");
    assert!(errors.contains(&format!("--> {shown}:4:15\n")), "{errors}");
    assert!(errors.contains(&format!("--> {shown}:6:19\n")), "{errors}");
    let underlined = "\n6 |     der(y) = -k * z;\n  |                   ^\n";
    assert!(errors.contains(underlined), "{errors}");
    let [before, last] = errors
        .trim_end()
        .rsplit_once('\n')
        .map(<[&str; 2]>::from)
        .unwrap();
    assert!(before.starts_with("error: "), "{errors}");
    assert!(
        last.starts_with(&format!("pws: 2 errors in {shown} (`pws explain PWS")),
        "{errors}"
    );
}

#[test]
fn what_is_not_used_is_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let unused = OSCILLATOR.replace("k = 1;", "k = 1, damping = 0;");
    let path = file(folder.path(), "unused.pws", &unused);
    let shown = path.to_str().unwrap();
    let [text, warnings] = texts(pws(&["show", shown]), 0);
    assert!(text.contains("what is known"), "{text}");
    let expected = "warning: the parameter `damping` is never used";
    assert!(warnings.starts_with(expected), "{warnings}");
    assert!(
        warnings.contains(&format!("--> {shown}:3:18\n")),
        "{warnings}"
    );
    assert_eq!(warnings.matches("warning:").count(), 1, "{warnings}");
    let out = folder.path().to_str().unwrap();
    let [_, warnings] = texts(
        pws(&["run", shown, "--initial", "x=1", "--end", "1", "--out", out]),
        0,
    );
    assert_eq!(warnings.matches("warning:").count(), 1, "{warnings}");
}

#[test]
fn files_that_declare_nothing_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (text, expected) in [("fn main() {}", "declares no system"), ("\n  )", ":2:3\n")] {
        let path = file(folder.path(), "other.rs", text);
        let [_, errors] = texts(pws(&["show", path.to_str().unwrap()]), 2);
        assert!(errors.contains(expected), "{errors}");
    }
    assert!(refusal(&["show", "missing.rs"]).contains("cannot read missing.rs"));
}

#[test]
fn latex_of_a_problem_and_of_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path(), "oscillator.pws", OSCILLATOR);
    for what in ["elliptic", path.to_str().unwrap()] {
        let text = said(&["show", what, "--latex"]);
        assert!(
            text.is_ascii() && text.contains(r"\begin{align*}"),
            "{text}"
        );
    }
}

#[test]
fn show_prints_declaration_and_scheme() {
    let text = said(&["show", "elliptic"]);
    assert!(text.contains("der(y) = 3 * x^2 + a_inside;"));
    assert!(text.contains("discrete vector field f^τ"));
    assert!(text.contains("skew pairing"));
}

/// What is printed can be pasted into the declaration.
#[test]
fn invariants_are_found_and_accepted() {
    let text = said(&["show", "pendulum", "--find-invariants", "2"]);
    assert!(text.contains("in all regions:\n    none up to degree 2"));
    assert!(
        text.contains("in the region `left`:\n    conserved invariant_1 = p^2 - 2*k_left*cos(q);")
    );

    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("duffing.pws");
    let system = "system Duffing { state x, v; der(x) = v; der(v) = -x - x^3; ";
    fs::write(&file, format!("{system} }}")).unwrap();
    let path = file.to_str().unwrap();
    let text = said(&["show", path, "--find-invariants", "4"]);
    let found = text
        .lines()
        .find(|line| line.contains("conserved"))
        .unwrap();
    assert_eq!(found.trim(), "conserved invariant_1 = 2*x^2 + 2*v^2 + x^4;");
    fs::write(&file, format!("{system} {found} }}")).unwrap();
    assert!(said(&["show", path]).contains("invariant_1"));

    for degree in ["0", "-1", "two", "1.5"] {
        let option = format!("--find-invariants={degree}");
        assert!(refusal(&["show", path, &option]).contains("--find-invariants"));
    }
    let refused = refusal(&["show", "fput_chain_32", "--find-invariants", "3"]);
    assert!(refused.contains("ask for a degree up to 2"));
    fs::write(&file, "system S { state x; der(x) = y; }").unwrap();
    let [_, text] = texts(pws(&["show", path, "--find-invariants", "2"]), 2);
    assert!(
        text.contains("error: `y` is not declared") && text.contains("duffing.pws:1:30\n"),
        "{text}"
    );
}
