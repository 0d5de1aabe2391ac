//! Model → proof that what it declares holds.
//!
//! The stage is [`check`]. In every region, each declared ψ has to satisfy
//!
//! ```text
//! ∂ₜψ + ∇ψ·f = 0
//! ```
//!
//! identically (Hirani, Wan & Wojtalewicz, eq. 2.3), which the normal form decides. What a
//! scheme needs beyond that is checked as well: ψ's gradients are independent, so that ΛΛᵀ has
//! an inverse at generic points, they leave something to move, and an interface can be crossed.

mod independence;

#[cfg(test)]
mod tests;

use crate::algebra::{
    Counterexample, Dag, Id, Name, Verdict, decide_zero, differentiate, gradient, is_proved_zero,
    to_text,
};
use crate::diagnostics::Diagnostics;
use crate::model::{Conserved, Model, Region};

/// Residuals are shown up to this many characters.
const LONGEST_RESIDUAL: usize = 240;

/// Proves what `model` declares; what is false or cannot be proved is reported.
pub fn check(model: &mut Model, diagnostics: &mut Diagnostics) {
    let variables = Variables::of(model);
    for region in &model.regions {
        let proved = region.conserved.iter().filter_map(|psi| {
            let field = &region.field;
            conserved(
                &mut model.dag,
                &variables,
                (region, field),
                psi,
                diagnostics,
            )
        });
        let proved: Vec<Quantity<'_>> = proved.collect();
        let all_proved = proved.len() == region.conserved.len();
        if all_proved {
            independence::check(&model.dag, &variables, region, &proved, diagnostics);
        }
    }
    interfaces(model, &variables, diagnostics);
}

/// The variables of a model.
struct Variables {
    states: Vec<Name>,
    all: Vec<Name>,
}

impl Variables {
    fn of(model: &Model) -> Self {
        let states = model.state_names();
        let parameters = model
            .parameters
            .iter()
            .map(|parameter| parameter.name.clone());
        let all = states
            .iter()
            .cloned()
            .chain(parameters)
            .chain([Model::time()])
            .collect();
        Self { states, all }
    }
}

/// A conserved quantity with its derivatives.
struct Quantity<'m> {
    declared: &'m Conserved,
    /// ∇ψ
    gradient: Vec<Id>,
    /// Whether ∂ₜψ is zero.
    autonomous: bool,
}

/// ∂ₜu + ∇u·f
fn rate(dag: &mut Dag, by_time: Id, gradient: &[Id], field: &[Id]) -> Id {
    let terms: Vec<Id> = gradient
        .iter()
        .zip(field)
        .map(|(&a, &b)| dag.mul(a, b))
        .collect();
    dag.sum([by_time].into_iter().chain(terms))
}

/// Proves ∂ₜψ + ∇ψ·f = 0 for one ψ.
fn conserved<'m>(
    dag: &mut Dag,
    variables: &Variables,
    (region, field): (&Region, &[Id]),
    psi: &'m Conserved,
    diagnostics: &mut Diagnostics,
) -> Option<Quantity<'m>> {
    let gradient = gradient(dag, psi.psi, &variables.states);
    let by_time = differentiate(dag, psi.psi, &Model::time());
    let autonomous = is_proved_zero(dag, by_time);
    let name = &psi.ident;
    if autonomous
        && gradient
            .iter()
            .all(|&component| is_proved_zero(dag, component))
    {
        let message = format!(
            "`{name}` depends neither on the states nor on `t`: a constant needs no conservation; remove it"
        );
        diagnostics.error(psi.span, message);
        return None;
    }
    let residual = rate(dag, by_time, &gradient, field);
    let message = match decide_zero(dag, residual) {
        Verdict::Proved => {
            return Some(Quantity {
                declared: psi,
                gradient,
                autonomous,
            });
        }
        Verdict::Refuted(counterexample) => format!(
            "`{name}` is not conserved{}: d/dt {name} = {}",
            in_region(region),
            refutation(dag, &counterexample)
        ),
        Verdict::Undecided => format!(
            "`{name}` could not be proved to be conserved{}: d/dt {name} = {} was found neither to be zero nor clearly not to be; write it in another way, or leave it out",
            in_region(region),
            shortened(&to_text(dag, residual))
        ),
    };
    diagnostics.error(psi.span, message);
    None
}

fn in_region(region: &Region) -> String {
    if region.sides.is_empty() {
        String::new()
    } else {
        format!(" in the region `{}`", region.ident)
    }
}

/// `x*y, which is 0.25 at x = 0.5, y = 0.5`
fn refutation(dag: &Dag, counterexample: &Counterexample) -> String {
    let residual = shortened(&to_text(dag, counterexample.residual));
    if dag.as_constant(counterexample.residual).is_some() {
        return residual;
    }
    let depends: Vec<Name> = dag.variables([counterexample.residual]);
    let point: Vec<String> = counterexample
        .point
        .iter()
        .filter(|(name, _)| depends.contains(name))
        .map(|(name, value)| format!("{name} = {}", rounded(*value)))
        .collect();
    let value = rounded(counterexample.value);
    if point.is_empty() {
        format!("{residual}, which is {value}")
    } else {
        format!("{residual}, which is {value} at {}", point.join(", "))
    }
}

fn shortened(text: &str) -> String {
    if text.chars().count() <= LONGEST_RESIDUAL {
        return text.to_owned();
    }
    let beginning: String = text.chars().take(LONGEST_RESIDUAL).collect();
    format!("{beginning}…")
}

/// Four significant digits.
fn rounded(value: f64) -> String {
    let scientific = format!("{value:.3e}");
    let shorter: f64 = scientific.parse().unwrap_or(value);
    if shorter == 0.0 || (1e-3..1e5).contains(&shorter.abs()) {
        format!("{shorter}")
    } else {
        format!("{shorter:e}")
    }
}

/// Interfaces that cannot be crossed.
fn interfaces(model: &mut Model, variables: &Variables, diagnostics: &mut Diagnostics) {
    let dag = &mut model.dag;
    for interface in &model.interfaces {
        let g = interface.switching_function;
        let name = &interface.ident;
        let gradient = gradient(dag, g, &variables.states);
        let by_time = differentiate(dag, g, &Model::time());
        let derivatives = gradient.iter().copied().chain([by_time]);
        let is_constant = derivatives.into_iter().all(|one| is_proved_zero(dag, one));
        let is_never_crossed = !is_constant
            && model.regions.iter().all(|region| {
                let rate = rate(dag, by_time, &gradient, &region.field);
                is_proved_zero(dag, rate)
            });
        if is_constant {
            let message = format!(
                "the interface `{name}` is constant: all of its derivatives are zero, so nothing can cross it"
            );
            diagnostics.error(interface.span, message);
        } else if is_never_crossed {
            let message = format!(
                "the interface `{name}` is never crossed: d/dt {name} = 0 in every region, so that each region is a system of its own"
            );
            diagnostics.error(interface.span, message);
        }
    }
}
