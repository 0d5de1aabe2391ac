//! `pws list`

use dmm_problems::registry;

use crate::failure::Failure;
use crate::output::{Table, grouped};

/// Prints a line for each problem.
pub(crate) fn list() -> Result<(), Failure> {
    let mut table = Table::new(
        5,
        ["problem", "states", "interface", "conserved", "what it is"],
    );
    for problem in registry::all() {
        let interfaces = match problem.interfaces() {
            [] => "none".to_owned(),
            names => names.join(", "),
        };
        table.row([
            problem.description().name.to_owned(),
            grouped(problem.states()).join(", "),
            interfaces,
            problem.conserved_names(0).join(", "),
            problem.description().title.to_owned(),
        ]);
    }
    Ok(table.print()?)
}
