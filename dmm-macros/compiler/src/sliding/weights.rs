//! The weights of a mean, solved for: Σₖ ∇gᵣ·Fₖ wₖ + ∂ₜgᵣ + ∇gᵣ·f₀ = 0 for the interface of every
//! weight r.

use super::mean::{Mean, Problem, simplified};
use crate::algebra::linear::determinant;
use crate::algebra::{Dag, Id, differentiate, gradient, is_proved_zero};
use crate::model::Model;

/// At most so many weights depend on one another.
const MOST_COUPLED: usize = 16;
/// Of so many at most by determinants, which have no pivots that may vanish.
const MOST_BY_DETERMINANTS: usize = 3;

/// A weight.
pub(super) struct Solution {
    /// w; of a switch that does not slide the constant of its side.
    pub(super) weight: Id,
    /// If it depends on no other weight that depends on it: the right side and the slope of its
    /// equation, slope w = right.
    pub(super) alone: Option<(Id, Id)>,
    /// Of a switch: 1 while it slides and 0 elsewhere, and the constant of its side.
    pub(super) switch: Option<(Id, Id)>,
}

/// The linear equations of the weights.
pub(super) struct System {
    /// ∇gᵣ·Fₖ
    matrix: Vec<Vec<Id>>,
    /// ∂ₜgᵣ + ∇gᵣ·f₀
    rest: Vec<Id>,
}

impl System {
    /// That of a mean.
    pub(super) fn of(model: &mut Model, mean: &Mean) -> Self {
        let states = model.state_names();
        let (mut matrix, mut rest) = (Vec::new(), Vec::new());
        for row in &mean.weights {
            let g = model.interfaces[row.interface].switching_function;
            let dag = &mut model.dag;
            let slopes = gradient(dag, g, &states);
            let mut entries = Vec::new();
            for weight in &mean.weights {
                entries.push(product(dag, &slopes, &weight.column));
            }
            matrix.push(entries);
            let by_time = differentiate(dag, g, &Model::time());
            let along = product(dag, &slopes, &mean.base);
            let sum = dag.add(by_time, along);
            rest.push(simplified(dag, sum));
        }
        Self { matrix, rest }
    }

    /// The weights; nothing where an interface of the place is one on which nothing slides.
    pub(super) fn solve(
        &self,
        model: &mut Model,
        mean: &Mean,
    ) -> Result<Option<Vec<Solution>>, Problem> {
        let mut solutions: Vec<Option<Solution>> = mean.weights.iter().map(|_| None).collect();
        for block in self.blocks(&model.dag) {
            let interface = mean.weights[block[0]].interface;
            let name = model.interfaces[interface].name();
            let problem = |message: String| Problem { interface, message };
            if block.len() > MOST_COUPLED {
                return Err(problem(format!(
                    "{} sliding switches depend on one another, `{name}` among them: up to {MOST_COUPLED} are supported",
                    block.len(),
                )));
            }
            let matrix: Vec<Vec<Id>> = (block.iter())
                .map(|&row| block.iter().map(|&k| self.matrix[row][k]).collect())
                .collect();
            let columns: Vec<usize> = (0..block.len()).collect();
            let is_singular = block.len() <= MOST_BY_DETERMINANTS && {
                let determinant = determinant(&mut model.dag, &matrix, &columns);
                is_proved_zero(&model.dag, determinant)
            };
            if is_singular {
                if block.iter().any(|&one| !mean.weights[one].is_switch) {
                    return Ok(None);
                }
                return Err(problem(format!(
                    "no solution slides on `{name}`: what switches there does not change how fast `{name}` changes"
                )));
            }
            let found = self.solve_block(model, mean, (&block, matrix), &solutions);
            for (&one, solution) in block.iter().zip(found) {
                solutions[one] = Some(solution);
            }
        }
        Ok(solutions.into_iter().collect())
    }

