//! Intervals contain the values that they enclose, and exact values are exact.

use std::collections::BTreeMap;

use proptest::prelude::*;

use super::formula::formula;
use super::random::{build, point, recipe, values};
use crate::algebra::evaluate::{Interval, enclose, evaluate_exactly};
use crate::algebra::{Dag, Name, Rational, evaluate_bounded};

fn range(text: &str) -> Interval {
    let mut dag = Dag::new();
    let root = formula(&mut dag, text);
    enclose(&dag, &[root], &BTreeMap::new())[0]
}

#[test]
fn signs_that_hold_everywhere_are_known() {
    for text in [
        "x^2 + 1",
        "exp(x)",
        "cosh(x) + y^4",
        "2 + sin(x)*cos(y)",
        "exp(x)/(1 + y^2)",
        "sqrt(x^2 + y^2) + 1/2",
        "(1 + x^2)^(3/2)",
        "pi - 3",
    ] {
        assert!(range(text).is_positive(), "{text}");
    }
    for text in [
        "x^2 + y^2",
        "x^2*y^4",
        "sqrt(x)",
        "abs(x)",
        "1 - tanh(x)",
        "acos(x)",
        "x^(1/3)",
    ] {
        assert!(
            range(text).is_not_negative() && !range(text).is_positive(),
            "{text}"
        );
    }
    for text in ["-1 - x^2", "-exp(-x)", "-2 + tanh(x)"] {
        assert!(range(text).is_negative(), "{text}");
    }
    for text in ["x", "x^3", "sin(x)", "x^2 - y^2", "ln(x)", "x*y", "1 - x^2"] {
        assert!(
            !range(text).is_not_negative() && !range(text).nonzero,
            "{text}"
        );
    }
    assert!(range("1/x").nonzero && !range("1/x").defined);
    assert!(range("1/(1 + x^2)").defined);
    assert!(!range("ln(x)").defined && !range("asin(x)").defined);
}

#[test]
fn exact_values() {
    let point: BTreeMap<Name, Rational> = [("x", (1, 3)), ("y", (-2, 7))]
        .into_iter()
        .map(|(name, (n, d))| (Name::new(name), Rational::new(n.into(), d.into())))
        .collect();
    for (text, expected) in [
        ("x + y", Some((1, 21))),
        ("x^2/y - 1", Some((-25, 18))),
        ("(x - 1/3)^3", Some((0, 1))),
        ("1/(x - 1/3)", None),
        ("sqrt(x)", None),
        ("x + z", None),
        ("x^(-2)", Some((9, 1))),
        ("(x + y)^100000", None),
    ] {
        let mut dag = Dag::new();
        let root = formula(&mut dag, text);
        let expected = expected.map(|(n, d)| Rational::new(i64::into(n), i64::into(d)));
        assert_eq!(evaluate_exactly(&dag, root, &point), expected, "{text}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// The floating-point value differs from the exact one by its own error bound at most.
    #[test]
    fn intervals_contain_values(recipe in recipe(5), point in point()) {
        let mut dag = Dag::new();
        let root = build(&mut dag, &recipe);
        let values = values(&point);
        let (value, error) = evaluate_bounded(&dag, &[root], &values)[0];
        let at_the_point = enclose(&dag, &[root], &values)[0];
        let everywhere = enclose(&dag, &[root], &BTreeMap::new())[0];
        for interval in [at_the_point, everywhere] {
            prop_assert!(!interval.low.is_nan() && !interval.high.is_nan());
            if value.is_finite() && error.is_finite() {
                let margin = 16.0 * error + f64::MIN_POSITIVE;
                prop_assert!(interval.low <= value + margin, "{interval:?}, {value}");
                prop_assert!(interval.high >= value - margin, "{interval:?}, {value}");
            }
        }
    }
}
