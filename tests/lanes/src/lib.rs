//! Trajectories in lanes are those one at a time; see `tests/`.
