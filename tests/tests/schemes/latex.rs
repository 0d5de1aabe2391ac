//! The listing as LaTeX: well formed, ASCII, and compiled where there is a compiler.

use std::process::Command;

use dmm_compiler::emit;
use dmm_problems::registry;

use crate::declaration;

fn fragments() -> Vec<(&'static str, String)> {
    registry::all()
        .iter()
        .map(|problem| {
            let scheme = dmm_compiler::read(declaration(problem)).expect("a problem compiles");
            (problem.description().name, emit::latex(&scheme))
        })
        .collect()
}

/// What is wrong with a fragment: characters, braces, environments, pairs of delimiters, `$`.
fn flaw(fragment: &str) -> Option<String> {
    if let Some(letter) = fragment.chars().find(|letter| !letter.is_ascii()) {
        return Some(format!("{letter:?} is not ASCII"));
    }
    let mut open: Vec<String> = Vec::new();
    let mut in_formula = false;
    for (number, line) in fragment.lines().enumerate() {
        let at = |what: &str| Some(format!("line {}: {what}: {line}", number + 1));
        if line.starts_with('%') {
            continue;
        }
        let displayed = open.iter().any(|one| one == "align*");
        let mut rest = line;
        while let Some(letter) = rest.chars().next() {
            let mut length = 1;
            match letter {
                '\\' => {
                    let word: usize = rest[1..]
                        .bytes()
                        .take_while(u8::is_ascii_alphabetic)
                        .count();
                    length = 1 + word.max(1);
                    let command = &rest[..length];
                    let name = || rest[length..].split(['{', '}']).nth(1).unwrap_or_default();
                    match command {
                        "\\begin" => open.push(name().to_owned()),
                        "\\end" if open.pop().as_deref() != Some(name()) => {
                            return at("environment");
                        }
                        "\\left" => open.push("left".into()),
                        "\\right" if open.pop().as_deref() != Some("left") => return at("\\right"),
                        _ => {}
                    }
                }
                '{' => open.push("{".into()),
                '}' if open.pop().as_deref() != Some("{") => return at("brace"),
                '$' => in_formula = !in_formula,
                '_' | '^' if !in_formula && !displayed => return at("script outside a formula"),
                '&' if !displayed => return at("unescaped &"),
                '#' | '%' | '~' if displayed => return at("unescaped character"),
                _ => {}
            }
            rest = &rest[length..];
        }
        if in_formula {
            return at("$");
        }
    }
    open.pop().map(|one| format!("{one} is not closed"))
}

#[test]
fn fragments_are_well_formed() {
    for (name, fragment) in fragments() {
        assert_eq!(flaw(&fragment), None, "{name}");
    }
}

#[test]
fn flaws_are_seen() {
    for wrong in [
        "{",
        "}",
        "\\begin{x}",
        "a_1",
        "$a",
        "é",
        "\\begin{a}\\end{b}",
        "a & b",
        "\\left(",
    ] {
        assert!(flaw(wrong).is_some(), "{wrong}");
    }
    assert_eq!(
        flaw("\\begin{align*}\na_{1} &= \\{b\\} \\\\\n\\end{align*} a\\_1 $x^2$"),
        None
    );
}

/// Runs `pdflatex` if there is one; without it there is nothing to compare with.
#[test]
fn fragments_compile() {
    if Command::new("pdflatex").arg("--version").output().is_err() {
        eprintln!("no pdflatex: not compiled");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    for (name, fragment) in fragments() {
        let document = format!(
            "\\documentclass{{article}}\\usepackage{{amsmath}}\n\\begin{{document}}\n{fragment}\\end{{document}}\n"
        );
        let file = format!("{name}.tex");
        std::fs::write(folder.path().join(&file), document).unwrap();
        let output = Command::new("pdflatex")
            .args(["-interaction=nonstopmode", "-halt-on-error", &file])
            .current_dir(folder.path())
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{name}: {said}");
    }
}
