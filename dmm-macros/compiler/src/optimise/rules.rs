//! The rules of saturation: identities of real arithmetic that hold wherever both sides have a
//! value, and that keep the rounding error of a sum within a small multiple of ε Σ|terms|.
//!
//! Nothing is distributed (a·(b − c) has an error that a·b − a·c has not), nothing is
//! cancelled (a·b/b has another domain than a), and no function is expanded (sinc u is not
//! sin u/u). A difference of two exact numbers, such as x₁ − x₀, loses nothing to rounding
//! where they are close: no rule takes it apart.

use std::sync::LazyLock;

use egg::{Id, Rewrite, Subst, Var, rewrite};
use num_traits::One;

use super::graph::{Facts, Graph};
use crate::algebra::Math;

/// A rewrite rule.
pub(super) type Rule = Rewrite<Math, Facts>;

/// Every rule, compiled once.
pub(super) static RULES: LazyLock<Vec<Rule>> = LazyLock::new(rules);

#[rustfmt::skip]
fn rules() -> Vec<Rule> {
    vec![
        rewrite!("commute-sum";            "(+ ?a ?b)"             => "(+ ?b ?a)" if varies),
        rewrite!("commute-product";        "(* ?a ?b)"             => "(* ?b ?a)" if varies),
        rewrite!("associate-sum";          "(+ (+ ?a ?b) ?c)"      => "(+ ?a (+ ?b ?c))" if is_no_difference("?a", "?b")),
        rewrite!("associate-product";      "(* (* ?a ?b) ?c)"      => "(* ?a (* ?b ?c))" if varies),
        rewrite!("add-difference";         "(+ ?a (- ?b ?c))"      => "(- (+ ?a ?b) ?c)" if is_loose("?b", "?c")),
        rewrite!("subtract-from-sum";      "(- (+ ?a ?b) ?c)"      => "(+ ?a (- ?b ?c))" if is_no_difference("?a", "?b")),
        rewrite!("subtract-from-difference"; "(- (- ?a ?b) ?c)"    => "(- ?a (+ ?b ?c))" if is_loose("?a", "?b")),
        rewrite!("subtract-sum";           "(- ?a (+ ?b ?c))"      => "(- (- ?a ?b) ?c)" if is_no_difference("?b", "?c")),
        rewrite!("subtract-difference";    "(- ?a (- ?b ?c))"      => "(- (+ ?a ?c) ?b)" if is_loose("?b", "?c")),
        rewrite!("negate-difference";      "(neg (- ?a ?b))"       => "(- ?b ?a)"),
        rewrite!("negate-sum";             "(neg (+ ?a ?b))"       => "(- (neg ?a) ?b)"),
        rewrite!("add-negative";           "(+ ?a (neg ?b))"       => "(- ?a ?b)"),
        rewrite!("subtract-negative";      "(- ?a (neg ?b))"       => "(+ ?a ?b)"),
        rewrite!("subtract-from-negative"; "(- (neg ?a) ?b)"       => "(neg (+ ?a ?b))"),
        rewrite!("negate-twice";           "(neg (neg ?a))"        => "?a"),
        rewrite!("negate-factor";          "(* (neg ?a) ?b)"       => "(neg (* ?a ?b))"),
        rewrite!("negate-product";         "(neg (* ?a ?b))"       => "(* (neg ?a) ?b)"),
        rewrite!("negate-numerator";       "(/ (neg ?a) ?b)"       => "(neg (/ ?a ?b))"),
        rewrite!("negate-denominator";     "(/ ?a (neg ?b))"       => "(neg (/ ?a ?b))"),
        rewrite!("factor-sum";             "(+ (* ?a ?b) (* ?a ?c))" => "(* ?a (+ ?b ?c))"),
        rewrite!("factor-difference";      "(- (* ?a ?b) (* ?a ?c))" => "(* ?a (- ?b ?c))"),
        rewrite!("collect";                "(+ ?a (* ?c ?a))"      => "(* (+ ?c 1) ?a)" if is_constant("?c")),
        rewrite!("double";                 "(+ ?a ?a)"             => "(* 2 ?a)"),
        rewrite!("halve";                  "(* 2 ?a)"              => "(+ ?a ?a)"),
        rewrite!("quarter";                "(* 1/4 (* ?a ?b))"     => "(* (* 1/2 ?a) (* 1/2 ?b))"),
        rewrite!("multiply-quotient";      "(* ?a (/ ?b ?c))"      => "(/ (* ?a ?b) ?c)"),
        rewrite!("divide-product";         "(/ (* ?a ?b) ?c)"      => "(* ?a (/ ?b ?c))"),
        rewrite!("divide-quotient";        "(/ (/ ?a ?b) ?c)"      => "(/ ?a (* ?b ?c))"),
        rewrite!("divide-by-product";      "(/ ?a (* ?b ?c))"      => "(/ (/ ?a ?b) ?c)"),
        rewrite!("divide-by-quotient";     "(/ ?a (/ ?b ?c))"      => "(/ (* ?a ?c) ?b)"),
        rewrite!("add-quotients";          "(+ (/ ?a ?c) (/ ?b ?c))" => "(/ (+ ?a ?b) ?c)"),
        rewrite!("subtract-quotients";     "(- (/ ?a ?c) (/ ?b ?c))" => "(/ (- ?a ?b) ?c)"),
        rewrite!("reciprocal";             "(/ ?a ?b)"             => "(* ?a (/ 1 ?b))" if is_varying("?a", "?b")),
        rewrite!("square-root";            "(* (sqrt ?a) (sqrt ?a))" => "?a" if is_not_negative("?a")),
        rewrite!("one-times";              "(* 1 ?a)"              => "?a"),
        rewrite!("over-one";               "(/ ?a 1)"              => "?a"),
    ]
}

