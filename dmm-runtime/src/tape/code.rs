//! Functions as operations on registers, translated once from a program.

use std::collections::BTreeSet;

use dmm_compiler::algebra::Id;
use dmm_compiler::program::{
    Derivative, Function, Functions, Input, Projected, Quantity, Results, Rows, Variable,
};

use super::operation::{self, Operation, Register, constants, register};
use crate::arithmetic::{Matrix, Scalar, Vector};

/// Functions over the same registers.
#[derive(Debug)]
pub(super) struct Code {
    /// How many registers there are.
    registers: usize,
    constants: Vec<(Register, f64)>,
    /// The parameters, by their registers.
    parameters: Vec<(Register, usize)>,
    /// What depends on parameters alone.
    fixed: Vec<Operation>,
    routines: Vec<(Quantity, Routine)>,
}

/// A function.
#[derive(Debug)]
pub(super) struct Routine {
    pub(super) first: Stage,
    pub(super) second: Option<Stage>,
    pub(super) results: Values,
}

/// Operations with the variables that they need.
#[derive(Debug)]
pub(super) struct Stage {
    pub(super) inputs: Vec<(Register, Variable)>,
    pub(super) operations: Vec<Operation>,
}

/// A column of registers.
pub(super) type Column = Vec<Register>;
/// The entries of a matrix that are not zero: row, column, register.
pub(super) type Entries = Vec<(u32, u32, Register)>;

/// What a function gives.
#[derive(Debug)]
pub(super) enum Values {
    Scalar(Register),
    Column(Column),
    Matrix(Entries),
    ScalarAndColumn(Register, Column),
    ColumnAndMatrix(Column, Entries),
    Projected(Box<Projection>),
}

/// What f^τ is solved for from.
#[derive(Debug)]
pub(super) struct Projection {
    pub(super) multiplier: Entries,
    pub(super) mean: Column,
    pub(super) by_time: Column,
    pub(super) by_state: Option<[Entries; 3]>,
    pub(super) by_end_time: Option<[Column; 3]>,
}

impl Code {
    /// That of `functions`, with the values of `also` that depend on parameters alone.
    pub(super) fn new(functions: &Functions, also: impl IntoIterator<Item = Id>) -> Self {
        let (lowered, stored) = (&functions.lowered, &functions.stored);
        let parameters = stored.inputs.iter().filter_map(|input| {
            let Variable::Parameter(index) = input.variable else {
                return None;
            };
            Some((register(input.node), index))
        });
        let given: BTreeSet<Id> = stored.inputs.iter().map(|input| input.node).collect();
        let fixed: Vec<Id> = stored.nodes().chain(also).collect();
        let fixed = lowered.order(&fixed, |id| given.contains(&id));
        let routines = functions.all.iter();
        Self {
            registers: lowered.dag().len(),
            constants: constants(lowered),
            parameters: parameters.collect(),
            fixed: Operation::all(lowered, &fixed),
            routines: routines
                .map(|one| (one.quantity, Routine::new(functions, one)))
                .collect(),
        }
    }

    /// Registers with everything that depends on parameters alone.
    pub(super) fn registers<S: Scalar>(&self, parameter: impl Fn(usize) -> S) -> Vec<S> {
        let mut registers = vec![S::from_f64(0.0); self.registers];
        for &(register, value) in &self.constants {
            registers[register as usize] = S::from_f64(value);
        }
        for &(register, index) in &self.parameters {
            registers[register as usize] = parameter(index);
        }
        operation::run(&self.fixed, &mut registers);
        registers
    }

    /// The function that computes `quantity`.
    pub(super) fn get(&self, quantity: Quantity) -> Option<&Routine> {
        let mut routines = self.routines.iter();
        let routine = routines.find(|(of, _)| *of == quantity);
        routine.map(|(_, routine)| routine)
    }
}

impl Routine {
    fn new(functions: &Functions, function: &Function) -> Self {
        let stage = |stage: &dmm_compiler::program::Stage| Stage {
            inputs: inputs(&stage.inputs),
            operations: Operation::all(&functions.lowered, &stage.operations),
        };
        Self {
            first: stage(&function.first),
            second: function.second.as_ref().map(stage),
            results: Values::new(functions, &function.results),
        }
    }
}

