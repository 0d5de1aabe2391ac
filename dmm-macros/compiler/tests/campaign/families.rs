//! Systems with their conserved quantities, before they are disguised.

use super::disguise::Disguise;
use super::random::Random;
use super::term::{Term, call, name};

/// A region's vector field, by state, and its conserved quantities.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    pub(crate) field: Vec<Term>,
    pub(crate) conserved: Vec<Term>,
}

/// A system: one part, or those above and below the interface.
#[derive(Clone, Debug)]
pub(crate) struct System {
    pub(crate) states: Vec<&'static str>,
    pub(crate) interface: Option<Term>,
    pub(crate) parts: Vec<Part>,
}

/// Names of families, in the order of [`system`].
pub(crate) const FAMILIES: [&str; 16] = [
    "polynomial",
    "rational",
    "square roots",
    "trigonometric",
    "exponential",
    "logarithmic",
    "hyperbolic",
    "inverse functions",
    "real powers",
    "powers of a parameter",
    "mixed functions",
    "skew field in 3 states",
    "two quantities",
    "time dependent",
    "two regions",
    "exact constants",
];

/// A function of `u`, of this family.
fn function(family: usize, u: Term, random: &mut Random) -> Term {
    let forms: &[&str] = match family {
        0 => &["u^2", "u^3 - u", "u^4/4 + u^2", "u*(u + 1)", "3*u^2/7"],
        1 => &[
            "1/(1 + u^2)",
            "u/(2 + u)",
            "u^2/(1 + u^2)",
            "1/u",
            "(u - 1)/(u^2 + 3)",
        ],
        2 => &[
            "sqrt(1 + u^2)",
            "sqrt(u)",
            "u*sqrt(2 + u)",
            "1/sqrt(1 + u^2)",
            "sqrt(1 - u^2)",
        ],
        3 => &[
            "sin(u)", "cos(u)", "sin(u)^2", "cos(2*u)", "tan(u)", "u*sin(u)",
        ],
        4 => &[
            "exp(u)",
            "exp(-u)",
            "exp(-u^2)",
            "u*exp(u)",
            "1/(1 + exp(u))",
        ],
        5 => &["ln(u)", "ln(1 + u^2)", "u*ln(u)", "ln(u)^2", "ln(2 + u)/u"],
        6 => &[
            "cosh(u)",
            "tanh(u)",
            "sinh(u)",
            "1/cosh(u)^2",
            "ln(cosh(u))",
        ],
        7 => &[
            "atan(u)",
            "asin(u)",
            "acos(u)",
            "atan(u)^2",
            "u*atan(u)",
            "ln(u + sqrt(1 + u^2))",
        ],
        8 => &[
            "u^(3/2)",
            "u^(1/3)",
            "u^(-2/3)",
            "(1 + u^2)^(3/4)",
            "u^(5/2)",
        ],
        9 => &[
            "u^k",
            "u^(k + 1)",
            "(1 + u^2)^k",
            "exp(k*u)",
            "u^(-k)",
            "u^(2*k)",
        ],
        _ => return function(random.below(10), u, random),
    };
    Term::read(random.pick(forms)).with(&[("u".into(), u)])
}

/// A factor that is a small number or a parameter.
fn factor(random: &mut Random) -> Term {
    Term::read(random.pick(&["1", "1", "2", "1/2", "3", "m", "1/3", "pi", "5/7"]))
}

/// An argument made of states.
fn argument(states: &[&str], random: &mut Random) -> Term {
    let pick = |random: &mut Random| name(states[random.below(states.len())]);
    let (x, y) = (pick(random), pick(random));
    match random.below(6) {
        0 if x != y => x + y,
        1 if x != y => x - y,
        2 if x != y => x * y,
        3 => factor(random) * x,
        _ => x,
    }
}

/// A sum of a few functions of the states.
fn quantity(family: usize, states: &[&str], random: &mut Random) -> Term {
    let mut sum = Term::Number(0);
    for state in states {
        let kind = if random.once_in(3) { 0 } else { family };
        sum = sum + factor(random) * function(kind, name(state), random);
    }
    if random.once_in(2) {
        sum = sum + factor(random) * function(family, argument(states, random), random);
    }
    match random.below(10) {
        0 => function(family, sum, random),
        1 => sum.clone() * function(family, argument(states, random), random),
        _ => sum,
    }
}

fn gradient(of: &Term, states: &[&str]) -> Vec<Term> {
    states.iter().map(|state| of.derivative(state)).collect()
}

/// (∂H/∂y, −∂H/∂x), times an integrating factor once in a while.
fn plane(h: &Term, family: usize, random: &mut Random) -> Vec<Term> {
    let scale = match random.below(3) {
        0 => function(family, argument(&["x", "y"], random), random),
        _ => Term::Number(1),
    };
    let by_x = h.derivative("x");
    let by_y = h.derivative("y");
    vec![by_y * scale.clone(), -(by_x * scale)]
}

