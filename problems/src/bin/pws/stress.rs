//! `pws stress`

use std::io::Write;
use std::path::PathBuf;

use dmm_problems::picture::Picture;
use dmm_problems::registry::Unknown;
use dmm_problems::registry::closest;
use dmm_problems::stress::{Extent, STUDIES, Study, Verdict};

use crate::failure::Failure;
use crate::input::FormatOption;
use crate::output::{self, Csv, Table};
use crate::progress;

/// What to try.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Names of the studies [default: all].
    studies: Vec<String>,
    /// The same in a few seconds.
    #[arg(long)]
    brief: bool,
    /// Directory of the results.
    #[arg(long, default_value = "output/stress")]
    out: PathBuf,
    /// How pictures are stored.
    #[arg(long, value_enum, default_value = "svg")]
    format: FormatOption,
}

/// Makes the studies, prints a table of each and says what was wrong.
pub(crate) fn stress(arguments: &Arguments) -> Result<(), Failure> {
    let studies: Vec<Study> = match arguments.studies.as_slice() {
        [] => STUDIES.to_vec(),
        names => names
            .iter()
            .map(|name| find(name))
            .collect::<Result<_, _>>()?,
    };
    let extent = if arguments.brief {
        Extent::Brief
    } else {
        Extent::Full
    };
    output::directory(&arguments.out)?;
    let header = ["study", "case", "scheme", "verdict", "finding"];
    let mut csv = Csv::create(arguments.out.join("stress.csv"), header)?;
    let mut files = Vec::new();
    let mut counts = [0; 3];
    for study in studies {
        let spinner = progress::spinner();
        let report = study.run(extent, &mut |case| {
            spinner.set_message(format!("{}: {case}", study.name));
            spinner.tick();
        });
        spinner.finish_and_clear();
        writeln!(std::io::stdout(), "{}: {}", study.name, study.title)?;
        let mut table = Table::new(4, ["case", "scheme", "verdict", "finding"]);
        for row in report.rows {
            counts[row.verdict as usize] += 1;
            let verdict = row.verdict.describe().to_owned();
            let cells = [row.case, row.scheme, verdict, row.finding];
            csv.row(std::iter::once(study.name).chain(cells.iter().map(String::as_str)))?;
            table.row(cells);
        }
        table.print()?;
        writeln!(std::io::stdout())?;
        if !report.panels.is_empty() {
            let picture = Picture::row(study.title, report.panels);
            let name = study.name.replace('-', "_");
            let format = arguments.format.into();
            files.push(output::picture(&arguments.out, &name, &picture, format)?);
        }
    }
    files.insert(0, csv.finish()?);
    let [survived, refused, wrong] = counts;
    writeln!(
        std::io::stdout(),
        "{survived} survived, {refused} refused, {wrong} wrong"
    )?;
    output::announce(&files)?;
    match wrong {
        0 => Ok(()),
        _ => Err(Failure::Stopped(format!(
            "{wrong} {}",
            Verdict::Wrong.describe()
        ))),
    }
}

fn find(name: &str) -> Result<Study, Failure> {
    let known = || STUDIES.iter().map(|study| study.name);
    let found = STUDIES.iter().find(|study| study.name == name);
    found.copied().ok_or_else(|| {
        Failure::from(Unknown {
            kind: "study",
            name: name.to_owned(),
            closest: closest(name, known()),
        })
    })
}
