//! Whether a quantity is conserved, apart from the normal form: ∂ₜψ + ∇ψ·f in 120 digits, by
//! automatic differentiation of the formulas as they were declared.

use std::collections::BTreeMap;

use dmm_compiler::algebra::{Dag, Function, Id, Math, Name};
use dmm_compiler::model::{Model, Region, Sign};

use super::arithmetic::{
    Big, big, doubles, exact_call, integer_power, kept, one, pi, quotient, rational,
};
use super::random::Random;

/// What is so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Truth {
    /// The rate is zero at all points.
    Holds,
    /// It is not at one of them.
    Fails,
    /// There are too few points in the domain to tell.
    Open,
}

/// Points at which the rate is evaluated.
const POINTS: usize = 6;
/// Points that are tried.
const TRIALS: usize = 600;
/// A rate below this part of its terms is zero, and else it is not: 2⁻¹⁶⁰. The digits are those
/// of 400 bits, and no change of a declaration is smaller than 10⁻⁹.
const SMALL: f64 = 7e-49;

/// A point of a model's variables.
pub(crate) type Point = BTreeMap<Name, f64>;

/// A point: positive coordinates, of both signs, or small; parameters among them integers.
pub(crate) fn point(model: &Model, random: &mut Random) -> Point {
    let ranges = [
        (0.1, 2.0),
        (-2.0, 2.0),
        (0.05, 0.9),
        (-0.9, 0.9),
        (0.01, 0.3),
    ];
    let (low, high) = ranges[random.below(ranges.len())];
    let mut draw = |low: f64, high: f64| {
        let unit = random.below(1 << 20) as f64 / f64::from(1 << 20);
        low + (high - low) * unit
    };
    let mut point = Point::new();
    for state in &model.states {
        point.insert(state.name.clone(), draw(low, high));
    }
    for parameter in &model.parameters {
        let value = draw(0.2, 3.5);
        let whole = draw(0.0, 1.0) < 0.4;
        point.insert(
            parameter.name.clone(),
            if whole { value.round().max(1.0) } else { value },
        );
    }
    point.insert(Model::time(), draw(0.1, 2.0));
    point
}

/// Whether `point` lies in `region`.
pub(crate) fn is_inside(model: &Model, region: &Region, point: &Point) -> bool {
    region.sides.iter().all(|side| {
        let g = model.interfaces[side.interface].switching_function;
        let value = doubles(&model.dag, &[g], point)[0];
        match side.sign {
            Sign::Positive => value > 0.0,
            Sign::Negative => value < 0.0,
        }
    })
}

/// Whether ψ of a region is conserved by its field.
pub(crate) fn truth(model: &Model, region: &Region, psi: Id, random: &mut Random) -> Truth {
    let roots: Vec<Id> = region.field.iter().copied().chain([psi]).collect();
    let mut found = 0;
    for _ in 0..TRIALS {
        let point = point(model, random);
        let finite = |value: &f64| value.is_finite();
        if !doubles(&model.dag, &roots, &point).iter().all(finite)
            || !is_inside(model, region, &point)
        {
            continue;
        }
        match is_zero(model, region, psi, &point) {
            Some(true) => found += 1,
            Some(false) => return Truth::Fails,
            None => {}
        }
        if found == POINTS {
            return Truth::Holds;
        }
    }
    if found >= 2 {
        Truth::Holds
    } else {
        Truth::Open
    }
}

/// Whether the rate of ψ is zero at a point, if it has a value there.
pub(crate) fn is_zero(model: &Model, region: &Region, psi: Id, point: &Point) -> Option<bool> {
    let zero = Big::ZERO;
    let mut rates = BTreeMap::from([(Model::time(), one())]);
    let mut size = one();
    let values = Duals::of(&model.dag, &region.field, point, &BTreeMap::new())?;
    for (state, component) in model.states.iter().zip(&region.field) {
        let rate = values.known[component].0.clone();
        rates.insert(state.name.clone(), rate);
    }
    let whole = Duals::of(&model.dag, &[psi], point, &rates)?;
    let rate = whole.known[&psi].1.clone();
    // the size of the terms: one rate at a time
    for (name, rate) in &rates {
        let single = BTreeMap::from([(name.clone(), rate.clone())]);
        let part = Duals::of(&model.dag, &[psi], point, &single)?.known[&psi]
            .1
            .clone();
        size += if part < zero { -part } else { part };
    }
    let relative = (rate / size).to_f64().value().abs();
    relative.is_finite().then_some(relative < SMALL)
}