/// A system of this family that conserves what it says.
pub(crate) fn system(family: usize, disguise: &Disguise, random: &mut Random) -> System {
    let one = |states: Vec<&'static str>, field, conserved| System {
        states,
        interface: None,
        parts: vec![Part { field, conserved }],
    };
    match FAMILIES[family] {
        "skew field in 3 states" => {
            let states = vec!["x", "y", "z"];
            let h = quantity(10, &states, random);
            let [hx, hy, hz] = [0, 1, 2].map(|index| gradient(&h, &states)[index].clone());
            let [a, b, c] = [(); 3].map(|()| match random.below(3) {
                0 => factor(random),
                _ => function(10, argument(&states, random), random),
            });
            let field = vec![
                a.clone() * hy.clone() - b.clone() * hz.clone(),
                c.clone() * hz - a * hx.clone(),
                b * hx - c * hy,
            ];
            one(states, field, vec![h])
        }
        "two quantities" => {
            let states = vec!["x", "y", "z"];
            let (g, h) = (quantity(0, &states, random), quantity(10, &states, random));
            let (a, b) = (gradient(&g, &states), gradient(&h, &states));
            let entry =
                |i: usize, j: usize| a[i].clone() * b[j].clone() - a[j].clone() * b[i].clone();
            one(
                states,
                vec![entry(1, 2), entry(2, 0), entry(0, 1)],
                vec![g, h],
            )
        }
        "time dependent" => {
            let states = vec!["x", "y"];
            let growing = function(10, Term::read("1 + t^2/3"), random);
            let mut psi = quantity(10, &states, random) * growing;
            psi = psi + factor(random) * function(10, Term::read("t + x/2"), random);
            let first = function(10, argument(&["x", "y", "t"], random), random);
            let by_time = psi.derivative("t");
            let along = psi.derivative("x") * first.clone();
            let second = -(by_time + along) / psi.derivative("y");
            one(states, vec![first, second], vec![psi])
        }
        "two regions" => {
            let states = vec!["x", "y"];
            let wall = Term::read(random.pick(&[
                "x",
                "y - 1/2",
                "x*y - 1/3",
                "exp(x) - 1",
                "x^2 + y^2 - 1",
            ]));
            let parts = [(); 2].map(|()| {
                let h = quantity(10, &states, random);
                let field = plane(&h, 10, random);
                Part {
                    field,
                    conserved: vec![h],
                }
            });
            System {
                states,
                interface: Some(wall),
                parts: parts.into(),
            }
        }
        "exact constants" => {
            let states = vec!["x", "y"];
            let ([a, other_a], [b, other_b]) =
                (disguise.two_ways(random), disguise.two_ways(random));
            let kinds = [random.below(8), random.below(8)];
            let first = function(kinds[0], name("x"), random);
            let second = function(kinds[1], name("y"), random);
            let field = vec![b * second.derivative("y"), -(a * first.derivative("x"))];
            let psi = other_a * first + other_b * second;
            one(states, field, vec![psi])
        }
        _ => {
            let states = vec!["x", "y"];
            let h = quantity(family, &states, random);
            let field = plane(&h, family, random);
            // what is conserved is conserved as any function of it
            let psi = match random.below(5) {
                0 => function(family, h.clone(), random),
                _ => h,
            };
            one(states, field, vec![psi])
        }
    }
}

impl System {
    /// Every formula but the interface.
    pub(crate) fn formulas_mut(&mut self) -> Vec<&mut Term> {
        let parts = self.parts.iter_mut();
        parts
            .flat_map(|part| part.field.iter_mut().chain(&mut part.conserved))
            .collect()
    }

    /// The declaration.
    pub(crate) fn declaration(&self) -> String {
        let mut formulas: Vec<&Term> = self.interface.iter().collect();
        for part in &self.parts {
            formulas.extend(part.field.iter().chain(&part.conserved));
        }
        let mut text = format!("system S {{ state {};", self.states.join(", "));
        for (parameter, default) in [("k", "2"), ("m", "3/2")] {
            if formulas.iter().any(|formula| formula.mentions(parameter)) {
                text.push_str(&format!(" param {parameter} = {default};"));
            }
        }
        let items = |part: &Part| {
            let mut text = String::new();
            for (state, component) in self.states.iter().zip(&part.field) {
                text.push_str(&format!(" der({state}) = {component};"));
            }
            for (psi, quantity) in part.conserved.iter().zip(["a", "b"]) {
                text.push_str(&format!(" conserved {quantity} = {psi};"));
            }
            text
        };
        match (&self.interface, self.parts.as_slice()) {
            (Some(wall), [above, below]) => text.push_str(&format!(
                " interface wall = {wall}; region above where wall > 0 {{{} }} region below where wall < 0 {{{} }}",
                items(above),
                items(below)
            )),
            _ => self.parts.iter().for_each(|part| text.push_str(&items(part))),
        }
        text.push_str(" }");
        text
    }

    /// Formulas to bring in: states and small numbers.
    pub(crate) fn any(&self) -> Vec<Term> {
        let mut any: Vec<Term> = self.states.iter().map(|state| name(state)).collect();
        any.extend(["2", "1/3", "sqrt(2)", "pi"].map(Term::read));
        any.push(call("exp", name(self.states[0])));
        any
    }
}
