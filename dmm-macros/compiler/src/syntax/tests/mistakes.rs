//! One precise message a mistake.

use super::{formula_messages, item_messages, read};

#[test]
fn one_precise_message_for_a_wrong_formula() {
    for (formula, message) in [
        ("x**2", "power is written `^`"),
        ("x.powi(2)", "power is written `^`, as in `x^2`"),
        ("(x + 1).sqrt()", "write `sqrt(x + 1)`"),
        ("x.abs()", "write `abs(x)`"),
        ("self.k", "write `k`"),
        ("x.foo()", "neither methods nor fields"),
        ("1.0f32 * x", "write `1.0`"),
        ("2x", "write `2*x`"),
        ("2 x", "missing operator"),
        ("x (x + 1) y", "missing operator"),
        ("sin x", "the argument of `sin` stands in parentheses"),
        ("f64::consts::PI", "formulas have no paths"),
        ("+x", "no unary plus"),
        ("x +", "the formula ends"),
        ("", "the formula ends"),
        ("(x +)", "the formula ends"),
        ("(x y)", "missing operator"),
        ("x > 0", "a comparison decides in a branch"),
        ("if x { 1 } else { 2 }", "expected `>` or `<`"),
        ("x, 2", "takes one definition"),
        ("\"x\"", "made of real numbers"),
        ("sin()()", "missing operator"),
    ] {
        let messages = formula_messages(formula);
        assert_eq!(messages.len(), 1, "{formula}: {messages:?}");
        assert!(messages[0].contains(message), "{formula}: {messages:?}");
    }
}

#[test]
fn one_precise_message_for_a_wrong_item() {
    for (items, message) in [
        ("der x = 1;", "write `der(x) = …;`"),
        ("der(x) == 1;", "with one `=`"),
        ("der(x) 1;", "expected `=`"),
        ("der(x, y) = 1;", "the name of one state"),
        ("der() = 1;", "the name of one state"),
        ("der(x) = 1", "a `;` is missing behind this formula"),
        ("state x", "a `;` is missing behind this"),
        ("state x y;", "expected `,` and another state"),
        (
            "state x = 1;",
            "the initial state is given to the integrator",
        ),
        ("state x: f64;", "leave out the type of `x`"),
        ("param k;", "a parameter has a default"),
        ("param k: f64 = 1;", "leave out the type of `k`"),
        ("let type = 1;", "`type` is a keyword of Rust"),
        ("state self;", "`self` is a keyword of Rust"),
        ("state _;", "`_` is not a name"),
        ("state r#in;", "raw identifiers"),
        ("state region;", "a word of the declaration language"),
        ("state 1;", "does not begin with a digit"),
        ("sate x;", "did you mean `state`?"),
        ("parameter k = 1;", "write `param`"),
        ("invariant h = 1;", "write `conserved`"),
        ("fn f() {}", "named by `let f = …;`"),
        ("k = 1;", "write `let k = …;`"),
        ("dx/dt = y;", "a derivative is written `der(x) = …;`"),
        ("interface a = x, slide;", "expected `sliding;`"),
        ("sliding { }", "in a block of its interface"),
        ("sliding a;", "in a block of its interface"),
        ("sliding a { der(x) = 0; }", "leave out this rate"),
        ("sliding a { state y; }", "belongs at the top level"),
        ("interface a = x, b = y;", "an `interface` item of its own"),
        ("conserved a = x, b = y;", "takes one definition"),
        ("region a where g >= 0 { }", "write `g > 0`"),
        ("region a where g > 1 { }", "`interface g = … - 1;`"),
        (
            "region a where g > 1 + k { }",
            "`interface g = … - (1 + k);`",
        ),
        ("region a where g == 0 { }", "one side of an interface"),
        ("region a where g { }", "expected `g > 0` or `g < 0`"),
        ("region a where 0 < g { }", "write `g > 0`"),
        (
            "region a where x + y > 0 { }",
            "declare `interface name = x + y;`",
        ),
        (
            "region a where g > 0 or h > 0 { }",
            "a region for each alternative",
        ),
        (
            "region a where g > 0 h > 0 { }",
            "expected `and` and another condition",
        ),
        ("region a where { }", "expected a condition"),
        ("region a;", "a region has a block"),
        ("region a g > 0 { }", "write `region a where wall > 0"),
        ("region a { state x; }", "belongs at the top level"),
        ("region a { der x = 1; }", "write `der(x) = …;`"),
        (
            "#[allow(dead_code)] state x;",
            "only documentation comments",
        ),
        ("#![doc = \"a\"] state x;", "in front of it"),
        ("; state x;", "expected `state`, `param`"),
        ("jump floor { v = -v; }", "states jump by `on wall falling"),
        ("reset(v) = -v;", "declared as `fn reset(…) = …;`"),
        ("reset v = -v;", "states jump by `on wall falling"),
        ("event floor = h;", "write `interface name = g;`"),
        ("slide floor;", "`interface belt = v - 1, sliding;`"),
        ("x.dot = v;", "a rate is written `der(x) = …;`"),
        ("conserved e: x^2;", "write `conserved e = …;` with `=`"),
        ("param k: 1;", "write `param k = …;` with `=`"),
        ("state y(t);", "write `state y;`"),
        ("state y(0) = 1;", "the initial state is given"),
        ("state y(3);", "declared as `y[3]`"),
        ("state (x, y);", "names stand without brackets"),
        ("state x in R;", "leave out what begins with this `in`"),
        ("state f64 x;", "without a type"),
        ("param k(t) = 1;", "`let k = …;`"),
        ("2*der(x) = 1;", "a rate stands alone on the left"),
        ("der(x) + x = 1;", "a rate stands alone on the left"),
        ("der(x) += 1;", "nothing is added up"),
        ("interface x - 1;", "write `interface name = …;`"),
        ("interface w = x > 0;", "where its formula is zero"),
        ("interface w = x = 0;", "where its formula is zero"),
        ("region x > 0 { }", "a region has a name"),
        (
            "param k = 1,5;",
            "decimals stand behind a point: write `1.5`",
        ),
        (
            "der(x) = 2*1,5*x;",
            "decimals stand behind a point: write `1.5`",
        ),
        ("-- a comment", "a comment is written `// …`"),
        ("der(x) = 1; + x;", "in front of the `;`"),
    ] {
        let messages = item_messages(items);
        assert_eq!(messages.len(), 1, "{items}: {messages:?}");
        assert!(messages[0].contains(message), "{items}: {messages:?}");
    }
}

