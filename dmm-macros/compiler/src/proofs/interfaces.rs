//! Interfaces that cannot be crossed: the rate ∂ₜg + ∇g·f of the switching function is zero, or
//! its sign is the same everywhere in a way that leads nothing across.

use super::Derivatives;
use super::message::InterfaceProblem;
use crate::algebra::evaluate::Interval;
use crate::algebra::{Dag, Id, is_proved_zero, normalise};
use crate::model::{Interface, Region, Sign};

/// By region, what is known of the rate of interface number `index`; or that the interface is
/// constant, or that no trajectory crosses it.
pub(super) fn examine(
    dag: &mut Dag,
    (index, interface): (usize, &Interface),
    derivatives: &Derivatives,
    regions: &[Region],
) -> Result<Vec<Rate>, InterfaceProblem> {
    let is_zero = |id: Id| is_proved_zero(dag, id);
    if interface.end.is_some() {
        // a motion may last for ever
        return Ok(vec![Rate::Unknown; regions.len()]);
    }
    if derivatives.gradient.iter().copied().all(is_zero) && is_zero(derivatives.time_derivative) {
        return Err(InterfaceProblem::Constant);
    }
    let mut rates = Vec::new();
    let mut sides = Vec::new();
    for region in regions {
        if region.slide.is_some() {
            rates.push(Rate::Unknown);
            continue;
        }
        let rate = derivatives.rate(dag, &region.field);
        let rate = sign(dag, rate);
        let side = region.sides.iter().find(|side| side.interface == index);
        sides.extend(side.map(|side| (side.sign, rate)));
        rates.push(rate);
    }
    let mut open = regions
        .iter()
        .zip(&rates)
        .filter(|(region, _)| region.slide.is_none());
    if open.all(|(_, &rate)| rate == Rate::Zero) {
        return Err(InterfaceProblem::NeverCrossed);
    }
    let all = |above: Rate, below: Rate| {
        let holds = |&(sign, rate): &(Sign, Rate)| match sign {
            Sign::Positive => rate == above,
            Sign::Negative => rate == below,
        };
        sides.len() == rates.len() && sides.iter().all(holds)
    };
    if all(Rate::NotPositive, Rate::NotNegative) && !interface.slides {
        return Err(InterfaceProblem::AlwaysSliding);
    }
    if all(Rate::NotNegative, Rate::NotPositive) {
        return Err(InterfaceProblem::AlwaysLeaving);
    }
    Ok(rates)
}

/// What is known of the sign of a rate, everywhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rate {
    /// It is zero.
    Zero,
    /// It is nowhere negative.
    NotNegative,
    /// It is nowhere positive.
    NotPositive,
    /// Nothing.
    Unknown,
}

fn sign(dag: &mut Dag, rate: Id) -> Rate {
    if is_proved_zero(dag, rate) {
        return Rate::Zero;
    }
    let normal = normalise(dag, rate);
    let ranges = [Some(rate), normal].map(|id| id.map(|id| Interval::of(dag, id)));
    let any = |holds: fn(Interval) -> bool| ranges.iter().flatten().any(|&range| holds(range));
    if any(Interval::is_not_negative) {
        Rate::NotNegative
    } else if any(Interval::is_not_positive) {
        Rate::NotPositive
    } else {
        Rate::Unknown
    }
}
