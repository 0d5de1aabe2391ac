//! What all figures of a paper share.

use std::ops::ControlFlow;

use dmm_picture::Format;

use crate::directory::Directory;
use crate::failure::Failure;
use crate::interrupt;
use crate::progress::Progress;

/// The two systems of the paper, with the numbers of their figures: crossing times, states,
/// conserved quantity.
pub(super) const SYSTEMS: [(&str, [u32; 3]); 2] =
    [("harmonic", [3, 4, 5]), ("elliptic", [6, 7, 8])];

/// Where the results go, and what is said about them in the end.
pub(super) struct Report {
    pub(super) out: Directory,
    pub(super) format: Format,
    pub(super) rows: Vec<[String; 4]>,
    pub(super) progress: Progress,
    /// The share of the work that was done before this part of the figures.
    pub(super) done: f64,
    /// The share of this part.
    pub(super) weight: f64,
}

/// Shares of the work: Fig. 2, then those of each system.
pub(super) const TRAJECTORIES: f64 = 0.02;
pub(super) const TIMES: f64 = 0.02;
pub(super) const STATES: f64 = 0.45;
pub(super) const CONSERVED: f64 = 0.02;

impl Report {
    /// Makes a part of the figures, unless the work is to stop.
    pub(super) fn part(
        &mut self,
        weight: f64,
        make: impl FnOnce(&mut Self) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        self.weight = weight;
        let stopped = || Failure::Interrupted("before all figures were drawn".to_owned());
        if self.at(0.0).is_break() {
            return Err(stopped());
        }
        make(self)?;
        self.done += weight;
        if interrupt::is_requested() {
            return Err(stopped());
        }
        Ok(())
    }

    /// The share of this part that is done; whether to go on.
    pub(super) fn at(&self, share: f64) -> ControlFlow<()> {
        self.progress.at(self.done + self.weight * share)
    }

    /// A line of the table paper / ours.
    pub(super) fn row(
        &mut self,
        figure: u32,
        what: impl Into<String>,
        paper: &str,
        ours: impl Into<String>,
    ) {
        self.line(format!("Fig. {figure}"), what, paper, ours);
    }

    /// The same of any place in the paper.
    pub(super) fn line(
        &mut self,
        place: impl Into<String>,
        what: impl Into<String>,
        paper: impl Into<String>,
        ours: impl Into<String>,
    ) {
        let row = [place.into(), what.into(), paper.into(), ours.into()];
        self.rows.push(row);
    }
}
