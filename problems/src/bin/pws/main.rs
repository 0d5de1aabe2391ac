//! `pws`: runs the reference problems and the studies on them.
//!
//! Results are CSV files and pictures in a directory, with a record of what they are results of;
//! tables and summaries go to standard output. What is wrong is one line on standard error, for
//! errors in a declaration with the source before it: exit status 2 if the request was wrong
//! (options, names, files), 1 if the integration stopped before its end, 130 if Ctrl-C ended it.

mod bench;
mod conserve;
mod converge;
mod directory;
mod ensemble;
mod explain;
mod failure;
mod file;
mod help;
mod input;
mod interrupt;
mod invariants;
mod list;
mod mode;
mod output;
mod paper;
mod portrait;
mod progress;
mod run;
mod scheme;
mod series;
mod show;
mod stress;

use std::io::Write;
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand};

use crate::failure::Failure;

/// Conservative integration of piecewise-smooth systems: reference problems and studies.
#[derive(Parser)]
#[command(name = "pws", version)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// List the problems.
    List,
    /// Show a problem: declaration, multipliers, discrete vector field and chosen strategy.
    #[command(after_help = help::problems())]
    Show(show::Arguments),
    /// Explain an error of `pws!` by its number: cause and remedy.
    Explain(explain::Arguments),
    /// Integrate a problem; write points, transitions and pictures.
    #[command(after_help = help::problems())]
    Run(run::Arguments),
    /// Integrate a problem from many initial states and parameters; write where they end.
    #[command(after_help = help::problems())]
    Ensemble(ensemble::Arguments),
    /// Measure errors against the step size, before and after transitions.
    #[command(after_help = help::problems())]
    Converge(converge::Arguments),
    /// Measure how well every problem's conserved quantities are kept over a long run.
    #[command(after_help = help::problems())]
    Conserve(conserve::Arguments),
    /// Measure the time of every scheme against its final error.
    #[command(after_help = help::problems())]
    Bench(bench::Arguments),
    /// Push every scheme to the edge of what it can do.
    Stress(stress::Arguments),
    /// Reproduce Figs 2-8 of Hirani, Wan & Wojtalewicz, or with `--fesd` those of Nurkanović, Sperl,
    /// Albrecht & Diehl.
    Paper(paper::Arguments),
}

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return refuse(&error),
    };
    let result = match &arguments.command {
        Command::List => list::list(),
        Command::Show(arguments) => show::show(arguments),
        Command::Explain(arguments) => explain::explain(arguments),
        Command::Run(arguments) => run::run(arguments),
        Command::Ensemble(arguments) => ensemble::ensemble(arguments),
        Command::Converge(arguments) => converge::converge(arguments),
        Command::Conserve(arguments) => conserve::conserve(arguments),
        Command::Bench(arguments) => bench::bench(arguments),
        Command::Stress(arguments) => stress::stress(arguments),
        Command::Paper(arguments) => paper::paper(arguments),
    };
    match result {
        Ok(()) | Err(Failure::ReaderGone) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("pws: {failure}");
            ExitCode::from(failure.status())
        }
    }
}

/// Help goes to standard output as `clap` prints it; a bad option becomes one line.
fn refuse(error: &clap::Error) -> ExitCode {
    if matches!(
        error.kind(),
        ErrorKind::DisplayHelp
            | ErrorKind::DisplayVersion
            | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand
    ) {
        let printed = error.print().and_then(|()| std::io::stdout().flush());
        return match printed.map_err(Failure::from) {
            Ok(()) | Err(Failure::ReaderGone) => {
                ExitCode::from(if error.use_stderr() { 2 } else { 0 })
            }
            Err(failure) => {
                eprintln!("pws: {failure}");
                ExitCode::from(failure.status())
            }
        };
    }
    let text = error.to_string();
    let paragraphs = text.split("\n\n").map(str::trim);
    let said: Vec<String> = paragraphs
        .filter(|paragraph| !paragraph.starts_with("Usage:") && !paragraph.starts_with("For more"))
        .map(|paragraph| paragraph.split_whitespace().collect::<Vec<_>>().join(" "))
        .filter(|paragraph| !paragraph.is_empty())
        .collect();
    let mut said = said.join("; ");
    if error.kind() == ErrorKind::InvalidSubcommand {
        let command = Arguments::command();
        let names: Vec<&str> = command
            .get_subcommands()
            .map(clap::Command::get_name)
            .collect();
        said.push_str(&format!(" (there are {})", names.join(", ")));
    }
    eprintln!("pws: {}", said.strip_prefix("error: ").unwrap_or(&said));
    ExitCode::from(2)
}
