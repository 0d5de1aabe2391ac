//! The search: null spaces modulo a prime, the independent ones among their vectors, and their
//! coefficients and proofs.

use std::collections::BTreeMap;

use num_traits::Signed;

use crate::algebra::linear::dot;
use crate::algebra::{Dag, Id, Math, Name, is_proved_zero};
use crate::proofs::Derivatives;

use super::Invariant;
use super::ansatz::{Ansatz, EXTRA_EQUATIONS, Parameters};
use super::candidate::{Candidate, occurring};
use super::coefficients::{functions, without_denominators};
use super::elimination::{Echelon, Entry};
use super::field::{NARROW, Random, to_coprime_integers};
use super::residues::Coefficients;
use super::simplify::{MIXED_COST, simplest, total};

/// Equations that are eliminated together.
const ROWS_AT_ONCE: usize = 16;

/// What is sought in.
pub(super) struct Search<'a> {
    pub(super) ansatz: &'a Ansatz<'a>,
    pub(super) states: &'a [Name],
    pub(super) parameters: &'a [Name],
    /// The vector fields of all regions.
    pub(super) fields: &'a [&'a [Id]],
}

/// Gradients of what was found, at a point, to tell what is new.
#[derive(Clone)]
pub(super) struct Known {
    rows: Vec<Vec<u64>>,
}

impl Known {
    pub(super) fn new() -> Self {
        Self { rows: Vec::new() }
    }

    /// Whether a gradient is independent of the known ones.
    fn is_new(&self, row: &[u64]) -> bool {
        let mut echelon = Echelon::new(row.len());
        for known in &self.rows {
            echelon.insert(vec![known.clone()]);
        }
        let before = echelon.rank();
        echelon.insert(vec![row.to_vec()]);
        echelon.rank() > before
    }
}

/// What was found, and how many vectors could not be turned into proved invariants.
#[derive(Default)]
pub(super) struct Findings {
    pub(super) invariants: Vec<Invariant>,
    pub(super) unresolved: usize,
}

