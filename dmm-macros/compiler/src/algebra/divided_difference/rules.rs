//! The table of rules: node → its children with their weights wᵢ in Δu = Σ wᵢ Δuᵢ.

use super::super::functions::Difference;
use super::super::{Function, Id, Math, PairFunction};
use super::chain::{Step, Weight};
use super::powers::{power_weight, rational_power_weight, small_fraction};

impl Step<'_> {
    /// The rule of the node `id`: its varying children with their weights.
    pub(super) fn weights(&mut self, id: Id) -> Vec<(Id, Weight)> {
        let rules = match self.dag[id].clone() {
            Math::Pi | Math::Constant(_) | Math::Variable(_) => Vec::new(),
            Math::Neg(u) => {
                let minus_one = self.dag.integer(-1);
                vec![(u, Weight::factor(minus_one))]
            }
            Math::Add([u, v]) => {
                let one = self.dag.integer(1);
                vec![(u, Weight::factor(one)), (v, Weight::factor(one))]
            }
            Math::Sub([u, v]) => {
                let [one, minus_one] = [self.dag.integer(1), self.dag.integer(-1)];
                vec![(u, Weight::factor(one)), (v, Weight::factor(minus_one))]
            }
            Math::Mul([u, v]) => {
                let [u_mean, v_mean] = [self.mean(u), self.mean(v)];
                vec![(u, Weight::factor(v_mean)), (v, Weight::factor(u_mean))]
            }
            Math::Div([u, v]) => self.quotient(u, v),
            Math::Pow([u, v]) => self.power(u, v),
            Math::Call(function, u) => vec![(u, self.call(function, u))],
            // expanded into quotients before
            Math::Pair(..) => Vec::new(),
        };
        rules
            .into_iter()
            .filter(|(child, _)| self.ends.vary(*child))
            .collect()
    }

    /// Δ(u/v) = (v̄ Δu − ū Δv)/(v₀v₁)
    fn quotient(&mut self, u: Id, v: Id) -> Vec<(Id, Weight)> {
        let one = self.dag.integer(1);
        if !self.ends.vary(v) {
            return vec![(u, Weight::quotient(one, v))];
        }
        let [start, end] = self.ends.of(v);
        let divisor = self.dag.mul(end, start);
        let [u_mean, v_mean] = [self.mean(u), self.mean(v)];
        let u_mean = self.dag.neg(u_mean);
        vec![
            (u, Weight::quotient(v_mean, divisor)),
            (v, Weight::quotient(u_mean, divisor)),
        ]
    }

    fn power(&mut self, u: Id, v: Id) -> Vec<(Id, Weight)> {
        let [start, end] = self.ends.of(u);
        if let Some(n) = self.dag.as_integer(v) {
            return vec![(u, power_weight(self.dag, [start, end], n))];
        }
        if let Some((p, q)) = small_fraction(self.dag, v) {
            return vec![(u, rational_power_weight(self.dag, [start, end], p, q))];
        }
        self.general_power(u, v)
    }

    /// u^v = exp w, w = v ln u: Δw = v̄ Δ(ln u) + (mean of ln u) Δv, Δ(ln u) = ln_dd Δu.
    fn general_power(&mut self, u: Id, v: Id) -> Vec<(Id, Weight)> {
        let [u_start, u_end] = self.ends.of(u);
        let [v_start, v_end] = self.ends.of(v);
        let [ln_start, ln_end] = [u_start, u_end].map(|u| self.dag.call(Function::Ln, u));
        let v_mean = self.mean(v);
        let (u_weight, u_part) = if self.ends.vary(u) {
            let ln_dd = self.pair(PairFunction::LnDd, u);
            let weight = self.dag.mul(v_mean, ln_dd);
            let difference = self.difference(u);
            (weight, self.dag.mul(weight, difference))
        } else {
            let zero = self.dag.integer(0);
            (zero, zero)
        };
        let ln_mean = self.dag.mean(ln_end, ln_start);
        let v_difference = self.difference(v);
        let v_part = self.dag.mul(ln_mean, v_difference);
        let difference = self.dag.add(u_part, v_part);
        let mean = if self.ends.vary(v) {
            let end = self.dag.mul(v_end, ln_end);
            let start = self.dag.mul(v_start, ln_start);
            self.dag.mean(end, start)
        } else {
            self.dag.mul(v, ln_mean)
        };
        let half = self.dag.fraction(1, 2);
        let half_difference = self.dag.mul(half, difference);
        let exp = self.dag.call(Function::Exp, mean);
        let sinhc = self.dag.call(Function::Sinhc, half_difference);
        let outer = self.dag.mul(exp, sinhc);
        [(u, u_weight), (v, ln_mean)]
            .map(|(child, weight)| (child, Weight::factor(self.dag.mul(outer, weight))))
            .into()
    }

    fn call(&mut self, function: Function, u: Id) -> Weight {
        match function.properties().difference {
            Difference::AtMean([outer, cardinal]) => self.at_mean(outer, cardinal, u),
            Difference::MinusAtMean([outer, cardinal]) => {
                let weight = self.at_mean(outer, cardinal, u);
                weight.negated(self.dag)
            }
            Difference::AtEnds([outer, cardinal]) => self.at_ends(outer, cardinal, u),
            Difference::Pair(function) => Weight::factor(self.pair(function, u)),
            Difference::MinusPair(function) => {
                let weight = Weight::factor(self.pair(function, u));
                weight.negated(self.dag)
            }
            Difference::Quotient(quotient) => {
                let [factor, divisor] = quotient(self.dag, self.ends.of(u));
                Weight::quotient(factor, divisor)
            }
            // its definition took its place before
            Difference::Definition(_) => Weight::factor(self.dag.integer(1)),
        }
    }

    /// h\[u₀, u₁\]
    fn pair(&mut self, function: PairFunction, u: Id) -> Id {
        let [start, end] = self.ends.of(u);
        self.dag.pair(function, start, end)
    }

    /// `outer`(ū)·`cardinal`(Δu/2)
    fn at_mean(&mut self, outer: Function, cardinal: Function, u: Id) -> Weight {
        let mean = self.mean(u);
        let half_difference = self.half_difference(u);
        let outer = self.dag.call(outer, mean);
        let cardinal = self.dag.call(cardinal, half_difference);
        Weight::factor(self.dag.mul(outer, cardinal))
    }

    /// (`cardinal`(Δu)/`outer`(u₀))/`outer`(u₁): divided twice, because the product of two
    /// large values of cosh would overflow first.
    fn at_ends(&mut self, outer: Function, cardinal: Function, u: Id) -> Weight {
        let difference = self.difference(u);
        let cardinal = self.dag.call(cardinal, difference);
        let [start, end] = self.ends.of(u).map(|u| self.dag.call(outer, u));
        let quotient = self.dag.div(cardinal, start);
        Weight::quotient(quotient, end)
    }
}