#[test]
fn one_precise_message_for_a_wrong_head() {
    for (text, message) in [
        ("", "expected `system Name { … }`"),
        ("pub Harmonic { }", "expected `system Name { … }`"),
        ("pub", "expected `system Name { … }`"),
        ("system { }", "expected a name"),
        ("system struct { }", "keyword of Rust"),
        ("system S;", "expected `{` after `system S`"),
        (
            "system S { } system T { }",
            "one `pws!` declares one system",
        ),
        (
            "#[derive(Debug)] system S { }",
            "only documentation comments",
        ),
        ("#![allow(dead_code)] system S { }", "`///` in front"),
    ] {
        let (_, messages) = read(text);
        assert_eq!(messages.len(), 1, "{text}: {messages:?}");
        assert!(messages[0].contains(message), "{text}: {messages:?}");
    }
}

#[test]
fn every_wrong_item_is_reported_and_the_others_are_kept() {
    let (declaration, messages) = read(
        "system S {
            state x, y
            param k = 1.0f64;
            let a = (x + );
            region r where g >= 0 {
                der(x) = y
                der(y) = x**2;
                conserved e = x;
            }
            on floor falling { v = -v }
            const c = 1;
        }",
    );
    // the missing `;` behind `state x, y` loses that item alone
    let expected = [
        "a `;` is missing behind this",
        "have no type",
        "the formula ends",
        "write `g > 0`",
        "a `;` is missing behind this formula",
        "power is written",
        "a `;` is missing behind this formula",
    ];
    assert_eq!(messages.len(), expected.len(), "{messages:?}");
    for (message, expected) in messages.iter().zip(expected) {
        assert!(message.contains(expected), "{message} / {expected}");
    }
    // what is wrong is left out, but the names of states, parameters and regions are kept
    let kept = declaration.expect("the head is in order").to_string();
    let expected = "system S {
    state x, y;
    param k = 0;
    region r {
        conserved e = x;
    }
    on floor falling {
    }
    const c = 1;
}";
    assert_eq!(kept, expected);
}

#[test]
fn names_of_wrong_items_are_kept() {
    for (items, kept) in [
        ("state x = 1, y: f64, q[3], z", "state x, y, q[3], z;"),
        ("state x y, q[], z;", "state x, q, z;"),
        ("state sum, x;", "state sum, x;"),
        (
            "param k, m = 2x, c: f64 = 1, d = 4;",
            "param k = 0;\n    param m = 0;\n    param c = 0;\n    param d = 4;",
        ),
        (
            "param m = [1, 2], type = 2;",
            "param m[2] = 0;\n    param type = 2;",
        ),
        ("region a;", "region a {\n    }"),
        (
            "const a = 2x, b = 3; let c = x +, d = 4;",
            "const b = 3;\n    let d = 4;",
        ),
    ] {
        let (declaration, messages) = read(&format!("system S {{ {items} }}"));
        assert!(!messages.is_empty(), "{items}");
        let printed = declaration.expect("a head").to_string();
        assert_eq!(printed, format!("system S {{\n    {kept}\n}}"), "{items}");
    }
}

#[test]
fn one_wrong_element_of_a_list_gives_one_message() {
    for items in [
        "param m[3] = 1 2, 3, 4; state x;",
        "let y = x z, z w, u v;",
        "state x y, z;",
        "param a = 1\nparam b = 2;",
        "param a = if x > 0 { 1, } else { 2 }, b = 3;",
    ] {
        let messages = item_messages(items);
        assert_eq!(messages.len(), 1, "{items}: {messages:?}");
    }
}
