//! What parses, how it is printed, and what is said about what does not parse.

use proc_macro2::TokenStream;

use super::{Declaration, Item, parse};
use crate::diagnostics::Diagnostics;

fn read(text: &str) -> (Option<Declaration>, Vec<String>) {
    let tokens: TokenStream = text.parse().expect("the test's text is made of tokens");
    let mut diagnostics = Diagnostics::new();
    let declaration = parse(tokens, &mut diagnostics);
    (declaration, diagnostics.messages())
}

fn printed(text: &str) -> String {
    let (declaration, messages) = read(text);
    assert_eq!(messages, Vec::<String>::new(), "{text}");
    declaration.expect("no error, so a declaration").to_string()
}

/// The messages on `der(x) = formula;`.
fn formula_messages(formula: &str) -> Vec<String> {
    read(&format!("system S {{ state x; der(x) = {formula}; }}")).1
}

fn item_messages(items: &str) -> Vec<String> {
    read(&format!("system S {{ {items} }}")).1
}

/// `formula` fully parenthesised.
fn structure(formula: &str) -> String {
    use super::{Expression, ExpressionKind as Kind};
    fn show(expression: &Expression) -> String {
        match &expression.kind {
            Kind::Number { text, .. } => text.clone(),
            Kind::Name(ident) => ident.to_string(),
            Kind::Call {
                function,
                arguments,
            } => {
                let arguments: Vec<String> = arguments.iter().map(show).collect();
                format!("{function}<{}>", arguments.join(","))
            }
            Kind::Negative(operand) => format!("[-{}]", show(operand)),
            Kind::Binary {
                operator,
                left,
                right,
            } => format!("[{}{}{}]", show(left), operator.symbol(), show(right)),
            Kind::Parenthesised(inner) => show(inner),
        }
    }
    let (declaration, messages) = read(&format!("system S {{ let a = {formula}; }}"));
    assert_eq!(messages, Vec::<String>::new(), "{formula}");
    match declaration.expect("a declaration").items.as_slice() {
        [Item::Let(definition)] => show(&definition.formula),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_declaration_prints_as_written() {
    let text = "\
/// Oscillator whose spring stiffens below y = 0.
pub system Harmonic {
    state x, y;
    /// Stiffness above.
    param k_above = 1.0;
    param k_below = 3;
    const c = 3/2;
    let r = sqrt(x^2 + y^2);
    interface spring = y;
    region above where spring > 0 {
        der(x) = y;
        der(y) = -k_above * x;
        /// Twice the kinetic energy and so on.
        conserved energy = (y^2 + k_above * x^2) / 2;
    }
    region below where spring < 0 {
        let q = x;
        der(x) = y;
        der(y) = -k_below * q * c / (r / r);
    }
}";
    assert_eq!(printed(text), text);
    let lists = "system  S{state x,y,;param/**A*/k=1 , m=2*pi;der(x)=-y ^-2;}";
    assert_eq!(
        printed(lists),
        "system S {\n    state x, y;\n    /// A\n    param k = 1;\n    param m = 2 * pi;\n    der(x) = -y^-2;\n}"
    );
}

#[test]
fn several_interfaces_parse() {
    let text = "\
system S {
    interface a = x;
    interface b = y;
    region both where a > 0 and b < 0 {
    }
    region other where a < 0 and b < 0 {
    }
}";
    let commas = text
        .replace("> 0 and", "> 0,")
        .replace("< 0 and", "< 0.0 &&");
    assert_eq!(printed(&commas), text);
}

#[test]
fn precedence() {
    for (formula, expected) in [
        ("a+b*c", "[a+[b*c]]"),
        ("a-b-c", "[[a-b]-c]"),
        ("a/b/c", "[[a/b]/c]"),
        ("a/b*c", "[[a/b]*c]"),
        ("a^b^c", "[a^[b^c]]"),
        ("-a^2", "[-[a^2]]"),
        ("(-a)^2", "[[-a]^2]"),
        ("2^-1", "[2^[-1]]"),
        ("2^-1^2", "[2^[-[1^2]]]"),
        ("2^--a", "[2^[-[-a]]]"),
        ("a^b*c", "[[a^b]*c]"),
        ("-a*b", "[[-a]*b]"),
        ("a*-b", "[a*[-b]]"),
        ("a - -b", "[a-[-b]]"),
        ("sin(a+b)^2", "[sin<[a+b]>^2]"),
        ("f(a, b, )", "f<a,b>"),
        ("-(a+b)*c", "[[-[a+b]]*c]"),
    ] {
        assert_eq!(structure(formula), expected, "{formula}");
    }
}

#[test]
fn one_precise_message_for_a_wrong_formula() {
    for (formula, message) in [
        ("x**2", "power is written `^`"),
        ("x.powi(2)", "power is written `^`, as in `x^2`"),
        ("(x + 1).sqrt()", "write `sqrt(x + 1)`"),
        ("x.abs()", "`abs` is not smooth"),
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
        ("x % 2", "remainder"),
        ("x > 0", "no comparisons"),
        ("if x { 1 } else { 2 }", "no branches"),
        ("x, 2", "takes one definition"),
        ("\"x\"", "expected a number"),
        ("sin()()", "missing operator"),
    ] {
        let messages = formula_messages(formula);
        assert_eq!(messages.len(), 1, "{formula}: {messages:?}");
        assert!(messages[0].contains(message), "{formula}: {messages:?}");
    }
}

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

#[test]
fn one_precise_message_for_a_wrong_item() {
    for (items, message) in [
        ("der x = 1;", "write `der(x) = …;`"),
        ("der(x) == 1;", "with one `=`"),
        ("der(x) 1;", "expected `=`"),
        ("der(x, y) = 1;", "the name of one state"),
        ("der() = 1;", "expected a name"),
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
        ("state 1;", "expected a name"),
        ("sate x;", "did you mean `state`?"),
        ("parameter k = 1;", "write `param`"),
        ("invariant h = 1;", "write `conserved`"),
        ("fn f() {}", "unknown item `fn`"),
        ("k = 1;", "write `let k = …;`"),
        ("dx/dt = y;", "a derivative is written `der(x) = …;`"),
        (
            "on floor falling { v = -e * v; }",
            "state jumps (`on`) are not supported yet",
        ),
        ("interface a = x, sliding;", "sliding is not supported yet"),
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
        ("region a g > 0 { }", "expected `where …`"),
        ("region a { state x; }", "belongs at the top level"),
        ("region a { der x = 1; }", "write `der(x) = …;`"),
        (
            "#[allow(dead_code)] state x;",
            "only documentation comments",
        ),
        ("#![doc = \"a\"] state x;", "in front of it"),
        ("; state x;", "expected `state`, `param`"),
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
            on floor falling { v = -v; }
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
        "state jumps",
    ];
    assert_eq!(messages.len(), expected.len(), "{messages:?}");
    for (message, expected) in messages.iter().zip(expected) {
        assert!(message.contains(expected), "{message} / {expected}");
    }
    let items = declaration.expect("the head is in order").items;
    assert!(
        matches!(items.as_slice(), [Item::Region(region), Item::Constant(_)]
        if region.items.len() == 1)
    );
}
