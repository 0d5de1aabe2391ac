//! The Jacobian of a step: ∂F/∂x₁ = I − τ ∂f^τ/∂x₁.
//!
//! For f^τ = f̄ − Λ^τᵀ λ the derivative is that of [`minimal_norm`](crate::scheme::Strategy),
//! P (∂f̄/∂x₁ − B) − Λ⁺ C, of which the entries of ∂f̄/∂x₁, B and C are listed.

use super::compose::{Entry, words};
use super::document::{Part, Piece, Section};
use super::lister::{Lister, symbol, titled};
use crate::algebra::{Id, Name};
use crate::model::plain_text;
use crate::scheme::Strategy;

/// The Jacobian of a region's step, without its trivial entries.
pub(super) fn section(lister: &mut Lister<'_>) {
    let derived = lister.derived;
    match &derived.strategy {
        Strategy::Midpoint { field }
        | Strategy::SkewPairing { field, .. }
        | Strategy::CrossProduct { field, .. } => explicit(lister, &field.jacobian),
        Strategy::MinimalNorm {
            mean,
            transposed_jacobian,
            constraint_jacobian,
            ..
        } => minimal_norm(
            lister,
            &mean.jacobian,
            transposed_jacobian,
            constraint_jacobian,
        ),
    }
}

/// What is listed.
const TITLE: (&str, &str) = ("Jacobian ", "∂F/∂x₁ = I − τ ∂f^τ/∂x₁");

fn explicit(lister: &mut Lister<'_>, jacobian: &[Vec<Id>]) {
    let states: Vec<&Name> = lister.states().collect();
    let mut entries = Vec::new();
    for (row, derivatives) in jacobian.iter().enumerate() {
        for (column, &derivative) in derivatives.iter().enumerate() {
            if lister.dag().is_zero(derivative) {
                continue;
            }
            let derivative = lister.composer.formula(lister.dag(), derivative);
            if lister.composer.formulas().is_zero(derivative) {
                continue;
            }
            let step = lister.composer.step_size();
            let formulas = lister.composer.formulas();
            let change = formulas.product(false, [(false, step), (false, derivative)]);
            let one = formulas.integer(1);
            let unit = (row == column).then_some((false, one));
            let entry = formulas.sum(unit.into_iter().chain([(true, change)]));
            entries.push((derivative_of("∂F[", states[row], states[column]), entry));
        }
    }
    let section = Section {
        notes: vec![words(others(entries.len(), states.len()))],
        ..titled(TITLE.0, TITLE.1)
    };
    lister.composer.add(section, entries);
}

/// What the entries are that are not listed.
fn others(listed: usize, states: usize) -> &'static str {
    if listed == states * states {
        ""
    } else if listed == 0 {
        "the unit matrix"
    } else {
        "the other entries are those of the unit matrix"
    }
}

fn derivative_of(sign: &'static str, row: &Name, column: &Name) -> Vec<Part> {
    vec![
        Part::Sign(sign),
        symbol(row),
        Part::Sign("]/∂"),
        symbol(&column.at_end()),
    ]
}

fn minimal_norm(
    lister: &mut Lister<'_>,
    mean: &[Vec<Id>],
    transposed: &[Vec<Id>],
    constraint: &[Vec<Id>],
) {
    let section = Section {
        reasons: vec![vec![
            Piece::Signs("∂f^τ/∂x₁ = P (∂f̄/∂x₁ − B) − Λ⁺ C"),
            " with ".into(),
            Piece::Signs("Λ⁺ = Λ^τᵀ (Λ^τ Λ^τᵀ)⁻¹"),
            " and ".into(),
            Piece::Signs("P = I − Λ⁺ Λ^τ"),
        ]],
        ..titled(TITLE.0, TITLE.1)
    };
    lister.composer.add(section, Vec::new());
    let states: Vec<&Name> = lister.states().collect();
    let rows = entries(lister, mean, |row, column| {
        derivative_of("∂f̄[", states[row], states[column])
    });
    not_zero(lister, "∂f̄/∂x₁", "", rows);
    let rows = entries(lister, transposed, |row, column| {
        bracketed("B[", symbol(states[row]), states[column])
    });
    not_zero(lister, "B = ∂(Λ^τᵀ λ)/∂x₁", "at constant λ", rows);
    let conserved = &lister.region.conserved;
    let rows = entries(lister, constraint, |row, column| {
        let name = Part::Name(plain_text(&conserved[row].ident));
        bracketed("C[", name, states[column])
    });
    not_zero(
        lister,
        "C = ∂(Λ^τ f^τ + ∂ₜ^τψ)/∂x₁",
        "at constant f^τ",
        rows,
    );
}

fn not_zero(lister: &mut Lister<'_>, heading: &'static str, remark: &str, rows: Vec<Entry>) {
    let note = match rows.len() {
        0 => "zero",
        _ => "",
    };
    let section = Section {
        remark: words(remark),
        notes: vec![words(note)],
        ..titled("", heading)
    };
    lister.composer.add(section, rows);
}

fn bracketed(sign: &'static str, row: Part, column: &Name) -> Vec<Part> {
    vec![
        Part::Sign(sign),
        row,
        Part::Sign(", "),
        symbol(column),
        Part::Sign("]"),
    ]
}

/// The entries of a matrix that are not zero.
fn entries(
    lister: &mut Lister<'_>,
    matrix: &[Vec<Id>],
    left: impl Fn(usize, usize) -> Vec<Part>,
) -> Vec<Entry> {
    let mut entries = Vec::new();
    for (row, derivatives) in matrix.iter().enumerate() {
        for (column, &derivative) in derivatives.iter().enumerate() {
            if lister.dag().is_zero(derivative) {
                continue;
            }
            let entry = lister.composer.formula(lister.dag(), derivative);
            if !lister.composer.formulas().is_zero(entry) {
                entries.push((left(row, column), entry));
            }
        }
    }
    entries
}
