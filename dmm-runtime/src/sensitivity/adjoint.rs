//! Derivatives carried backwards along a solution: the steps are made again from the points that are
//! kept, the last first, and recorded one at a time.

use nalgebra::DVector;

use super::replay::{Place, Replay};
use crate::arithmetic::recorded::{Recorded, gradient, recording};
use crate::arithmetic::{Scalar, Time, Vector};
use crate::contract::System;
use crate::error::{Error, invalid, number};
use crate::method::Method;
use crate::output::{Point, Solution};

/// A number that a solution has, of which a gradient is wanted.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum Functional<const N: usize> {
    /// wᵀ x(t)
    State {
        /// t
        t: f64,
        /// w
        weights: Vector<f64, N>,
    },
    /// t̂* of a transition.
    TransitionTime {
        /// Its index in [`Solution::transitions`].
        transition: usize,
    },
    /// wᵀ x(t̂*⁺), of the state behind a transition.
    AfterTransition {
        /// Its index in [`Solution::transitions`].
        transition: usize,
        /// w
        weights: Vector<f64, N>,
    },
}

/// The derivatives of one number by the initial state and by all parameters.
#[derive(Clone, PartialEq, Debug)]
pub struct Gradient<const N: usize> {
    /// By the components of the initial state.
    pub by_initial: Vector<f64, N>,
    /// In the order of [`Metadata::parameters`](crate::Metadata::parameters).
    pub by_parameters: DVector<f64>,
}

/// The derivatives of a functional by the state and the time of a point, then by the parameters.
type Adjoint = Vec<f64>;

/// The gradients of functionals.
pub(super) fn gradients<Sys: System<N>, Met: Method, const N: usize>(
    solution: &Solution<Sys, Met, N>,
    functionals: &[Functional<N>],
) -> Result<Vec<Gradient<N>>, Error> {
    let replay = Replay::new(solution)?;
    let parameters = replay.parameters();
    let points = solution.points();
    let wanted = states(solution, functionals)?;
    let mut adjoints = vec![vec![0.0; N + 1 + parameters.len()]; functionals.len()];
    // what is wanted of the states from a point on
    let observe = |index: usize, adjoints: &mut Vec<Adjoint>| -> Result<(), Error> {
        for wanted in wanted.iter().filter(|wanted| wanted.point == index) {
            let point = &points[index];
            let weights = wanted.weights.iter().copied().chain([0.0]).collect();
            let by = backwards(point, &parameters, [&weights], |place, parameters| {
                let x = replay.state_at(point, place, parameters, Time::new(wanted.t))?;
                Ok(Place { x, t: place.t })
            })?;
            for (sum, part) in adjoints[wanted.functional].iter_mut().zip(&by[0]) {
                *sum += part;
            }
        }
        Ok(())
    };
    observe(points.len() - 1, &mut adjoints)?;
    let mut transition = solution.transitions().len();
    for stage in replay.stages.iter().rev() {
        if stage.met.is_some() {
            transition -= 1;
            for (adjoint, functional) in adjoints.iter_mut().zip(functionals) {
                at_transition(functional, transition, adjoint);
            }
        }
        adjoints = backwards(
            stage.from,
            &parameters,
            &adjoints,
            |place, parameters| match stage.met {
                Some(met) => {
                    let [_, after] = replay.meet(stage, met, place, parameters)?;
                    Ok(after)
                }
                None => Ok(Place {
                    x: replay.step(stage, place, parameters)?,
                    t: Recorded::from_f64(stage.end.value),
                }),
            },
        )?;
        observe(stage.index, &mut adjoints)?;
    }
    let gradients = adjoints.iter().map(|adjoint| Gradient {
        by_initial: Vector::from_fn(|i, _| adjoint[i]),
        by_parameters: DVector::from_column_slice(&adjoint[N + 1..]),
    });
    Ok(gradients.collect())
}

/// A state that is asked for: wᵀ x(t), the index of the last point before it, and that of the functional.
struct Wanted<'a, const N: usize> {
    point: usize,
    functional: usize,
    t: f64,
    weights: &'a Vector<f64, N>,
}

/// The states that are asked for.
fn states<'a, Sys: System<N>, Met: Method, const N: usize>(
    solution: &Solution<Sys, Met, N>,
    functionals: &'a [Functional<N>],
) -> Result<Vec<Wanted<'a, N>>, Error> {
    let mut states = Vec::new();
    for (index, functional) in functionals.iter().enumerate() {
        match functional {
            Functional::State { t, weights } => states.push(Wanted {
                point: solution.point_before(*t)?,
                functional: index,
                t: *t,
                weights,
            }),
            Functional::TransitionTime { transition }
            | Functional::AfterTransition { transition, .. } => {
                if *transition >= solution.transitions().len() {
                    let requirement = "must be the index of a transition of the solution";
                    invalid("transition", number(*transition as f64), requirement)?;
                }
            }
        }
    }
    Ok(states)
}

/// Adds the derivatives of a functional by the time of a transition and by the state behind it.
fn at_transition<const N: usize>(
    functional: &Functional<N>,
    transition: usize,
    adjoint: &mut Adjoint,
) {
    match functional {
        Functional::TransitionTime { transition: one } if *one == transition => adjoint[N] += 1.0,
        Functional::AfterTransition {
            transition: one,
            weights,
        } if *one == transition => {
            for (sum, weight) in adjoint.iter_mut().zip(weights) {
                *sum += weight;
            }
        }
        _ => {}
    }
}

/// From derivatives by what is computed from a point, those by the point; what an adjoint has of the
/// parameters is added.
fn backwards<'a, Region, const N: usize>(
    point: &Point<Region, N>,
    parameters: &[f64],
    adjoints: impl IntoIterator<Item = &'a Adjoint>,
    compute: impl FnOnce(&Place<Recorded, N>, &[Recorded]) -> Result<Place<Recorded, N>, Error>,
) -> Result<Vec<Adjoint>, Error> {
    recording(|| {
        let values = point.x.iter().chain([&point.t]).chain(parameters);
        let variables: Vec<_> = values.map(|&value| Recorded::variable(value)).collect();
        let place = Place::of(point, |_, row| variables[row]);
        let end = compute(&place, &variables[N + 1..])?;
        let by_point = |adjoint: &Adjoint| {
            let weighted = end.into_rows().zip(adjoint.iter().copied());
            let mut by = gradient(weighted, &variables);
            for (sum, part) in by.iter_mut().zip(adjoint).skip(N + 1) {
                *sum += part;
            }
            by
        };
        Ok(adjoints.into_iter().map(by_point).collect())
    })
}
