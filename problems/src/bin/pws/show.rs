//! `pws show PROBLEM`, `pws show FILE`

use std::io::Write;
use std::path::Path;

use dmm_compiler::diagnostics::Diagnostics;
use dmm_compiler::emit;
use dmm_compiler::scheme::Scheme;
use dmm_problems::problem::Problem;
use proc_macro2::TokenStream;

use crate::failure::Failure;
use crate::file::Source;
use crate::input;
use crate::invariants;
use crate::output;

/// What to show.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Name of the problem (see `pws list`), or a file: Rust with `pws!` in it, or a declaration
    /// alone.
    #[arg(value_name = "PROBLEM|FILE")]
    problem: String,
    /// Write a fragment of a LaTeX document that loads amsmath.
    #[arg(long)]
    latex: bool,
    /// Find the polynomial invariants up to this degree instead, for a system whose conserved
    /// quantities are not known.
    #[arg(long, value_name = "DEGREE", conflicts_with = "latex")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    find_invariants: Option<u32>,
}

/// Prints the declaration and the derived scheme.
pub(crate) fn show(arguments: &Arguments) -> Result<(), Failure> {
    if let Some(degree) = arguments.find_invariants {
        return find_invariants(arguments, degree);
    }
    match input::own_file(&arguments.problem) {
        Some(path) => show_file(path, arguments),
        None => show_problem(&input::problem(&arguments.problem, &[])?, arguments),
    }
}

/// Prints the invariants of what is declared in a file or of a problem.
fn find_invariants(arguments: &Arguments, degree: u32) -> Result<(), Failure> {
    match input::own_file(&arguments.problem) {
        Some(path) => {
            let source = Source::read(path)?;
            let declarations = source.declarations()?;
            invariants::print(declarations, degree, |wrong| source.report(wrong))
        }
        None => {
            let problem = input::problem(&arguments.problem, &[])?;
            let declaration = tokens(&problem)?;
            invariants::print(vec![declaration], degree, |wrong| {
                let messages = wrong.iter().flat_map(|one| one.messages());
                unreadable(&problem, &messages.collect::<Vec<_>>().join("; "))
            })
        }
    }
}

fn show_file(path: &Path, arguments: &Arguments) -> Result<(), Failure> {
    let mut schemes = Vec::new();
    let mut wrong = Vec::new();
    let source = Source::read(path)?;
    for declaration in source.declarations()? {
        let mut diagnostics = Diagnostics::new();
        match dmm_compiler::read_with(declaration, &mut diagnostics) {
            Some(scheme) => {
                source.warn(&diagnostics);
                schemes.push(scheme);
            }
            None => wrong.push(diagnostics),
        }
    }
    if !wrong.is_empty() {
        return Err(source.report(&wrong));
    }
    let texts: Vec<String> = schemes
        .iter()
        .map(|scheme| listing(scheme, arguments))
        .collect();
    print(&texts.join("\n"))
}

fn listing(scheme: &Scheme, arguments: &Arguments) -> String {
    if arguments.latex {
        emit::latex(scheme)
    } else {
        emit::listing(scheme)
    }
}

fn show_problem(problem: &Problem, arguments: &Arguments) -> Result<(), Failure> {
    if arguments.latex {
        return print(&listing(&scheme(problem)?, arguments));
    }
    let description = problem.description();
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "{}: {}\nsource: {}",
        description.name, description.title, description.source
    )?;
    let start = assignments(problem.states(), description.initial);
    writeln!(out, "start at t = 0: {start}")?;
    let (names, values): (Vec<&str>, Vec<f64>) = problem.parameters().into_iter().unzip();
    if !names.is_empty() {
        writeln!(out, "parameters: {}", assignments(&names, &values))?;
    }
    writeln!(
        out,
        "reference solution: {}",
        match description.reference {
            Some(_) => "32 digits",
            None => "computed when needed",
        }
    )?;
    // the listing begins with the declaration
    writeln!(out, "\n{}", problem.listing().trim_end())?;
    Ok(())
}

/// `x = 1, q = [0, 1, 2]`
fn assignments(names: &[&str], values: &[f64]) -> String {
    let groups = output::groups(names).into_iter().map(|(group, places)| {
        let is_group = names[places.start].contains('[');
        let values: Vec<String> = values[places].iter().map(f64::to_string).collect();
        if is_group {
            format!("{group} = [{}]", values.join(", "))
        } else {
            format!("{group} = {}", values.concat())
        }
    });
    groups.collect::<Vec<String>>().join(", ")
}

/// The scheme of a problem, derived from its declaration once more.
fn scheme(problem: &Problem) -> Result<Scheme, Failure> {
    dmm_compiler::read(tokens(problem)?)
        .map_err(|diagnostics| unreadable(problem, &diagnostics.messages().join("; ")))
}

/// The declaration of a problem.
fn tokens(problem: &Problem) -> Result<TokenStream, Failure> {
    let declaration = problem.declaration().parse();
    declaration.map_err(|error: proc_macro2::LexError| unreadable(problem, &error.to_string()))
}

fn unreadable(problem: &Problem, messages: &str) -> Failure {
    let name = problem.description().name;
    Failure::Stopped(format!("{name} does not compile: {messages}"))
}

fn print(text: &str) -> Result<(), Failure> {
    writeln!(std::io::stdout().lock(), "{}", text.trim_end())?;
    Ok(())
}
