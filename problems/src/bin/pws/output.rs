//! Files and tables.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use dmm_problems::picture::{Format, Picture};

use crate::failure::Failure;

/// The directory `path`, made if it does not exist.
pub(crate) fn directory(path: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(path).map_err(|error| Failure::write(path, error))
}

/// A CSV file being written, with its path for messages.
pub(crate) struct Csv {
    path: PathBuf,
    writer: csv::Writer<File>,
}

impl Csv {
    /// A new file with a header.
    pub(crate) fn create(
        path: PathBuf,
        header: impl IntoIterator<Item = impl AsRef<[u8]>>,
    ) -> Result<Self, Failure> {
        let file = File::create(&path).map_err(|error| Failure::write(&path, error))?;
        let mut csv = Self {
            path,
            writer: csv::Writer::from_writer(file),
        };
        csv.row(header)?;
        Ok(csv)
    }

    /// Adds a row.
    pub(crate) fn row(
        &mut self,
        fields: impl IntoIterator<Item = impl AsRef<[u8]>>,
    ) -> Result<(), Failure> {
        self.writer
            .write_record(fields)
            .map_err(|error| Failure::write(&self.path, io::Error::from(error)))
    }

    /// Adds what is left to the file.
    pub(crate) fn finish(mut self) -> Result<PathBuf, Failure> {
        match self.writer.flush() {
            Ok(()) => Ok(self.path),
            Err(error) => Err(Failure::write(&self.path, error)),
        }
    }
}

/// Writes `NAME.svg` or `NAME.png` into a directory.
pub(crate) fn picture(
    directory: &Path,
    name: &str,
    picture: &Picture,
    format: Format,
) -> Result<PathBuf, Failure> {
    let path = directory.join(format!("{name}.{}", format.extension()));
    match picture.write(&path, format) {
        Ok(()) => Ok(path),
        Err(error) => Err(Failure::write(&path, error)),
    }
}

/// Says which files were written.
pub(crate) fn announce(paths: &[PathBuf]) -> io::Result<()> {
    let mut out = io::stdout().lock();
    for path in paths {
        writeln!(out, "wrote {}", path.display())?;
    }
    Ok(())
}

/// A table of text, columns aligned; the first column to the left, the others to the right.
#[derive(Default)]
pub(crate) struct Table {
    rows: Vec<Vec<String>>,
    /// How many columns are aligned to the left.
    left: usize,
}

impl Table {
    /// A table with a header, whose first `left` columns are words.
    pub(crate) fn new(left: usize, header: impl IntoIterator<Item = impl Into<String>>) -> Self {
        Self {
            rows: vec![header.into_iter().map(Into::into).collect()],
            left,
        }
    }

    /// Adds a row.
    pub(crate) fn row(&mut self, cells: impl IntoIterator<Item = impl Into<String>>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// Prints it to standard output.
    pub(crate) fn print(&self) -> io::Result<()> {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or_default();
        let width = |column: usize| {
            let cells = self.rows.iter().filter_map(|row| row.get(column));
            cells
                .map(|cell| cell.chars().count())
                .max()
                .unwrap_or_default()
        };
        let widths: Vec<usize> = (0..columns).map(width).collect();
        let mut out = io::stdout().lock();
        for row in &self.rows {
            let mut line = String::new();
            for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
                let padding = " ".repeat(width - cell.chars().count());
                if column > 0 {
                    line.push_str("  ");
                }
                match column < self.left {
                    true => line.extend([cell.as_str(), &padding]),
                    false => line.extend([padding.as_str(), cell]),
                }
            }
            writeln!(out, "{}", line.trim_end())?;
        }
        Ok(())
    }
}
