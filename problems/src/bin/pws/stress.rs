//! `pws stress`

use std::io::{self, Write};
use std::ops::ControlFlow;

use clap::builder::{PossibleValue, PossibleValuesParser};
use dmm_picture::Picture;
use dmm_problems::stress::{Extent, Observe, Row, STUDIES, Study, Verdict};
use serde_json::json;

use crate::directory::DirectoryOptions;
use crate::failure::Failure;
use crate::input::FormatOption;
use crate::interrupt;
use crate::output::Csv;
use crate::progress::Progress;

/// What to try.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Names of the studies [default: all].
    #[arg(value_parser = studies())]
    studies: Vec<String>,
    /// The same in a few seconds.
    #[arg(long)]
    brief: bool,
    #[command(flatten)]
    directory: DirectoryOptions,
    /// How pictures are stored.
    #[arg(long, value_enum, default_value = "svg")]
    format: FormatOption,
}

/// Makes the studies, prints a table of each and says what was wrong.
pub(crate) fn stress(arguments: &Arguments) -> Result<(), Failure> {
    let asked = &arguments.studies;
    let is_asked = |study: &Study| asked.is_empty() || asked.iter().any(|name| name == study.name);
    let studies: Vec<Study> = STUDIES.into_iter().filter(is_asked).collect();
    let extent = if arguments.brief {
        Extent::Brief
    } else {
        Extent::Full
    };
    let names: Vec<&str> = studies.iter().map(|study| study.name).collect();
    let stems: Vec<String> = names.iter().map(|name| name.replace('-', "_")).collect();
    let stems: Vec<&str> = stems.iter().map(String::as_str).chain(["stress"]).collect();
    let request = json!({ "studies": names, "brief": arguments.brief });
    let mut out = arguments.directory.open("output/stress", &stems, request)?;
    interrupt::listen()?;
    let header = ["study", "case", "scheme", "verdict", "finding"];
    let mut csv = out.csv("stress.csv", header)?;
    csv.flush()?;
    let mut counts = [0; 3];
    for study in &studies {
        writeln!(io::stdout(), "{}: {}", study.name, study.title)?;
        line(["case", "scheme", "verdict", "finding"])?;
        let mut told = Told {
            study: study.name,
            progress: Progress::new(study.name),
            csv: &mut csv,
            counts: &mut counts,
            failure: None,
        };
        let panels = study.run(extent, &mut told);
        told.progress.finish();
        if let Some(failure) = told.failure {
            return Err(failure);
        }
        writeln!(io::stdout())?;
        if !panels.is_empty() {
            let picture = Picture::row(study.title, panels);
            let name = study.name.replace('-', "_");
            out.picture(&name, &picture, arguments.format.into())?;
        }
        if interrupt::is_requested() {
            break;
        }
    }
    out.add(csv.finish()?);
    let [survived, refused, wrong] = counts;
    writeln!(
        io::stdout(),
        "{survived} survived, {refused} refused, {wrong} wrong"
    )?;
    let outcome = match wrong {
        _ if interrupt::is_requested() => {
            let cases = survived + refused + wrong;
            Err(Failure::Interrupted(format!("after {cases} cases")))
        }
        0 => Ok(()),
        _ => Err(Failure::Stopped(format!(
            "{wrong} {}",
            Verdict::Wrong.describe()
        ))),
    };
    out.finish(&outcome)?;
    outcome
}

/// Tells of each case as soon as it has ended: a study may take an hour.
struct Told<'a> {
    study: &'static str,
    progress: Progress,
    csv: &'a mut Csv,
    /// How many there were of each verdict.
    counts: &'a mut [usize; 3],
    /// The first case that could not be written.
    failure: Option<Failure>,
}

impl Told<'_> {
    fn tell(&mut self, row: &Row) -> Result<(), Failure> {
        let verdict = row.verdict.describe();
        let cells = [&*row.case, &*row.scheme, verdict, &*row.finding];
        self.csv.row(std::iter::once(self.study).chain(cells))?;
        self.csv.flush()?;
        self.progress.above(|| line(cells))?;
        Ok(())
    }
}

impl Observe for Told<'_> {
    fn begins(&mut self, case: &str) -> ControlFlow<()> {
        self.progress = Progress::new(&format!("{}: {case}", self.study));
        self.progress.at(0.0)
    }

    fn at(&mut self, share: f64) -> ControlFlow<()> {
        self.progress.at(share)
    }

    fn ended(&mut self, row: Row) {
        self.progress.finish();
        self.counts[row.verdict as usize] += 1;
        if self.failure.is_none() {
            self.failure = self.tell(&row).err();
        }
    }
}

/// A line of the table, which is not known as a whole before its end.
fn line([case, scheme, verdict, finding]: [&str; 4]) -> io::Result<()> {
    writeln!(
        io::stdout(),
        "{case:<50}  {scheme:<16}  {verdict:<8}  {finding}"
    )
}

/// The names of the studies, with what they do.
fn studies() -> PossibleValuesParser {
    let values = STUDIES.iter();
    PossibleValuesParser::new(values.map(|study| PossibleValue::new(study.name).help(study.title)))
}
