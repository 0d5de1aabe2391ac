//! `pws paper`: Figs 2–8 of Hirani, Wan & Wojtalewicz, *Conservative integrators for piecewise
//! smooth systems with transversal dynamics*, with their numbers beside ours.
//!
//! The paper gives neither the times it integrates to nor the sizes of its perturbations; ours
//! are chosen here: 30 transitions, and a crossing located too late by c·τᵖ.

mod conserved;
mod orders;
mod report;
mod trajectories;

use std::path::PathBuf;

use crate::failure::Failure;
use crate::input::FormatOption;
use crate::output::{self, Csv, Table};
use report::{Report, SYSTEMS};

/// Where to.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Directory of the results.
    #[arg(long, default_value = "output/paper")]
    out: PathBuf,
    /// How pictures are stored.
    #[arg(long, value_enum, default_value = "svg")]
    format: FormatOption,
}

/// Makes all figures.
pub(crate) fn paper(arguments: &Arguments) -> Result<(), Failure> {
    output::directory(&arguments.out)?;
    let mut report = Report {
        out: arguments.out.clone(),
        format: arguments.format.into(),
        files: Vec::new(),
        rows: Vec::new(),
    };
    trajectories::figure(&mut report)?;
    for (name, [times, states, conserved]) in SYSTEMS {
        orders::crossing_times(&mut report, name, times)?;
        orders::states(&mut report, name, states)?;
        conserved::figure(&mut report, name, conserved)?;
    }
    let header = ["figure", "quantity", "paper", "ours"];
    let mut csv = Csv::create(report.out.join("comparison.csv"), header)?;
    let mut table = Table::new(4, header);
    for row in &report.rows {
        csv.row(row)?;
        table.row(row.clone());
    }
    report.files.push(csv.finish()?);
    table.print()?;
    output::announce(&report.files)?;
    Ok(())
}
