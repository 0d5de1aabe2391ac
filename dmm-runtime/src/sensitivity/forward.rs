//! Derivatives carried forward along a solution, in a few directions at once.

use nalgebra::DMatrix;

use super::replay::{NONE, Place, Replay};
use crate::arithmetic::dual::Dual;
use crate::arithmetic::{Derived, Scalar, Time};
use crate::contract::System;
use crate::error::Error;
use crate::method::Method;
use crate::output::Point;

/// Directions that are carried at once.
const WIDTH: usize = 4;

/// The derivatives of a place by all directions: the components of the initial state, then the
/// parameters.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Derivatives {
    /// A row a component of the state, and one more for the time.
    pub(super) first: DMatrix<f64>,
    /// A matrix for each of these, symmetric; none where only first derivatives are wanted.
    pub(super) second: Vec<DMatrix<f64>>,
}

impl Derivatives {
    fn zeros<C: Carried>(rows: usize, directions: usize) -> Self {
        let seconds = if C::Number::DERIVATIVES > 1 { rows } else { 0 };
        Self {
            first: DMatrix::zeros(rows, directions),
            second: vec![DMatrix::zeros(directions, directions); seconds],
        }
    }

    /// What is not finite has not been derived.
    fn is_finite(&self) -> bool {
        let all = std::iter::once(&self.first).chain(&self.second);
        all.flatten().all(|entry| entry.is_finite())
    }
}

/// The directions that a scalar carries derivatives in.
pub(super) trait Carried: Copy {
    /// The scalar.
    type Number: Derived;

    /// All that there are of some directions.
    fn all(directions: usize) -> Vec<Self>;

    /// The number in a row of derivatives.
    fn load(self, value: f64, row: usize, from: &Derivatives) -> Self::Number;

    /// The derivatives of a number into a row.
    fn store(self, number: Self::Number, row: usize, to: &mut Derivatives);
}

/// First derivatives in the directions from one on.
#[derive(Clone, Copy)]
pub(super) struct First {
    first: usize,
}

impl Carried for First {
    type Number = Dual<f64, WIDTH>;

    fn all(directions: usize) -> Vec<Self> {
        let firsts = (0..directions).step_by(WIDTH);
        firsts.map(|first| Self { first }).collect()
    }

    fn load(self, value: f64, row: usize, from: &Derivatives) -> Self::Number {
        block(value, self.first, |k| from.first.get((row, k)))
    }

    fn store(self, number: Self::Number, row: usize, to: &mut Derivatives) {
        for (k, part) in number.parts.into_iter().enumerate() {
            if let Some(entry) = to.first.get_mut((row, self.first + k)) {
                *entry = part;
            }
        }
    }
}

/// First and second derivatives, the second ones in one direction and in those from another on.
#[derive(Clone, Copy)]
pub(super) struct Second {
    outer: usize,
    inner: First,
}

impl Carried for Second {
    type Number = Dual<Dual<f64, WIDTH>, 1>;

    fn all(directions: usize) -> Vec<Self> {
        let outers = 0..directions;
        let both = outers.flat_map(|outer| {
            let inners = First::all(directions).into_iter();
            inners.map(move |inner| Self { outer, inner })
        });
        // the others are the same by symmetry
        both.filter(|both| both.inner.first + WIDTH > both.outer)
            .collect()
    }

    fn load(self, value: f64, row: usize, from: &Derivatives) -> Self::Number {
        let by_outer = from.first[(row, self.outer)];
        Dual {
            value: self.inner.load(value, row, from),
            parts: [block(by_outer, self.inner.first, |k| {
                from.second
                    .get(row)
                    .and_then(|all| all.get((self.outer, k)))
            })],
        }
    }

    fn store(self, number: Self::Number, row: usize, to: &mut Derivatives) {
        self.inner.store(number.value, row, to);
        let inner = self.inner.first..to.first.ncols();
        for (k, part) in inner.zip(number.parts[0].parts) {
            to.second[row][(self.outer, k)] = part;
            to.second[row][(k, self.outer)] = part;
        }
    }
}

/// A value with the derivatives that there are from a direction on.
fn block<'a>(
    value: f64,
    first: usize,
    derivative: impl Fn(usize) -> Option<&'a f64>,
) -> Dual<f64, WIDTH> {
    Dual::new(value, |k| {
        derivative(first + k).copied().unwrap_or_default()
    })
}

