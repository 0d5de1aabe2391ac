//! `pws stress`

use std::io::{self, Write};
use std::path::PathBuf;

use dmm_problems::picture::Picture;
use dmm_problems::registry::Unknown;
use dmm_problems::registry::closest;
use dmm_problems::stress::{Extent, Observe, Row, STUDIES, Study, Verdict};
use indicatif::ProgressBar;

use crate::failure::Failure;
use crate::input::FormatOption;
use crate::output::{self, Csv};
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
    let names: Vec<&str> = arguments.studies.iter().map(String::as_str).collect();
    let studies: Vec<Study> = match names.as_slice() {
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
    csv.flush()?;
    let mut files = Vec::new();
    let mut counts = [0; 3];
    for study in studies {
        writeln!(io::stdout(), "{}: {}", study.name, study.title)?;
        line(["case", "scheme", "verdict", "finding"])?;
        let mut told = Told {
            study: study.name,
            spinner: progress::spinner(),
            csv: &mut csv,
            counts: &mut counts,
            failure: None,
        };
        let panels = study.run(extent, &mut told);
        told.spinner.finish_and_clear();
        if let Some(failure) = told.failure {
            return Err(failure);
        }
        writeln!(io::stdout())?;
        if !panels.is_empty() {
            let picture = Picture::row(study.title, panels);
            let name = study.name.replace('-', "_");
            let format = arguments.format.into();
            files.push(output::picture(&arguments.out, &name, &picture, format)?);
        }
    }
    files.insert(0, csv.finish()?);
    let [survived, refused, wrong] = counts;
    writeln!(
        io::stdout(),
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

/// Tells of each case as soon as it has ended: a study may take an hour.
struct Told<'a> {
    study: &'static str,
    spinner: ProgressBar,
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
        self.spinner.suspend(|| line(cells))?;
        Ok(())
    }
}

impl Observe for Told<'_> {
    fn begins(&mut self, case: &str) {
        self.spinner.set_message(format!("{}: {case}", self.study));
        self.spinner.tick();
    }

    fn ended(&mut self, row: Row) {
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
