//! What all figures of the paper share.

use std::path::PathBuf;

use dmm_problems::picture::Format;

/// The two systems of the paper, with the numbers of their figures: crossing times, states,
/// conserved quantity.
pub(super) const SYSTEMS: [(&str, [u32; 3]); 2] =
    [("harmonic", [3, 4, 5]), ("elliptic", [6, 7, 8])];

/// Where the results go, and what is said about them in the end.
pub(super) struct Report {
    pub(super) out: PathBuf,
    pub(super) format: Format,
    pub(super) files: Vec<PathBuf>,
    pub(super) rows: Vec<[String; 4]>,
}

impl Report {
    /// A line of the table paper / ours.
    pub(super) fn row(
        &mut self,
        figure: u32,
        what: impl Into<String>,
        paper: &str,
        ours: impl Into<String>,
    ) {
        self.rows.push([
            format!("Fig. {figure}"),
            what.into(),
            paper.to_owned(),
            ours.into(),
        ]);
    }
}
