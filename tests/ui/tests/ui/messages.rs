//! What the compiler says to a file that does not compile.
//!
//! The compiler is called as it was for the tests themselves, with the same files of the
//! dependencies: nothing is compiled once more.

use std::env;
use std::ffi::OsStr;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What the compiler was called with for this test.
const ARGUMENTS: &[&str] = &dmm_ui_arguments::arguments!();

/// Where the workspace is from here, and this package from there.
const WORKSPACE: &str = "../..";
const PACKAGE: &str = "tests/ui";

/// Compares the messages of all files of a directory with those in the files `*.stderr` beside
/// them, or writes the latter if `UPDATE_MESSAGES` is set.
pub(crate) fn check(directory: &str) {
    let mut wrong = String::new();
    let files = files(directory, "rs");
    assert!(!files.is_empty(), "nothing in {directory}");
    for file in files {
        let expected = file.with_extension("stderr");
        let messages = messages(&file).unwrap_or_else(|| panic!("{} compiles", file.display()));
        if env::var_os("UPDATE_MESSAGES").is_some() {
            fs::write(root().join(&expected), &messages).expect("expected messages are written");
        }
        let expected = fs::read_to_string(root().join(&expected)).unwrap_or_default();
        if messages != expected {
            let name = file.display();
            let texts = format!("--- expected\n{expected}--- found\n{messages}");
            writeln!(wrong, "{name}\n{texts}").expect("a text takes more");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// The files of a directory of the package that have an extension, in the order of their names.
pub(crate) fn files(directory: &str, extension: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join(directory)).expect("a directory of the package");
    let mut files: Vec<PathBuf> = entries
        .map(|entry| Path::new(directory).join(entry.expect("a file").file_name()))
        .filter(|path| path.extension() == Some(OsStr::new(extension)))
        .collect();
    files.sort();
    files
}

/// The directory of the package.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The messages to a file, the same wherever the workspace is; nothing if the file compiles.
fn messages(file: &Path) -> Option<String> {
    let [program, arguments @ ..] = ARGUMENTS else {
        unreachable!("a command line begins with the program");
    };
    let dependencies = arguments
        .windows(2)
        .filter(|pair| ["--extern", "-L", "--target"].contains(&pair[0]));
    let output = Command::new(program)
        .args(dependencies.flatten())
        .args(["--edition=2024", "--crate-type=bin", "--emit=metadata"])
        .args(["--color=never", "--diagnostic-width=140", "--verbose"])
        .args(["--out-dir", env!("CARGO_TARGET_TMPDIR")])
        .arg(Path::new(PACKAGE).join(file))
        // where other files of the workspace have the names that they were compiled by
        .current_dir(root().join(WORKSPACE))
        .output()
        .expect("the compiler");
    let text = String::from_utf8(output.stderr).expect("messages in UTF-8");
    (!output.status.success()).then(|| normalised(&text))
}

/// Messages without how many there are, and without numbers of lines of other files than that which
/// does not compile.
fn normalised(text: &str) -> String {
    let mut normalised = String::new();
    // whether lines of another file are shown
    let mut is_other = false;
    for line in text.lines() {
        if ENDS.iter().any(|end| line.starts_with(end)) {
            continue;
        }
        if let Some((before, place)) = line.split_once("--> ") {
            let own = place.strip_prefix(PACKAGE);
            let own = own.and_then(|place| place.strip_prefix('/'));
            is_other = own.is_none();
            let place = match own {
                Some(place) => place.to_owned(),
                None => {
                    let path = place.split(':').next().unwrap_or_default();
                    format!("$WORKSPACE/{path}")
                }
            };
            normalised.push_str(&format!("{before}--> {place}\n"));
            continue;
        }
        let digits = line.len() - line.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        is_other &= digits > 0 || line.starts_with([' ', '.']);
        if is_other {
            normalised.extend(std::iter::repeat_n(' ', digits));
            normalised.push_str(&line[digits..]);
        } else {
            normalised.push_str(line);
        }
        normalised.push('\n');
    }
    format!("{}\n", normalised.trim_end())
}

/// What the compiler says of all messages together.
const ENDS: [&str; 4] = [
    "error: aborting due to ",
    "Some errors have detailed explanations: ",
    "For more information about ",
    "error: could not compile ",
];
