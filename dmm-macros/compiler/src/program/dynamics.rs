//! The functions of a region: its expressions lowered together, and then optimised function by
//! function; and the recurrences of its solution.

use super::forces::by_velocities;
use super::function::{Functions, Quantity, Variables};
use super::inputs::{at_point, over_step, solved};
use super::lower::Lowered;
use super::optimise::Optimiser;
use super::results::{Derivative, Projected, Results, Rows};
use super::series::{Series, for_series};
use super::size::size;
use crate::algebra::{Dag, Id, Name};
use crate::scheme::{Explicit, RegionScheme, Scheme, Strategy};

/// The program of a region.
#[derive(Debug)]
pub struct Dynamics {
    /// f, ∂f/∂x, ψ, Σ|terms of ψ|, (ψ, Λ), f^τ, (f^τ, ∂f^τ/∂x₁) and, where f or ψ depends on the time,
    /// ∂f^τ/∂t₁, in this order.
    pub functions: Functions,
    /// The recurrences of the Taylor coefficients of the solution of ẋ = f(t, x).
    pub series: Series,
}

impl Dynamics {
    /// The functions of `region`; `dag` has the nodes of the scheme.
    pub(super) fn new(
        scheme: &Scheme,
        region: usize,
        dag: &mut Dag,
        parameters: &[Name],
        optimiser: &mut Optimiser,
    ) -> Self {
        let mut written = Lowered::new(parameters.to_vec());
        let results = Written::lower(dag, &mut written, scheme, region);
        let (results, mut lowered) = results.optimised(&written, optimiser);
        let field = results[0].1.roots();
        let states = scheme.model.state_names();
        let variables = Variables {
            at_point: at_point(&states),
            over_step: over_step(&states),
            solved: solved(&scheme.regions[region].strategy),
        };
        let field = for_series(&mut lowered, &field);
        let functions = Functions::new(lowered, results, &variables, parameters);
        let series = Series::of_solution(&functions, &states, &field);
        Self { functions, series }
    }
}

/// The results of the functions of a region.
struct Written {
    field: Results,
    jacobian: Results,
    psi: Results,
    psi_size: Results,
    multiplier: Results,
    discrete: Vec<(Quantity, Results)>,
}

impl Written {
    /// The operations as they are written.
    fn lower(dag: &mut Dag, lowered: &mut Lowered, scheme: &Scheme, region: usize) -> Self {
        let states = &scheme.model.state_names();
        let declared = &scheme.model.regions[region];
        let scheme = &scheme.regions[region];
        let psi: Vec<Id> = declared.conserved.iter().map(|one| one.psi).collect();
        let sizes: Vec<Id> = psi.iter().map(|&psi| size(dag, psi)).collect();
        let field = by_velocities(dag, declared, states);
        let mut lowering = Lowering { dag, lowered };
        let psi = lowering.column(&psi);
        Self {
            field: Results::Column(lowering.column(&field)),
            jacobian: Results::Matrix(lowering.rows(&scheme.jacobian)),
            multiplier: Results::ColumnAndMatrix(
                psi.clone(),
                lowering.rows(&scheme.proved.multiplier),
            ),
            psi: Results::Column(psi),
            psi_size: Results::Column(lowering.column(&sizes)),
            discrete: lowering.discrete(scheme),
        }
    }

    /// The same functions by fewer operations. The functions at a point and those over a step
    /// have no variables in common, and are optimised apart.
    fn optimised(
        mut self,
        written: &Lowered,
        optimiser: &mut Optimiser,
    ) -> (Vec<(Quantity, Results)>, Lowered) {
        let mut target = Lowered::new(written.parameters().to_vec());
        for id in self.psi_size.roots_mut() {
            *id = target.copy(written, *id);
        }
        let at_point = [&mut self.field, &mut self.psi, &mut self.multiplier];
        let at_point = at_point.into_iter().map(Results::roots_mut).collect();
        target.optimise(written, at_point, optimiser);
        target.optimise(written, vec![self.jacobian.roots_mut()], optimiser);
        let over_step = self.discrete.iter_mut();
        let over_step = over_step.map(|(_, results)| results.roots_mut()).collect();
        target.optimise(written, over_step, optimiser);
        let mut results = vec![
            (Quantity::VectorField, self.field),
            (Quantity::Jacobian, self.jacobian),
            (Quantity::Conserved, self.psi),
            (Quantity::ConservedSize, self.psi_size),
            (Quantity::Multiplier, self.multiplier),
        ];
        results.extend(self.discrete);
        (results, target)
    }
}

/// Lowers the expressions of a scheme.
struct Lowering<'a> {
    dag: &'a Dag,
    lowered: &'a mut Lowered,
}

impl Lowering<'_> {
    fn column(&mut self, roots: &[Id]) -> Vec<Id> {
        let roots = roots.iter();
        roots
            .map(|&root| self.lowered.lower(self.dag, root))
            .collect()
    }

    fn rows(&mut self, rows: &[Vec<Id>]) -> Rows {
        rows.iter().map(|row| self.column(row)).collect()
    }

    /// f^τ, (f^τ, ∂f^τ/∂x₁) and, where f or ψ depends on the time, ∂f^τ/∂t₁.
    fn discrete(&mut self, scheme: &RegionScheme) -> Vec<(Quantity, Results)> {
        let [value, linearised, time_derivative] = match &scheme.strategy {
            Strategy::Midpoint { field }
            | Strategy::SkewPairing { field, .. }
            | Strategy::CrossProduct { field, .. } => self.explicit(field),
            Strategy::MinimalNorm {
                mean,
                transposed_jacobian,
                transposed_time_derivative,
                constraint_jacobian,
                constraint_time_derivative,
                ..
            } => {
                let by_state = [&mean.jacobian, transposed_jacobian, constraint_jacobian];
                let by_time = [
                    &mean.time_derivative,
                    transposed_time_derivative,
                    constraint_time_derivative,
                ];
                self.minimal_norm(scheme, &mean.value, by_state, by_time)
            }
        };
        let mut results = vec![
            (Quantity::DiscreteVectorField, value),
            (Quantity::Linearised, linearised),
        ];
        if !scheme.autonomous {
            results.push((Quantity::TimeDerivative, time_derivative));
        }
        results
    }

    /// f^τ as an expression.
    fn explicit(&mut self, field: &Explicit) -> [Results; 3] {
        let value = self.column(&field.value);
        [
            Results::Column(value.clone()),
            Results::ColumnAndMatrix(value, self.rows(&field.jacobian)),
            Results::Column(self.column(&field.time_derivative)),
        ]
    }

    /// f^τ = f̄ − Λ^τᵀ λ, with what its derivatives by x₁ and t₁ take.
    fn minimal_norm(
        &mut self,
        scheme: &RegionScheme,
        mean: &[Id],
        by_state: [&Rows; 3],
        by_time: [&Vec<Id>; 3],
    ) -> [Results; 3] {
        let value = Projected {
            multiplier: self.rows(&scheme.discrete_multiplier),
            mean: self.column(mean),
            by_time: self.column(&scheme.discrete_time_derivative),
            derivative: None,
        };
        let by_state = Derivative::State(by_state.map(|rows| self.rows(rows)));
        let by_time = Derivative::Time(by_time.map(|entries| self.column(entries)));
        [None, Some(by_state), Some(by_time)].map(|derivative| {
            Results::Projected(Box::new(Projected {
                derivative,
                ..value.clone()
            }))
        })
    }
}
