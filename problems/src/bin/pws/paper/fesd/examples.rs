//! Example 3: the four kinds of switches.

use dmm_problems::method::MethodName;
use dmm_runtime::Model;

use super::runs::{self, Case};
use crate::failure::Failure;
use crate::output;
use crate::paper::report::Report;

/// An example with a unique solution.
struct Example {
    name: &'static str,
    declaration: &'static str,
    initial: f64,
    t_end: f64,
    /// What happens, by the solution in closed form.
    paper: &'static str,
}

const EXAMPLES: [Example; 3] = [
    Example {
        name: "(a) ẋ = 2 − sgn x, x(0) = −1",
        declaration: "
system Crossing {
    state x;
    interface switch = x;
    region below where switch < 0 { der(x) = 3; }
    region above where switch > 0 { der(x) = 1; }
}",
        initial: -1.0,
        t_end: 2.0,
        paper: "crossed at t = 1/3; x(2) = 5/3",
    },
    Example {
        name: "(b) ẋ = −sgn x, x(0) = 1",
        declaration: "
system Sliding {
    state x;
    interface switch = x, sliding;
    region below where switch < 0 { der(x) = 1; }
    region above where switch > 0 { der(x) = -1; }
}",
        initial: 1.0,
        t_end: 2.0,
        paper: "slides from t = 1; x(2) = 0",
    },
    Example {
        name: "(c) ẋ = −sgn x + t, x(0) = 0",
        declaration: "
system Leaving {
    state x;
    interface switch = x, sliding;
    region below where switch < 0 { der(x) = 1 + t; }
    region above where switch > 0 { der(x) = -1 + t; }
}",
        initial: 0.0,
        t_end: 2.0,
        paper: "leaves at t = 1; x(2) = 1/2",
    },
];

/// The last: both fields lead away from x = 0.
const SPONTANEOUS: &str = "
system Spontaneous {
    state x;
    interface switch = x;
    region below where switch < 0 { der(x) = -1; }
    region above where switch > 0 { der(x) = 1; }
}";

/// A line each.
pub(super) fn table(report: &mut Report) -> Result<(), Failure> {
    const STEPS: u32 = 20;
    for example in EXAMPLES {
        let problem = runs::declared(example.declaration)?;
        let case = Case {
            problem: &problem,
            method: MethodName::GaussLegendre2,
            initial: &[example.initial],
            t_end: example.t_end,
        };
        let seen = case.detecting(STEPS)?;
        let transitions = seen.transitions.iter();
        let mut ours: Vec<String> = transitions
            .map(|crossed| format!("{} at t = {:.12}", crossed.kind.name(), crossed.t))
            .collect();
        ours.push(format!("x(2) = {}", output::short(seen.last[0])));
        report.line("Ex. 3", example.name, example.paper, ours.join("; "));
    }
    // a declaration that is refused says why
    let ours = match Model::compile(SPONTANEOUS) {
        Ok(_) => "compiled".to_owned(),
        Err(error) => {
            let text = error.to_string();
            let code = text.rsplit_once('[').map_or("", |(_, code)| code);
            format!(
                "refused: both sides lead away ({})",
                code.trim_end_matches(']')
            )
        }
    };
    let paper = "infinitely many solutions";
    report.line("Ex. 3", "(d) ẋ = sgn x, x(0) = 0", paper, ours);
    Ok(())
}
