//! The results of a function: numbers, columns and matrices of nodes.

use crate::algebra::Id;

/// A matrix by rows.
pub type Rows = Vec<Vec<Id>>;

/// What a function gives.
#[derive(Debug, Clone)]
pub enum Results {
    /// A number.
    Scalar(Id),
    /// A column.
    Column(Vec<Id>),
    /// A matrix, as ∂f/∂x.
    Matrix(Rows),
    /// A number and a column, as ∂ₜg and ∇g.
    ScalarAndColumn(Id, Vec<Id>),
    /// A column and a matrix with as many rows, as f^τ and ∂f^τ/∂x₁.
    ColumnAndMatrix(Vec<Id>, Rows),
    /// f^τ = f̄ − Λ^τᵀ λ, which is solved for, or a derivative of it.
    Projected(Box<Projected>),
}

/// What the projection of f̄ on the conserved quantities is made from:
/// (Λ^τ Λ^τᵀ) λ = Λ^τ f̄ + ∂ₜ^τψ and w = f^τ = f̄ − Λ^τᵀ λ.
#[derive(Debug, Clone)]
pub struct Projected {
    /// Λ^τ
    pub multiplier: Rows,
    /// f̄
    pub mean: Vec<Id>,
    /// ∂ₜ^τψ
    pub by_time: Vec<Id>,
    /// What a derivative of f^τ takes in addition, over w and λ.
    pub derivative: Option<Derivative>,
}

/// The derivatives of f̄, of Λ^τᵀ λ at constant λ, and of Λ^τ w + ∂ₜ^τψ at constant w.
#[derive(Debug, Clone)]
pub enum Derivative {
    /// By x₁.
    State([Rows; 3]),
    /// By t₁.
    Time([Vec<Id>; 3]),
}

impl Results {
    /// All results; a column and a matrix row by row, so that what they share stands together.
    pub fn roots(&self) -> Vec<Id> {
        self.clone()
            .roots_mut()
            .into_iter()
            .map(|root| *root)
            .collect()
    }

    /// As [`Results::roots`].
    pub(super) fn roots_mut(&mut self) -> Vec<&mut Id> {
        match self {
            Self::Scalar(root) => vec![root],
            Self::Column(column) => column.iter_mut().collect(),
            Self::Matrix(rows) => rows.iter_mut().flatten().collect(),
            Self::ScalarAndColumn(scalar, column) => {
                let mut roots = vec![scalar];
                roots.extend(column);
                roots
            }
            Self::ColumnAndMatrix(column, rows) => row_by_row(column, rows),
            Self::Projected(projected) => {
                let Projected {
                    multiplier,
                    mean,
                    by_time,
                    derivative,
                } = &mut **projected;
                let mut roots = row_by_row(mean, multiplier);
                roots.extend(by_time);
                roots.extend(derivative.iter_mut().flat_map(Derivative::roots_mut));
                roots
            }
        }
    }
}

impl Projected {
    /// What has to be known before λ and w are solved for.
    pub fn roots(&self) -> Vec<Id> {
        [&self.multiplier.concat()[..], &self.mean, &self.by_time].concat()
    }
}

impl Derivative {
    /// All entries.
    pub fn roots(&self) -> Vec<Id> {
        match self {
            Self::State(matrices) => matrices.concat().concat(),
            Self::Time(columns) => columns.concat(),
        }
    }

    fn roots_mut(&mut self) -> Vec<&mut Id> {
        match self {
            Self::State(matrices) => matrices.iter_mut().flatten().flatten().collect(),
            Self::Time(columns) => columns.iter_mut().flatten().collect(),
        }
    }
}

/// The entries of a column and a matrix, row by row.
fn row_by_row<'a>(column: &'a mut [Id], rows: &'a mut Rows) -> Vec<&'a mut Id> {
    let mut rows = rows.iter_mut();
    let mut entries = Vec::new();
    for entry in column {
        entries.push(entry);
        entries.extend(rows.next().into_iter().flatten());
    }
    entries.extend(rows.flatten());
    entries
}
