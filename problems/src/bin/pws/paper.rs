//! `pws paper`: Figs 2–8 of Hirani, Wan & Wojtalewicz, *Conservative integrators for piecewise
//! smooth systems with transversal dynamics*, with their numbers beside ours.
//!
//! The paper gives neither the times it integrates to nor the sizes of its perturbations; ours
//! are chosen here: 30 transitions, and a crossing located too late by c·τᵖ.
//!
//! `pws paper --fesd`: those of another paper, see [`fesd`].

mod conserved;
mod fesd;
mod orders;
mod report;
mod trajectories;

use serde_json::{Value, json};

use crate::directory::DirectoryOptions;
use crate::failure::Failure;
use crate::input::FormatOption;
use crate::interrupt;
use crate::output::Table;
use crate::progress::Progress;
use report::{CONSERVED, Report, STATES, SYSTEMS, TIMES, TRAJECTORIES};

/// Which, and where to.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Reproduce Figs 5, 8, 9 and Example 3 of Nurkanović, Sperl, Albrecht & Diehl instead: the orders
    /// of Runge-Kutta methods with and without detection of switches.
    #[arg(long)]
    fesd: bool,
    /// The same with fewer points, in a few seconds.
    #[arg(long, requires = "fesd")]
    brief: bool,
    #[command(flatten)]
    directory: DirectoryOptions,
    /// How pictures are stored.
    #[arg(long, value_enum, default_value = "svg")]
    format: FormatOption,
}

/// Makes all figures.
pub(crate) fn paper(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.fesd {
        let extent = fesd::Extent::of(arguments.brief);
        let request = json!({ "figures": [5, 8, 9], "examples": [3], "brief": arguments.brief });
        let place = ("output/fesd", fesd::STEMS.as_slice());
        return reproduce(arguments, place, request, |report| {
            fesd::figures(report, &extent)
        });
    }
    let stems: Vec<String> = stems().collect();
    let stems: Vec<&str> = stems.iter().map(String::as_str).collect();
    let request = json!({ "figures": [2, 3, 4, 5, 6, 7, 8] });
    reproduce(arguments, ("output/paper", &stems), request, figures)
}

/// Makes the figures of a paper, and prints its numbers beside ours.
fn reproduce(
    arguments: &Arguments,
    (default, stems): (&str, &[&str]),
    request: Value,
    figures: impl FnOnce(&mut Report) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut report = Report {
        out: arguments.directory.open(default, stems, request)?,
        format: arguments.format.into(),
        rows: Vec::new(),
        progress: Progress::new("figures"),
        done: 0.0,
        weight: 0.0,
    };
    interrupt::listen()?;
    let outcome = figures(&mut report);
    report.progress.finish();
    // the figures that were made are compared, whatever became of the others
    let header = ["figure", "quantity", "paper", "ours"];
    let mut csv = report.out.csv("comparison.csv", header)?;
    let mut table = Table::new(4, header);
    for row in &report.rows {
        csv.row(row)?;
        table.row(row.clone());
    }
    report.out.add(csv.finish()?);
    table.print()?;
    report.out.finish(&outcome)?;
    outcome
}

fn figures(report: &mut Report) -> Result<(), Failure> {
    report.part(TRAJECTORIES, trajectories::figure)?;
    for (name, [times, states, conserved]) in SYSTEMS {
        report.part(TIMES, |report| orders::crossing_times(report, name, times))?;
        report.part(STATES, |report| orders::states(report, name, states))?;
        report.part(CONSERVED, |report| {
            conserved::figure(report, name, conserved)
        })?;
    }
    Ok(())
}

/// What the files are called.
fn stems() -> impl Iterator<Item = String> {
    let own = SYSTEMS.iter().flat_map(|(name, numbers)| {
        let kinds = ["crossing_time", "perturbed", "conserved"];
        let files = numbers.iter().zip(kinds);
        files.map(move |(number, kind)| format!("fig{number}_{name}_{kind}"))
    });
    let common = ["fig2_trajectories", "comparison"].map(str::to_owned);
    common.into_iter().chain(own)
}
