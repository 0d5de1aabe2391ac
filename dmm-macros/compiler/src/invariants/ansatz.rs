//! ψ = Σ cₘ m over the monomials m of the generators, and its values at points.

use crate::algebra::linear::dot;
use crate::algebra::normal_form::terms::{Atom, Terms, terms};
use crate::algebra::{Dag, Id, Math, Name, gradient};

use super::field::{Field, NARROW, Point, Random, granularity};
use super::generators::Generator;

/// The most monomials of which an ansatz may be made.
pub(super) const MOST_MONOMIALS: usize = 3_000;

/// Equations beyond the number of unknowns: a wrong vector satisfies each of them with a
/// probability of about 10⁻⁸.
pub(super) const EXTRA_EQUATIONS: usize = 12;

/// Points at which a root does not exist are left out, up to so many in a row.
const MOST_TRIALS: usize = 200;

/// The exponents of the generators.
pub(super) type Monomial = Vec<u32>;

/// The monomials, of degree 1 to `degree` and in rising order; `None` if there are too many.
pub(super) fn monomials(generators: &[Generator], degree: u32) -> Option<Vec<Monomial>> {
    let mut all = Vec::new();
    for total in 1..=degree {
        let mut exponents = vec![0; generators.len()];
        extend(generators, total, 0, &mut exponents, &mut all)?;
    }
    Some(all)
}

fn extend(
    generators: &[Generator],
    left: u32,
    place: usize,
    exponents: &mut Monomial,
    all: &mut Vec<Monomial>,
) -> Option<()> {
    let Some(generator) = generators.get(place) else {
        if left == 0 {
            if all.len() == MOST_MONOMIALS {
                return None;
            }
            all.push(exponents.clone());
        }
        return Some(());
    };
    // The last generator has to take what is left.
    let least = if place + 1 == generators.len() {
        left
    } else {
        0
    };
    for exponent in (least..=left.min(generator.highest)).rev() {
        if let Some(slot) = exponents.get_mut(place) {
            *slot = exponent;
        }
        extend(generators, left - exponent, place + 1, exponents, all)?;
    }
    if let Some(slot) = exponents.get_mut(place) {
        *slot = 0;
    }
    Some(())
}

/// The ansatz with all that its derivatives are made of.
pub(super) struct Ansatz<'m> {
    pub(super) generators: Vec<Generator>,
    pub(super) monomials: Vec<Monomial>,
    states: usize,
    fields: usize,
    parameters: &'m [Name],
    terms: Terms,
    granularity: Vec<i64>,
    /// The roots of the parameters' values in the two sets.
    sets: [Vec<u64>; 2],
}

/// The values at a point.
pub(super) struct Values {
    /// Of the generators.
    generators: Vec<u64>,
    /// By field, those of the rates ġ/g of the generators.
    rates: Vec<Vec<u64>>,
    /// By state, those of the derivatives ∂g/∂x/g.
    derivatives: Vec<Vec<u64>>,
}

/// The values of the parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Parameters {
    /// Others at each point: what vanishes then vanishes for all parameters.
    Varied,
    /// A set of values.
    First,
    /// Another set.
    Second,
    /// The first set, the root of one value doubled.
    Doubled(usize),
}

/// Values of parameters are powers of this degree, so that the roots of them that occur exist.
pub(super) const DEGREE_OF_VALUES: u64 = 12;

impl<'m> Ansatz<'m> {
    /// `None` if something has no normal form.
    pub(super) fn new(
        dag: &mut Dag,
        states: &[Name],
        parameters: &'m [Name],
        fields: &[&[Id]],
        generators: Vec<Generator>,
        monomials: Vec<Monomial>,
    ) -> Option<Self> {
        let mut roots: Vec<Id> = generators.iter().map(|one| one.expression).collect();
        let mut derivatives = Vec::new();
        for generator in &generators {
            derivatives.push(gradient(dag, generator.expression, states));
        }
        for field in fields {
            for derivative in &derivatives {
                roots.push(dot(dag, derivative, field));
            }
        }
        for place in 0..states.len() {
            roots.extend(
                derivatives
                    .iter()
                    .filter_map(|by_state| by_state.get(place)),
            );
        }
        let terms = terms(dag, &roots)?;
        let mut random = Random(1);
        let mut some = || {
            let value = |_: &Name| 2 + random.below(NARROW.p - 3);
            parameters.iter().map(value).collect()
        };
        Some(Self {
            generators,
            monomials,
            states: states.len(),
            fields: fields.len(),
            parameters,
            granularity: granularity(&terms)?,
            terms,
            sets: [some(), some()],
        })
    }

    pub(super) fn degree(&self, monomial: usize) -> u32 {
        self.monomials
            .get(monomial)
            .map_or(0, |exponents| exponents.iter().sum())
    }

    /// Whether a monomial has even powers of states alone, and some, as terms of an energy do.
    pub(super) fn is_square_of_states(&self, monomial: usize) -> bool {
        self.monomials.get(monomial).is_some_and(|exponents| {
            let mut states = exponents.iter().take(self.states);
            states.clone().any(|&exponent| exponent > 0)
                && states.all(|exponent| exponent.is_multiple_of(2))
        })
    }

    /// The values at a random point; `None` if none could be found.
    pub(super) fn point(
        &self,
        field: Field,
        parameters: Parameters,
        random: &mut Random,
    ) -> Option<Values> {
        (0..MOST_TRIALS).find_map(|_| self.try_point(field, parameters, random))
    }

