//! The dynamics of a region, evaluated from their program.

use std::cell::RefCell;
use std::sync::Arc;

use dmm_compiler::program::{Quantity, Variable};

use super::code::{Code, Routine, Stage, Values, converted, matrix, vector};
use super::guards::{TapeGuards, TapeSides};
use super::series::SeriesCode;
use crate::arithmetic::{Matrix, MinimalNorm, Scalar, Vector};
use crate::contract::{Dynamics, Solvability};
use crate::series::{Order, Rolled};

/// What is known of a region.
#[derive(Debug)]
pub(super) struct RegionCode {
    pub(super) code: Code,
    pub(super) series: SeriesCode,
    pub(super) sides: Arc<TapeSides>,
    /// How many ψ there are.
    pub(super) quantities: usize,
    pub(super) autonomous: bool,
    pub(super) solvability: Solvability,
    pub(super) affine: bool,
    pub(super) affine_quantities: Vec<bool>,
}

/// The dynamics of a region with parameters. Components and quantities beyond those of the region
/// are zero.
#[derive(Clone, Debug)]
pub(crate) struct TapeDynamics<S: Scalar, const N: usize, const M: usize> {
    region: Arc<RegionCode>,
    registers: RefCell<Vec<S>>,
    guards: TapeGuards<S>,
}

impl<S: Scalar, const N: usize, const M: usize> TapeDynamics<S, N, M> {
    /// Those with parameters.
    pub(super) fn new(region: &Arc<RegionCode>, parameter: impl Fn(usize) -> S) -> Self {
        Self {
            registers: RefCell::new(region.code.registers(&parameter)),
            guards: TapeGuards::new(&region.sides, &parameter),
            region: Arc::clone(region),
        }
    }

    /// The results of a function at a point.
    #[inline]
    fn at_point<T>(
        &self,
        quantity: Quantity,
        t: S,
        x: &Vector<S, N>,
        results: impl FnOnce(&[S], &Values) -> T,
        none: impl FnOnce() -> T,
    ) -> T {
        let Some(routine) = self.region.code.get(quantity) else {
            return none();
        };
        let registers = &mut **self.registers.borrow_mut();
        routine.first.run_at(registers, t, x);
        results(registers, &routine.results)
    }

    /// The column that a function at a point gives.
    #[inline]
    fn column<const R: usize>(&self, quantity: Quantity, t: S, x: &Vector<S, N>) -> Vector<S, R> {
        let zero = || Vector::from_element(S::from_f64(0.0));
        let results = |registers: &[S], values: &Values| match values {
            Values::Column(column) => vector(registers, column),
            _ => zero(),
        };
        self.at_point(quantity, t, x, results, zero)
    }

    /// f^τ or a derivative of it.
    #[inline]
    fn over_step<T>(
        &self,
        quantity: Quantity,
        ends: &Ends<'_, S, N>,
        then: impl FnOnce(&[S], &Routine, Option<Solved<S, N, M>>) -> T,
        none: impl FnOnce() -> T,
    ) -> T {
        let Some(routine) = self.region.code.get(quantity) else {
            return none();
        };
        // outside of the loan of the registers
        let at_start = match &routine.results {
            Values::Projected(_) if self.region.quantities > 1 => {
                Some(self.multiplier(ends.t0, ends.x0).1)
            }
            _ => None,
        };
        let registers = &mut **self.registers.borrow_mut();
        run::<S, N, M>(&routine.first, registers, ends, None);
        let Values::Projected(projection) = &routine.results else {
            return then(registers, routine, None);
        };
        let multiplier = matrix(registers, &projection.multiplier);
        let solver = MinimalNorm::new(&multiplier, at_start.as_ref().unwrap_or(&multiplier));
        let mean = vector(registers, &projection.mean);
        let (field, multipliers) = solver.field(&mean, &vector(registers, &projection.by_time));
        if let Some(second) = &routine.second {
            run(second, registers, ends, Some((&field, &multipliers)));
        }
        then(registers, routine, Some(Solved { solver, field }))
    }
}

/// The ends of a step.
struct Ends<'a, S: Scalar, const N: usize> {
    t0: S,
    x0: &'a Vector<S, N>,
    t1: S,
    x1: &'a Vector<S, N>,
}

/// f^τ where it was solved for.
struct Solved<S: Scalar, const N: usize, const M: usize> {
    solver: MinimalNorm<S, N, M>,
    field: Vector<S, N>,
}

/// A stage of a function over a step.
fn run<S: Scalar, const N: usize, const M: usize>(
    stage: &Stage,
    registers: &mut [S],
    ends: &Ends<'_, S, N>,
    solved: Option<(&Vector<S, N>, &Vector<S, M>)>,
) {
    stage.run(registers, |variable| match (variable, solved) {
        (Variable::StartState(index), _) => ends.x0[index],
        (Variable::EndState(index), _) => ends.x1[index],
        (Variable::StartTime, _) => ends.t0,
        (Variable::Field(index), Some((field, _))) => field[index],
        (Variable::Multiplier(index), Some((_, multipliers))) => multipliers[index],
        _ => ends.t1,
    });
}

impl<S: Scalar, const N: usize, const M: usize> Dynamics<S, N, M> for TapeDynamics<S, N, M> {
    type Guards = TapeGuards<S>;
    type Over<Other: Scalar> = TapeDynamics<Other, N, M>;