impl Search<'_> {
    /// The invariants among the candidates for these fields that do not depend on the known
    /// ones, which grow by them; `None` if no points of the domain were found.
    pub(super) fn select(
        &self,
        dag: &mut Dag,
        fields: &[usize],
        candidates: &[Candidate],
        known: &mut Known,
    ) -> Option<Findings> {
        let mut random = Random(2);
        let at = self
            .ansatz
            .point(NARROW, Parameters::First, &mut Random(3))?;
        let gradient = |vector: &[Entry]| self.ansatz.gradient(&at, vector);
        let mut groups: BTreeMap<(u32, bool), Vec<&Candidate>> = BTreeMap::new();
        for candidate in candidates {
            let depends = candidate.parameters != Parameters::Varied;
            let group = groups.entry((candidate.degree, depends)).or_default();
            group.push(candidate);
        }
        let cost = |column: usize| {
            if self.ansatz.is_square_of_states(column) {
                1
            } else {
                MIXED_COST
            }
        };
        let mut findings = Findings::default();
        for ((degree, _), mut group) in groups {
            loop {
                group.retain(|one| known.is_new(&gradient(&one.vector)));
                let is_new = |vector: &[Entry]| known.is_new(&gradient(vector));
                let simplest = group
                    .iter()
                    .enumerate()
                    .map(|(place, one)| (simplest(one, candidates, cost, is_new), place))
                    .min_by_key(|(vector, place)| (total(vector, cost), *place));
                let Some((vector, place)) = simplest else {
                    break;
                };
                let own = group.remove(place);
                let found = [vector, own.vector.clone()].into_iter().find_map(|vector| {
                    let found = self.lift(dag, fields, &vector, own.parameters, &mut random)?;
                    Some((found, vector))
                });
                match found {
                    Some(((psi, derivatives), vector)) => {
                        known.rows.push(gradient(&vector));
                        findings.invariants.push(Invariant {
                            psi,
                            derivatives,
                            degree,
                        });
                    }
                    None => findings.unresolved += 1,
                }
            }
        }
        Some(findings)
    }

    /// The null vectors for these fields and monomials: those for parameters as symbols, and
    /// those with coefficients that do not depend on them.
    pub(super) fn candidates(&self, fields: &[usize], columns: &[usize]) -> Option<Vec<Candidate>> {
        let mut random = Random(4);
        let all = if self.parameters.is_empty() {
            Parameters::Varied
        } else {
            Parameters::First
        };
        let mut candidates = self.null_space(fields, columns, all, &mut random)?;
        if all != Parameters::Varied {
            // They are combinations of the others, so that no other monomials occur.
            let columns = occurring(&candidates);
            let simple = self.null_space(fields, &columns, Parameters::Varied, &mut random)?;
            candidates.extend(simple);
        }
        Some(candidates)
    }

    fn null_space(
        &self,
        fields: &[usize],
        columns: &[usize],
        parameters: Parameters,
        random: &mut Random,
    ) -> Option<Vec<Candidate>> {
        let mut echelon = Echelon::new(columns.len());
        let mut left = columns.len() + EXTRA_EQUATIONS;
        while left > 0 && echelon.rank() < columns.len() {
            let mut rows = Vec::new();
            for _ in 0..left.min(ROWS_AT_ONCE) {
                let at = self.ansatz.point(NARROW, parameters, random)?;
                let mut rates = self.ansatz.rates(NARROW, &at, columns);
                let chosen = fields.iter();
                rows.extend(chosen.filter_map(|&field| rates.get_mut(field).map(std::mem::take)));
            }
            left = left.saturating_sub(ROWS_AT_ONCE);
            echelon.insert(rows);
        }
        let candidate = |free: usize| {
            let entries = echelon.null_vector(free).into_iter();
            let vector = entries.filter_map(|(place, value)| Some((*columns.get(place)?, value)));
            Candidate {
                vector: vector.collect(),
                degree: columns
                    .get(free)
                    .map_or(0, |&column| self.ansatz.degree(column)),
                parameters,
            }
        };
        Some(echelon.free_columns().into_iter().map(candidate).collect())
    }

    /// ψ with exact coefficients, and its derivatives; `None` if they were not found or not proved.
    fn lift(
        &self,
        dag: &mut Dag,
        fields: &[usize],
        vector: &[Entry],
        parameters: Parameters,
        random: &mut Random,
    ) -> Option<(Id, Derivatives)> {
        let columns: Vec<usize> = vector.iter().map(|&(column, _)| column).collect();
        let chosen = fields
            .iter()
            .filter_map(|&field| self.fields.get(field).copied());
        let chosen: Vec<&[Id]> = chosen.collect();
        let coefficients = Coefficients {
            ansatz: self.ansatz,
            fields,
            columns: &columns,
        };
        if parameters == Parameters::Varied {
            let numbers = coefficients.numbers(random)?;
            let scale = to_coprime_integers(numbers.iter());
            let numbers: Vec<Id> = numbers
                .into_iter()
                .map(|number| dag.constant(number * &scale))
                .collect();
            let psi = combination(dag, self.ansatz, &columns, &numbers);
            return self.proved(dag, psi, &chosen);
        }
        let known = coefficients.powers(dag, self.parameters, random)?;
        let monomials: Vec<Id> = columns
            .iter()
            .map(|&column| self.ansatz.monomial(dag, column))
            .collect();
        let functions = functions(dag, self.states, &chosen, &monomials, &known)?;
        let coefficients = without_denominators(dag, &functions)?;
        let psi = combination(dag, self.ansatz, &columns, &coefficients);
        self.proved(dag, psi, &chosen)
    }

    /// ψ with its derivatives, if ∇ψ·f = 0 is proved for these fields.
    fn proved(&self, dag: &mut Dag, psi: Id, fields: &[&[Id]]) -> Option<(Id, Derivatives)> {
        let derivatives = Derivatives::of(dag, psi, self.states);
        let is_proved = fields.iter().all(|field| {
            let residual = dot(dag, &derivatives.gradient, field);
            is_proved_zero(dag, residual)
        });
        is_proved.then_some((psi, derivatives))
    }
}

/// Σ coefficient·monomial of these columns, with the sign for which squares of states, and then
/// most terms, are positive.
fn combination(dag: &mut Dag, ansatz: &Ansatz<'_>, columns: &[usize], coefficients: &[Id]) -> Id {
    let (mut positive, mut negative) = (Vec::new(), Vec::new());
    let (mut balance, mut first) = (0, None);
    for (&column, &coefficient) in columns.iter().zip(coefficients) {
        let monomial = ansatz.monomial(dag, column);
        let term = dag.mul(coefficient, monomial);
        let is_square = ansatz.is_square_of_states(column);
        let weight = if is_square { columns.len() as i64 } else { 1 };
        let is_negative = is_negative(dag, term);
        first.get_or_insert(is_negative);
        if is_negative {
            balance -= weight;
            negative.push(dag.neg(term));
        } else {
            balance += weight;
            positive.push(term);
        }
    }
    if balance < 0 || balance == 0 && first == Some(true) {
        std::mem::swap(&mut positive, &mut negative);
    }
    let sum = dag.sum(positive);
    negative
        .into_iter()
        .fold(sum, |sum, term| dag.sub(sum, term))
}

/// Whether an expression is written with a minus sign in front.
fn is_negative(dag: &Dag, id: Id) -> bool {
    match &dag[id] {
        Math::Neg(_) => true,
        Math::Constant(value) => value.is_negative(),
        Math::Mul([first, _]) | Math::Div([first, _]) => is_negative(dag, *first),
        _ => false,
    }
}