    /// A root of a parameter's value; `None` if it is varied.
    pub(super) fn root_of_parameter(
        &self,
        field: Field,
        parameters: Parameters,
        index: usize,
    ) -> Option<u64> {
        let [first, second] = &self.sets;
        match parameters {
            Parameters::Varied => None,
            Parameters::First => first.get(index).copied(),
            Parameters::Second => second.get(index).copied(),
            Parameters::Doubled(doubled) => {
                let root = first.get(index).copied()?;
                Some(if doubled == index {
                    field.add(root, root)
                } else {
                    root
                })
            }
        }
    }

    fn try_point(
        &self,
        field: Field,
        parameters: Parameters,
        random: &mut Random,
    ) -> Option<Values> {
        let fixed = |atom: &Atom| {
            let Atom::Variable(name) = atom else {
                return None;
            };
            let index = self.parameters.iter().position(|other| other == name)?;
            let root = self.root_of_parameter(field, parameters, index)?;
            Some(field.pow(root, DEGREE_OF_VALUES))
        };
        let point = Point::random(field, &self.terms, &self.granularity, random, fixed)?;
        let values = point.forms()?;
        let mut parts = values.chunks(self.generators.len());
        let generators = parts.next()?.to_vec();
        let inverses: Vec<u64> = generators
            .iter()
            .map(|&value| field.inverse(value))
            .collect::<Option<_>>()?;
        let over = |part: &[u64]| -> Vec<u64> {
            let pairs = part.iter().zip(&inverses);
            pairs
                .map(|(&value, &inverse)| field.mul(value, inverse))
                .collect()
        };
        let rates: Vec<_> = parts.by_ref().take(self.fields).map(over).collect();
        let derivatives = parts.take(self.states).map(over).collect();
        Some(Values {
            generators,
            rates,
            derivatives,
        })
    }

    /// The values of these monomials.
    pub(super) fn values(&self, field: Field, at: &Values, columns: &[usize]) -> Vec<u64> {
        let highest = self.monomials.iter().flatten().copied().max().unwrap_or(0) as usize;
        let powers: Vec<Vec<u64>> = at
            .generators
            .iter()
            .map(|&value| {
                let next = |power: &u64| Some(field.mul(*power, value));
                std::iter::successors(Some(1), next)
                    .take(highest + 1)
                    .collect()
            })
            .collect();
        let value = |&column: &usize| {
            let exponents = self.monomials.get(column).map_or(&[][..], Vec::as_slice);
            let factors = exponents
                .iter()
                .zip(&powers)
                .filter(|&(&exponent, _)| exponent > 0);
            factors.fold(1, |product, (&exponent, powers)| {
                let power = powers.get(exponent as usize).copied().unwrap_or(0);
                field.mul(product, power)
            })
        };
        columns.iter().map(value).collect()
    }

    /// Each of these monomials' values times Σ exponent·logarithmic derivative.
    fn differentiated(
        &self,
        field: Field,
        columns: &[usize],
        values: &[u64],
        logarithmic: &[u64],
    ) -> Vec<u64> {
        let derivative = |(&column, &value): (&usize, &u64)| {
            let exponents = self.monomials.get(column).map_or(&[][..], Vec::as_slice);
            let terms = exponents
                .iter()
                .zip(logarithmic)
                .filter(|&(&exponent, _)| exponent > 0);
            let sum = terms.fold(0, |sum, (&exponent, &rate)| {
                field.add(sum, field.mul(exponent.into(), rate))
            });
            field.mul(value, sum)
        };
        columns.iter().zip(values).map(derivative).collect()
    }

    /// ∇m·f of these monomials, for each field.
    pub(super) fn rates(&self, field: Field, at: &Values, columns: &[usize]) -> Vec<Vec<u64>> {
        let values = self.values(field, at, columns);
        let rates = at.rates.iter();
        rates
            .map(|rate| self.differentiated(field, columns, &values, rate))
            .collect()
    }

    /// ∇ψ of a combination of monomials.
    pub(super) fn gradient(&self, at: &Values, vector: &[(usize, u64)]) -> Vec<u64> {
        let columns: Vec<usize> = vector.iter().map(|&(column, _)| column).collect();
        let values = self.values(NARROW, at, &columns);
        let component = |logarithmic: &Vec<u64>| {
            let derivatives = self.differentiated(NARROW, &columns, &values, logarithmic);
            let terms = derivatives.iter().zip(vector);
            terms.fold(0, |sum, (&derivative, &(_, coefficient))| {
                NARROW.add(sum, NARROW.mul(derivative, coefficient))
            })
        };
        at.derivatives.iter().map(component).collect()
    }

    /// A monomial as an expression.
    pub(super) fn monomial(&self, dag: &mut Dag, column: usize) -> Id {
        let exponents = self.monomials.get(column).map_or(&[][..], Vec::as_slice);
        let mut product = dag.integer(1);
        let mut below = dag.integer(1);
        for (generator, &exponent) in self.generators.iter().zip(exponents) {
            // (1/u)ⁿ is written 1/uⁿ
            let (base, side) = match dag[generator.expression] {
                Math::Div([one, base]) if dag.is_one(one) => (base, &mut below),
                _ => (generator.expression, &mut product),
            };
            let power = dag.powi(base, exponent.into());
            *side = dag.mul(*side, power);
        }
        dag.div(product, below)
    }
}
