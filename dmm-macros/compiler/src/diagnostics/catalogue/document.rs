//! The catalogue as a document.

use std::fmt::Write;

use super::{Code, stages};

/// The catalogue in Markdown: a heading for each number, so that it can be linked to.
pub fn markdown() -> String {
    let mut text = String::from(
        "# Diagnostics of `pws!`\n\n\
         Each message ends with a number, as in `[PWS131]`; here is what it means and what to do.\n\
         `pws explain PWS131` prints an entry.\n",
    );
    for stage in stages() {
        let (first, last) = (stage.numbers.start(), stage.numbers.end());
        // writing to a string cannot fail
        let _ = write!(text, "\n## {} ({first}–{last})\n", stage.about);
        for code in stage.codes {
            entry(&mut text, code);
        }
    }
    text
}

fn entry(text: &mut String, code: &Code) {
    let Code {
        title,
        cause,
        remedy,
        ..
    } = code;
    let _ = write!(
        text,
        "\n### {code}\n\n**{}.** {cause}\n\n*Remedy:* {remedy}\n",
        capitalised(title)
    );
}

/// `title` as the beginning of a sentence.
fn capitalised(title: &str) -> String {
    let mut letters = title.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters).collect()
}
