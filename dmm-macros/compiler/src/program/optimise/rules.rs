//! The rules of saturation: identities of real arithmetic that hold wherever both sides have a
//! value, and that keep the rounding error of a sum within a small multiple of ε Σ|terms|.
//!
//! Nothing is distributed (a·(b − c) has an error that a·b − a·c has not), nothing is
//! cancelled (a·b/b has another domain than a), and no function is expanded (sinc u is not
//! sin u/u). A difference of two exact numbers, such as x₁ − x₀, loses nothing to rounding
//! where they are close: no rule takes it apart.
//!
//! Sums and products have no order: a rule holds for its patterns with the operands of either
//! exchanged.

use std::sync::LazyLock;

use egg::{Pattern, PatternAst};

use super::constants::ONE;
use super::operation::Symbol;
use super::pattern::{Match, Search, Steps};
use super::snapshot::Snapshot;
use crate::algebra::Math;

/// A rule: what a pattern matches is equal to the other side, on a condition.
pub(super) struct Rule {
    /// What it is called.
    #[cfg_attr(
        not(test),
        expect(dead_code, reason = "tests name the rule that fails")
    )]
    pub(super) name: &'static str,
    /// Both sides as they are written.
    #[cfg_attr(not(test), expect(dead_code, reason = "tests evaluate both sides"))]
    pub(super) sides: [PatternAst<Math>; 2],
    /// Finds the left side.
    pub(super) search: Search,
    /// Makes the right side.
    pub(super) steps: Steps,
    /// What has to be known of what was found.
    pub(super) condition: Condition,
}

/// What has to be known of the classes that variables stand for.
#[derive(Debug, Clone, Copy)]
pub(super) enum Condition {
    Always,
    /// The whole depends on more than parameters; what does not is stored, in whatever
    /// form.
    Varies,
    /// a − b is not a difference of exact numbers.
    Loose(usize, usize),
    /// a + b is not such a difference, by the sign of one of them.
    NoDifference(usize, usize),
    /// a is a number.
    Constant(usize),
    /// a/b is worth a reciprocal: a is not 1, and b is not a number, whose reciprocal would be
    /// rounded.
    Varying(usize, usize),
    /// a is not negative.
    NotNegative(usize),
}
use Condition::*;

// pattern variables
const A: usize = 0;
const B: usize = 1;
const C: usize = 2;

/// Every rule, compiled once.
pub(super) static RULES: LazyLock<Vec<Rule>> = LazyLock::new(rules);

