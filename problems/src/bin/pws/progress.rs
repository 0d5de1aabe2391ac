//! How far long work is, on a terminal only: a bar with the time that is left, as soon as the
//! work has taken a second.

use std::fmt::Write;
use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use crate::interrupt;

/// Work that is over sooner shows nothing.
const DELAY: Duration = Duration::from_secs(1);
/// An estimate from less than this share of the work says nothing.
const LEAST_SHARE: f64 = 1e-4;
/// Places of the bar.
const LENGTH: u64 = 1_000_000;

/// How far the work is.
pub(crate) struct Progress {
    bar: ProgressBar,
    start: Instant,
    /// Whether standard error is a terminal.
    is_read: bool,
}

impl Progress {
    /// Nothing is done yet.
    pub(crate) fn new(what: &str) -> Self {
        let target = ProgressDrawTarget::hidden();
        let bar = ProgressBar::with_draw_target(Some(LENGTH), target);
        let template = "{bar:32} {percent:>3} %  {elapsed}{left}  {msg}";
        let style = ProgressStyle::with_template(template)
            .unwrap_or_else(|_| ProgressStyle::default_bar())
            .with_key("left", |state: &ProgressState, text: &mut dyn Write| {
                let share = f64::from(state.fraction());
                if let Some(left) = left(state.elapsed(), share) {
                    // nobody reads a bar that cannot be written
                    let _ = write!(text, ", about {} left", rounded(left));
                }
            });
        bar.set_style(style);
        bar.set_message(what.to_owned());
        Self {
            bar,
            start: Instant::now(),
            is_read: std::io::stderr().is_terminal(),
        }
    }

    /// Says what is being done.
    pub(crate) fn tell(&self, what: &str) {
        self.bar.set_message(what.to_owned());
    }

    /// The share of the work that is done; whether to go on.
    pub(crate) fn at(&self, share: f64) -> ControlFlow<()> {
        if self.is_read {
            if self.bar.is_hidden() && self.start.elapsed() > DELAY {
                self.bar.set_draw_target(ProgressDrawTarget::stderr());
            }
            self.bar
                .set_position((share.clamp(0.0, 1.0) * LENGTH as f64) as u64);
        }
        interrupt::check()
    }

    /// How many of a number that is not known are done; whether to go on.
    pub(crate) fn count(&self, done: u64, what: &str) -> ControlFlow<()> {
        if self.is_read && self.start.elapsed() > DELAY {
            if self.bar.is_hidden() {
                let style = ProgressStyle::with_template("{elapsed}  {msg}");
                let usual = ProgressStyle::default_spinner();
                self.bar.set_style(style.unwrap_or(usual));
                self.bar.set_draw_target(ProgressDrawTarget::stderr());
            }
            self.bar.set_message(format!("{done} {what}"));
        }
        interrupt::check()
    }

    /// Prints to standard output above the bar.
    pub(crate) fn above<T>(&self, print: impl FnOnce() -> T) -> T {
        self.bar.suspend(print)
    }

    /// Removes the bar.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// The time that the rest takes at the pace so far.
fn left(elapsed: Duration, share: f64) -> Option<Duration> {
    let known = LEAST_SHARE..=1.0;
    let seconds = elapsed.as_secs_f64() * (1.0 - share) / share;
    known
        .contains(&share)
        .then(|| Duration::try_from_secs_f64(seconds).ok())?
}

/// A time as people say it.
fn rounded(time: Duration) -> String {
    match time.as_secs_f64() {
        seconds if seconds < 99.5 => format!("{seconds:.0} s"),
        seconds if seconds < 90.0 * 60.0 => format!("{:.0} min", seconds / 60.0),
        seconds => format!("{:.1} h", seconds / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_takes_as_long_as_what_was_done() {
        let time = |seconds| Duration::from_secs(seconds);
        assert_eq!(left(time(10), 0.25), Some(time(30)));
        assert_eq!(left(time(10), 1.0), Some(time(0)));
        assert_eq!(left(time(10), 0.0), None);
        assert_eq!(left(time(10), f64::NAN), None);
    }

    #[test]
    fn times_are_rounded() {
        for (seconds, text) in [(0, "0 s"), (99, "99 s"), (150, "2 min"), (9000, "2.5 h")] {
            assert_eq!(rounded(Duration::from_secs(seconds)), text);
        }
    }
}
