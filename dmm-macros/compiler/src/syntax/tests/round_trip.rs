//! `parse(print(declaration))` prints the same text.

use proptest::prelude::*;

use super::super::Declaration;
use super::{printed, read};

/// Every construct of the language.
pub(super) const LANGUAGE: &str = "\
/// A chain
/// of masses.
pub(crate) system Chain {
    const n = 8, half = n/2;
    state q[n], p[n], x;
    /// Position.
    state y;
    param k = 1, m[n] = 1.5, l[2] = [1, 2 * pi];
    /// Of a spring.
    fn V(r, i) = r^2 / 2 + i * m[i];
    let total = sum(i in 0..n, p[i]);
    interface wall = q[0] - x;
    discrete hits = 0;
    /// Of the wall.
    on wall falling where p[0] < 0 and hits < 3 {
        p[0] = -k * p[0];
        hits = hits + 1;
        conserves H, energy;
    }
    on wall {
    }
    every 2 * k {
        x = 0;
    }
    at 3 {
        x = 1;
    }
    hamiltonian H = sum(i in 0..n - 1, p[i]^2 / (2 * m[i]) + V(q[i + 1] - q[i], i)) in (q, p), (x, y), (q[0], p[1]);
    der(x) = -y^-2;
    region above where wall > 0 {
        let a = -(x + 1)^2^3;
        let b = 2 * if x > k { y } else if t < 3 { -abs(x) } else { max(x, y) } + 1;
        for i in 0..n {
            der(q[i]) = p[i];
            for j in i..i + 1 {
                der(p[(i + j) % n]) = -q[i] + sum(l in 0..2, sum(o in 0..l, q[l + o]));
                conserved c = q[i] * j;
                assume conserved d = q[i] * j;
            }
        }
    }
    region below where wall < 0 {
        hamiltonian H = x * y in (x, y);
        /// Not proved.
        assume conserved momentum = total - -1. / 3;
        conserved energy = H;
    }
}";

#[test]
fn every_construct() {
    let once = printed(LANGUAGE);
    assert_eq!(printed(&once), once);
    let expected = LANGUAGE
        .replace(
            "const n = 8, half = n/2;",
            "const n = 8;\n    const half = n / 2;",
        )
        .replace(
            "param k = 1, m[n] = 1.5, l[2] = [1, 2 * pi];",
            "param k = 1;\n    param m[n] = 1.5;\n    param l[2] = [1, 2 * pi];",
        );
    assert_eq!(once, expected);
}

fn name() -> impl Strategy<Value = String> {
    prop::sample::select(vec!["x", "q", "k_1", "_a", "sine", "forth", "d", "Ω"])
        .prop_map(str::to_owned)
}

fn number() -> impl Strategy<Value = String> {
    prop::sample::select(vec!["0", "12", "1.", "0.5", "1e-3", "1_0.2_5", "3E4"])
        .prop_map(str::to_owned)
}

/// A formula in any spacing: the precedence of what is joined is left to the parser.
fn formula() -> impl Strategy<Value = String> {
    prop_oneof![name(), number()].prop_recursive(5, 40, 3, |inner| {
        let operator =
            prop::sample::select(vec![" + ", "-", "*", " / ", "^", "%", " - ", " ^ ", "/"]);
        prop_oneof![
            4 => (inner.clone(), operator, inner.clone())
                .prop_map(|(left, operator, right)| format!("{left}{operator}{right}")),
            1 => inner.clone().prop_map(|operand| format!("-{operand}")),
            1 => inner.clone().prop_map(|operand| format!("( {operand})")),
            1 => (name(), inner.clone()).prop_map(|(group, index)| format!("{group} [{index}]")),
            1 => (name(), prop::collection::vec(inner.clone(), 0..3))
                .prop_map(|(function, arguments)| format!("{function}({})", arguments.join(","))),
            1 => (name(), inner.clone(), inner.clone(), inner)
                .prop_map(|(i, start, end, term)| format!("sum({i} in {start} .. {end}, {term},)")),
        ]
    })
}

