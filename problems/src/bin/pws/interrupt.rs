//! Ctrl-C: the first asks the work to end in order, the second ends the program at once.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use signal_hook::consts::SIGINT;
use signal_hook::flag;

use crate::failure::{Failure, INTERRUPTED};

/// Whether Ctrl-C was pressed; nothing as long as nobody asks.
static REQUESTED: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// From here on Ctrl-C only asks: who works has to look at [`check`].
pub(crate) fn listen() -> Result<(), Failure> {
    let requested = Arc::new(AtomicBool::new(false));
    if REQUESTED.set(Arc::clone(&requested)).is_err() {
        return Ok(());
    }
    // in this order: the first signal finds the flag unset, the second finds it set
    flag::register_conditional_shutdown(SIGINT, i32::from(INTERRUPTED), Arc::clone(&requested))
        .and_then(|_| flag::register(SIGINT, requested))
        .map(|_| ())
        .map_err(|error| Failure::Stopped(format!("cannot listen to Ctrl-C: {error}")))
}

/// Whether Ctrl-C was pressed.
pub(crate) fn is_requested() -> bool {
    let requested = REQUESTED.get();
    requested.is_some_and(|requested| requested.load(Ordering::Relaxed))
}

/// Whether to go on.
pub(crate) fn check() -> ControlFlow<()> {
    if is_requested() {
        ControlFlow::Break(())
    } else {
        ControlFlow::Continue(())
    }
}
