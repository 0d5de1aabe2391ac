//! The coefficients of a pack: four recurrences that are alike, side by side. A pack of three has its first
//! coefficient twice.

use std::array;

use egg::Language;
use proc_macro2::TokenStream;
use quote::quote;

use super::sums::quotient_from;
use super::vectors::Lanes;
use super::writer::{Writer, minus};
use crate::algebra::{Id, Math};
use crate::program::series::{Coefficient, Place, Recurrence, fused_term};

/// A pack: its coefficients, and the first lanes of its sums in the tables.
struct Pack<'c> {
    members: Lanes<&'c Coefficient>,
    /// How many of them are different.
    count: usize,
    lanes: &'c [usize],
}

impl Pack<'_> {
    /// What `of` takes of each recurrence.
    fn each<T>(&self, of: impl Fn(&Recurrence) -> Option<T>) -> Option<Lanes<T>> {
        let values: Option<Vec<T>> = (self.members.iter())
            .map(|member| of(&member.recurrence))
            .collect();
        values?.try_into().ok()
    }
}

/// What a recurrence of a pack takes, by name.
macro_rules! taken {
    ($pack:ident, $recurrence:ident: $($field:ident),+) => {
        $(let $field = $pack.each(|one| match *one {
            Recurrence::$recurrence { $field, .. } => Some($field),
            _ => None,
        })?;)+
    };
}

