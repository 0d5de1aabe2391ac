//! What a declaration becomes.

use super::super::{Expression, ExpressionKind as Kind, Item};
use super::{printed, read};

/// `formula` fully parenthesised.
fn structure(formula: &str) -> String {
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
            Kind::Element { group, index } => format!("{group}<{}>", show(index)),
            Kind::If {
                condition,
                then,
                otherwise,
                ..
            } => format!(
                "if<{}{}{},{},{}>",
                show(&condition.left),
                condition.relation.symbol(),
                show(&condition.right),
                show(then),
                show(otherwise)
            ),
            Kind::Sum {
                variable,
                range,
                term,
            } => format!(
                "sum<{variable},{},{},{}>",
                show(&range.start),
                show(&range.end),
                show(term)
            ),
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
