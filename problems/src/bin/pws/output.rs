//! Files and tables.

use std::fs::File;
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

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

    /// Sees to it that all rows so far are in the file.
    pub(crate) fn flush(&mut self) -> Result<(), Failure> {
        let flushed = self.writer.flush();
        flushed.map_err(|error| Failure::write(&self.path, error))
    }

    /// Adds what is left to the file.
    pub(crate) fn finish(mut self) -> Result<PathBuf, Failure> {
        self.flush()?;
        Ok(self.path)
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

/// Names in their order, the elements of a group as one: `q[3], p` of `q[0], q[1], q[2], p`.
pub(crate) fn grouped(names: &[&str]) -> Vec<String> {
    let groups = groups(names);
    let name = |(name, states): (&str, Range<usize>)| {
        if names[states.start].contains('[') {
            format!("{name}[{}]", states.len())
        } else {
            name.to_owned()
        }
    };
    groups.into_iter().map(name).collect()
}

/// The groups that names belong to, each with the places of its elements; a name without an
/// index is a group of its own.
pub(crate) fn groups<'a>(names: &[&'a str]) -> Vec<(&'a str, Range<usize>)> {
    let mut groups: Vec<(&str, Range<usize>)> = Vec::new();
    for (place, &name) in names.iter().enumerate() {
        match (name.split_once('['), groups.last_mut()) {
            (Some((base, _)), Some((last, places))) if base == *last => places.end = place + 1,
            (Some((base, _)), _) => groups.push((base, place..place + 1)),
            (None, _) => groups.push((name, place..place + 1)),
        }
    }
    groups
}

/// A number as people write it: small and large ones with an exponent, and no more digits than it
/// takes to read the same number back.
pub(crate) fn number(value: f64) -> String {
    if value != 0.0 && value.is_finite() && !(1e-4..1e16).contains(&value.abs()) {
        format!("{value:e}")
    } else {
        value.to_string()
    }
}

/// A number in a table for people: six digits of it.
pub(crate) fn short(value: f64) -> String {
    let rounded = format!("{value:.5e}").parse();
    number(rounded.unwrap_or(value))
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
                if column < self.left {
                    line.extend([cell.as_str(), &padding]);
                } else {
                    line.extend([padding.as_str(), cell]);
                }
            }
            writeln!(out, "{}", line.trim_end())?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_of_a_group_are_one_name() {
        assert_eq!(grouped(&["x", "y"]), ["x", "y"]);
        assert_eq!(
            grouped(&["q[0]", "q[1]", "p[0]", "p[1]", "s"]),
            ["q[2]", "p[2]", "s"]
        );
        assert_eq!(groups(&["a", "q[0]", "q[1]"]), [("a", 0..1), ("q", 1..3)]);
        assert!(grouped(&[]).is_empty());
    }

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (-0.25, "-0.25"),
            (1e-300, "1e-300"),
            (2.5e20, "2.5e20"),
        ] {
            assert_eq!(number(value), text);
        }
        assert_eq!(
            [1.0 / 3.0, -1e-17, 2.0].map(short),
            ["0.333333", "-1e-17", "2"]
        );
        assert_eq!(short(f64::NAN), "NaN");
    }
}
