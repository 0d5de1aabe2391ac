//! `pws explain [NUMBER]`

use std::io::Write;

use dmm_compiler::diagnostics::catalogue;

use crate::failure::Failure;

/// What to explain.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The number at the end of a compiler's message, as in PWS131 or 131; all of them without.
    number: Option<String>,
}

/// Prints cause and remedy of an error of `pws!`, or a line for each error.
pub(crate) fn explain(arguments: &Arguments) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    let Some(text) = &arguments.number else {
        for code in catalogue::all() {
            writeln!(out, "{code}  {}", code.title)?;
        }
        return Ok(());
    };
    let code = number(text)
        .and_then(catalogue::find)
        .ok_or_else(|| unknown(text))?;
    writeln!(
        out,
        "{code}: {}\n\ncause:  {}\nremedy: {}",
        code.title, code.cause, code.remedy
    )?;
    Ok(())
}

/// `PWS131`, `[PWS131]`, `pws131` or `131`
fn number(text: &str) -> Option<u16> {
    let text = text.trim().trim_matches(['[', ']']);
    let is_prefixed = text
        .get(..3)
        .is_some_and(|prefix| prefix.eq_ignore_ascii_case("pws"));
    let digits = if is_prefixed { text.get(3..)? } else { text };
    let only_digits = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    only_digits.then(|| digits.parse().ok()).flatten()
}

fn unknown(text: &str) -> Failure {
    let ranges: Vec<String> = catalogue::stages()
        .iter()
        .filter_map(|stage| {
            let (first, last) = (stage.codes.first()?, stage.codes.last()?);
            Some(if first == last {
                first.to_string()
            } else {
                format!("{first} to {last}")
            })
        })
        .collect();
    Failure::Request(format!(
        "there is no error `{text}`: there are {} (`pws explain` lists them)",
        ranges.join(", ")
    ))
}
