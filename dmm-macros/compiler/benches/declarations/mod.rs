//! The declarations in Rust sources.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};

/// Where the problems of this repository are declared.
pub(crate) fn problems() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../problems/src/systems")
}

/// The bodies of every `pws! { … }` in the sources under `path`, in the order of the files'
/// names, each with the file that it is in.
pub(crate) fn declarations(path: &Path) -> Result<Vec<(PathBuf, TokenStream)>, Box<dyn Error>> {
    let mut files = Vec::new();
    collect(path, &mut files).map_err(|error| format!("{}: {error}", path.display()))?;
    let mut found = Vec::new();
    for file in files {
        let tokens: TokenStream = fs::read_to_string(&file)?
            .parse()
            .map_err(|error| format!("{}: {error}", file.display()))?;
        let mut bodies = Vec::new();
        find(tokens, &mut bodies);
        found.extend(bodies.into_iter().map(|body| (file.clone(), body)));
    }
    Ok(found)
}

/// The Rust sources under `path`, in the order of their names.
fn collect(path: &Path, files: &mut Vec<PathBuf>) -> std::io::Result<()> {
    if path.is_dir() {
        let mut entries = fs::read_dir(path)?
            .map(|entry| entry.map(|entry| entry.path()))
            .collect::<Result<Vec<PathBuf>, _>>()?;
        entries.sort();
        for entry in entries {
            collect(&entry, files)?;
        }
    } else if path.extension().is_some_and(|extension| extension == "rs") {
        files.push(path.to_owned());
    } else {
        fs::metadata(path)?;
    }
    Ok(())
}

/// The bodies of `pws! { … }`, however deep they stand.
fn find(tokens: TokenStream, found: &mut Vec<TokenStream>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for (index, token) in tokens.iter().enumerate() {
        let TokenTree::Group(group) = token else {
            continue;
        };
        let before = |back: usize| {
            index
                .checked_sub(back)
                .map(|position| tokens[position].to_string())
        };
        if before(1).as_deref() == Some("!") && before(2).as_deref() == Some("pws") {
            found.push(group.stream());
        } else {
            find(group.stream(), found);
        }
    }
}