/// Variables by their registers.
pub(super) fn inputs(inputs: &[Input]) -> Vec<(Register, Variable)> {
    let inputs = inputs.iter();
    inputs
        .map(|input| (register(input.node), input.variable))
        .collect()
}

impl Stage {
    /// Evaluates it at (t, x).
    #[inline]
    pub(super) fn run_at<S: Scalar, const N: usize>(
        &self,
        registers: &mut [S],
        t: S,
        x: &Vector<S, N>,
    ) {
        self.run(registers, |variable| match variable {
            Variable::State(index) => x[index],
            _ => t,
        });
    }

    /// Evaluates it.
    #[inline]
    pub(super) fn run<S: Scalar>(&self, registers: &mut [S], variable: impl Fn(Variable) -> S) {
        for &(register, of) in &self.inputs {
            registers[register as usize] = variable(of);
        }
        operation::run(&self.operations, registers);
    }
}

/// Registers over other scalars, lane by lane.
pub(super) fn converted<S: Scalar, Other: Scalar>(registers: &[S]) -> Vec<Other> {
    let registers = registers.iter();
    registers
        .map(|value| Other::by_lane(|lane| value.lane(lane)))
        .collect()
}

fn column(ids: &[Id]) -> Column {
    ids.iter().map(|&id| register(id)).collect()
}

fn entries(functions: &Functions, rows: &Rows) -> Entries {
    let mut entries = Vec::new();
    for (i, row) in (0..).zip(rows) {
        for (j, &id) in (0..).zip(row) {
            if !functions.lowered.dag().is_zero(id) {
                entries.push((i, j, register(id)));
            }
        }
    }
    entries
}

impl Values {
    fn new(functions: &Functions, results: &Results) -> Self {
        match results {
            Results::Scalar(root) => Self::Scalar(register(*root)),
            Results::Column(roots) => Self::Column(column(roots)),
            Results::Matrix(rows) => Self::Matrix(entries(functions, rows)),
            Results::ScalarAndColumn(root, roots) => {
                Self::ScalarAndColumn(register(*root), column(roots))
            }
            Results::ColumnAndMatrix(roots, rows) => {
                Self::ColumnAndMatrix(column(roots), entries(functions, rows))
            }
            Results::Projected(projected) => {
                Self::Projected(Box::new(Projection::new(functions, projected)))
            }
        }
    }
}

impl Projection {
    fn new(functions: &Functions, projected: &Projected) -> Self {
        let (by_state, by_end_time) = match &projected.derivative {
            None => (None, None),
            Some(Derivative::State(matrices)) => {
                let matrices = matrices.each_ref();
                (Some(matrices.map(|rows| entries(functions, rows))), None)
            }
            Some(Derivative::Time(columns)) => {
                (None, Some(columns.each_ref().map(|one| column(one))))
            }
        };
        Self {
            multiplier: entries(functions, &projected.multiplier),
            mean: column(&projected.mean),
            by_time: column(&projected.by_time),
            by_state,
            by_end_time,
        }
    }
}

/// The values of a column; zero beyond its end.
#[inline]
pub(super) fn vector<S: Scalar, const N: usize>(
    registers: &[S],
    column: &[Register],
) -> Vector<S, N> {
    let mut vector = Vector::<S, N>::from_element(S::from_f64(0.0));
    for (entry, &register) in vector.iter_mut().zip(column) {
        *entry = registers[register as usize];
    }
    vector
}

/// The values of a matrix; zero beyond its rows and columns.
#[inline]
pub(super) fn matrix<S: Scalar, const R: usize, const C: usize>(
    registers: &[S],
    entries: &Entries,
) -> Matrix<S, R, C> {
    let mut matrix = Matrix::<S, R, C>::from_element(S::from_f64(0.0));
    for &(i, j, register) in entries {
        matrix[(i as usize, j as usize)] = registers[register as usize];
    }
    matrix
}
