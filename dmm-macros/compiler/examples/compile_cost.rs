//! What `pws!` costs: the time of every stage for every declaration in some Rust sources.
//!
//! ```text
//! cargo run -p dmm-compiler --example compile_cost [FILE | DIRECTORY]...
//! ```
//!
//! Without arguments, the problems of this repository, and then `cargo check` of them with
//! everything that they depend on already built. Users' macros run unoptimised, even in release
//! builds, so the default profile is the one to measure.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use dmm_compiler::diagnostics::Diagnostics;
use dmm_compiler::{check, emit, proofs, scheme, syntax};
use proc_macro2::{TokenStream, TokenTree};

/// Each declaration is compiled this often; the fastest run counts.
const RUNS: usize = 5;

fn main() -> Result<(), Box<dyn Error>> {
    let mut paths: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let problems = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../problems");
    let own_problems = paths.is_empty();
    if own_problems {
        paths.push(problems.join("src/systems"));
    }
    let mut files = Vec::new();
    for path in paths {
        collect(&path, &mut files).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    println!(
        "{:<24} {:>6} {:>4} {:>6} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7}",
        "system", "states", "ψ", "nodes", "parse", "check", "prove", "derive", "emit", "total"
    );
    for file in files {
        let tokens: TokenStream = fs::read_to_string(&file)?
            .parse()
            .map_err(|error| format!("{}: {error}", file.display()))?;
        let mut declarations = Vec::new();
        find_declarations(tokens, &mut declarations);
        for declaration in declarations {
            let costs = (0..RUNS)
                .map(|_| measure(declaration.clone()))
                .collect::<Result<Vec<Cost>, String>>()
                .map_err(|error| format!("{}: {error}", file.display()))?;
            if let Some(cost) = costs.into_iter().min_by_key(Cost::total) {
                println!("{}", cost.row());
            }
        }
    }
    println!("\ntimes in ms, the fastest of {RUNS} runs");
    if own_problems {
        cargo_check(&problems)?;
        let start = Instant::now();
        fs::File::options()
            .append(true)
            .open(problems.join("src/lib.rs"))?
            .set_modified(std::time::SystemTime::now())?;
        cargo_check(&problems)?;
        println!(
            "cargo check of the problems, dependencies built: {:.1?}",
            start.elapsed()
        );
    }
    Ok(())
}

/// `cargo check` of the package at `directory`.
fn cargo_check(directory: &Path) -> Result<(), Box<dyn Error>> {
    let status = std::process::Command::new(env!("CARGO"))
        .args(["check", "--quiet", "--lib"])
        .current_dir(directory)
        .status()?;
    status
        .success()
        .then_some(())
        .ok_or_else(|| "cargo check failed".into())
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
fn find_declarations(tokens: TokenStream, found: &mut Vec<TokenStream>) {
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
            find_declarations(group.stream(), found);
        }
    }
}

/// The times of the stages on one declaration.
struct Cost {
    name: String,
    states: usize,
    conserved: usize,
    nodes: usize,
    stages: [Duration; 5],
}

impl Cost {
    fn total(&self) -> Duration {
        self.stages.iter().sum()
    }

    fn row(&self) -> String {
        let times: String = self
            .stages
            .iter()
            .chain([&self.total()])
            .map(|time| format!(" {:>7.2}", 1e3 * time.as_secs_f64()))
            .collect();
        let Self {
            name,
            states,
            conserved,
            nodes,
            ..
        } = self;
        format!("{name:<24} {states:>6} {conserved:>4} {nodes:>6}{times}")
    }
}

fn measure(input: TokenStream) -> Result<Cost, String> {
    let mut diagnostics = Diagnostics::new();
    let mut clock = Clock::new();
    let declaration = syntax::parse(input, &mut diagnostics);
    clock.lap(0);
    let model = declaration
        .filter(|_| diagnostics.is_empty())
        .and_then(|declaration| check::resolve(declaration, &mut diagnostics));
    clock.lap(1);
    let model = model.map(|mut model| {
        proofs::check(&mut model, &mut diagnostics);
        model
    });
    clock.lap(2);
    let scheme = model
        .filter(|_| diagnostics.is_empty())
        .and_then(|model| scheme::derive(model, &mut diagnostics));
    clock.lap(3);
    let tokens = scheme.as_ref().map(emit::rust);
    clock.lap(4);
    match (scheme, tokens) {
        (Some(scheme), Some(_)) => Ok(Cost {
            name: scheme.model.name.to_string(),
            states: scheme.model.states.len(),
            conserved: scheme
                .regions
                .iter()
                .map(|region| region.multiplier.len())
                .sum(),
            nodes: scheme.dag().len(),
            stages: clock.laps,
        }),
        _ => Err(diagnostics.messages().join("\n")),
    }
}

/// Times of stages that follow each other.
struct Clock {
    last: Instant,
    laps: [Duration; 5],
}

impl Clock {
    fn new() -> Self {
        Self {
            last: Instant::now(),
            laps: [Duration::ZERO; 5],
        }
    }

    fn lap(&mut self, stage: usize) {
        let now = Instant::now();
        self.laps[stage] = now - self.last;
        self.last = now;
    }
}
