//! Model → model with its sliding motions: one more region for each place where a solution may slide.
//!
//! Where the fields on both sides of an interface g = 0 lead to it, a solution goes on along the
//! mean of them that stays on it (Filippov 1988; Nurkanović, Sperl, Albrecht & Diehl 2024, eq. 3
//! and 14),
//!
//! ```text
//! ẋ = Σ θᵢ fᵢ(t, x),      Σ θᵢ = 1,      ∂ₜg + ∇g·ẋ = 0,
//! ```
//!
//! as long as every θᵢ is positive. The θᵢ are solved for here, so that the motion is a vector field
//! like any other: g is one of its conserved quantities, θᵢ = 0 is where it ends, and everything
//! behind this stage treats it as a region. A switch of a formula is s u + (1 − s) v with the
//! constant s of the mode; it slides where s is the θ(t, x) of this equation instead. So one field
//! serves every set of switches that slide: a constant for each of them says whether it does.

mod mean;
mod motion;
mod places;
mod weights;

use std::collections::HashSet;

use quote::format_ident;

use crate::diagnostics::Diagnostics;
use crate::diagnostics::catalogue::check as codes;
use crate::model::{Model, plain_text};
use mean::{Problem, of_place};
use motion::{Motion, motion};
use places::{Place, places};

/// Adds the sliding motions to a model. Where something that is declared to slide cannot, that is
/// reported.
pub fn extend(model: &mut Model, diagnostics: &mut Diagnostics) {
    let slides = |index: &usize| model.interfaces[*index].slides;
    let sliding: Vec<usize> = (0..model.interfaces.len()).filter(slides).collect();
    if sliding.is_empty() {
        return;
    }
    let mut found: Vec<Place> = Vec::new();
    for (position, &first) in sliding.iter().enumerate() {
        found.extend(places(model, &[first]));
        let others = sliding.get(position + 1..).unwrap_or_default();
        for &second in others {
            found.extend(places(model, &[first, second]));
        }
    }
    let declared = model.regions.len();
    let regions = (0..declared).map(|region| Place::of_region(model, region));
    let mut known: HashSet<usize> = HashSet::new();
    for place in regions.chain(found).collect::<Vec<Place>>() {
        match motions(model, &place) {
            Ok(motions) => {
                for motion in motions {
                    known.extend(place.on.iter().chain(&motion.switches).copied());
                    let name = name(model, &place, !motion.switches.is_empty());
                    motion.add_to(model, &place, name);
                }
            }
            Err(problem) => {
                let span = model.interfaces[problem.interface].span;
                diagnostics.report(codes::NOT_A_MEAN, span, problem.message);
                return;
            }
        }
    }
    for &interface in sliding.iter().filter(|one| !known.contains(one)) {
        let interface = &model.interfaces[interface];
        let message = format!(
            "no solution slides on `{}`: the fields on its sides do the same to its switching function",
            interface.name()
        );
        diagnostics.report(codes::NO_SLIDING, interface.span, message);
    }
}

/// The motions at a place: on its interfaces alone, and on switches too.
fn motions(model: &mut Model, place: &Place) -> Result<Vec<Motion>, Problem> {
    let Some(mean) = of_place(model, place) else {
        return Ok(Vec::new());
    };
    let mut motions = Vec::new();
    if !place.on.is_empty() {
        motions.extend(motion(model, &mean)?);
    }
    if let Some(mean) = mean.with_switches(model, place)? {
        motions.extend(motion(model, &mean)?);
    }
    Ok(motions)
}

/// The name of a motion, which no other region has.
fn name(model: &Model, place: &Place, with_switches: bool) -> proc_macro2::Ident {
    let mut text = String::new();
    if place.on.is_empty() {
        let region = place
            .regions
            .first()
            .and_then(|&one| model.regions.get(one));
        text += &region.map_or_else(String::new, |region| plain_text(&region.ident));
    }
    for (index, &interface) in place.on.iter().enumerate() {
        text += if index == 0 { "sliding_" } else { "_and_" };
        text += &plain_text(&model.interfaces[interface].ident);
    }
    if with_switches {
        text += if place.on.is_empty() {
            "_sliding"
        } else {
            "_and_switches"
        };
    }
    let camel = |text: &str| crate::model::camel_case(text);
    let is_taken = |text: &str| {
        let mut regions = model.regions.iter();
        regions.any(|region| camel(&region.ident.to_string()) == camel(text))
    };
    if is_taken(&text) {
        // several motions on the same interface have the names of what lies beside it
        for &region in &place.regions {
            text += &format!("_{}", plain_text(&model.regions[region].ident));
        }
    }
    while is_taken(&text) {
        text += "_other";
    }
    format_ident!("{text}")
}
