//! Input of any depth and length is refused, not overflowed.

use super::{formula_messages, item_messages};

#[test]
fn deep_and_long_formulas_are_refused_not_overflowed() {
    let deep = format!("{}x{}", "(".repeat(300), ")".repeat(300));
    assert!(formula_messages(&deep)[0].contains("nested too deeply"));
    let tower = vec!["x"; 5000].join("^");
    assert!(formula_messages(&tower)[0].contains("nested too deeply"));
    let signs = format!("{}x", "- ".repeat(5000));
    assert!(formula_messages(&signs)[0].contains("nested too deeply"));
    let long = vec!["x"; 5000].join(" + ");
    assert!(formula_messages(&long)[0].contains("too long"));
    assert_eq!(
        formula_messages(&vec!["x"; 300].join(" + ")),
        Vec::<String>::new()
    );
}

fn wrapped(open: &str, inner: &str, close: &str, times: usize) -> String {
    format!("{}{inner}{}", open.repeat(times), close.repeat(times))
}

#[test]
fn nested_indices_sums_and_calls_are_refused_not_overflowed() {
    for (open, close) in [
        ("q[", "]"),
        ("sum(i in 0..3, ", ")"),
        ("sum(i in 0..", ", 1)"),
        ("f(1, ", ")"),
        ("-(", ")"),
        ("2^(", ")"),
        ("2^-", ""),
    ] {
        let allowed = formula_messages(&wrapped(open, "x", close, 20));
        assert_eq!(allowed, Vec::<String>::new(), "{open}");
        for times in [70, 100, 5000] {
            let messages = formula_messages(&wrapped(open, "x", close, times));
            assert_eq!(messages.len(), 1, "{open} {times}");
            assert!(messages[0].contains("nested too deeply"), "{messages:?}");
        }
    }
}

#[test]
fn nested_loops_and_blocks_are_refused_not_overflowed() {
    let body = "der(q[i]) = 1;";
    let allowed = item_messages(&wrapped("for i in 0..2 { ", body, "}", 8));
    assert_eq!(allowed, Vec::<String>::new());
    for times in [9, 100, 50_000] {
        let messages = item_messages(&wrapped("for i in 0..2 { ", body, "}", times));
        assert_eq!(messages.len(), 1, "{times}");
        assert!(messages[0].contains("nested too deeply"), "{messages:?}");
    }
    for (open, close) in [("{", "}"), ("(", ")"), ("[", "]"), ("region a {", "}")] {
        let messages = item_messages(&wrapped(open, "", close, 50_000));
        assert_eq!(messages.len(), 1, "{open}");
        assert!(messages[0].contains("nested too deeply"), "{messages:?}");
    }
}

#[test]
fn long_numbers_are_refused_before_they_are_read() {
    for number in ["7".repeat(100_000), format!("0.{}", "7".repeat(100_000))] {
        let messages = formula_messages(&number);
        assert_eq!(messages.len(), 1, "{messages:?}");
        assert!(messages[0].contains("digits"), "{messages:?}");
    }
    let tiny = format!("0.{}1", "0".repeat(1_000));
    assert_eq!(formula_messages(&tiny), Vec::<String>::new());
}
