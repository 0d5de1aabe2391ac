//! The command line of a benchmark.

/// The arguments, without the one by which cargo says that it wants a benchmark.
pub(crate) fn arguments() -> impl Iterator<Item = String> {
    let arguments = std::env::args().skip(1);
    arguments.filter(|argument| argument != "--bench")
}
