//! What the functions of a flow evaluate: the expressions of a region, lowered together, and
//! then optimised function by function.

use super::lower::{Lowered, size};
use crate::algebra::{Dag, Id, Name};
use crate::optimise::Optimiser;
use crate::scheme::{Explicit, RegionScheme, Scheme, Strategy};

/// A matrix by rows.
pub(super) type Rows = Vec<Vec<Id>>;

/// The nodes of a region, by the function that evaluates them.
#[derive(Clone)]
pub(super) struct Nodes {
    /// f
    pub field: Vec<Id>,
    /// ψ
    pub psi: Vec<Id>,
    /// Σ|terms of ψ|
    pub psi_size: Vec<Id>,
    /// ψ and Λ
    pub multiplier: (Vec<Id>, Rows),
    /// The functions over a step.
    pub discrete: Discrete,
}

/// The nodes of f^τ and its derivatives.
#[derive(Clone)]
pub(super) enum Discrete {
    Explicit(Field),
    MinimalNorm(Box<MinimalNorm>),
}

/// The functions of a field that is an expression.
#[derive(Clone)]
pub(super) struct Field {
    /// f^τ
    pub value: Vec<Id>,
    /// f^τ and ∂f^τ/∂x₁
    pub linearised: (Vec<Id>, Rows),
    /// ∂f^τ/∂t₁, where the flow is not autonomous
    pub time_derivative: Option<Vec<Id>>,
}

/// The functions of [`Strategy::MinimalNorm`].
#[derive(Clone)]
pub(super) struct MinimalNorm {
    /// The variables λ.
    pub lambda: Vec<Name>,
    /// The variables w = f^τ.
    pub field: Vec<Name>,
    /// f^τ
    pub value: Base,
    /// f^τ; the derivatives by x₁ of f̄, Λ^τᵀλ and Λ^τw + ∂ₜ^τψ
    pub linearised: (Base, [Rows; 3]),
    /// f^τ; the derivatives by t₁ of f̄, Λ^τᵀλ and Λ^τw + ∂ₜ^τψ, where the flow is not
    /// autonomous
    pub time_derivative: Option<(Base, [Vec<Id>; 3])>,
}

/// What the projection on the conserved quantities is made from.
#[derive(Clone)]
pub(super) struct Base {
    /// Λ^τ
    pub multiplier: Rows,
    /// f̄
    pub mean: Vec<Id>,
    /// ∂ₜ^τψ
    pub by_time: Vec<Id>,
}

impl Nodes {
    /// The operations of a region as they are written.
    pub(super) fn lower(
        dag: &mut Dag,
        lowered: &mut Lowered,
        scheme: &Scheme,
        region: usize,
    ) -> Self {
        let declared = &scheme.model.regions[region];
        let scheme = &scheme.regions[region];
        let psi: Vec<Id> = declared.conserved.iter().map(|one| one.psi).collect();
        let sizes: Vec<Id> = psi.iter().map(|&psi| size(dag, psi)).collect();
        let psi = lower_all(dag, lowered, &psi);
        Self {
            field: lower_all(dag, lowered, &declared.field),
            multiplier: (psi.clone(), lower_rows(dag, lowered, &scheme.multiplier)),
            psi,
            psi_size: lower_all(dag, lowered, &sizes),
            discrete: Discrete::lower(dag, lowered, scheme),
        }
    }

    /// The same functions by fewer operations. The functions at a point and those over a step
    /// have no variables in common, and are optimised apart.
    pub(super) fn optimised(
        &self,
        lowered: &Lowered,
        optimiser: &mut Optimiser,
    ) -> (Self, Lowered) {
        let mut nodes = self.clone();
        let mut target = Lowered::new(lowered.parameters().to_vec());
        for id in &mut nodes.psi_size {
            *id = target.copy(lowered, *id);
        }
        let (psi, rows) = &mut nodes.multiplier;
        let point = vec![
            nodes.field.iter_mut().collect(),
            nodes.psi.iter_mut().collect(),
            list(psi, rows),
        ];
        target.optimise(lowered, point, optimiser);
        target.optimise(lowered, nodes.discrete.functions_mut(), optimiser);
        (nodes, target)
    }

    /// The emitted methods with what they evaluate.
    pub(super) fn functions(&self) -> Vec<(&'static str, Vec<Id>)> {
        let (psi, rows) = &self.multiplier;
        let point = [
            ("vector_field", self.field.clone()),
            ("conserved", self.psi.clone()),
            ("conserved_size", self.psi_size.clone()),
            ("multiplier", [&psi[..], &rows.concat()].concat()),
        ];
        let names = ["discrete_vector_field", "linearised", "time_derivative"];
        let mut discrete = self.discrete.clone();
        let step = names.into_iter().zip(discrete.functions_mut());
        let step = step.map(|(name, roots)| (name, roots.into_iter().map(|root| *root).collect()));
        point.into_iter().chain(step).collect()
    }