fn target() -> impl Strategy<Value = String> {
    (name(), prop::option::of(formula())).prop_map(|(name, index)| match index {
        Some(index) => format!("{name}[{index}]"),
        None => name,
    })
}

/// Items of any block.
fn item() -> impl Strategy<Value = String> {
    let documentation = prop_oneof![Just(""), Just("/// What it is.\n"), Just("/// a\n/// b\n")];
    let pairs = prop::collection::vec((target(), target()), 1..3);
    let plain = prop_oneof![
        (name(), formula()).prop_map(|(name, formula)| format!("let {name}={formula};")),
        (target(), formula()).prop_map(|(target, formula)| format!("der({target})={formula};")),
        (name(), formula()).prop_map(|(name, formula)| format!("conserved {name}={formula};")),
        (name(), formula())
            .prop_map(|(name, formula)| format!("assume conserved {name} = {formula};")),
        (name(), formula(), pairs).prop_map(|(name, formula, pairs)| {
            let pairs: Vec<String> = pairs.iter().map(|(q, p)| format!("({q},{p})")).collect();
            format!("hamiltonian {name} = {formula} in {};", pairs.join(","))
        }),
    ];
    (documentation, plain).prop_map(|(documentation, item)| format!("{documentation}{item}\n"))
}

/// A loop, possibly in others.
fn repeat() -> impl Strategy<Value = String> {
    let innermost = (target(), formula())
        .prop_map(|(target, formula)| format!("der({target})={formula}; conserved a={formula};"));
    innermost.prop_recursive(3, 4, 2, |inner| {
        (name(), formula(), formula(), inner).prop_map(|(i, start, end, items)| {
            format!("for {i} in {start} .. {end} {{ {items} {items} }}\n")
        })
    })
}

/// Items of the top level.
fn top_item() -> impl Strategy<Value = String> {
    let groups = prop::collection::vec(target(), 1..4);
    let defaults = prop::collection::vec(formula(), 1..3);
    let side = prop::sample::select(vec![" x > 0", " x < 0 and y > 0.", " x<0, q<0 && z>0"]);
    prop_oneof![
        groups.prop_map(|groups| format!("state {};", groups.join(","))),
        (target(), formula(), name(), formula())
            .prop_map(|(a, one, b, two)| format!("param {a}={one}, {b}={two};")),
        (name(), defaults)
            .prop_map(|(name, all)| format!("param {name}[n] = [{},];", all.join(","))),
        (name(), formula(), formula())
            .prop_map(|(name, one, two)| format!("const {name}={one},b={two};")),
        (name(), name(), formula()).prop_map(|(f, a, body)| format!("fn {f}({a},b,)={body};")),
        (name(), formula()).prop_map(|(name, formula)| format!("interface {name} = {formula};")),
        (
            name(),
            side,
            prop::collection::vec(prop_oneof![item(), repeat()], 0..3)
        )
            .prop_map(|(name, side, items)| format!(
                "region {name} where{side} {{ {} }}",
                items.concat()
            )),
        item(),
        repeat(),
    ]
}

/// What a declaration is, and not where it stands.
fn without_places(declaration: &Declaration) -> String {
    let text = format!("{declaration:?}");
    let mut parts = text.split("bytes(");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| {
        text + part.split_once(')').map_or(part, |(_, rest)| rest)
    })
}

proptest! {
    /// The text of a declaration is the declaration: reading it again gives the same one.
    #[test]
    fn any_declaration(items in prop::collection::vec(top_item(), 0..6)) {
        let text = format!("/// S.\npub system S {{ {} }}", items.join("\n"));
        let (first, messages) = read(&text);
        prop_assert_eq!(messages, Vec::<String>::new(), "{}", text);
        let first = first.expect("no error, so a declaration");
        let printed = first.to_string();
        let (second, messages) = read(&printed);
        prop_assert_eq!(messages, Vec::<String>::new(), "{}", printed);
        let second = second.expect("no error, so a declaration");
        prop_assert_eq!(second.to_string(), printed);
        prop_assert_eq!(without_places(&first), without_places(&second));
    }
}
