//! Where `pws!` may stand; see `tests/`.
