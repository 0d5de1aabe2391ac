//! Exact evaluation: an expression without roots and transcendental functions has a rational
//! value at a rational point, and one that is not zero disproves an identity whatever its size.

use std::collections::{BTreeMap, HashMap};

use num_traits::{One, Zero};

use super::super::{Dag, Id, Math, Name, Rational};

/// Values with more bits than this are given up.
const MOST_BITS: u64 = 1 << 14;
/// Powers above this size are given up.
const LARGEST_POWER: i64 = 1024;

/// The value of `root`; `None` where it is not a rational number, is not defined, or has too
/// many digits.
pub fn evaluate_exactly(
    dag: &Dag,
    root: Id,
    values: &BTreeMap<Name, Rational>,
) -> Option<Rational> {
    let mut known: HashMap<Id, Rational> = HashMap::new();
    for id in dag.reachable([root]) {
        let value = node(dag, id, &known, values)?;
        if value.numer().bits().max(value.denom().bits()) > MOST_BITS {
            return None;
        }
        known.insert(id, value);
    }
    known.remove(&root)
}

fn node(
    dag: &Dag,
    id: Id,
    known: &HashMap<Id, Rational>,
    values: &BTreeMap<Name, Rational>,
) -> Option<Rational> {
    match &dag[id] {
        Math::Constant(value) => Some(value.clone()),
        Math::Variable(name) => values.get(name).cloned(),
        Math::Neg(u) => Some(-known.get(u)?.clone()),
        Math::Add([u, v]) => Some(known.get(u)? + known.get(v)?),
        Math::Sub([u, v]) => Some(known.get(u)? - known.get(v)?),
        Math::Mul([u, v]) => Some(known.get(u)? * known.get(v)?),
        Math::Div([u, v]) => {
            let divisor = known.get(v)?;
            (!divisor.is_zero()).then(|| Some(known.get(u)? / divisor))?
        }
        Math::Pow([u, v]) => power(known.get(u)?, dag.as_integer(*v)?),
        Math::Pi | Math::Call(..) | Math::Pair(..) => None,
    }
}

fn power(base: &Rational, exponent: i64) -> Option<Rational> {
    if exponent.saturating_abs() > LARGEST_POWER || exponent < 0 && base.is_zero() {
        return None;
    }
    let bits = base.numer().bits().max(base.denom().bits());
    if bits.saturating_mul(exponent.unsigned_abs()) > MOST_BITS {
        return None;
    }
    if exponent == 0 {
        return Some(Rational::one());
    }
    Some(base.pow(i32::try_from(exponent).ok()?))
}
