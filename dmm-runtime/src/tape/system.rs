//! A system that was compiled at run time, with room for N states and M quantities.

use std::sync::Arc;

use dmm_compiler::program::{self, GuardSide, Program, Quantity};
use dmm_compiler::scheme;

use super::code::{Code, Values};
use super::dynamics::{RegionCode, TapeDynamics};
use super::guards::{GuardsCode, TapeSides};
use super::metadata;
use super::series::{SeriesCode, fixed};
use crate::arithmetic::{Scalar, Vector};
use crate::contract::{DynamicsVisitor, Metadata, Mode, Side, Solvability, System};

/// What is known of a system, whatever its parameters.
#[derive(Debug)]
pub(crate) struct SystemCode {
    pub(crate) metadata: &'static Metadata,
    pub(crate) declaration: String,
    pub(crate) listing: String,
    regions: Vec<Arc<RegionCode>>,
    events: Option<EventsCode>,
    /// The declared values of the parameters.
    pub(crate) defaults: Vec<f64>,
    /// The initial values of the discrete states.
    initial: [f64; MOST_DISCRETE],
}

/// The most discrete states.
const MOST_DISCRETE: usize = 15;
/// The most interfaces with events.
const MOST_FREE: usize = 64;

/// The events of a system.
#[derive(Debug)]
struct EventsCode {
    code: Code,
    /// By event: how many conditions it has.
    conditions: Vec<usize>,
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
            let of_region = program
                .guards
                .iter()
                .flat_map(|guards| &guards.sides[index]);
            let mut sides = TapeSides {
                guards: guards.clone(),
                sides: Vec::new(),
                free: Vec::new(),
            };
            for &(number, side_of) in of_region {
                match side_of {
                    GuardSide::Fixed(sign) => sides.sides.push((number, metadata::side(sign))),
                    GuardSide::Free(parameter) => sides.free.push((number, parameter)),
                }
            }
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
            events: program.events.as_ref().map(|events| EventsCode {
                code: Code::new(&events.functions, []),
                conditions: events.conditions.clone(),
            }),
            initial: initial(program),
            defaults: program.defaults.iter().map(super::default_value).collect(),
        }
    }

    /// How many quantities a region conserves at most.
    pub(crate) fn most_quantities(&self) -> usize {
        let regions = self.regions.iter();
        regions.map(|region| region.quantities).max().unwrap_or(0)
    }
}

/// The initial values of the discrete states, behind which there are zeros.
fn initial(program: &Program<'_>) -> [f64; MOST_DISCRETE] {
    let mut values = program.initial.iter().map(super::default_value);
    std::array::from_fn(|_| values.next().unwrap_or(0.0))
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
        let metadata = code.metadata;
        let fits = metadata.states.len() <= N
            && code.most_quantities() <= M
            && metadata.free.len() <= MOST_FREE;
        fits.then(|| Self {
            code: Arc::clone(code),
            parameters: parameters.to_vec(),
        })
    }
}

impl<const N: usize, const M: usize> Tape<N, M> {
    /// Parameter number `index` or, behind the parameters, what is constant in a mode.
    fn parameter<S: Scalar>(
        &self,
        mode: TapeMode,
        index: usize,
        parameter: impl Fn(usize) -> S,
    ) -> S {
        let behind = |place: usize| {
            let Metadata { discrete, free, .. } = self.code.metadata;
            let place = match place.checked_sub(discrete.len()) {
                None => place,
                Some(side) if side < free.len() => MOST_DISCRETE + side,
                Some(slide) => MOST_DISCRETE + MOST_FREE + slide - free.len(),
            };
            mode.constant(place)
        };
        match index.checked_sub(self.parameters.len()) {
            None => parameter(index),
            Some(place) => S::from_f64(behind(place)),
        }
    }
}

/// A mode of a system that was compiled at run time.
pub(crate) type TapeMode = Mode<TapeRegion, MOST_DISCRETE, MOST_FREE>;

/// A region of a system that was compiled at run time, by its index in [`Metadata::regions`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct TapeRegion(usize);

impl<const N: usize, const M: usize> System<N> for Tape<N, M> {
    type Region = TapeMode;

    const IS_INTERPRETED: bool = true;

    fn metadata(&self) -> &'static Metadata {
        self.code.metadata
    }

    fn declaration(&self) -> &str {
        &self.code.declaration
    }

    fn listing(&self) -> &str {
        &self.code.listing
    }

    fn region(&self, index: usize) -> Option<TapeMode> {
        let is_there = index < self.code.regions.len();
        is_there.then(|| Mode::new(TapeRegion(index), self.code.initial))
    }

    fn index(region: TapeMode) -> usize {
        region.region.0
    }

    fn region_on(&self, sides: &[Option<Side>], like: Option<TapeMode>) -> Option<TapeMode> {
        let region = self.region(self.code.metadata.region_on(sides)?)?;
        Some(region.on(self.code.metadata, sides, like))
    }

    fn side(&self, region: TapeMode, interface: usize) -> Option<Side> {
        region.side(self.code.metadata, region.region.0, interface)
    }

    fn slides_on(&self, region: TapeMode, interface: usize) -> bool {
        region.slides_on(self.code.metadata, region.region.0, interface)
    }

    fn constants(region: TapeMode) -> Vec<f64> {
        (0..MOST_DISCRETE)
            .map(|index| region.constant(index))
            .collect()
    }

    fn with_constant(region: TapeMode, index: usize, value: f64) -> TapeMode {
        region.with_constant(index, value)
    }

    fn jump_with<S: Scalar>(
        &self,
        region: TapeMode,
        event: usize,
        t: S,
        state: &Vector<S, N>,
        parameter: impl Fn(usize) -> S,
    ) -> Option<(Vector<S, N>, Vec<S>)> {
        let events = self.code.events.as_ref()?;
        let routine = events.code.get(Quantity::Event(event))?;
        let Values::Column(column) = &routine.results else {
            return None;
        };
        let parameter = |index| self.parameter(region, index, &parameter);
        let mut registers = events.code.registers(parameter);
        routine.first.run_at(&mut registers, t, state);
        let values = column.iter().map(|&register| registers[register as usize]);
        let values: Vec<S> = values.collect();
        let (conditions, values) = values.split_at_checked(*events.conditions.get(event)?)?;
        if !conditions.iter().all(|&condition| condition.to_f64() > 0.0) {
            return None;
        }
        let (states, discrete) = values.split_at_checked(self.code.metadata.states.len())?;
        let state = |index: usize| states.get(index).copied().unwrap_or(S::from_f64(0.0));
        let state = Vector::from_fn(|index, _| state(index));
        Some((state, discrete.to_vec()))
    }

    fn parameters(&self) -> Vec<f64> {
        self.parameters.clone()
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        self.parameters.get_mut(index)
    }

    fn visit<V: DynamicsVisitor<N>>(&self, region: TapeMode, visitor: V) -> V::Output {
        self.visit_with(region, |index| self.parameters[index], visitor)
    }

    #[inline(always)]
    fn visit_with<S: Scalar, V: DynamicsVisitor<N, S>>(
        &self,
        mode: TapeMode,
        parameter: impl Fn(usize) -> S,
        visitor: V,
    ) -> V::Output {
        let known = self.code.regions.len();
        let region = &self.code.regions[mode.region.0.min(known - 1)];
        let parameter = |index| self.parameter(mode, index, &parameter);
        visitor.visit(&TapeDynamics::<S, N, M>::new(region, parameter))
    }
}
