//! Regions and their vector fields.

use super::{all, field, messages, one, read};

#[test]
fn every_state_has_one_derivative() {
    one("state x, y; der(x) = y;", "the system has no `der(y)`");
    one(
        "state x, y, z; der(x) = y;",
        "the system has no `der(y)`, `der(z)`",
    );
    one(
        "state x; der(x) = 1; der(x) = 2;",
        "`der(x)` is given twice",
    );
    one("state x; der(x) = 1; der(y) = 2;", "there is no state `y`");
    one(
        "state position; der(positon) = 2;",
        "did you mean `position`?",
    );
    one(
        "state x; param k = 1; der(x) = 1; der(k) = 2;",
        "`k` is a parameter; only states have a `der`",
    );
    one(
        "state x; der(x) = 1; der(t) = 1;",
        "`t` is the time, which needs no `der`",
    );
    one(
        "state x, y; interface g = x;
         region a where g > 0 { der(x) = y; } region b where g < 0 { der(x) = y; der(y) = 1; }",
        "the region `a` has no `der(y)`",
    );
    one(
        "state x; interface g = x; region a where g > 0 { der(x) = 1; der(x) = 2; }
         region b where g < 0 { der(x) = 1; }",
        "`der(x)` is given twice in the region `a`",
    );
    one(
        "param k = 1; const c = 1; let _a = k + c;",
        "at least one state",
    );
    let many: Vec<String> = (0..129)
        .map(|i| format!("state x{i}; der(x{i}) = 1;"))
        .collect();
    one(&many.join(" "), "129 states are too many");
}

/// A system with the interface g and these regions.
fn with_regions(regions: &str) -> String {
    format!("state x; interface wall = x; {regions}")
}

#[test]
fn a_system_is_the_same_without_an_interface_that_bounds_nothing() {
    let (model, messages) = read("system S { state x; interface wall = x; der(x) = 2*x; }");
    assert_eq!(messages.len(), 1, "{messages:?}");
    let model = model.expect("a warning is no error");
    assert!(model.interfaces.is_empty());
    assert_eq!(model.regions.len(), 1);
    assert_eq!(field(&model, 0), ["2*x"]);

    let beside = "system S {
        state x; interface none = x + 1; interface wall = x;
        region a where wall > 0 { der(x) = 1; } region b where wall < 0 { der(x) = 2; }
    }";
    let (model, messages) = read(beside);
    assert_eq!(messages.len(), 1, "{messages:?}");
    assert!(messages[0].starts_with("warning: the interface `none` bounds no region"));
    let model = model.expect("a warning is no error");
    assert_eq!(model.interfaces.len(), 1);
    assert_eq!(model.interfaces[0].ident, "wall");
    assert_eq!(model.regions[0].sides[0].interface, 0);

    let meant = "system S { state x; interface _wall = x; der(x) = 2*x; }";
    assert_eq!(read(meant).1, Vec::<String>::new());
    all(&with_regions(""), &["the system has no `der(x)`"]);
}

#[test]
fn regions_are_the_two_sides_of_the_interface() {
    let both = "region a where wall > 0 { der(x) = 1; } region b where wall < 0 { der(x) = 1; }";
    assert_eq!(messages(&with_regions(both)), Vec::<String>::new());
    for (regions, message) in [
        (
            "region a where wall > 0 { der(x) = 1; }",
            "there is no region where `wall < 0`",
        ),
        (
            "der(x) = 1;",
            "warning: the interface `wall` bounds no region",
        ),
        (
            "region a where wall > 0 { der(x) = 1; } region b where wall > 0 { der(x) = 1; }",
            "the regions `a` and `b` overlap: both are where `wall > 0`",
        ),
        (
            "region a where wall > 0 { der(x) = 1; } region a where wall < 0 { der(x) = 1; }",
            "the region `a` is declared twice",
        ),
        (
            "region low_y where wall > 0 { der(x) = 1; } region lowY where wall < 0 { der(x) = 1; }",
            "are both called `LowY`",
        ),
        (
            "region a { der(x) = 1; } region b where wall < 0 { der(x) = 1; }",
            "on which side is the region `a`?",
        ),
        (
            "region a where wal > 0 { der(x) = 1; } region b where wall < 0 { der(x) = 1; }",
            "did you mean `wall`?",
        ),
        (
            "region a where x > 0 { der(x) = 1; } region b where wall < 0 { der(x) = 1; }",
            "`x` is a state, not an interface",
        ),
        (
            "region a where wall > 0 and wall > 0 { der(x) = 1; } region b where wall < 0 { der(x) = 1; }",
            "`wall` stands twice",
        ),
        (
            "der(x) = 2; region a where wall > 0 { der(x) = 1; } region b where wall < 0 { der(x) = 1; }",
            "`der(x)` stands at the top level already, for all regions: it cannot be given again in the region `a`",
        ),
        (
            "conserved e = x; region a where wall > 0 { der(x) = 0; conserved e = t; }
             region b where wall < 0 { der(x) = 0; conserved e = t; }",
            "`e` is declared at the top level already, for all regions: it cannot be declared again in the region `a`",
        ),
    ] {
        one(&with_regions(regions), message);
    }
}

