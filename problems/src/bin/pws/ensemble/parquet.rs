//! A table as a Parquet file: columns of doubles, counts and text, in groups of rows.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use super::cells::{Cell, Column, Kind};
use crate::failure::Failure;

/// Rows that are in memory before they are written.
const GROUP: usize = 1 << 16;

/// Values of a column that are not yet written, with 1 for each row that has one and 0 for each
/// that has none.
enum Waiting {
    Counts(Vec<i64>, Vec<i16>),
    Numbers(Vec<f64>, Vec<i16>),
    Texts(Vec<ByteArray>, Vec<i16>),
}

/// A file being written.
pub(crate) struct Parquet {
    path: PathBuf,
    writer: SerializedFileWriter<File>,
    columns: Vec<Waiting>,
    rows: usize,
}

impl Parquet {
    /// A new file with these columns.
    pub(crate) fn create(path: PathBuf, columns: &[Column]) -> Result<Self, Failure> {
        let file = File::create(&path).map_err(|error| Failure::write(&path, error))?;
        let writer = schema(columns)
            .and_then(|schema| SerializedFileWriter::new(file, Arc::new(schema), Arc::default()))
            .map_err(|error| unwritten(&path, error))?;
        let waiting = columns.iter().map(|(_, kind)| match kind {
            Kind::Count => Waiting::Counts(Vec::new(), Vec::new()),
            Kind::Number => Waiting::Numbers(Vec::new(), Vec::new()),
            Kind::Text => Waiting::Texts(Vec::new(), Vec::new()),
        });
        Ok(Self {
            path,
            writer,
            columns: waiting.collect(),
            rows: 0,
        })
    }

    /// Adds a row.
    pub(crate) fn row(&mut self, cells: Vec<Cell>) -> Result<(), Failure> {
        for (column, cell) in self.columns.iter_mut().zip(cells) {
            column.push(cell);
        }
        self.rows += 1;
        if self.rows < GROUP {
            Ok(())
        } else {
            self.write()
        }
    }

    /// Adds what is left to the file.
    pub(crate) fn finish(mut self) -> Result<PathBuf, Failure> {
        self.write()?;
        match self.writer.close() {
            Ok(_) => Ok(self.path),
            Err(error) => Err(unwritten(&self.path, error)),
        }
    }

    /// Writes the rows in memory as a group.
    fn write(&mut self) -> Result<(), Failure> {
        if self.rows == 0 {
            return Ok(());
        }
        self.rows = 0;
        let mut write = || {
            let mut group = self.writer.next_row_group()?;
            for column in &mut self.columns {
                column.write(&mut group)?;
            }
            group.close().map(drop)
        };
        write().map_err(|error| unwritten(&self.path, error))
    }
}

impl Waiting {
    fn push(&mut self, cell: Cell) {
        let note = |levels: &mut Vec<i16>, found: bool| levels.push(i16::from(found));
        match self {
            Self::Counts(values, levels) => {
                let value = match cell {
                    Cell::Count(count) => i64::try_from(count).ok(),
                    _ => None,
                };
                note(levels, value.is_some());
                values.extend(value);
            }
            Self::Numbers(values, levels) => {
                let value = match cell {
                    Cell::Number(value) => Some(value),
                    _ => None,
                };
                note(levels, value.is_some());
                values.extend(value);
            }
            Self::Texts(values, levels) => {
                let value = match cell {
                    Cell::Text(text) => Some(ByteArray::from(text.into_bytes())),
                    _ => None,
                };
                note(levels, value.is_some());
                values.extend(value);
            }
        }
    }

    fn write(
        &mut self,
        group: &mut SerializedRowGroupWriter<'_, File>,
    ) -> Result<(), ParquetError> {
        match self {
            Self::Counts(values, levels) => next::<Int64Type>(group, values, levels),
            Self::Numbers(values, levels) => next::<DoubleType>(group, values, levels),
            Self::Texts(values, levels) => next::<ByteArrayType>(group, values, levels),
        }
    }
}

/// Writes the next column of a group, and leaves it empty.
fn next<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, File>,
    values: &mut Vec<T::T>,
    levels: &mut Vec<i16>,
) -> Result<(), ParquetError> {
    if let Some(mut column) = group.next_column()? {
        column
            .typed::<T>()
            .write_batch(values, Some(levels), None)?;
        column.close()?;
    }
    values.clear();
    levels.clear();
    Ok(())
}

fn schema(columns: &[Column]) -> Result<Type, ParquetError> {
    let field = |(name, kind): &Column| {
        let (physical, logical) = match kind {
            Kind::Count => (Physical::INT64, None),
            Kind::Number => (Physical::DOUBLE, None),
            Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        Type::primitive_type_builder(name, physical)
            .with_repetition(Repetition::OPTIONAL)
            .with_logical_type(logical)
            .build()
            .map(Arc::new)
    };
    let fields = columns.iter().map(field).collect::<Result<_, _>>()?;
    Type::group_type_builder("ensemble")
        .with_fields(fields)
        .build()
}

fn unwritten(path: &Path, error: ParquetError) -> Failure {
    Failure::write(path, io::Error::other(error))
}
