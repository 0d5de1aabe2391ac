//! The guards of a region, evaluated from their program.

use std::cell::RefCell;
use std::sync::Arc;

use dmm_compiler::program::Quantity;

use super::code::{Code, Values, converted, vector};
use super::series::SeriesCode;
use crate::arithmetic::{Scalar, Vector};
use crate::contract::{Guards, Side};
use crate::series::{Order, Rolled};

/// The functions g of a system.
#[derive(Debug)]
pub(super) struct GuardsCode {
    pub(super) code: Code,
    pub(super) series: SeriesCode,
    /// The guards that are positive with either sign.
    pub(super) oriented: Vec<usize>,
    pub(super) first_condition: Option<usize>,
    pub(super) autonomous: bool,
    pub(super) degree: Option<u32>,
}

/// The guards of a region: functions and sides.
#[derive(Debug)]
pub(super) struct TapeSides {
    /// Nothing where the system has no guards.
    pub(super) guards: Option<Arc<GuardsCode>>,
    pub(super) sides: Vec<(usize, Side)>,
    /// The guards whose side is part of the mode, with the numbers of the parameters that tell it.
    pub(super) free: Vec<(usize, usize)>,
}

impl TapeSides {
    /// With the sides of a mode.
    fn on<S: Scalar>(self: &Arc<Self>, parameter: impl Fn(usize) -> S) -> Arc<Self> {
        if self.free.is_empty() {
            return Arc::clone(self);
        }
        let side = |index: usize| Side::of(parameter(index).to_f64() - 0.5);
        let free = self.free.iter().map(|&(guard, index)| (guard, side(index)));
        Arc::new(Self {
            guards: self.guards.clone(),
            sides: self.sides.iter().copied().chain(free).collect(),
            free: Vec::new(),
        })
    }

    /// Whether a guard keeps the sign that it has where the region is entered.
    pub(super) fn keeps_signs(&self) -> bool {
        let oriented = self.guards.iter().flat_map(|guards| &guards.oriented);
        let mut numbers = oriented.filter(|number| self.sides.iter().any(|(of, _)| of == *number));
        numbers.next().is_some()
    }
}

/// The guards of a region with parameters.
#[derive(Clone, Debug)]
pub(crate) struct TapeGuards<S: Scalar> {
    sides: Arc<TapeSides>,
    registers: RefCell<Vec<S>>,
    /// The guards whose sign is turned.
    turned: Vec<usize>,
}

impl<S: Scalar> TapeGuards<S> {
    /// Those with parameters.
    pub(super) fn new(sides: &Arc<TapeSides>, parameter: impl Fn(usize) -> S) -> Self {
        let guards = sides.guards.as_ref();
        let registers = guards.map(|guards| guards.code.registers(&parameter));
        Self {
            sides: sides.on(parameter),
            registers: RefCell::new(registers.unwrap_or_default()),
            turned: Vec::new(),
        }
    }

    /// The same over other scalars.
    pub(super) fn converted<Other: Scalar>(&self) -> TapeGuards<Other> {
        TapeGuards {
            sides: Arc::clone(&self.sides),
            registers: RefCell::new(converted(&self.registers.borrow())),
            turned: self.turned.clone(),
        }
    }

    /// With guards that are positive at (t, x), of those that keep a sign.
    pub(super) fn turned<const N: usize>(&self, t: S, x: &Vector<S, N>) -> Self {
        let mut turned = self.clone();
        let oriented = self.sides.guards.iter().flat_map(|guards| &guards.oriented);
        for &number in oriented {
            if self.switching_function(number, t, x).to_f64() < 0.0 {
                match turned.turned.iter().position(|&one| one == number) {
                    Some(place) => drop(turned.turned.remove(place)),
                    None => turned.turned.push(number),
                }
            }
        }
        turned
    }

    /// u, or −u where the guard is turned.
    fn with_sign(&self, guard: usize, u: S) -> S {
        if self.turned.contains(&guard) { -u } else { u }
    }