#[test]
fn regions_need_an_interface_that_can_be_crossed() {
    one(
        "state x; region a { der(x) = 1; }",
        "a region is bounded by an interface",
    );
    one(
        "state x; region a where wall > 0 { der(x) = 1; }",
        "there is no interface `wall`",
    );
    one(
        "state x; param k = 1; interface wall = k - 2;
         region a where wall > 0 { der(x) = 1; } region b where wall < 0 { der(x) = 1; }",
        "depends neither on a state nor on `t`",
    );
}

/// A system with the interfaces p, q and r and regions of these patterns.
fn with_patterns(patterns: &[&str]) -> Vec<String> {
    let region = |(number, pattern): (usize, &&str)| {
        format!("region a{number} where {pattern} {{ der(x) = 1; der(y) = 1; der(z) = 1; }}")
    };
    let regions: Vec<String> = patterns.iter().enumerate().map(region).collect();
    let interfaces = "state x, y, z; interface p = x; interface q = y; interface r = z;";
    let mut found = messages(&format!("{interfaces} {}", regions.join(" ")));
    // some of these patterns need not have all of them
    found.retain(|message| !message.starts_with("warning: "));
    found
}

#[test]
fn patterns_of_several_interfaces_cover_the_space_without_an_overlap() {
    for patterns in [
        &["p > 0", "p < 0"][..],
        &["p > 0 and q > 0", "p > 0 and q < 0", "p < 0"],
        &[
            "r < 0",
            "r > 0 and p > 0, q < 0",
            "r > 0 && p < 0",
            "p > 0 and q > 0 and r > 0",
        ],
        // none of them is on one side of another
        &[
            "p > 0, q < 0",
            "q > 0, r < 0",
            "r > 0, p < 0",
            "p > 0, q > 0, r > 0",
            "p < 0, q < 0, r < 0",
        ],
    ] {
        assert_eq!(
            with_patterns(patterns),
            Vec::<String>::new(),
            "{patterns:?}"
        );
    }
    for (patterns, message) in [
        (
            &["p > 0 and q > 0", "p < 0 and q > 0"][..],
            "there is no region where `q < 0`",
        ),
        (
            &["p > 0", "p < 0 and r > 0"],
            "there is no region where `p < 0 and r < 0`",
        ),
        (
            &["p > 0", "q < 0", "p < 0 and q > 0"],
            "`a0` and `a1` overlap: both are where `p > 0 and q < 0`",
        ),
        (
            &[
                "p > 0, q < 0",
                "q > 0, r < 0",
                "r > 0, p < 0",
                "p > 0, q > 0, r > 0",
            ],
            "there is no region where `p < 0 and q < 0 and r < 0`",
        ),
    ] {
        let found = with_patterns(patterns);
        assert!(
            found.len() == 1 && found[0].contains(message),
            "{patterns:?}: {found:#?}"
        );
    }
    let missing = with_patterns(&["p > 0 and q > 0 and r > 0"]);
    assert_eq!(missing.len(), 3, "{missing:#?}");
}

#[test]
fn a_missing_region_does_not_make_its_parameters_unused() {
    let messages = messages(
        "state x; param k_above = 1, k_below = 2; interface wall = x;
         region above where wall > 0 { der(x) = k_above; }",
    );
    assert_eq!(messages.len(), 1, "{messages:#?}");
    assert!(messages[0].contains("there is no region where `wall < 0`"));
}
