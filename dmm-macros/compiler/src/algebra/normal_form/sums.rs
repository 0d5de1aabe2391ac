//! Long sums with many denominators, by parts.
//!
//! Σ nₖ/dₖ over the common denominator of *all* terms grows beyond bounds for a chain with as
//! many denominators as bonds, although the terms of each bond cancel among themselves. So the
//! products of the sum are multiplied out as far as their factors divide, those with equal
//! denominators are added first, then those that share a factor of a denominator, and only what
//! is left of these comes over one denominator.

use std::collections::BTreeMap;

use egg::Language;

use super::super::functions::Form;
use super::super::{Dag, Id, Math};
use super::Obstacle;
use super::algebra::Algebra;
use super::denominator::Factors;
use super::form::Forms;
use super::fraction::Fraction;

/// A sum is not multiplied out to more products than this.
const MOST_PRODUCTS: usize = 4_096;

/// ± Π factors / Π divisors
#[derive(Clone, Debug, Default)]
struct Product {
    negative: bool,
    factors: Vec<Id>,
    divisors: Vec<Id>,
}

/// The normal form of `root`, which is a sum.
pub(super) fn normal_form_by_parts(
    algebra: &mut Algebra,
    dag: &Dag,
    root: Id,
) -> Result<Fraction, Obstacle> {
    let nodes = dag.reachable([root]);
    let divides = dividing(dag, &nodes);
    let products = expand(dag, root, &divides)?;
    let mut forms = Forms::new(algebra, dag);
    let mut groups: BTreeMap<Factors, Vec<Fraction>> = BTreeMap::new();
    for product in products {
        let mut form = Fraction::one();
        for &factor in &product.factors {
            let factor = forms.of(factor)?;
            form = forms.algebra().mul(&form, &factor)?;
        }
        for &divisor in &product.divisors {
            let inverse = forms.inverse_of(divisor)?;
            form = forms.algebra().mul(&form, &inverse)?;
        }
        let form = if product.negative { form.neg() } else { form };
        groups
            .entry(form.denominator.clone())
            .or_default()
            .push(form);
    }
    let algebra = forms.algebra();
    // what cancels in a group changes its denominator
    let mut parts: BTreeMap<Factors, Vec<Fraction>> = BTreeMap::new();
    for group in groups.into_values() {
        let sum = algebra.sum(group)?;
        let sum = algebra.cancel(sum);
        parts.entry(sum.denominator.clone()).or_default().push(sum);
    }
    let mut clusters: Vec<Vec<Fraction>> = Vec::new();
    for part in parts.into_values() {
        let sum = algebra.sum(part)?;
        if !sum.is_zero() {
            join(&mut clusters, sum);
        }
    }
    let mut sums = Vec::new();
    for cluster in clusters {
        let sum = algebra.sum(cluster)?;
        sums.push(algebra.cancel(sum));
    }
    algebra.sum(sums)
}

/// Puts `sum` together with the clusters that it shares a factor of its denominator with.
fn join(clusters: &mut Vec<Vec<Fraction>>, sum: Fraction) {
    let shares = |other: &Fraction| {
        let mut own = sum.denominator.iter();
        own.any(|(index, _)| other.denominator.iter().any(|(known, _)| known == index))
    };
    let (mut joined, rest): (Vec<_>, Vec<_>) = std::mem::take(clusters)
        .into_iter()
        .partition(|cluster| cluster.iter().any(shares));
    *clusters = rest;
    let mut all: Vec<Fraction> = joined.drain(..).flatten().collect();
    all.push(sum);
    clusters.push(all);
}

impl Algebra {
    /// Σ terms, in pairs of similar length.
    fn sum(&mut self, mut terms: Vec<Fraction>) -> Result<Fraction, Obstacle> {
        while terms.len() > 1 {
            let mut sums = Vec::with_capacity(terms.len().div_ceil(2));
            for pair in terms.chunks(2) {
                sums.push(match pair {
                    [a, b] => self.add(a, b)?,
                    _ => pair.first().cloned().unwrap_or_default(),
                });
            }
            terms = sums;
        }
        Ok(terms.pop().unwrap_or_default())
    }
}

/// Whether the form of a node may have a denominator, by node.
fn dividing(dag: &Dag, nodes: &[Id]) -> Vec<bool> {
    let size = nodes.last().map_or(0, |&last| usize::from(last) + 1);
    let mut divides = vec![false; size];
    for &id in nodes {
        let node = &dag[id];
        let own = match node {
            Math::Div(_) | Math::Pair(..) => true,
            Math::Pow([_, exponent]) => dag.as_integer(*exponent).is_none_or(|n| n < 0),
            Math::Call(function, _) => !matches!(
                function.properties().form,
                Form::Exponential | Form::Circular { .. } | Form::Hyperbolic { .. }
            ),
            _ => false,
        };
        let below = node.children().iter().any(|&child| is_set(&divides, child));
        if let Some(flag) = divides.get_mut(usize::from(id)) {
            *flag = own || below;
        }
    }
    divides
}

fn is_set(flags: &[bool], id: Id) -> bool {
    flags.get(usize::from(id)).copied().unwrap_or(false)
}

/// `root` as a sum of products, sums among their factors multiplied out where they divide.
fn expand(dag: &Dag, root: Id, divides: &[bool]) -> Result<Vec<Product>, Obstacle> {
    let mut done = Vec::new();
    let mut open: Vec<(Product, Vec<Id>)> = vec![(Product::default(), vec![root])];
    // a product is finished when nothing of it is left to be looked at
    while let Some((mut product, mut pending)) = open.pop() {
        let Some(id) = pending.pop() else {
            done.push(product);
            if done.len() + open.len() > MOST_PRODUCTS {
                return Err(Obstacle::TooLarge);
            }
            continue;
        };
        let is_root = product.factors.is_empty() && product.divisors.is_empty();
        match dag[id] {
            Math::Neg(u) => {
                product.negative = !product.negative;
                pending.push(u);
                open.push((product, pending));
            }
            Math::Add([u, v]) | Math::Sub([u, v])
                if is_set(divides, id) || is_root && pending.is_empty() =>
            {
                let mut second = product.clone();
                second.negative ^= matches!(dag[id], Math::Sub(_));
                let mut others = pending.clone();
                others.push(v);
                pending.push(u);
                open.push((second, others));
                open.push((product, pending));
            }
            Math::Mul([u, v]) if is_set(divides, id) => {
                pending.extend([v, u]);
                open.push((product, pending));
            }
            Math::Div([u, v]) => {
                product.divisors.push(v);
                pending.push(u);
                open.push((product, pending));
            }
            _ => {
                product.factors.push(id);
                open.push((product, pending));
            }
        }
        if open.len() > MOST_PRODUCTS {
            return Err(Obstacle::TooLarge);
        }
    }
    Ok(done)
}