impl Writer<'_, '_> {
    /// The coefficients of a pack, of this number.
    pub(super) fn pack(&mut self, number: usize, coefficients: &[Coefficient]) {
        let tables = self.tables;
        let value = match coefficients {
            [first, second] => self.of_pair([first, second]),
            _ => self.of_pack(&Pack {
                members: array::from_fn(|lane| &coefficients[lane % coefficients.len()]),
                count: coefficients.len(),
                lanes: &tables.packs[number],
            }),
        };
        let Some(value) = value else {
            let message = format!("no recurrence of pack {number}");
            self.block.push(quote!(compile_error!(#message);));
            return;
        };
        let elements = self.elements(&value, coefficients.len());
        for (coefficient, element) in coefficients.iter().zip(elements) {
            self.block.set_value(coefficient.node, element.clone());
            if let Some(slot) = coefficient.kept {
                self.set(Place::Slot(slot), &element);
            }
        }
    }

    /// uₖ, and h du/dh of the arguments u.
    fn derivatives(
        &mut self,
        arguments: Lanes<Id>,
        places: Lanes<Place>,
        count: usize,
    ) -> TokenStream {
        let u = self.values(arguments);
        self.derivatives_of(&u, places, count);
        u
    }

    fn derivatives_of(&mut self, u: &TokenStream, places: Lanes<Place>, count: usize) {
        let derivatives = Self::call("derivative", std::slice::from_ref(u));
        let elements = self.elements(&derivatives, count);
        for (place, element) in places.into_iter().zip(&elements) {
            self.set(place, element);
        }
    }

    /// The reciprocals of values, taken at order zero.
    fn inverses(&mut self, places: Lanes<Place>, values: Lanes<TokenStream>) -> TokenStream {
        let mut taken = Vec::new();
        let inverses: Lanes<TokenStream> = array::from_fn(|lane| {
            let (place, value) = (places[lane], &values[lane]);
            if taken.contains(&place) {
                let array = self.array(place);
                return quote!(#array[0]);
            }
            taken.push(place);
            self.inverse(place, value)
        });
        self.vector(inverses)
    }

    /// `start` at order zero, `later` behind.
    fn by_order(&self, start: Lanes<TokenStream>, later: &TokenStream) -> TokenStream {
        quote!(if at == 0 { dmm::series::Pack([#(#start),*]) } else { #later })
    }

    /// The coefficients of order k of what a pack computes.
    fn of_pack(&mut self, pack: &Pack<'_>) -> Option<TokenStream> {
        let [first, ..] = &pack.members;
        let at_zero = quote!(0);
        Some(match first.recurrence {
            Recurrence::Linear => return self.linear(pack.members.map(|member| member.node)),
            Recurrence::Shifted(shape) => {
                let shifted = pack.each(|one| match one {
                    Recurrence::Shifted(shifted) => Some(*shifted),
                    _ => None,
                })?;
                let u = self.values(shifted.map(|shifted| shifted.moving.1));
                let c = self.fixed_values(shifted.map(|shifted| shifted.fixed.1));
                let (u, c) = (minus(shape.moving.0, &u), minus(shape.fixed.0, &c));
                Self::call("plus", &[u, c])
            }
            Recurrence::Square(_) => {
                let of = pack.each(|one| match *one {
                    Recurrence::Square(of) => Some(of),
                    _ => None,
                })?;
                let lane = *pack.lanes.first()?;
                let (first, newest) = (self.row_from(2, lane, &at_zero), self.newest_of(of));
                let middle = self.row_from(2, lane, &quote!(at / 2));
                let sum = self.half_sums_from(lane);
                Self::call("square_from", &[quote!([#first, #newest]), middle, sum])
            }
            Recurrence::Product(_) => {
                let of = pack.each(|one| match *one {
                    Recurrence::Product(of) => Some(of),
                    _ => None,
                })?;
                let lane = *pack.lanes.first()?;
                let [u, v] = [0, 1].map(|side| {
                    let first = self.row_from(side, lane, &at_zero);
                    let newest = self.newest_of(of.map(|of| of[side]));
                    quote!([#first, #newest])
                });
                Self::call("product_from", &[u, v, self.inner_sums_from(lane)])
            }
            Recurrence::Quotient { .. } => {
                taken!(pack, Quotient: numerator, denominator, inverse, is_late);
                let lane = *pack.lanes.first()?;
                let (u, v) = (self.values(numerator), self.newest_of(denominator));
                let values = denominator.map(|place| self.newest(place));
                let inverse = self.inverses(inverse, values);
                let (first, sum) = (self.row_from(1, lane, &at_zero), self.inner_sums_from(lane));
                let name = quotient_from(is_late.contains(&true));
                Self::call(name, &[u, v, first, inverse, sum])
            }
            Recurrence::Power { .. } => return self.powers(pack),
            Recurrence::SquareRoot { .. } => {
                taken!(pack, SquareRoot: argument, inverse);
                let lane = *pack.lanes.first()?;
                let scalar = self.scope.scalar;
                let roots = argument.map(|argument| {
                    let value = self.value(argument);
                    quote!(#scalar::sqrt(#value))
                });
                let twice = roots.each_ref();
                let twice = twice.map(|root| quote!(#scalar::from_f64(2.0) * #root));
                let inverse = self.inverses(inverse, twice);
                let (u, middle) = (
                    self.values(argument),
                    self.row_from(2, lane, &quote!(at / 2)),
                );
                let sum = self.half_sums_from(lane);
                let later = Self::call("square_root_from", &[u, middle, inverse, sum]);
                self.by_order(roots, &later)
            }
            Recurrence::Exponential { .. } => {
                taken!(pack, Exponential: argument, derivative);
                let lane = *pack.lanes.first()?;
                let start = argument.map(|argument| self.exponential_at_start(argument));
                let u = self.derivatives(argument, derivative, pack.count);
                let later = self.integrals(&u, lane);
                self.by_order(start, &later)
            }
            Recurrence::Pair { .. } => return self.pairs(pack),
            _ => return None,
        })
    }

    /// ∫ v du, of sums from a lane on.
    fn integrals(&self, u: &TokenStream, lane: usize) -> TokenStream {
        let first = self.row_from(1, lane, &quote!(0));
        Self::call(
            "integral_from",
            &[u.clone(), first, self.inner_sums_from(lane)],
        )
    }

    /// u^c and h dw/dh
    fn powers(&mut self, pack: &Pack<'_>) -> Option<TokenStream> {
        taken!(pack, Power: base, exponent, inverse, derivative);
        let &[lane, other] = pack.lanes else {
            return None;
        };
        let bases = base.map(|place| self.newest(place));
        let start = array::from_fn(|lane| self.power_at_start(&bases[lane], exponent[lane]));
        let u = self.newest_of(base);
        let inverse = self.inverses(inverse, bases);
        let exponent = self.fixed_values(exponent);
        let first = self.row_from(0, lane, &quote!(0));
        let (sum, other) = (self.inner_sums_from(lane), self.inner_sums_from(other));
        let sums = quote!([#sum, #other]);
        let later = Self::call("power_from", &[u, exponent, first, inverse, sums]);
        let value = self.by_order(start, &later);
        let elements = self.elements(&value, pack.count);
        let elements: Lanes<TokenStream> =
            array::from_fn(|lane| elements[lane % pack.count].clone());
        let w = self.vector(elements);
        self.derivatives_of(&w, derivative, pack.count);
        Some(w)
    }

    /// sin and cos, sinh and cosh: each the integral of the other.
    fn pairs(&mut self, pack: &Pack<'_>) -> Option<TokenStream> {
        taken!(pack, Pair: functions, is_negative, argument, derivative, places, own);
        let &[sine_lane, cosine_lane] = pack.lanes else {
            return None;
        };
        let [start_of_sines, start_of_cosines] = [0, 1]
            .map(|which| array::from_fn(|lane| self.start(functions[lane][which], argument[lane])));
        let u = self.derivatives(argument, derivative, pack.count);
        // the sums of the cosine's derivative have the sines, and the other way round
        let sines = self.integrals(&u, cosine_lane);
        let cosines = minus(is_negative[0], &self.integrals(&u, sine_lane));
        let both = [(start_of_sines, sines), (start_of_cosines, cosines)];
        let values = both.map(|(start, later)| {
            let value = self.by_order(start, &later);
            self.elements(&value, pack.count)
        });
        for (which, elements) in values.iter().enumerate() {
            for (places, element) in places.iter().zip(elements) {
                self.set(places[which], element);
            }
        }
        Some(self.newest_of(own))
    }

    /// What is linear in its operands.
    fn linear(&mut self, nodes: Lanes<Id>) -> Option<TokenStream> {
        let dag = self.scope.lowered.dag();
        let operands = |side: usize| nodes.map(|id| dag[id].children()[side]);
        let is_fixed = |id: Id| self.scope.lowered.is_fixed(id);
        Some(match dag[nodes[0]] {
            Math::Neg(_) => minus(true, &self.values(operands(0))),
            Math::Mul([a, _]) => {
                let (c, u) = if is_fixed(a) { (0, 1) } else { (1, 0) };
                let (c, u) = (self.fixed_values(operands(c)), self.values(operands(u)));
                quote!(#c * #u)
            }
            Math::Add([a, b]) | Math::Sub([a, b]) => {
                let is_difference = matches!(dag[nodes[0]], Math::Sub(_));
                let product = fused_term(self.scope.lowered, nodes[0]);
                match product.filter(|&product| !self.block.has_value(product)) {
                    Some(product) => {
                        let side = usize::from(product == b && a != b);
                        let minus = [side == 1, side == 0].map(|minus| minus && is_difference);
                        self.sum_with_product(operands(side), operands(1 - side), minus)?
                    }
                    None => {
                        let (u, v) = (self.values(operands(0)), self.values(operands(1)));
                        if is_difference {
                            quote!(#u - #v)
                        } else {
                            quote!(#u + #v)
                        }
                    }
                }
            }
            _ => return None,
        })
    }

    /// ±cu ± v, where the products cu are computed here alone.
    fn sum_with_product(
        &mut self,
        products: Lanes<Id>,
        others: Lanes<Id>,
        [minus_product, minus_other]: [bool; 2],
    ) -> Option<TokenStream> {
        let lowered = self.scope.lowered;
        let factors = products.map(|id| match lowered.dag()[id] {
            Math::Mul([a, b]) if lowered.is_fixed(a) => Some([a, b]),
            Math::Mul([a, b]) => Some([b, a]),
            _ => None,
        });
        let factors: Vec<[Id; 2]> = factors.into_iter().collect::<Option<_>>()?;
        let side = |side: usize| -> Lanes<Id> { array::from_fn(|lane| factors[lane][side]) };
        let (c, u) = (self.fixed_values(side(0)), self.values(side(1)));
        let (c, v) = (minus(minus_product, &c), self.values(others));
        let v = minus(minus_other, &v);
        Some(quote!(dmm::series::Arithmetic::times_plus(#c, #u, #v)))
    }
}
