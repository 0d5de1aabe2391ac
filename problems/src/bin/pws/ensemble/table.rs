//! The table of results: a row for each member, as CSV or, where the program was built with it,
//! as Parquet. The name of the file decides.

use std::path::PathBuf;

use super::cells::{Cell, Column};
#[cfg(feature = "parquet")]
use super::parquet::Parquet;
use crate::failure::Failure;
use crate::output::Csv;

/// A table being written, in constant memory.
pub(crate) enum Table {
    Csv(Box<Csv>),
    #[cfg(feature = "parquet")]
    Parquet(Box<Parquet>),
}

impl Table {
    /// A new file with these columns.
    pub(crate) fn create(path: PathBuf, columns: &[Column]) -> Result<Self, Failure> {
        if path.extension().is_some_and(|ending| ending == "parquet") {
            return Self::parquet(path, columns);
        }
        Csv::create(path, columns.iter().map(|(name, _)| name))
            .map(|file| Self::Csv(Box::new(file)))
    }

    #[cfg(feature = "parquet")]
    fn parquet(path: PathBuf, columns: &[Column]) -> Result<Self, Failure> {
        Parquet::create(path, columns).map(|file| Self::Parquet(Box::new(file)))
    }

    #[cfg(not(feature = "parquet"))]
    fn parquet(path: PathBuf, _: &[Column]) -> Result<Self, Failure> {
        Err(Failure::Request(format!(
            "{}: this program was built without Parquet; name a .csv file, or build it with \
             `--features parquet`",
            path.display()
        )))
    }

    /// Adds a row.
    pub(crate) fn row(&mut self, cells: Vec<Cell>) -> Result<(), Failure> {
        match self {
            Self::Csv(csv) => csv.row(cells.iter().map(Cell::written)),
            #[cfg(feature = "parquet")]
            Self::Parquet(file) => file.row(cells),
        }
    }

    /// Adds what is left to the file.
    pub(crate) fn finish(self) -> Result<PathBuf, Failure> {
        match self {
            Self::Csv(csv) => csv.finish(),
            #[cfg(feature = "parquet")]
            Self::Parquet(file) => file.finish(),
        }
    }
}
