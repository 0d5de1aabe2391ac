//! Why a command ends without success.

use std::io;
use std::path::Path;

use dmm_problems::convergence::StudyError;
use dmm_problems::registry::Unknown;
use dmm_problems::work_precision::GoalError;
use thiserror::Error;

/// The exit status of a program that Ctrl-C has ended: 128 and the number of the signal.
pub(crate) const INTERRUPTED: u8 = 130;

/// Why a command ends without success.
#[derive(Debug, Error)]
pub(crate) enum Failure {
    /// The request makes no sense.
    #[error("{0}")]
    Request(String),
    /// A name does not exist.
    #[error(transparent)]
    Unknown(#[from] Unknown),
    /// A file cannot be written.
    #[error("cannot write {path}: {error}")]
    Write {
        /// The file.
        path: String,
        /// Why.
        error: io::Error,
    },
    /// A file cannot be read.
    #[error("cannot read {path}: {error}")]
    Read {
        /// The file.
        path: String,
        /// Why.
        error: io::Error,
    },
    /// The integration stopped before its end.
    #[error("{0}")]
    Stopped(String),
    /// Ctrl-C was pressed.
    #[error("interrupted {0}: the files have what was computed until then")]
    Interrupted(String),
    /// Nothing reads standard output any more.
    #[error("standard output is closed")]
    ReaderGone,
}

impl Failure {
    /// The exit status.
    pub(crate) fn status(&self) -> u8 {
        match self {
            Self::Stopped(_) => 1,
            Self::Interrupted(_) => INTERRUPTED,
            Self::ReaderGone => 0,
            Self::Request(_) | Self::Unknown(_) | Self::Write { .. } | Self::Read { .. } => 2,
        }
    }

    /// That `path` cannot be written.
    pub(crate) fn write(path: &Path, error: impl Into<io::Error>) -> Self {
        Self::Write {
            path: path.display().to_string(),
            error: error.into(),
        }
    }
}

impl Failure {
    /// That `path` cannot be read.
    pub(crate) fn read(path: &Path, error: impl Into<io::Error>) -> Self {
        Self::Read {
            path: path.display().to_string(),
            error: error.into(),
        }
    }
}

impl From<dmm_runtime::Error> for Failure {
    fn from(error: dmm_runtime::Error) -> Self {
        match error.kind {
            dmm_runtime::ErrorKind::InvalidInput { .. } | dmm_runtime::ErrorKind::NoRegion => {
                Self::Request(error.to_string())
            }
            _ => Self::Stopped(error.to_string()),
        }
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Input(_) | StudyError::TooFew { .. } => Self::Request(error.to_string()),
            _ => Self::Stopped(error.to_string()),
        }
    }
}

impl From<GoalError> for Failure {
    fn from(error: GoalError) -> Self {
        match error {
            GoalError::Time(_) => Self::Request(error.to_string()),
            GoalError::Truth(_) => Self::Stopped(error.to_string()),
        }
    }
}

impl From<io::Error> for Failure {
    /// Of standard output: everything else names its file.
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::ReaderGone,
            _ => Self::Write {
                path: "to standard output".to_owned(),
                error,
            },
        }
    }
}
