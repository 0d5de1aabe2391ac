//! A progress bar for long work, on a terminal only.

use std::io::IsTerminal;

use indicatif::{ProgressBar, ProgressStyle};

/// Says what is being done, on a terminal.
pub(crate) fn spinner() -> ProgressBar {
    if std::io::stderr().is_terminal() {
        ProgressBar::new_spinner()
    } else {
        ProgressBar::hidden()
    }
}

/// Work of fewer steps is over before one could look.
const LONG: f64 = 3e6;

/// A bar over `length` units for work of about `steps` steps; hidden where it would not be
/// read or not be needed.
pub(crate) fn bar(length: u64, steps: f64) -> ProgressBar {
    if steps < LONG || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style =
        ProgressStyle::with_template("{bar:40} {percent:>3} % {elapsed} (left: {eta}) {msg}");
    ProgressBar::new(length).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// A bar over so many pieces of work, or a count of them where that is not known.
pub(crate) fn counter(count: Option<u64>) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    match count {
        Some(count) => bar(count, f64::INFINITY),
        None => ProgressBar::no_length(),
    }
}