    fn over<Other: Scalar>(&self) -> TapeDynamics<Other, N, M> {
        TapeDynamics {
            region: Arc::clone(&self.region),
            registers: RefCell::new(converted(&self.registers.borrow())),
            guards: self.guards.converted(),
        }
    }

    const AFFINE: Option<bool> = None;

    fn is_autonomous(&self) -> bool {
        self.region.autonomous
    }

    fn solvability(&self) -> Solvability {
        self.region.solvability
    }

    fn is_affine(&self) -> bool {
        self.region.affine
    }

    fn is_affine_quantity(&self, quantity: usize) -> bool {
        let known = self.region.affine_quantities.get(quantity);
        known.copied().unwrap_or(true)
    }

    fn quantities(&self) -> usize {
        self.region.quantities
    }

    fn keeps_signs(&self) -> bool {
        self.region.sides.keeps_signs()
    }

    fn guards(&self) -> &TapeGuards<S> {
        &self.guards
    }

    fn oriented(&self, t: S, x: &Vector<S, N>) -> Self {
        Self {
            guards: self.guards.turned(t, x),
            ..self.clone()
        }
    }

    fn vector_field(&self, t: S, x: &Vector<S, N>) -> Vector<S, N> {
        self.column(Quantity::VectorField, t, x)
    }

    fn jacobian(&self, t: S, x: &Vector<S, N>) -> Matrix<S, N, N> {
        let zero = || Matrix::from_element(S::from_f64(0.0));
        let results = |registers: &[S], values: &Values| match values {
            Values::Matrix(entries) => matrix(registers, entries),
            _ => zero(),
        };
        self.at_point(Quantity::Jacobian, t, x, results, zero)
    }

    fn conserved(&self, t: S, x: &Vector<S, N>) -> Vector<S, M> {
        self.column(Quantity::Conserved, t, x)
    }

    fn conserved_size(&self, t: S, x: &Vector<S, N>) -> Vector<S, M> {
        self.column(Quantity::ConservedSize, t, x)
    }

    fn multiplier(&self, t: S, x: &Vector<S, N>) -> (Vector<S, M>, Matrix<S, M, N>) {
        let zero = S::from_f64(0.0);
        let none = || (Vector::from_element(zero), Matrix::from_element(zero));
        let results = |registers: &[S], values: &Values| match values {
            Values::ColumnAndMatrix(column, entries) => {
                (vector(registers, column), matrix(registers, entries))
            }
            _ => none(),
        };
        self.at_point(Quantity::Multiplier, t, x, results, none)
    }

    fn discrete_vector_field(
        &self,
        t0: S,
        x0: &Vector<S, N>,
        t1: S,
        x1: &Vector<S, N>,
    ) -> Vector<S, N> {
        let none = || Vector::from_element(S::from_f64(0.0));
        let ends = Ends { t0, x0, t1, x1 };
        self.over_step(
            Quantity::DiscreteVectorField,
            &ends,
            |registers, routine, solved| match (&routine.results, solved) {
                (_, Some(solved)) => solved.field,
                (Values::Column(column), None) => vector(registers, column),
                _ => none(),
            },
            none,
        )
    }

    fn linearised(
        &self,
        t0: S,
        x0: &Vector<S, N>,
        t1: S,
        x1: &Vector<S, N>,
    ) -> (Vector<S, N>, Matrix<S, N, N>) {
        let zero = S::from_f64(0.0);
        let none = || (Vector::from_element(zero), Matrix::from_element(zero));
        let ends = Ends { t0, x0, t1, x1 };
        self.over_step(
            Quantity::Linearised,
            &ends,
            |registers, routine, solved| match (&routine.results, solved) {
                (Values::ColumnAndMatrix(column, entries), None) => {
                    (vector(registers, column), matrix(registers, entries))
                }
                (Values::Projected(projection), Some(solved)) => match &projection.by_state {
                    Some([mean, transposed, constraint]) => {
                        let jacobian = solved.solver.jacobian(
                            &matrix(registers, mean),
                            &matrix(registers, transposed),
                            &matrix(registers, constraint),
                        );
                        (solved.field, jacobian)
                    }
                    None => none(),
                },
                _ => none(),
            },
            none,
        )
    }

    fn time_derivative(&self, t0: S, x0: &Vector<S, N>, t1: S, x1: &Vector<S, N>) -> Vector<S, N> {
        let none = || Vector::from_element(S::from_f64(0.0));
        let ends = Ends { t0, x0, t1, x1 };
        self.over_step(
            Quantity::TimeDerivative,
            &ends,
            |registers, routine, solved| match (&routine.results, solved) {
                (Values::Column(column), None) => vector(registers, column),
                (Values::Projected(projection), Some(solved)) => match &projection.by_end_time {
                    Some([mean, transposed, constraint]) => solved.solver.time_derivative(
                        &vector(registers, mean),
                        &vector(registers, transposed),
                        &vector(registers, constraint),
                    ),
                    None => none(),
                },
                _ => none(),
            },
            none,
        )
    }

    type Series<const P: usize> = Vec<[S; P]>;
    type Unrolled = Rolled;

    fn series<const P: usize>(&self) -> Vec<[S; P]> {
        vec![[S::from_f64(0.0); P]; self.region.series.slots(N)]
    }

    fn advance<K: Order, const P: usize>(&self, k: K, t: S, series: &mut Vec<[S; P]>) {
        let registers = &mut **self.registers.borrow_mut();
        self.region
            .series
            .solution::<S, K, N, P>(k, t, registers, series);
    }
}
