//! Coefficients from their residues modulo the wide prime.
//!
//! The null space modulo the narrow prime says of which monomials an invariant is made; with
//! the last coefficient 1 the others are unique, and a small system gives their residues for any
//! values of the parameters. A coefficient that is the same for all of them is a fraction that
//! its residue tells. One that is c·Π pᵉ in the parameters p, which is what masses and
//! stiffnesses mostly become, is told from how it changes as each of them is doubled.

use crate::algebra::{Dag, Id, Name, Rational};

use super::ansatz::{Ansatz, DEGREE_OF_VALUES, EXTRA_EQUATIONS, Parameters};
use super::elimination::solve;
use super::field::{Random, WIDE};

/// Exponents of parameters are between ± this.
const LARGEST_EXPONENT: i64 = 8;

/// ∇ψ·f = 0 for these fields with these monomials, the last with the coefficient 1.
pub(super) struct Coefficients<'a> {
    pub(super) ansatz: &'a Ansatz<'a>,
    pub(super) fields: &'a [usize],
    pub(super) columns: &'a [usize],
}

impl Coefficients<'_> {
    /// The residues of all coefficients; `None` if they are not unique.
    fn residues(&self, parameters: Parameters, random: &mut Random) -> Option<Vec<u64>> {
        let mut rows = Vec::new();
        for _ in 0..self.columns.len() + EXTRA_EQUATIONS {
            let at = self.ansatz.point(WIDE, parameters, random)?;
            let mut rates = self.ansatz.rates(WIDE, &at, self.columns);
            let chosen = self.fields.iter();
            rows.extend(chosen.filter_map(|&field| rates.get_mut(field).map(std::mem::take)));
        }
        let mut residues = solve(WIDE, &rows, self.columns.len().checked_sub(1)?)?;
        residues.push(1);
        Some(residues)
    }

    /// The coefficients if they do not depend on the parameters.
    pub(super) fn numbers(&self, random: &mut Random) -> Option<Vec<Rational>> {
        let residues = self.residues(Parameters::Varied, random)?;
        let numbers = residues.into_iter().map(|residue| WIDE.fraction(residue));
        numbers.collect()
    }

    /// The coefficients of the form c·Π pᵉ, and nothing for the others; `None` if they are not
    /// unique.
    pub(super) fn powers(
        &self,
        dag: &mut Dag,
        parameters: &[Name],
        random: &mut Random,
    ) -> Option<Vec<Option<Id>>> {
        let first = self.residues(Parameters::First, random)?;
        let second = self.residues(Parameters::Second, random)?;
        let doubled: Vec<Option<Vec<u64>>> = (0..parameters.len())
            .map(|index| self.residues(Parameters::Doubled(index), random))
            .collect();
        let power = |(place, (&one, &other)): (usize, (&u64, &u64))| {
            let exponents = doubled.iter().map(|residues| {
                let residue = *residues.as_ref()?.get(place)?;
                exponent(WIDE.mul(residue, WIDE.inverse(one)?))
            });
            let exponents: Vec<i64> = exponents.collect::<Option<_>>()?;
            let factor = |set| self.product(set, &exponents);
            let constant = WIDE.mul(one, WIDE.inverse(factor(Parameters::First)?)?);
            let expected = WIDE.mul(constant, factor(Parameters::Second)?);
            if expected != other {
                return None;
            }
            let mut value = dag.constant(WIDE.fraction(constant)?);
            for (name, &exponent) in parameters.iter().zip(&exponents) {
                let exponent = Rational::new(exponent.into(), DEGREE_OF_VALUES.into());
                let (base, exponent) = (dag.variable(name), dag.constant(exponent));
                let power = dag.pow(base, exponent);
                value = dag.mul(value, power);
            }
            Some(value)
        };
        Some(first.iter().zip(&second).enumerate().map(power).collect())
    }

    /// Π pᵉ, the exponents in parts of the degree of the parameters' values.
    fn product(&self, parameters: Parameters, exponents: &[i64]) -> Option<u64> {
        let mut product = 1;
        for (index, &exponent) in exponents.iter().enumerate() {
            let root = self.ansatz.root_of_parameter(WIDE, parameters, index)?;
            let power = WIDE.pow(root, exponent.unsigned_abs());
            let factor = if exponent < 0 {
                WIDE.inverse(power)?
            } else {
                power
            };
            product = WIDE.mul(product, factor);
        }
        Some(product)
    }
}

/// n with 2ⁿ = `residue`, as large as exponents of parameters may be.
fn exponent(residue: u64) -> Option<i64> {
    let largest = LARGEST_EXPONENT * DEGREE_OF_VALUES as i64;
    let mut rising = 1;
    let mut falling = 1;
    let half = WIDE.inverse(2)?;
    for n in 0..=largest {
        if rising == residue {
            return Some(n);
        }
        if falling == residue {
            return Some(-n);
        }
        rising = WIDE.mul(rising, 2);
        falling = WIDE.mul(falling, half);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_are_told_from_powers_of_two() {
        assert_eq!(exponent(1), Some(0));
        assert_eq!(exponent(4096), Some(12));
        assert_eq!(exponent(WIDE.inverse(64).expect("not zero")), Some(-6));
        assert_eq!(exponent(3), None);
    }
}
