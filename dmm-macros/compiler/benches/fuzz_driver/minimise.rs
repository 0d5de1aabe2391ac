//! Makes a failing case as short as it can be: parts of it are left out as long as it fails.

use std::io;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use crate::fuzz::tree::{self, Tree};

/// Trials of one case; each is a process.
const TRIALS: usize = 400;
/// A trial that takes longer hangs, which is a failure as well.
const HANG: Duration = Duration::from_secs(20);

/// A shorter text that fails like `text`, or `text` itself.
pub(crate) fn shorten(text: &str) -> String {
    let Some(mut trees) = tree::read(text) else {
        return text.to_owned();
    };
    let mut trials = TRIALS;
    if !fails(&tree::text(&trees)) {
        return text.to_owned();
    }
    let mut progress = true;
    while progress && trials > 0 {
        progress = false;
        for path in tree::sequences(&trees) {
            progress |= shorten_sequence(&mut trees, &path, &mut trials);
        }
    }
    tree::text(&trees)
}

/// Leaves out halves, quarters, … of one sequence; whether anything could be.
fn shorten_sequence(trees: &mut Vec<Tree>, path: &[usize], trials: &mut usize) -> bool {
    let mut chunk = tree::at(trees, path).len();
    let mut progress = false;
    while chunk > 0 {
        let mut start = 0;
        while start < tree::at(trees, path).len() && *trials > 0 {
            let mut shorter = trees.clone();
            let sequence = tree::at_mut(&mut shorter, path);
            let end = (start + chunk).min(sequence.len());
            sequence.drain(start..end);
            *trials -= 1;
            if fails(&tree::text(&shorter)) {
                *trees = shorter;
                progress = true;
            } else {
                start += chunk;
            }
        }
        chunk /= 2;
    }
    progress
}

/// Whether a process that compiles `text` says that something is wrong, dies, or hangs.
fn fails(text: &str) -> bool {
    let file = std::env::temp_dir().join(format!("dmm_fuzz_{}.pws", std::process::id()));
    if std::fs::write(&file, text).is_err() {
        return false;
    }
    let result = fails_file(&file).unwrap_or(false);
    drop(std::fs::remove_file(&file));
    result
}

fn fails_file(file: &Path) -> io::Result<bool> {
    let mut child = Command::new(std::env::current_exe()?)
        .arg("--check")
        .arg(file)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()?;
    let output = child.stdout.take();
    let (alive, ended) = mpsc::channel::<()>();
    let reader = thread::spawn(move || {
        // its output ends with the process, and with this thread the channel
        let _alive = alive;
        output.map(|mut output| io::copy(&mut output, &mut io::sink()))
    });
    if ended.recv_timeout(HANG) == Err(RecvTimeoutError::Timeout) {
        // a process that is killed has no success
        child.kill()?;
    }
    drop(reader.join());
    Ok(!child.wait()?.success())
}