    /// The results of a function.
    fn at_point<T, const N: usize>(
        &self,
        quantity: Quantity,
        t: S,
        x: &Vector<S, N>,
        results: impl FnOnce(&[S], &Values) -> Option<T>,
    ) -> Option<T> {
        let routine = self.sides.guards.as_ref()?.code.get(quantity)?;
        let registers = &mut **self.registers.borrow_mut();
        routine.first.run_at(registers, t, x);
        results(registers, &routine.results)
    }

    fn number<const N: usize>(&self, quantity: Quantity, t: S, x: &Vector<S, N>) -> S {
        let number = self.at_point(quantity, t, x, |registers, values| match values {
            Values::Scalar(register) => Some(registers[*register as usize]),
            _ => None,
        });
        number.unwrap_or(S::from_f64(f64::NAN))
    }
}

impl<S: Scalar, const N: usize> Guards<S, N> for TapeGuards<S> {
    fn sides(&self) -> &[(usize, Side)] {
        &self.sides.sides
    }

    fn is_condition(&self, guard: usize) -> bool {
        let first = self.sides.guards.as_ref();
        let first = first.and_then(|guards| guards.first_condition);
        first.is_some_and(|first| guard >= first)
    }

    fn is_autonomous(&self) -> bool {
        let guards = self.sides.guards.as_ref();
        guards.is_none_or(|guards| guards.autonomous)
    }

    fn degree(&self) -> Option<u32> {
        match &self.sides.guards {
            Some(guards) => guards.degree,
            None => Some(0),
        }
    }

    type Each<T: Copy> = Vec<T>;

    fn each<T: Copy>(&self, value: impl FnMut(usize) -> T) -> Vec<T> {
        (0..self.sides.sides.len()).map(value).collect()
    }

    type Over<Other: Scalar> = TapeGuards<Other>;

    fn over<Other: Scalar>(&self) -> TapeGuards<Other> {
        self.converted()
    }

    fn oriented(&self, t: S, x: &Vector<S, N>) -> Self {
        self.turned(t, x)
    }

    fn switching_function(&self, guard: usize, t: S, x: &Vector<S, N>) -> S {
        let value = self.number(Quantity::SwitchingFunction(guard), t, x);
        self.with_sign(guard, value)
    }

    fn switching_size(&self, guard: usize, t: S, x: &Vector<S, N>) -> S {
        self.number(Quantity::SwitchingSize(guard), t, x)
    }

    fn switching_gradient(&self, guard: usize, t: S, x: &Vector<S, N>) -> (S, Vector<S, N>) {
        let quantity = Quantity::SwitchingGradient(guard);
        let derivatives = self.at_point(quantity, t, x, |registers, values| match values {
            Values::ScalarAndColumn(by_time, gradient) => Some((
                registers[*by_time as usize],
                vector::<S, N>(registers, gradient),
            )),
            _ => None,
        });
        let nan = S::from_f64(f64::NAN);
        let (by_time, gradient) = derivatives.unwrap_or((nan, Vector::from_element(nan)));
        let by_time = self.with_sign(guard, by_time);
        (by_time, gradient.map(|entry| self.with_sign(guard, entry)))
    }

    type Series<const P: usize> = Vec<[S; P]>;
    type Unrolled = Rolled;

    fn series<const P: usize>(&self) -> Vec<[S; P]> {
        let guards = self.sides.guards.as_ref();
        let slots = guards.map_or(0, |guards| guards.series.slots(guards.count()));
        vec![[S::from_f64(0.0); P]; slots]
    }

    fn advance<K: Order, const P: usize>(
        &self,
        k: K,
        t: S,
        states: &[[S; P]],
        series: &mut Vec<[S; P]>,
    ) {
        let Some(guards) = &self.sides.guards else {
            return;
        };
        let registers = &mut **self.registers.borrow_mut();
        guards.series.along(k, t, registers, states, series);
        for &guard in &self.turned {
            series[guard][k.get()] = -series[guard][k.get()];
        }
    }
}

impl GuardsCode {
    /// How many functions there are.
    fn count(&self) -> usize {
        self.series.roots()
    }
}
