//! The expressions of a region, lowered together so that they share what they have in common.

use super::lower::{Lowered, size};
use super::system::Emission;
use crate::algebra::{Dag, Id, Name};
use crate::scheme::{Explicit, RegionScheme, Strategy};

/// The lowered nodes of a region.
pub(super) struct Nodes {
    pub field: Vec<Id>,
    pub psi: Vec<Id>,
    pub psi_size: Vec<Id>,
    pub multiplier: Vec<Vec<Id>>,
    pub discrete: Discrete,
}

/// The lowered nodes of f^τ.
pub(super) enum Discrete {
    Explicit(Field),
    MinimalNorm(Box<MinimalNorm>),
}

/// A lowered [`Explicit`].
pub(super) struct Field {
    pub value: Vec<Id>,
    pub jacobian: Vec<Vec<Id>>,
    pub time_derivative: Vec<Id>,
}

/// The lowered nodes of [`Strategy::MinimalNorm`].
pub(super) struct MinimalNorm {
    pub multiplier: Vec<Vec<Id>>,
    pub by_time: Vec<Id>,
    pub mean: Field,
    pub lambda: Vec<Name>,
    pub field: Vec<Name>,
    pub transposed_jacobian: Vec<Vec<Id>>,
    pub transposed_time_derivative: Vec<Id>,
    pub constraint_jacobian: Vec<Vec<Id>>,
    pub constraint_time_derivative: Vec<Id>,
}

impl Nodes {
    pub(super) fn lower(
        dag: &mut Dag,
        lowered: &mut Lowered,
        emission: &Emission<'_>,
        region: usize,
    ) -> Self {
        let declared = &emission.scheme.model.regions[region];
        let scheme = &emission.scheme.regions[region];
        let psi: Vec<Id> = declared.conserved.iter().map(|one| one.psi).collect();
        let sizes: Vec<Id> = psi.iter().map(|&psi| size(dag, psi)).collect();
        Self {
            field: lower_all(dag, lowered, &declared.field),
            psi: lower_all(dag, lowered, &psi),
            psi_size: lower_all(dag, lowered, &sizes),
            multiplier: lower_rows(dag, lowered, &scheme.multiplier),
            discrete: Discrete::lower(dag, lowered, scheme),
        }
    }

    pub(super) fn roots(&self) -> Vec<Id> {
        let mut roots = [&self.field[..], &self.psi, &self.psi_size].concat();
        roots.extend(self.multiplier.iter().flatten());
        match &self.discrete {
            Discrete::Explicit(field) => field.roots(&mut roots),
            Discrete::MinimalNorm(nodes) => {
                nodes.mean.roots(&mut roots);
                roots.extend(nodes.multiplier.iter().flatten());
                roots.extend(&nodes.by_time);
                roots.extend(nodes.transposed_jacobian.iter().flatten());
                roots.extend(&nodes.transposed_time_derivative);
                roots.extend(nodes.constraint_jacobian.iter().flatten());
                roots.extend(&nodes.constraint_time_derivative);
            }
        }
        roots
    }
}

impl Discrete {
    pub(super) fn lower(dag: &Dag, lowered: &mut Lowered, scheme: &RegionScheme) -> Self {
        match &scheme.strategy {
            Strategy::Midpoint { field }
            | Strategy::SkewPairing { field, .. }
            | Strategy::CrossProduct { field, .. } => {
                Self::Explicit(Field::lower(dag, lowered, field))
            }
            Strategy::MinimalNorm {
                mean,
                lambda,
                field,
                transposed_jacobian,
                transposed_time_derivative,
                constraint_jacobian,
                constraint_time_derivative,
            } => Self::MinimalNorm(Box::new(MinimalNorm {
                multiplier: lower_rows(dag, lowered, &scheme.discrete_multiplier),
                by_time: lower_all(dag, lowered, &scheme.discrete_time_derivative),
                mean: Field::lower(dag, lowered, mean),
                lambda: lambda.clone(),
                field: field.clone(),
                transposed_jacobian: lower_rows(dag, lowered, transposed_jacobian),
                transposed_time_derivative: lower_all(dag, lowered, transposed_time_derivative),
                constraint_jacobian: lower_rows(dag, lowered, constraint_jacobian),
                constraint_time_derivative: lower_all(dag, lowered, constraint_time_derivative),
            })),
        }
    }
}

impl Field {
    pub(super) fn lower(dag: &Dag, lowered: &mut Lowered, field: &Explicit) -> Self {
        Self {
            value: lower_all(dag, lowered, &field.value),
            jacobian: lower_rows(dag, lowered, &field.jacobian),
            time_derivative: lower_all(dag, lowered, &field.time_derivative),
        }
    }

    pub(super) fn roots(&self, roots: &mut Vec<Id>) {
        roots.extend(&self.value);
        roots.extend(self.jacobian.iter().flatten());
        roots.extend(&self.time_derivative);
    }
}

fn lower_all(dag: &Dag, lowered: &mut Lowered, roots: &[Id]) -> Vec<Id> {
    roots.iter().map(|&root| lowered.lower(dag, root)).collect()
}

fn lower_rows(dag: &Dag, lowered: &mut Lowered, rows: &[Vec<Id>]) -> Vec<Vec<Id>> {
    rows.iter()
        .map(|row| lower_all(dag, lowered, row))
        .collect()
}
