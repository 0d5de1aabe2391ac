//! Words of other languages, and what there is instead.
//!
//! One table for items, [`ITEMS`].

use crate::diagnostics::Code;
use crate::diagnostics::catalogue::syntax::{
    BRANCH, DERIVATIVE, INITIAL_VALUE, ONE_SYSTEM, TYPE, UNKNOWN_ITEM,
};

/// What is said of an item that begins with another language's word for it.
enum Instead {
    /// The language has a word for it.
    Word(&'static str),
    /// It is written otherwise, or is not there at all.
    Advice(Code, &'static str),
}
use Instead::{Advice, Word};

const REGION: &str = "each side of an interface is a region: declare `interface wall = …;` where it switches and write `region name where wall > 0 { … }`";
const INTEGRATOR: &str = "how it is integrated is not declared: methods, tolerances and times are given to the integrator";

/// The words with which items of other languages begin.
const ITEMS: &[(&[&str], Instead)] = &[
    (
        &["slide", "slides", "stick", "stiction", "filippov"],
        Advice(
            UNKNOWN_ITEM,
            "a solution may slide where that is declared: `interface belt = v - 1, sliding;`, or `if v > 1 sliding { … } else { … }`",
        ),
    ),
    (
        &["parameter", "parameters", "params", "parm"],
        Word("param"),
    ),
    (
        &["variable", "variables", "var", "vars", "states", "unknown"],
        Word("state"),
    ),
    (
        &["constant", "constants", "static", "define"],
        Word("const"),
    ),
    (&["function", "func", "def", "fun"], Word("fn")),
    (
        &[
            "event",
            "events",
            "guard",
            "surface",
            "boundary",
            "threshold",
            "callback",
            "zero",
        ],
        Advice(
            UNKNOWN_ITEM,
            "write `interface name = g;` for where g = 0, and `region … where name > 0 { … }` and `region … where name < 0 { … }` for what holds on its sides",
        ),
    ),
    (
        &[
            "if",
            "else",
            "elif",
            "elseif",
            "when",
            "case",
            "match",
            "switch",
            "otherwise",
            "transition",
        ],
        Advice(UNKNOWN_ITEM, REGION),
    ),
    (
        &[
            "mode", "modes", "phase", "location", "regime", "domain", "regions",
        ],
        Word("region"),
    ),
    (
        &[
            "ode",
            "rate",
            "flow",
            "deriv",
            "derivative",
            "derivatives",
            "diff",
            "dot",
        ],
        Word("der"),
    ),
    (
        &[
            "equation",
            "equations",
            "eq",
            "eqs",
            "eqn",
            "begin",
            "algorithm",
            "model",
        ],
        Advice(
            UNKNOWN_ITEM,
            "leave it out: the items of a system stand one after another, `der(x) = …;`",
        ),
    ),
    (
        &["end", "endif", "done"],
        Advice(UNKNOWN_ITEM, "leave it out: a block ends with its `}`"),
    ),
    (
        &[
            "invariant",
            "invariants",
            "conserve",
            "conserves",
            "conservation",
            "integral",
            "first_integral",
            "energy",
            "momentum",
        ],
        Word("conserved"),
    ),
    (
        &["lagrangian", "Lagrangian"],
        Advice(
            UNKNOWN_ITEM,
            "there are no Lagrangians: write the equations of motion, or `hamiltonian H = … in (q, p);`",
        ),
    ),
    (&["Hamiltonian", "ham"], Word("hamiltonian")),
    (&["while", "loop", "foreach", "repeat"], Word("for")),
    (
        &["initial", "init", "start", "initial_state", "ic"],
        Advice(
            INITIAL_VALUE,
            "the initial state is given to the integrator, not declared",
        ),
    ),
    (
        &[
            "tolerance",
            "tol",
            "method",
            "solver",
            "scheme",
            "tspan",
            "solve",
            "simulate",
            "integrate",
            "stop",
            "terminate",
            "options",
            "dt",
        ],
        Advice(UNKNOWN_ITEM, INTEGRATOR),
    ),
    (
        &["constraint", "constraints", "algebraic", "alias"],
        Advice(
            UNKNOWN_ITEM,
            "there are no algebraic equations: name a formula with `let`, and take coordinates in which a constraint holds",
        ),
    ),
    (
        &[
            "jump",
            "jumps",
            "reset",
            "resets",
            "reinit",
            "impact",
            "bounce",
            "collision",
        ],
        Advice(
            UNKNOWN_ITEM,
            "states jump by `on wall falling { x = …; }`, where an interface is crossed, `every T { … }` or `at T { … }`",
        ),
    ),
    (
        &["input", "inputs", "control", "forcing"],
        Advice(
            UNKNOWN_ITEM,
            "there are no inputs: write a formula of the time `t`, or declare a `param`",
        ),
    ),
    (
        &["output", "outputs", "observable", "measure", "plot"],
        Advice(
            UNKNOWN_ITEM,
            "there are no outputs: what is looked at is computed from the solution",
        ),
    ),
    (
        &["noise", "random", "brownian", "stochastic"],
        Advice(
            UNKNOWN_ITEM,
            "nothing is random: a rate is a formula of the states, the parameters and `t`",
        ),
    ),
    (
        &["delay"],
        Advice(
            UNKNOWN_ITEM,
            "there are no delays: a rate depends on the states at the same time",
        ),
    ),
    (
        &["unit", "units", "dimension"],
        Advice(
            UNKNOWN_ITEM,
            "numbers have no units: choose some and keep to them",
        ),
    ),
    (
        &[
            "import", "include", "use", "using", "extends", "extern", "mod",
        ],
        Advice(
            UNKNOWN_ITEM,
            "a declaration is complete in itself: nothing is imported",
        ),
    ),
    (
        &["print", "println", "return", "assert", "display"],
        Advice(
            UNKNOWN_ITEM,
            "a declaration says what holds and executes nothing: do this with the solution",
        ),
    ),
    (
        &[
            "Real", "real", "double", "float", "int", "Integer", "f64", "f32", "vector", "matrix",
        ],
        Advice(
            TYPE,
            "every quantity is real: write `state x;` for what changes and `param k = 1;` for what does not",
        ),
    ),
    (
        &[
            "system",
            "subsystem",
            "struct",
            "class",
            "component",
            "module",
            "enum",
            "impl",
        ],
        Advice(ONE_SYSTEM, "a system cannot contain another one"),
    ),
    (
        &["self"],
        Advice(
            DERIVATIVE,
            "states are called by their name, and their rates are written `der(x) = …;`",
        ),
    ),
];

/// What is said of the item that begins with `word`, if it is a word of another language.
pub(super) fn of_item(word: &str) -> Option<(Code, String)> {
    let (_, instead) = ITEMS.iter().find(|(words, _)| words.contains(&word))?;
    Some(match instead {
        Word(instead) => (
            UNKNOWN_ITEM,
            format!("unknown item `{word}`: write `{instead}`"),
        ),
        Advice(UNKNOWN_ITEM, advice) => (UNKNOWN_ITEM, format!("unknown item `{word}`: {advice}")),
        Advice(code, advice) => (*code, (*advice).to_owned()),
    })
}

/// What is said of a formula that switches by `word`.
pub(super) fn of_branch(word: &str) -> Option<(Code, &'static str)> {
    matches!(
        word,
        "if" | "else" | "match" | "when" | "where" | "then" | "case" | "switch"
    )
    .then_some((BRANCH, NO_BRANCH))
}

/// What is said of branches in formulas.
pub(super) const NO_BRANCH: &str = "a formula switches by `if a > b { u } else { v }`, or by `abs`, `sign`, `min`, `max` and `clamp`";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::syntax::name;

    #[test]
    fn every_word_stands_once_and_is_none_of_the_language() {
        let words = ITEMS.iter().map(|(words, _)| *words);
        let mut all: Vec<&str> = words.flatten().copied().collect();
        all.sort_unstable();
        let twice: Vec<_> = all.windows(2).filter(|pair| pair[0] == pair[1]).collect();
        assert!(twice.is_empty(), "{twice:?}");
        let known: Vec<_> = (all.iter())
            .filter(|word| name::ITEMS.contains(word) && **word != "on")
            .collect();
        assert!(known.is_empty(), "{known:?}");
    }

    #[test]
    fn what_is_to_be_written_is_a_word_of_the_language() {
        for (_, instead) in ITEMS {
            if let Word(word) = instead {
                assert!(name::ITEMS.contains(word), "{word}");
            }
        }
    }
}
