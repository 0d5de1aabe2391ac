//! Runs of hundreds of thousands of steps; see `tests/`.
