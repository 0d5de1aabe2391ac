//! The forces of a Hamiltonian by its velocities.
//!
//! Where H = ½ pᵀA(q)p + V(q), the velocities are q̇ = A p. With the mass matrix M = A⁻¹
//!
//! ```text
//! ∂H/∂qₖ = −½ q̇ᵀ (∂M/∂qₖ) q̇ + ∂V/∂qₖ
//! ```
//!
//! as the derivatives of H by a parameter at constant p, and of the Lagrangian at constant q̇, are
//! opposite (Landau & Lifshitz, Mechanics, 1976, §40). M is a polynomial of lengths and cosines where A
//! has its determinant as a denominator, and q̇ has been computed: of a double pendulum 13 recurrences of
//! Taylor coefficients are left of 19.

use std::collections::HashMap;

use super::optimise::Count;
use crate::algebra::linear::determinant;
use crate::algebra::{
    Dag, Id, Math, Name, Verdict, decide_zero, differentiate, divide_exactly, gradient,
};
use crate::model::Region;

/// The mass matrix of more pairs is not looked for.
const MOST_PAIRS: usize = 3;

/// f with its forces by its velocities, if that takes fewer operations.
pub(super) fn by_velocities(dag: &mut Dag, region: &Region, states: &[Name]) -> Vec<Id> {
    shortened(dag, region, states).unwrap_or_else(|| region.field.clone())
}

/// The same; nothing where it is not shorter, or not proved to be f.
fn shortened(dag: &mut Dag, region: &Region, states: &[Name]) -> Option<Vec<Id>> {
    let forces = Forces::new(dag, region, states)?;
    let mut field = region.field.clone();
    for (k, &(_, p)) in region.canonical.iter().enumerate() {
        field[p] = forces.force(dag, k);
    }
    let [before, after] = [&region.field, &field].map(|f| Count::shared(dag, f, |_| false));
    let is_same = |dag: &mut Dag, p: usize| {
        let difference = dag.sub(region.field[p], field[p]);
        decide_zero(dag, difference) == Verdict::Proved
    };
    let is_shorter = after.weighted < before.weighted;
    let is_field = is_shorter && region.canonical.iter().all(|&(_, p)| is_same(dag, p));
    is_field.then_some(field)
}

/// What the forces are made of.
struct Forces {
    /// The coordinates.
    coordinates: Vec<Name>,
    /// q̇
    velocities: Vec<Id>,
    /// M
    masses: Vec<Vec<Id>>,
    /// −∂V/∂q
    at_rest: Vec<Id>,
}

impl Forces {
    /// Nothing where q̇ is no A(q) p, A is constant, or M is not simple.
    fn new(dag: &mut Dag, region: &Region, states: &[Name]) -> Option<Self> {
        let (q, p): (Vec<usize>, Vec<usize>) = region.canonical.iter().copied().unzip();
        if q.is_empty() || q.len() > MOST_PAIRS {
            return None;
        }
        let [coordinates, momenta] = [&q, &p].map(|pairs| -> Vec<Name> {
            pairs.iter().map(|&state| states[state].clone()).collect()
        });
        let field = |state: &usize| region.field[*state];
        let velocities: Vec<Id> = q.iter().map(field).collect();
        let mut by_momenta = |&velocity: &Id| -> Vec<Id> { gradient(dag, velocity, &momenta) };
        let inverse: Vec<Vec<Id>> = velocities.iter().map(&mut by_momenta).collect();
        let used = dag.variables(inverse.iter().flatten().copied());
        let is_used = |name: &Name| used.contains(name);
        if momenta.iter().any(is_used) || !coordinates.iter().any(is_used) {
            return None;
        }
        let zero = dag.integer(0);
        let rest: HashMap<Name, Id> = momenta.iter().map(|p| (p.clone(), zero)).collect();
        let mut at_rest = |root: Id| dag.substitute(root, &rest);
        let still: Vec<Id> = velocities.iter().map(|&root| at_rest(root)).collect();
        let at_rest: Vec<Id> = p.iter().map(|state| at_rest(field(state))).collect();
        if still.iter().any(|&velocity| !dag.is_zero(velocity)) {
            return None;
        }
        Some(Self {
            masses: inverted(dag, &inverse)?,
            coordinates,
            velocities,
            at_rest,
        })
    }

