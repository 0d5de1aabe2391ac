//! Token streams out of nothing: soups of words, nested delimiters, and systems that are well
//! formed and have random formulas.

use super::random::Random;
use super::vocabulary::{LITERALS, SIGNS, WORDS};

/// Variables of the systems with random formulas.
const VARIABLES: [&str; 4] = ["x", "y", "k", "t"];
/// Functions of the language.
const FUNCTIONS: [&str; 12] = [
    "sin", "cos", "tan", "sinh", "cosh", "tanh", "asin", "acos", "atan", "exp", "ln", "sqrt",
];

/// Tokens in no order, half of the time in the body of a system.
pub(crate) fn soup(random: &mut Random) -> String {
    let length = 1 + random.below(60);
    let tokens = stream(random, length, 0);
    if random.once_in(2) {
        tokens
    } else {
        format!("system S {{ {tokens} }}")
    }
}

fn stream(random: &mut Random, length: usize, depth: usize) -> String {
    let mut text = String::new();
    for _ in 0..length {
        let token = match random.below(12) {
            0..=4 => random.pick(WORDS).to_owned(),
            5..=7 => random.pick(SIGNS).to_owned(),
            8 | 9 => random.pick(LITERALS).to_owned(),
            10 => word(random),
            _ if depth < 6 => {
                let [open, close] = random.pick(&[&["(", ")"], &["[", "]"], &["{", "}"]]);
                let length = random.below(8);
                format!("{open}{}{close}", stream(random, length, depth + 1))
            }
            _ => ";".to_owned(),
        };
        text.push_str(&token);
        if !random.once_in(20) {
            text.push(' ');
        }
    }
    text
}

/// A name of letters that languages use.
fn word(random: &mut Random) -> String {
    let letters = [
        "a", "b", "x", "_", "q", "é", "ψ", "θ", "变", "R", "0", "1", "ß", "ı", "x₀",
    ];
    let length = 1 + random.below(4);
    let mut word = String::from(random.pick(&["a", "x", "ψ", "_", "Z"]));
    (0..length).for_each(|_| word.push_str(random.pick(&letters)));
    word
}

/// Delimiters, signs or operators within one another, as deep as rustc itself reads them.
pub(crate) fn nested(random: &mut Random) -> String {
    let depth = 1 << random.below(10);
    let (before, core, after) = random.pick(&[
        &("(", "x", ")"),
        &("{", "x", "}"),
        &("[", "0", "]"),
        &("-", "x", ""),
        &("2^", "x", ""),
        &("x^-", "1", ""),
        &("sin(", "x", ")"),
        &("(x+", "y", ")*2"),
        &("1/(1+", "x", ")"),
        &("x+", "y", ""),
        &("x*", "y", "*k"),
        &("q[", "0", "]"),
        &("sum(i in 0..2, ", "x", ")"),
        &("for i in 0..2 {", "der(x) = 1;", "}"),
        &("region a {", "der(x) = 1;", "}"),
        &("V(", "x", ")"),
    ]);
    let inner = format!("{}{core}{}", before.repeat(depth), after.repeat(depth));
    match random.below(4) {
        0 => inner,
        1 => format!("system S {{ {inner} }}"),
        2 => format!("system S {{ state x, y; param k = 2; der(x) = {inner}; der(y) = k; }}"),
        _ => format!(
            "system S {{ state x, y; param k = 2; fn V(q) = q^2; der(x) = y; der(y) = k; conserved c = {inner}; }}"
        ),
    }
}

/// A system with random formulas.
pub(crate) fn system(random: &mut Random) -> String {
    let depth = 1 + random.below(4);
    let [f, g, h, s] = [(); 4].map(|()| formula(random, depth));
    match random.below(8) {
        0..=2 => format!("system S {{ state x, y; param k = 2; hamiltonian H = {h} in (x, y); }}"),
        3 => format!(
            "system S {{ state x, y; param k = 2; der(x) = {f}; der(y) = {g}; conserved c = {h}; }}"
        ),
        4 => format!(
            "system S {{ state x, y; param k = 2; interface wall = {s};
             region low where wall < 0 {{ hamiltonian H = {h} in (x, y); }}
             region high where wall > 0 {{ der(x) = {f}; der(y) = {g}; }} }}"
        ),
        5 => format!(
            "system S {{ state x, y; param k = 2; let u = {f};
             der(x) = u; der(y) = -k * u; assume conserved c = k * x + y; }}"
        ),
        6 => {
            let n = 1 + random.below(12);
            format!(
                "system S {{ state q[{n}], p[{n}]; param k = 2; fn V(x, y) = {h};
                 hamiltonian H = sum(i in 0..{n}, p[i]^2/2 + V(q[i], q[(i + 1) % {n}]))
                 in (q, p); }}"
            )
        }
        _ => format!(
            "system S {{ state x, y, z; param k = 2;
             der(x) = {f}; der(y) = {g}; der(z) = ({f})*({g});
             conserved a = {h}; conserved b = {s}; }}"
        ),
    }
}

/// A formula of up to `depth` levels.
fn formula(random: &mut Random, depth: usize) -> String {
    if depth == 0 {
        return match random.below(8) {
            0 | 1 => random
                .pick(&["1", "2", "3", "1/2", "0.1", "pi", "7", "1/3"])
                .to_owned(),
            index => VARIABLES[index % VARIABLES.len()].to_owned(),
        };
    }
    let mut operand = || formula(random, depth - 1);
    let (u, v) = (operand(), operand());
    match random.below(11) {
        0 | 1 => format!("({u} + {v})"),
        2 => format!("({u} - {v})"),
        3 | 4 => format!("{u} * {v}"),
        5 => format!("{u} / ({v})"),
        6 => format!("({u})^{}", random.pick(&["2", "3", "5", "-1", "-2", "12"])),
        7 => format!(
            "({u})^({})",
            random.pick(&["1/2", "3/2", "-1/3", "k", "2/7"])
        ),
        8 => format!("-{u}"),
        _ => format!("{}({u})", FUNCTIONS[random.below(FUNCTIONS.len())]),
    }
}
