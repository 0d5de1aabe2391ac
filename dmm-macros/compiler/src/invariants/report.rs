//! The invariants as text, in the notation of declarations.

use std::collections::BTreeSet;
use std::fmt::Write;

use proc_macro2::TokenStream;

use super::{Invariant, Obstacle, find};
use crate::algebra::to_text;
use crate::diagnostics::Diagnostics;
use crate::model::Model;
use crate::syntax;
use crate::{check, proofs};

/// The model of a declaration, of which nothing has to be proved for invariants to be sought.
pub fn read(input: TokenStream) -> Result<Model, Diagnostics> {
    let mut diagnostics = Diagnostics::new();
    let model = syntax::parse(input, &mut diagnostics)
        .filter(|_| diagnostics.is_empty())
        .and_then(|declaration| check::resolve(declaration, &mut diagnostics));
    model.filter(|_| diagnostics.is_empty()).ok_or(diagnostics)
}

/// The polynomial invariants of `model` up to `degree` as text, with lines that can be pasted
/// into the declaration, and comments on where they are conserved: ln x needs x > 0.
pub fn report(model: &mut Model, degree: u32) -> Result<String, Obstacle> {
    let found = find(model, degree)?;
    let mut names = Names::of(model);
    let mut text = String::new();
    let quantities: Vec<String> = found
        .generators
        .iter()
        .map(|&generator| to_text(&model.dag, generator))
        .collect();
    let _ = writeln!(
        text,
        "invariants of {}: polynomials of degree up to {} in {} ({} monomials)",
        model.name,
        found.degree,
        quantities.join(", "),
        found.monomials
    );
    if depends_on_time(model) {
        text.push_str("the vector field depends on `t`; sought are invariants without `t`\n");
    }
    let has_regions = !found.regions.is_empty();
    if has_regions {
        text.push_str("\nin all regions:\n");
    } else {
        text.push('\n');
    }
    let all: Vec<usize> = (0..model.regions.len()).collect();
    names.write(&mut text, model, &all, &found.common, found.degree, "");
    for (region, own) in found.regions.iter().enumerate() {
        let Some(ident) = model.regions.get(region).map(|region| &region.ident) else {
            continue;
        };
        let _ = writeln!(text, "\nin the region `{ident}`:");
        let besides = if found.common.is_empty() {
            ""
        } else {
            " besides those of all regions"
        };
        names.write(&mut text, model, &[region], own, found.degree, besides);
    }
    if found.unresolved > 0 {
        let _ = writeln!(
            text,
            "\nthere may be {} more, with coefficients that could not be written down or proved",
            found.unresolved
        );
    }
    Ok(text)
}

fn depends_on_time(model: &Model) -> bool {
    let fields = model.regions.iter().flat_map(|region| &region.field);
    let time = Model::time();
    fields
        .into_iter()
        .any(|&component| model.dag.depends_on(component, &time))
}

/// Names that are not taken.
struct Names {
    taken: BTreeSet<String>,
    count: usize,
}

impl Names {
    fn of(model: &Model) -> Self {
        let states = model.states.iter().map(|state| &state.ident);
        let parameters = model.parameters.iter().map(|parameter| &parameter.ident);
        let interfaces = model.interfaces.iter().map(|interface| &interface.ident);
        let conserved = model.regions.iter().flat_map(|region| &region.conserved);
        let conserved = conserved.map(|conserved| &conserved.ident);
        let idents = states.chain(parameters).chain(interfaces).chain(conserved);
        Self {
            taken: idents.map(ToString::to_string).collect(),
            count: 0,
        }
    }

    fn next(&mut self) -> String {
        loop {
            self.count += 1;
            let name = format!("invariant_{}", self.count);
            if !self.taken.contains(&name) {
                return name;
            }
        }
    }

    /// One line an invariant, below one that says where it is conserved unless that is
    /// everywhere.
    fn write(
        &mut self,
        text: &mut String,
        model: &mut Model,
        regions: &[usize],
        invariants: &[Invariant],
        degree: u32,
        besides: &str,
    ) {
        for invariant in invariants {
            let derivatives = &invariant.derivatives;
            let conditions: Vec<String> =
                proofs::domain(model, regions, invariant.psi, derivatives)
                    .into_iter()
                    .map(|condition| condition.statement(&model.dag))
                    .collect();
            if !conditions.is_empty() {
                let _ = writeln!(text, "    // where {}", conditions.join(", "));
            }
            let psi = to_text(&model.dag, invariant.psi);
            let _ = writeln!(text, "    conserved {} = {psi};", self.next());
        }
        if invariants.is_empty() {
            let _ = writeln!(text, "    none up to degree {degree}{besides}");
        }
    }
}