    fn solve_block(
        &self,
        model: &mut Model,
        mean: &Mean,
        (block, mut matrix): (&[usize], Vec<Vec<Id>>),
        known: &[Option<Solution>],
    ) -> Vec<Solution> {
        let mut switches = Vec::new();
        for &one in block {
            let weight = &mean.weights[one];
            let interface = &model.interfaces[weight.interface];
            let (slides, side) = (Model::slide_of(interface), interface.side.clone());
            let dag = &mut model.dag;
            let (slides, side) = (dag.variable(&slides), dag.variable(&side));
            switches.push(weight.is_switch.then_some((slides, side)));
        }
        let dag = &mut model.dag;
        let mut right = Vec::new();
        for &row in block {
            let mut terms = vec![self.rest[row]];
            for (entry, known) in self.matrix[row].iter().zip(known) {
                if let Some(known) = known {
                    terms.push(dag.mul(*entry, known.weight));
                }
            }
            let sum = dag.sum(terms);
            let sum = dag.neg(sum);
            right.push(simplified(dag, sum));
        }
        let alone = (block.len() == 1).then(|| (right[0], matrix[0][0]));
        // a switch that does not slide has the weight of its side
        for (row, switch) in switches.iter().enumerate() {
            let Some((slides, side)) = *switch else {
                continue;
            };
            for (column, entry) in matrix[row].iter_mut().enumerate() {
                let unit = dag.integer(i64::from(row == column));
                *entry = dag.blend(slides, *entry, unit);
            }
            right[row] = dag.blend(slides, right[row], side);
        }
        for (row, &right) in matrix.iter_mut().zip(&right) {
            row.push(right);
        }
        let weights = if block.len() <= MOST_BY_DETERMINANTS {
            by_determinants(dag, &matrix)
        } else {
            by_elimination(dag, matrix)
        };
        let solution = |(weight, switch)| Solution {
            weight,
            alone,
            switch,
        };
        weights.into_iter().zip(switches).map(solution).collect()
    }

    /// The weights that depend on one another together, those that others depend on first.
    fn blocks(&self, dag: &Dag) -> Vec<Vec<usize>> {
        let count = self.matrix.len();
        let mut reaches = vec![vec![false; count]; count];
        for (row, entries) in self.matrix.iter().enumerate() {
            for (column, &entry) in entries.iter().enumerate() {
                reaches[row][column] = row == column || !dag.is_zero(entry);
            }
        }
        for middle in 0..count {
            for row in 0..count {
                for column in 0..count {
                    reaches[row][column] |= reaches[row][middle] && reaches[middle][column];
                }
            }
        }
        let mut blocks: Vec<Vec<usize>> = Vec::new();
        let mut left: Vec<usize> = (0..count).collect();
        while !left.is_empty() {
            // one that depends on nothing but what depends on it
            let is_next = |&&one: &&usize| {
                let mut others = left.iter();
                others.all(|&other| !reaches[one][other] || reaches[other][one])
            };
            let Some(&first) = left.iter().find(is_next) else {
                break;
            };
            let is_with = |&one: &usize| reaches[first][one] && reaches[one][first];
            let (block, others) = left.iter().partition(|one| is_with(one));
            left = others;
            blocks.push(block);
        }
        blocks
    }
}

/// The solution of linear equations, whose right sides are the last column, by Cramer's rule.
fn by_determinants(dag: &mut Dag, rows: &[Vec<Id>]) -> Vec<Id> {
    let columns: Vec<usize> = (0..rows.len()).collect();
    let whole = determinant(dag, rows, &columns);
    let solution = |index: usize| {
        let mut replaced = columns.clone();
        replaced[index] = rows.len();
        let part = determinant(dag, rows, &replaced);
        dag.div(part, whole)
    };
    (0..rows.len()).map(solution).collect()
}

/// The same by Gaussian elimination without a choice of pivots: those of friction between bodies, whose
/// matrix is that of inverse masses, are not zero.
fn by_elimination(dag: &mut Dag, mut rows: Vec<Vec<Id>>) -> Vec<Id> {
    let count = rows.len();
    for pivot in 0..count {
        let (done, below) = rows.split_at_mut(pivot + 1);
        let above = &done[pivot];
        for row in below {
            if dag.is_zero(row[pivot]) {
                continue;
            }
            let factor = dag.div(row[pivot], above[pivot]);
            for column in pivot..=count {
                let part = dag.mul(factor, above[column]);
                row[column] = dag.sub(row[column], part);
            }
            row[pivot] = dag.integer(0);
        }
    }
    let mut solution = vec![dag.integer(0); count];
    for index in (0..count).rev() {
        let mut rest = rows[index][count];
        for later in index + 1..count {
            let part = dag.mul(rows[index][later], solution[later]);
            rest = dag.sub(rest, part);
        }
        solution[index] = dag.div(rest, rows[index][index]);
    }
    solution
}

/// Σ uᵢ vᵢ
fn product(dag: &mut Dag, u: &[Id], v: &[Id]) -> Id {
    let mut terms = Vec::new();
    for (&u, &v) in u.iter().zip(v) {
        terms.push(dag.mul(u, v));
    }
    let sum = dag.sum(terms);
    simplified(dag, sum)
}
