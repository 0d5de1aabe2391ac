//! What a command accepts, for its help.

use dmm_problems::registry;

/// The problems, by name and title.
pub(crate) fn problems() -> String {
    let widest = registry::names().map(str::len).max().unwrap_or_default();
    let mut text = "Problems:\n".to_owned();
    for description in registry::descriptions() {
        let (name, title) = (description.name, description.title);
        text.push_str(&format!("  {name:widest$}  {title}\n"));
    }
    text.push_str(
        "\nFILE declares a system of your own: Rust with `pws!` in it, or `system Name { … }` alone. \
         `pws show FILE` tells what is derived from it.",
    );
    text
}
