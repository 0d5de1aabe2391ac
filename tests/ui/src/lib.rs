//! Declarations that compile, and the messages of those that do not; see `tests/`.
