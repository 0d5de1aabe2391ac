//! Runs of many steps or from many starts; see `tests/`.