    /// Everything that is evaluated.
    pub(super) fn roots(&self) -> Vec<Id> {
        let functions = self.functions().into_iter();
        functions.flat_map(|(_, roots)| roots).collect()
    }
}

impl Discrete {
    fn lower(dag: &Dag, lowered: &mut Lowered, scheme: &RegionScheme) -> Self {
        match &scheme.strategy {
            Strategy::Midpoint { field }
            | Strategy::SkewPairing { field, .. }
            | Strategy::CrossProduct { field, .. } => {
                Self::Explicit(Field::lower(dag, lowered, field, scheme.autonomous))
            }
            Strategy::MinimalNorm {
                mean,
                lambda,
                field,
                transposed_jacobian,
                transposed_time_derivative,
                constraint_jacobian,
                constraint_time_derivative,
            } => {
                let value = Base {
                    multiplier: lower_rows(dag, lowered, &scheme.discrete_multiplier),
                    mean: lower_all(dag, lowered, &mean.value),
                    by_time: lower_all(dag, lowered, &scheme.discrete_time_derivative),
                };
                let by_state = [&mean.jacobian, transposed_jacobian, constraint_jacobian]
                    .map(|rows| lower_rows(dag, lowered, rows));
                let by_time = [
                    &mean.time_derivative,
                    transposed_time_derivative,
                    constraint_time_derivative,
                ]
                .map(|entries| lower_all(dag, lowered, entries));
                Self::MinimalNorm(Box::new(MinimalNorm {
                    lambda: lambda.clone(),
                    field: field.clone(),
                    linearised: (value.clone(), by_state),
                    time_derivative: (!scheme.autonomous).then(|| (value.clone(), by_time)),
                    value,
                }))
            }
        }
    }

    /// The roots of f^τ, (f^τ, ∂f^τ/∂x₁) and, where the flow is not autonomous, ∂f^τ/∂t₁.
    fn functions_mut(&mut self) -> Vec<Vec<&mut Id>> {
        match self {
            Self::Explicit(field) => {
                let (value, rows) = &mut field.linearised;
                let by_time = field.time_derivative.iter_mut();
                [field.value.iter_mut().collect(), list(value, rows)]
                    .into_iter()
                    .chain(by_time.map(|entries| entries.iter_mut().collect()))
                    .collect()
            }
            Self::MinimalNorm(nodes) => {
                let (base, matrices) = &mut nodes.linearised;
                let mut linearised = base.roots();
                linearised.extend(matrices.iter_mut().flatten().flatten());
                let by_time = nodes.time_derivative.iter_mut().map(|(base, columns)| {
                    let mut roots = base.roots();
                    roots.extend(columns.iter_mut().flatten());
                    roots
                });
                [nodes.value.roots(), linearised]
                    .into_iter()
                    .chain(by_time)
                    .collect()
            }
        }
    }
}

impl Field {
    fn lower(dag: &Dag, lowered: &mut Lowered, field: &Explicit, autonomous: bool) -> Self {
        let value = lower_all(dag, lowered, &field.value);
        Self {
            linearised: (value.clone(), lower_rows(dag, lowered, &field.jacobian)),
            time_derivative: (!autonomous).then(|| lower_all(dag, lowered, &field.time_derivative)),
            value,
        }
    }
}

impl Base {
    fn roots(&mut self) -> Vec<&mut Id> {
        let mut roots = list(&mut self.mean, &mut self.multiplier);
        roots.extend(&mut self.by_time);
        roots
    }

    /// The values of every root.
    pub(super) fn all(&self) -> Vec<Id> {
        [&self.multiplier.concat()[..], &self.mean, &self.by_time].concat()
    }
}

/// The entries of a column and a matrix, row by row, so that what they share stands together.
fn list<'a>(column: &'a mut [Id], rows: &'a mut Rows) -> Vec<&'a mut Id> {
    let mut rows = rows.iter_mut();
    let mut entries = Vec::new();
    for entry in column {
        entries.push(entry);
        entries.extend(rows.next().into_iter().flatten());
    }
    entries.extend(rows.flatten());
    entries
}

fn lower_all(dag: &Dag, lowered: &mut Lowered, roots: &[Id]) -> Vec<Id> {
    roots.iter().map(|&root| lowered.lower(dag, root)).collect()
}

fn lower_rows(dag: &Dag, lowered: &mut Lowered, rows: &[Vec<Id>]) -> Rows {
    rows.iter()
        .map(|row| lower_all(dag, lowered, row))
        .collect()
}