/// What is told of the derivatives along a solution, in the order of time.
pub(super) trait Collector {
    /// Of the state at the time of a point.
    fn point(&mut self, derivatives: &Derivatives);

    /// Of the places in front of a transition and behind it, whose time changes as well.
    fn transition(&mut self, t: f64, before: &Derivatives, after: &Derivatives);
}

/// Derivatives carried along a solution.
pub(super) struct Forward<'a, Sys: System<N>, Met: Method, const N: usize, C: Carried> {
    replay: &'a Replay<'a, Sys, Met, N>,
    /// The directions that are carried at once, with the parameters as numbers.
    all: Vec<(C, Vec<C::Number>)>,
    directions: usize,
}

impl<'a, Sys: System<N>, Met: Method, C: Carried, const N: usize> Forward<'a, Sys, Met, N, C> {
    pub(super) fn new(replay: &'a Replay<'a, Sys, Met, N>) -> Self {
        let parameters = replay.parameters();
        let directions = N + parameters.len();
        let mut units = Derivatives::zeros::<C>(parameters.len(), directions);
        for row in 0..parameters.len() {
            units.first[(row, N + row)] = 1.0;
        }
        let numbers = |carried: C| {
            let values = parameters.iter().enumerate();
            let numbers = values.map(|(row, &value)| carried.load(value, row, &units));
            numbers.collect()
        };
        let all = C::all(directions).into_iter();
        Self {
            replay,
            all: all.map(|carried| (carried, numbers(carried))).collect(),
            directions,
        }
    }

    /// Tells a collector of the derivatives along the solution.
    pub(super) fn run(&self, collector: &mut impl Collector) -> Result<(), Error> {
        let replay = self.replay;
        let mut present = self.zeros();
        present.first.fill_diagonal(1.0);
        present.first.row_mut(N).fill(0.0);
        collector.point(&present);
        for stage in &replay.stages {
            if stage.moves() {
                let [end] = self.map(stage.from, &present, |place, parameters| {
                    let x = replay.step(stage, place, parameters)?;
                    let t = C::Number::from_f64(stage.end.value);
                    Ok([Place { t, x }])
                })?;
                collector.point(&end);
                if stage.met.is_none() {
                    present = end;
                    continue;
                }
            }
            let Some(met) = stage.met else { continue };
            let [before, after] = self.map(stage.from, &present, |place, parameters| {
                replay.meet(stage, met, place, parameters)
            })?;
            collector.transition(met.t, &before, &after);
            let end = replay.end(stage);
            collector.point(&self.at(end, &after, end.time)?);
            present = after;
        }
        Ok(())
    }

    /// At a fixed time behind a point, from the derivatives of the place there.
    pub(super) fn at(
        &self,
        point: &Point<Sys::Region, N>,
        present: &Derivatives,
        time: Time,
    ) -> Result<Derivatives, Error> {
        let [end] = self.map(point, present, |place, parameters| {
            let x = self.replay.state_at(point, place, parameters, time)?;
            let t = C::Number::from_f64(time.value);
            Ok([Place { t, x }])
        })?;
        Ok(end)
    }

    fn zeros(&self) -> Derivatives {
        Derivatives::zeros::<C>(N + 1, self.directions)
    }

    /// The derivatives of places that are computed from one with derivatives.
    fn map<const R: usize>(
        &self,
        point: &Point<Sys::Region, N>,
        derivatives: &Derivatives,
        compute: impl Fn(&Place<C::Number, N>, &[C::Number]) -> Result<[Place<C::Number, N>; R], Error>,
    ) -> Result<[Derivatives; R], Error> {
        let mut results = std::array::from_fn(|_| self.zeros());
        for (carried, parameters) in &self.all {
            let place = Place::of(point, |value, row| carried.load(value, row, derivatives));
            for (place, result) in compute(&place, parameters)?.into_iter().zip(&mut results) {
                for (row, number) in place.into_rows().enumerate() {
                    carried.store(number, row, result);
                }
            }
        }
        if results.iter().all(Derivatives::is_finite) {
            return Ok(results);
        }
        Err(self.replay.refuse(point, NONE))
    }
}