    /// −∂H/∂qₖ
    fn force(&self, dag: &mut Dag, k: usize) -> Id {
        let half = dag.fraction(1, 2);
        let mut force = self.at_rest[k];
        for (i, row) in self.masses.iter().enumerate() {
            for (j, &mass) in row.iter().enumerate().skip(i) {
                let derivative = differentiate(dag, mass, &self.coordinates[k]);
                // as it is: quotients that are multiplied would become one, which shares nothing
                let product = dag.insert(Math::Mul([self.velocities[i], self.velocities[j]]));
                let term = dag.mul(derivative, product);
                let term = if i == j { dag.mul(half, term) } else { term };
                force = dag.add(force, term);
            }
        }
        force
    }
}

/// The inverse of a symmetric matrix, if its entries have no denominators that may vanish.
fn inverted(dag: &mut Dag, rows: &[Vec<Id>]) -> Option<Vec<Vec<Id>>> {
    let all: Vec<usize> = (0..rows.len()).collect();
    let whole = determinant(dag, rows, &all);
    let mut entry = |i: usize, j: usize| {
        let others: Vec<&Vec<Id>> = rows
            .iter()
            .enumerate()
            .filter(|&(row, _)| row != j)
            .map(|(_, row)| row)
            .collect();
        let columns: Vec<usize> = all.iter().copied().filter(|&column| column != i).collect();
        let minor = determinant(dag, &others, &columns);
        let cofactor = if (i + j).is_multiple_of(2) {
            minor
        } else {
            dag.neg(minor)
        };
        let quotient = divide_exactly(dag, cofactor, whole)?;
        quotient.denominator.is_empty().then_some(quotient.value)
    };
    let entries = all
        .iter()
        .map(|&i| all.iter().map(|&j| entry(i, j)).collect());
    entries.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostics::Diagnostics;
    use crate::model::Model;
    use crate::{check, syntax};

    /// A system, and its field by its velocities.
    fn of_system(body: &str) -> (Model, Vec<Id>) {
        let mut diagnostics = Diagnostics::new();
        let declaration = format!("system Own {{ {body} }}").parse().unwrap();
        let parsed = syntax::parse(declaration, &mut diagnostics).unwrap();
        let mut model = check::resolve(parsed, &mut diagnostics).unwrap();
        let states = model.state_names();
        let field = by_velocities(&mut model.dag, &model.regions[0], &states);
        (model, field)
    }

    #[test]
    fn forces_are_made_of_velocities() {
        for (body, pairs) in [
            // a bead on the parabola y = x²/2, with the mass matrix 1 + x²
            (
                "state x, p; hamiltonian H = p^2/(2*(1 + x^2)) + x^2/2 in (x, p);",
                1,
            ),
            (
                "state a, b, p, q; param m = 2, l = 3;
                hamiltonian H = (m*l^2*p^2 + (1 + m)*q^2 - 2*m*l*p*q*cos(a - b))
                    /(2*m*l^2*(1 + m*sin(a - b)^2)) - cos(a) - cos(b) in (a, p), (b, q);",
                2,
            ),
        ] {
            let (model, field) = of_system(body);
            let (velocities, forces) = field.split_at(pairs);
            assert_eq!(velocities, &model.regions[0].field[..pairs]);
            for &force in forces {
                let parts = model.dag.reachable([force]);
                assert!(velocities.iter().all(|one| parts.contains(one)), "{body}");
            }
        }
    }

    #[test]
    fn what_is_no_simpler_stays() {
        for body in [
            // the mass matrix is constant
            "state q, p; hamiltonian H = p^2/2 - cos(q) in (q, p);",
            // it has a pole where the force has none
            "state q, p; hamiltonian H = q^2*p^2/2 in (q, p);",
            // momenta of a charge in a magnetic field are no velocities
            "state x, y, p, q; hamiltonian H = ((p - y^2)^2 + q^2)/(2*(1 + x^2)) in (x, p), (y, q);",
            // a relativistic energy is no square
            "state q, p; hamiltonian H = sqrt(1 + p^2/(1 + q^2)) in (q, p);",
        ] {
            let (model, field) = of_system(body);
            assert_eq!(field, model.regions[0].field, "{body}");
        }
    }
}