#[rustfmt::skip]
fn rules() -> Vec<Rule> {
    vec![
        rule("associate-sum",             "(+ (+ ?a ?b) ?c)",          "(+ ?a (+ ?b ?c))",              NoDifference(A, B)),
        rule("associate-product",         "(* (* ?a ?b) ?c)",          "(* ?a (* ?b ?c))",              Varies),
        rule("add-difference",            "(+ ?a (- ?b ?c))",          "(- (+ ?a ?b) ?c)",              Loose(B, C)),
        rule("subtract-from-sum",         "(- (+ ?a ?b) ?c)",          "(+ ?a (- ?b ?c))",              NoDifference(A, B)),
        rule("subtract-from-difference",  "(- (- ?a ?b) ?c)",          "(- ?a (+ ?b ?c))",              Loose(A, B)),
        rule("subtract-sum",              "(- ?a (+ ?b ?c))",          "(- (- ?a ?b) ?c)",              NoDifference(B, C)),
        rule("subtract-difference",       "(- ?a (- ?b ?c))",          "(- (+ ?a ?c) ?b)",              Loose(B, C)),
        rule("negate-difference",         "(neg (- ?a ?b))",           "(- ?b ?a)",                     Always),
        rule("negate-sum",                "(neg (+ ?a ?b))",           "(- (neg ?a) ?b)",               Always),
        rule("add-negative",              "(+ ?a (neg ?b))",           "(- ?a ?b)",                     Always),
        rule("subtract-negative",         "(- ?a (neg ?b))",           "(+ ?a ?b)",                     Always),
        rule("subtract-from-negative",    "(- (neg ?a) ?b)",           "(neg (+ ?a ?b))",               Always),
        rule("negate-twice",              "(neg (neg ?a))",            "?a",                            Always),
        rule("negate-factor",             "(* (neg ?a) ?b)",           "(neg (* ?a ?b))",               Always),
        rule("negate-product",            "(neg (* ?a ?b))",           "(* (neg ?a) ?b)",               Always),
        rule("negate-numerator",          "(/ (neg ?a) ?b)",           "(neg (/ ?a ?b))",               Always),
        rule("negate-denominator",        "(/ ?a (neg ?b))",           "(neg (/ ?a ?b))",               Always),
        rule("factor-sum",                "(+ (* ?a ?b) (* ?a ?c))",   "(* ?a (+ ?b ?c))",              Always),
        rule("factor-difference",         "(- (* ?a ?b) (* ?a ?c))",   "(* ?a (- ?b ?c))",              Always),
        rule("collect",                   "(+ ?a (* ?c ?a))",          "(* (+ ?c 1) ?a)",               Constant(C)),
        rule("double",                    "(+ ?a ?a)",                 "(* 2 ?a)",                      Always),
        rule("halve",                     "(* 2 ?a)",                  "(+ ?a ?a)",                     Always),
        rule("quarter",                   "(* 1/4 (* ?a ?b))",         "(* (* 1/2 ?a) (* 1/2 ?b))",     Always),
        rule("multiply-quotient",         "(* ?a (/ ?b ?c))",          "(/ (* ?a ?b) ?c)",              Always),
        rule("divide-product",            "(/ (* ?a ?b) ?c)",          "(* ?a (/ ?b ?c))",              Always),
        rule("divide-quotient",           "(/ (/ ?a ?b) ?c)",          "(/ ?a (* ?b ?c))",              Always),
        rule("divide-by-product",         "(/ ?a (* ?b ?c))",          "(/ (/ ?a ?b) ?c)",              Always),
        rule("divide-by-quotient",        "(/ ?a (/ ?b ?c))",          "(/ (* ?a ?c) ?b)",              Always),
        rule("add-quotients",             "(+ (/ ?a ?c) (/ ?b ?c))",   "(/ (+ ?a ?b) ?c)",              Always),
        rule("subtract-quotients",        "(- (/ ?a ?c) (/ ?b ?c))",   "(/ (- ?a ?b) ?c)",              Always),
        rule("reciprocal",                "(/ ?a ?b)",                 "(* ?a (/ 1 ?b))",               Varying(A, B)),
        rule("square-root",               "(* (sqrt ?a) (sqrt ?a))",   "?a",                            NotNegative(A)),
        rule("one-times",                 "(* 1 ?a)",                  "?a",                            Always),
        rule("over-one",                  "(/ ?a 1)",                  "?a",                            Always),
    ]
}

fn rule(name: &'static str, left: &'static str, right: &'static str, condition: Condition) -> Rule {
    let [left, right] = [left, right].map(|side| {
        let pattern: Pattern<Math> = side.parse().expect("a pattern");
        pattern.ast
    });
    Rule {
        name,
        search: Search::new(&left),
        steps: Steps::new(&right),
        condition,
        sides: [left, right],
    }
}

impl Condition {
    /// Whether it holds for a match.
    pub(super) fn holds(self, classes: &Snapshot, found: &Match) -> bool {
        let of = |variable: usize| classes.known(found.variables[variable]);
        let negative = |variable: usize| classes.has(found.variables[variable], Symbol::Neg);
        match self {
            Always => true,
            Varies => !classes.known(found.class).fixed,
            Loose(a, b) => !(of(a).exact && of(b).exact),
            NoDifference(a, b) => !(of(a).exact && of(b).exact && (negative(a) || negative(b))),
            Constant(a) => of(a).constant.is_some(),
            Varying(a, b) => of(a).constant != Some(ONE) && of(b).constant.is_none(),
            NotNegative(a) => of(a).not_negative,
        }
    }
}