fn var(name: &str) -> Var {
    name.parse().expect("a pattern variable")
}

/// Whether an expression depends on more than parameters; what does not is computed once a
/// flow, in whatever form.
fn varies(graph: &mut Graph, class: Id, _: &Subst) -> bool {
    !graph[class].data.fixed
}

/// Whether a − b is not a difference of exact numbers.
fn is_loose(a: &str, b: &str) -> impl Fn(&mut Graph, Id, &Subst) -> bool + use<> {
    let (a, b) = (var(a), var(b));
    move |graph, _, subst| !(graph[subst[a]].data.exact && graph[subst[b]].data.exact)
}

/// Whether a + b is not such a difference, by the sign of one of them.
fn is_no_difference(a: &str, b: &str) -> impl Fn(&mut Graph, Id, &Subst) -> bool + use<> {
    let (a, b) = (var(a), var(b));
    move |graph, _, subst| {
        let (a, b) = (&graph[subst[a]], &graph[subst[b]]);
        let negative =
            |class: &egg::EClass<Math, _>| class.iter().any(|node| matches!(node, Math::Neg(_)));
        !(a.data.exact && b.data.exact && (negative(a) || negative(b)))
    }
}

fn is_constant(a: &str) -> impl Fn(&mut Graph, Id, &Subst) -> bool + use<> {
    let a = var(a);
    move |graph, _, subst| graph[subst[a]].data.constant.is_some()
}

/// Whether a/b is worth a reciprocal: a is not 1, and b is not a constant, whose reciprocal
/// would be rounded.
fn is_varying(a: &str, b: &str) -> impl Fn(&mut Graph, Id, &Subst) -> bool + use<> {
    let (a, b) = (var(a), var(b));
    move |graph, _, subst| {
        let is_one = |value: &crate::algebra::Rational| value.is_one();
        !graph[subst[a]].data.constant.as_ref().is_some_and(is_one)
            && graph[subst[b]].data.constant.is_none()
    }
}

fn is_not_negative(a: &str) -> impl Fn(&mut Graph, Id, &Subst) -> bool + use<> {
    let a = var(a);
    move |graph, _, subst| graph[subst[a]].data.not_negative
}