/// Values with their derivatives along a direction.
struct Duals {
    known: BTreeMap<Id, (Big, Big)>,
}

impl Duals {
    /// Of everything below `roots`; nothing outside of a domain.
    fn of(dag: &Dag, roots: &[Id], point: &Point, rates: &BTreeMap<Name, Big>) -> Option<Self> {
        let mut known: BTreeMap<Id, (Big, Big)> = BTreeMap::new();
        for id in dag.reachable(roots.iter().copied()) {
            let of = |child: &Id| known[child].clone();
            let value = match &dag[id] {
                Math::Pi => (pi(), Big::ZERO),
                Math::Constant(value) => (rational(value), Big::ZERO),
                Math::Variable(name) => {
                    let rate = rates.get(name).cloned().unwrap_or(Big::ZERO);
                    (big(*point.get(name)?)?, rate)
                }
                Math::Neg(u) => {
                    let (u, du) = of(u);
                    (-u, -du)
                }
                Math::Add([u, v]) => {
                    let ((u, du), (v, dv)) = (of(u), of(v));
                    (u + v, du + dv)
                }
                Math::Sub([u, v]) => {
                    let ((u, du), (v, dv)) = (of(u), of(v));
                    (u - v, du - dv)
                }
                Math::Mul([u, v]) => {
                    let ((u, du), (v, dv)) = (of(u), of(v));
                    (&u * &v, du * v + u * dv)
                }
                Math::Div([u, v]) => {
                    let ((u, du), (v, dv)) = (of(u), of(v));
                    let value = quotient(&u, &v)?;
                    let slope = quotient(&(du - &value * dv), &v)?;
                    (value, slope)
                }
                Math::Pow([u, v]) => power(dag, of(u), of(v), *v)?,
                Math::Call(function, u) => {
                    let (u, du) = of(u);
                    (exact_call(*function, &u)?, slope(*function, &u, &du)?)
                }
                Math::Pair(..) => return None,
            };
            known.insert(id, (kept(value.0), kept(value.1)));
        }
        Some(Self { known })
    }
}

fn power(dag: &Dag, (u, du): (Big, Big), (v, dv): (Big, Big), exponent: Id) -> Option<(Big, Big)> {
    let whole = dag.as_integer(exponent).or_else(|| {
        // a parameter that is an integer: negative bases have powers
        let value = v.to_f64().value();
        (u < Big::ZERO && value.fract() == 0.0 && dv == Big::ZERO).then_some(value as i64)
    });
    if let Some(n) = whole {
        let value = integer_power(&u, n)?;
        let slope = match n {
            0 => Big::ZERO,
            _ => integer_power(&u, n - 1)? * Big::from(n) * du,
        };
        return Some((value, slope));
    }
    if u <= Big::ZERO {
        return None;
    }
    let logarithm = u.ln();
    let value = (&logarithm * &v).exp();
    let slope = &value * (dv * logarithm + v * du / u);
    Some((value, slope))
}

/// h′(u) u̇
fn slope(function: Function, u: &Big, du: &Big) -> Option<Big> {
    use Function::*;
    if *du == Big::ZERO {
        return Some(Big::ZERO);
    }
    let factor = match function {
        Sqrt => quotient(&one(), &(u.sqrt() * Big::from(2)))?,
        Exp => u.exp(),
        Ln => quotient(&one(), u)?,
        Sin => u.cos(),
        Cos => -u.sin(),
        Tan => quotient(&one(), &(u.cos() * u.cos()))?,
        Sinh => u.cosh(),
        Cosh => u.sinh(),
        Tanh => quotient(&one(), &(u.cosh() * u.cosh()))?,
        Asin | Acos => {
            let square = one() - u * u;
            let root = (square > Big::ZERO).then(|| square.sqrt())?;
            let slope = quotient(&one(), &root)?;
            if function == Asin { slope } else { -slope }
        }
        Atan => quotient(&one(), &(one() + u * u))?,
        Abs | Sinc | SincPrime | Sinhc | SinhcPrime => return None,
    };
    Some(factor * du)
}
