//! A system that was compiled at run time, with room for N states and M quantities.

use std::sync::Arc;

use dmm_compiler::program::{self, Program};
use dmm_compiler::scheme;

use super::code::Code;
use super::dynamics::{RegionCode, TapeDynamics};
use super::guards::{GuardsCode, TapeSides};
use super::metadata;
use super::series::{SeriesCode, fixed};
use crate::arithmetic::Scalar;
use crate::contract::{DynamicsVisitor, Metadata, Solvability, System};

/// What is known of a system, whatever its parameters.
#[derive(Debug)]
pub(crate) struct SystemCode {
    pub(crate) metadata: &'static Metadata,
    pub(crate) declaration: String,
    pub(crate) listing: String,
    regions: Vec<Arc<RegionCode>>,
    /// The declared values of the parameters.
    pub(crate) defaults: Vec<f64>,
}

impl SystemCode {
    /// That of a program.
    pub(crate) fn new(program: &Program<'_>, listing: String) -> Self {
        let guards = program
            .guards
            .as_ref()
            .map(|guards| Arc::new(guards_code(guards)));
        let regions = program.dynamics.iter().enumerate();
        let regions = regions.map(|(index, dynamics)| {
            let sides = program
                .guards
                .iter()
                .flat_map(|guards| &guards.sides[index]);
            let sides = sides.map(|&(number, sign)| (number, metadata::side(sign)));
            let sides = TapeSides {
                guards: guards.clone(),
                sides: sides.collect(),
            };
            let scheme = &program.scheme.regions[index];
            Arc::new(region_code(
                dynamics,
                scheme,
                Arc::new(sides),
                program.states.len(),
            ))
        });
        let model = &program.scheme.model;
        Self {
            metadata: metadata::kept(&program.metadata),
            declaration: model.source.clone(),
            listing,
            regions: regions.collect(),
            defaults: program.defaults.iter().map(super::default_value).collect(),
        }
    }

    /// How many quantities a region conserves at most.
    pub(crate) fn most_quantities(&self) -> usize {
        let regions = self.regions.iter();
        regions.map(|region| region.quantities).max().unwrap_or(0)
    }
}

fn guards_code(guards: &program::Guards) -> GuardsCode {
    let fixed = fixed(&guards.functions, &guards.series);
    GuardsCode {
        code: Code::new(&guards.functions, fixed),
        series: SeriesCode::new(&guards.functions, &guards.series, guards.count),
        oriented: guards.oriented.clone(),
        first_condition: guards.first_condition,
        autonomous: guards.autonomous,
        degree: guards.degree,
    }
}

fn region_code(
    dynamics: &program::Dynamics,
    scheme: &scheme::RegionScheme,
    sides: Arc<TapeSides>,
    states: usize,
) -> RegionCode {
    let fixed = fixed(&dynamics.functions, &dynamics.series);
    RegionCode {
        code: Code::new(&dynamics.functions, fixed),
        series: SeriesCode::new(&dynamics.functions, &dynamics.series, states),
        sides,
        quantities: scheme.proved.multiplier.len(),
        autonomous: scheme.autonomous,
        solvability: match scheme.solvability {
            scheme::Solvability::Nonlinear => Solvability::Nonlinear,
            scheme::Solvability::Affine => Solvability::Affine,
            scheme::Solvability::Linear => Solvability::Linear,
        },
        affine: scheme.affine,
        affine_quantities: scheme.affine_quantities.clone(),
    }
}

/// A system that was compiled at run time. States beyond those of the system are zero.
#[derive(Clone, Debug)]
pub(crate) struct Tape<const N: usize, const M: usize> {
    code: Arc<SystemCode>,
    parameters: Vec<f64>,
}

impl<const N: usize, const M: usize> Tape<N, M> {
    /// The system with parameters, if there is room for it.
    pub(crate) fn new(code: &Arc<SystemCode>, parameters: &[f64]) -> Option<Self> {
        let fits = code.metadata.states.len() <= N && code.most_quantities() <= M;
        fits.then(|| Self {
            code: Arc::clone(code),
            parameters: parameters.to_vec(),
        })
    }
}

/// A region of a system that was compiled at run time, by its index in [`Metadata::regions`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct TapeRegion(usize);

impl<const N: usize, const M: usize> System<N> for Tape<N, M> {
    type Region = TapeRegion;

    fn metadata(&self) -> &'static Metadata {
        self.code.metadata
    }

    fn declaration(&self) -> &str {
        &self.code.declaration
    }

    fn listing(&self) -> &str {
        &self.code.listing
    }

    fn region(&self, index: usize) -> Option<TapeRegion> {
        (index < self.code.regions.len()).then_some(TapeRegion(index))
    }

    fn index(region: TapeRegion) -> usize {
        region.0
    }

    fn parameters(&self) -> Vec<f64> {
        self.parameters.clone()
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        self.parameters.get_mut(index)
    }

    fn visit<V: DynamicsVisitor<N>>(&self, region: TapeRegion, visitor: V) -> V::Output {
        self.visit_with(region, |index| self.parameters[index], visitor)
    }

    fn visit_with<S: Scalar, V: DynamicsVisitor<N, S>>(
        &self,
        region: TapeRegion,
        parameter: impl Fn(usize) -> S,
        visitor: V,
    ) -> V::Output {
        let known = self.code.regions.len();
        let region = &self.code.regions[region.0.min(known - 1)];
        visitor.visit(&TapeDynamics::<S, N, M>::new(region, parameter))
    }
}
