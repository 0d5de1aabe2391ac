//! `pws show PROBLEM`

use std::io::Write;

use crate::failure::Failure;
use crate::input;

/// What to show.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Name of the problem (see `pws list`).
    problem: String,
}

/// Prints the declaration and the derived scheme.
pub(crate) fn show(arguments: &Arguments) -> Result<(), Failure> {
    let problem = input::problem(&arguments.problem, &[])?;
    let card = problem.card();
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "{}: {}\nsource: {}",
        card.name, card.title, card.source
    )?;
    let states = problem.states().iter().zip(card.initial);
    let start: Vec<String> = states
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    writeln!(out, "start at t = 0: {}", start.join(", "))?;
    let parameters = problem.parameters();
    if !parameters.is_empty() {
        let values: Vec<String> = parameters
            .iter()
            .map(|(name, value)| format!("{name} = {value}"))
            .collect();
        writeln!(out, "parameters: {}", values.join(", "))?;
    }
    writeln!(
        out,
        "reference solution: {}",
        match card.reference {
            Some(_) => "32 digits",
            None => "computed when needed",
        }
    )?;
    // the listing begins with the declaration
    writeln!(out, "\n{}", problem.listing().trim_end())?;
    Ok(())
}
