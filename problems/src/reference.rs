//! Reference solutions: the files under `reference/`, which list crossings, samples and levels
//! of a piecewise-smooth problem to 32 digits.

use serde::Deserialize;
use thiserror::Error;

use crate::problem::Problem;

/// A solution known to 32 digits, rounded to doubles.
#[derive(Clone, PartialEq, Debug)]
pub struct Reference {
    /// The first crossings, at most 40.
    pub crossings: Vec<Crossing>,
    /// States at fixed times.
    pub samples: Vec<Sample>,
    /// The first segments; segment k begins at crossing k.
    pub segments: Vec<Segment>,
    /// How many crossings there are up to the last sample.
    pub crossings_total: u64,
}

/// A crossing of the interface.
#[derive(Clone, PartialEq, Debug)]
pub struct Crossing {
    /// t*
    pub t: f64,
    /// x*
    pub x: Vec<f64>,
    /// The side of the interface (−1 or 1) that is entered.
    pub to: f64,
}

/// The state at a fixed time.
#[derive(Clone, PartialEq, Debug)]
pub struct Sample {
    /// Time.
    pub t: f64,
    /// State.
    pub x: Vec<f64>,
    /// How many crossings came before.
    pub crossings_before: u64,
}

/// A stay on one side of the interface.
#[derive(Clone, PartialEq, Debug)]
pub struct Segment {
    /// The side (−1 or 1).
    pub side: f64,
    /// The values of the conserved quantities.
    pub psi: Vec<f64>,
}

/// Why a reference file cannot be used.
#[derive(Debug, Error)]
pub enum ReferenceError {
    /// It is not the JSON that is expected.
    #[error("reference data: {0}")]
    Json(#[from] serde_json::Error),
    /// A decimal string is not a number.
    #[error("reference data: `{0}` is not a number")]
    Number(String),
    /// A side is neither `+` nor `-`.
    #[error("reference data: `{0}` is not a side of the interface")]
    Side(String),
}

/// The file as it is written: numbers as decimal strings.
#[derive(Deserialize)]
struct File {
    crossings: Vec<CrossingEntry>,
    samples: Vec<SampleEntry>,
    segments: Vec<SegmentEntry>,
    crossings_total: u64,
}

#[derive(Deserialize)]
struct CrossingEntry {
    t: String,
    x: Vec<String>,
    to: String,
}

#[derive(Deserialize)]
struct SampleEntry {
    t: String,
    x: Vec<String>,
    crossings_before: u64,
}

#[derive(Deserialize)]
struct SegmentEntry {
    region: String,
    psi: Vec<String>,
}

fn number(text: &str) -> Result<f64, ReferenceError> {
    text.parse()
        .map_err(|_| ReferenceError::Number(text.to_owned()))
}

fn numbers(texts: &[String]) -> Result<Vec<f64>, ReferenceError> {
    texts.iter().map(|text| number(text)).collect()
}

fn side(text: &str) -> Result<f64, ReferenceError> {
    match text {
        "+" => Ok(1.0),
        "-" => Ok(-1.0),
        _ => Err(ReferenceError::Side(text.to_owned())),
    }
}

impl Reference {
    /// Reads a reference file.
    ///
    /// # Errors
    /// [`ReferenceError`] if it is malformed.
    pub fn parse(json: &str) -> Result<Self, ReferenceError> {
        let file: File = serde_json::from_str(json)?;
        let crossing = |entry: &CrossingEntry| -> Result<Crossing, ReferenceError> {
            Ok(Crossing {
                t: number(&entry.t)?,
                x: numbers(&entry.x)?,
                to: side(&entry.to)?,
            })
        };
        let sample = |entry: &SampleEntry| -> Result<Sample, ReferenceError> {
            Ok(Sample {
                t: number(&entry.t)?,
                x: numbers(&entry.x)?,
                crossings_before: entry.crossings_before,
            })
        };
        let segment = |entry: &SegmentEntry| -> Result<Segment, ReferenceError> {
            Ok(Segment {
                side: side(&entry.region)?,
                psi: numbers(&entry.psi)?,
            })
        };
        Ok(Self {
            crossings: file
                .crossings
                .iter()
                .map(crossing)
                .collect::<Result<_, _>>()?,
            samples: file.samples.iter().map(sample).collect::<Result<_, _>>()?,
            segments: file
                .segments
                .iter()
                .map(segment)
                .collect::<Result<_, _>>()?,
            crossings_total: file.crossings_total,
        })
    }

    /// The reference of a problem, where there is one.
    ///
    /// # Errors
    /// [`ReferenceError`] if it is malformed.
    pub fn of(problem: &Problem) -> Result<Option<Self>, ReferenceError> {
        problem.description().reference.map(Self::parse).transpose()
    }

    /// The level of ψ on a side, if it is the same in every segment there: the orbit is closed,
    /// or only crosses from side to side.
    pub fn constant_level(&self, side: f64) -> Option<&[f64]> {
        let mut segments = self.segments.iter().filter(|segment| segment.side == side);
        let first = segments.next()?;
        let close = |a: &f64, b: &f64| (a - b).abs() <= f64::EPSILON * a.abs();
        segments
            .all(|segment| segment.psi.iter().zip(&first.psi).all(|(a, b)| close(a, b)))
            .then_some(&first.psi)
    }
}
