//! Identities by which a formula is written in another way. Each holds wherever both of its
//! sides have values; `u`, `v` and `w` stand for anything.

use super::random::Random;
use super::term::{Term, is_open, name};

/// Both sides of identities between formulas.
pub(crate) const IDENTITIES: &[(&str, &str)] = &[
    // sums, products, quotients
    ("u", "u + w - w"),
    ("u", "u*w/w"),
    ("u", "2*u - u"),
    ("u - v", "-(v - u)"),
    ("u + v", "v + u"),
    ("u*v", "v*u"),
    ("u*(v + w)", "u*v + u*w"),
    ("u*(v - w)", "u*v - u*w"),
    ("(u + v)/w", "u/w + v/w"),
    ("u + v", "(u^2 - v^2)/(u - v)"),
    ("u - v", "(u^2 - v^2)/(u + v)"),
    ("u/v", "u*v/v^2"),
    ("u/v", "u*v^-1"),
    ("1/u - 1/v", "(v - u)/(u*v)"),
    ("u^2", "u*u"),
    ("u^2", "(u + 1)*(u - 1) + 1"),
    ("u^3", "u*u^2"),
    ("(u + v)^2", "u^2 + 2*u*v + v^2"),
    ("(u - v)^2", "u^2 - 2*u*v + v^2"),
    ("u*v", "((u + v)^2 - (u - v)^2)/4"),
    // roots and powers
    ("u", "sqrt(u)^2"),
    ("u", "(u^3)^(1/3)"),
    ("u", "(u^(1/3))^3"),
    ("u", "sqrt(u)*sqrt(u^3)/u"),
    ("sqrt(u)", "u^(1/2)"),
    ("sqrt(u)", "u/sqrt(u)"),
    ("sqrt(u)", "sqrt(u^3)/u"),
    ("sqrt(u)", "(u^(1/4))^2"),
    ("sqrt(u)", "sqrt(4*u)/2"),
    ("1/sqrt(u)", "sqrt(u)/u"),
    ("1/sqrt(u)", "sqrt(1/u)"),
    (
        "sqrt(u)*sqrt(v)",
        "sqrt(u)*sqrt(v)*sqrt(w^2 + 1)/sqrt(1 + w^2)",
    ),
    ("1/(1 + sqrt(u))", "(1 - sqrt(u))/(1 - u)"),
    ("sqrt(u)", "sqrt(u*(1 + w^2))/sqrt(1 + w^2)"),
    ("u^(3/2)", "u*sqrt(u)"),
    ("u^(3/2)", "sqrt(u)^3"),
    ("u^(3/2)", "sqrt(u^3)"),
    ("u^(1/3)", "u^(2/3)/u^(1/3)"),
    ("u^k", "u^(k + 1)/u"),
    ("u^k", "exp(k*ln(u))"),
    ("u^k", "u^(k/2)*u^(k/2)"),
    ("u^k", "(u^(2*k))^(1/2)"),
    ("u^(k + 1)", "u*u^k"),
    ("u^k", "1/u^(-k)"),
    // exponentials and logarithms
    ("u", "exp(ln(u))"),
    ("exp(u)", "exp(u/2)^2"),
    ("exp(u)", "1/exp(-u)"),
    ("exp(u)", "cosh(u) + sinh(u)"),
    ("exp(u)", "(1 + tanh(u/2))/(1 - tanh(u/2))"),
    ("exp(u + v)", "exp(u)*exp(v)"),
    ("exp(u - v)", "exp(u)/exp(v)"),
    ("exp(u)", "sqrt(exp(2*u))"),
    ("u", "ln(exp(u))"),
    ("ln(u)", "ln(u^3)/3"),
    ("ln(u)", "-ln(1/u)"),
    ("ln(u)", "2*ln(sqrt(u))"),
    ("ln(u)", "ln(2*u) - ln(2)"),
    ("ln(u)", "ln(u*(1 + w^2)) - ln(1 + w^2)"),
    ("ln(u)", "ln(u/3) + ln(6) - ln(2)"),
    // hyperbolic functions
    ("sinh(u)", "(exp(u) - exp(-u))/2"),
    ("cosh(u)", "(exp(u) + exp(-u))/2"),
    ("tanh(u)", "sinh(u)/cosh(u)"),
    ("tanh(u)", "1 - 2/(exp(2*u) + 1)"),
    ("tanh(u)", "2*tanh(u/2)/(1 + tanh(u/2)^2)"),
    ("sinh(u)", "2*sinh(u/2)*cosh(u/2)"),
    ("cosh(u)", "sqrt(1 + sinh(u)^2)"),
    ("cosh(u)", "1 + 2*sinh(u/2)^2"),
    ("cosh(u)^2", "1 + sinh(u)^2"),
    ("1", "cosh(w)^2 - sinh(w)^2"),
    // trigonometry
    ("sin(u)", "2*sin(u/2)*cos(u/2)"),
    ("sin(u)", "cos(pi/2 - u)"),
    ("sin(u)", "-sin(u + pi)"),
    ("sin(u)", "tan(u)*cos(u)"),
    ("sin(u)", "2*tan(u/2)/(1 + tan(u/2)^2)"),
    ("sin(u)", "3*sin(u/3) - 4*sin(u/3)^3"),
    ("cos(u)", "1 - 2*sin(u/2)^2"),
    ("cos(u)", "(sin(u + pi/6) - sin(u - pi/6))"),
    ("cos(u)", "sin(u + pi/2)"),
    ("cos(u)", "cos(u - pi/3) + cos(u + pi/3)"),
    ("cos(u)", "(1 - tan(u/2)^2)/(1 + tan(u/2)^2)"),
    ("sin(u)^2", "1 - cos(u)^2"),
    ("sin(u)^2", "(1 - cos(2*u))/2"),
    ("cos(u)^2", "1/(1 + tan(u)^2)"),
    ("tan(u)", "sin(u)/cos(u)"),
    ("tan(u)", "(1 - cos(2*u))/sin(2*u)"),
    ("sin(u + v)", "sin(u)*cos(v) + cos(u)*sin(v)"),
    ("cos(u + v)", "cos(u)*cos(v) - sin(u)*sin(v)"),
    ("1", "sin(w)^2 + cos(w)^2"),
    ("1", "sin(w)/(cos(w)*tan(w))"),
    // inverse functions
    ("u", "tan(atan(u))"),
    ("u", "sin(asin(u))"),
    ("u", "cos(acos(u))"),
    ("atan(u)", "-atan(-u)"),
    ("atan(u)", "asin(u/sqrt(1 + u^2))"),
    ("atan(u)", "2*atan(u/(1 + sqrt(1 + u^2)))"),
    ("asin(u)", "pi/2 - acos(u)"),
    ("acos(u)", "pi/2 - asin(u)"),
    ("asin(u)", "atan(u/sqrt(1 - u^2))"),
    ("acos(u)", "2*asin(sqrt((1 - u)/2))"),
    ("sqrt(1 - u^2)", "cos(asin(u))"),
    ("sqrt(1 - u^2)", "sqrt(1 - u)*sqrt(1 + u)"),
    ("1/sqrt(1 + u^2)", "cos(atan(u))"),
    ("1/(1 + u^2)", "cos(atan(u))^2"),
    ("ln(u + sqrt(1 + u^2))", "-ln(sqrt(1 + u^2) - u)"),
];

/// Both sides of identities between constants.
pub(crate) const CONSTANTS: &[(&str, &str)] = &[
    ("sin(pi/5)", "sqrt(10 - 2*sqrt(5))/4"),
    ("cos(pi/5)", "(1 + sqrt(5))/4"),
    ("sin(pi/10)", "(sqrt(5) - 1)/4"),
    ("tan(pi/5)", "sqrt(5 - 2*sqrt(5))"),
    ("cos(pi/5)*sin(pi/10)", "1/4"),
    ("cos(pi/5) - cos(2*pi/5)", "1/2"),
    ("sin(pi/5)*sin(2*pi/5)", "sqrt(5)/4"),
    ("sin(pi/12)", "(sqrt(6) - sqrt(2))/4"),
    ("cos(pi/12)", "(sqrt(6) + sqrt(2))/4"),
    ("tan(pi/8)", "sqrt(2) - 1"),
    ("cos(pi/8)", "sqrt(2 + sqrt(2))/2"),
    ("cos(pi/16)", "sqrt(2 + sqrt(2 + sqrt(2)))/2"),
    ("tan(pi/12)", "2 - sqrt(3)"),
    ("cos(pi/7) - cos(2*pi/7) + cos(3*pi/7)", "1/2"),
    ("sin(pi/18)*sin(5*pi/18)*sin(7*pi/18)", "1/8"),
    ("cos(pi/9)*cos(2*pi/9)*cos(4*pi/9)", "1/8"),
    ("sin(3*pi/10)", "(1 + sqrt(5))/4"),
    ("4*sin(pi/24)*cos(pi/24)", "2*sin(pi/12)"),
    ("sqrt(3 + 2*sqrt(2))", "1 + sqrt(2)"),
    ("sqrt(3 - 2*sqrt(2))", "sqrt(2) - 1"),
    ("sqrt(5 + 2*sqrt(6))", "sqrt(2) + sqrt(3)"),
    ("sqrt(5 - 2*sqrt(6))", "sqrt(3) - sqrt(2)"),
    ("sqrt(7 - 4*sqrt(3))", "2 - sqrt(3)"),
    ("sqrt(2 + sqrt(3))", "(sqrt(6) + sqrt(2))/2"),
    ("sqrt(6 + 2*sqrt(5))", "1 + sqrt(5)"),
    ("sqrt(9/4 + sqrt(2))", "sqrt(2) + 1/2"),
    ("(2 + sqrt(5))^(1/3)", "(1 + sqrt(5))/2"),
    ("(7 + 5*sqrt(2))^(1/3)", "1 + sqrt(2)"),
    ("(26 + 15*sqrt(3))^(1/3)", "2 + sqrt(3)"),
    ("(17 + 12*sqrt(2))^(1/4)", "1 + sqrt(2)"),
    ("(3 + 2*sqrt(2))^(3/2)", "7 + 5*sqrt(2)"),
    ("sqrt(3 + 2*sqrt(2)) - sqrt(3 - 2*sqrt(2))", "2"),
    ("sqrt(4 + sqrt(7)) - sqrt(4 - sqrt(7))", "sqrt(2)"),
    ("1/(sqrt(3) - sqrt(2))", "sqrt(3) + sqrt(2)"),
    ("1/(2^(1/3) - 1)", "1 + 2^(1/3) + 4^(1/3)"),
    (
        "sqrt(10 + 2*sqrt(6) + 2*sqrt(10) + 2*sqrt(15))",
        "sqrt(2) + sqrt(3) + sqrt(5)",
    ),
    ("sqrt(2)*sqrt(3)", "sqrt(6)"),
    ("2^(1/3)*4^(1/3)", "2"),
    ("sqrt(2 + sqrt(2))*sqrt(2 - sqrt(2))", "sqrt(2)"),
    ("sqrt(1 + sqrt(3/4)/2 + sqrt(3)/4)", "(1 + sqrt(3))/2"),
    ("atan(1/2) + atan(1/3)", "pi/4"),
    ("4*atan(1/5) - atan(1/239)", "pi/4"),
    ("atan(1) + atan(2) + atan(3)", "pi"),
    ("2*atan(1/3) + atan(1/7)", "pi/4"),
    ("atan(5/7) + atan(7/5)", "pi/2"),
    ("atan(3) - atan(1/2)", "pi/4"),
    ("atan(2/5) + atan(1/7)", "atan(19/33)"),
    ("atan(sqrt(3))", "pi/3"),
    ("atan(2 - sqrt(3))", "pi/12"),
    ("atan(sqrt(2) - 1)", "pi/8"),
    ("atan(sqrt(2)) + atan(1/sqrt(2))", "pi/2"),
    ("asin(3/5) + asin(4/5)", "pi/2"),
    ("asin(3/5)", "atan(3/4)"),
    ("acos(5/13)", "asin(12/13)"),
    ("asin(2/sqrt(5))", "atan(2)"),
    ("asin(sqrt(2)/2)", "pi/4"),
    ("acos(sqrt(3)/2)", "pi/6"),
    ("acos(1/3)", "2*atan(1/sqrt(2))"),
    ("asin((sqrt(5) - 1)/4)", "pi/10"),
    ("acos(-1/2)", "2*pi/3"),
    ("asin(5/13) + asin(12/13)", "asin(1)"),
    ("acos(1/3) + acos(-1/3)", "pi"),
    ("cos(atan(3/4))", "4/5"),
    ("sin(2*atan(1/3))", "3/5"),
    ("cos(acos(1/3)/2)", "sqrt(2/3)"),
    ("ln(8)", "3*ln(2)"),
    ("ln(6)", "ln(2) + ln(3)"),
    ("ln(2 + sqrt(3))", "-ln(2 - sqrt(3))"),
    ("ln(3 + 2*sqrt(2))", "2*ln(1 + sqrt(2))"),
    ("ln(sqrt(6) - sqrt(2))", "ln(2)/2 + ln(sqrt(3) - 1)"),
    ("exp(2*ln(3))", "9"),
    ("cosh(ln(2))", "5/4"),
    ("sinh(ln(1 + sqrt(2)))", "1"),
    ("tanh(ln(3)/2)", "1/2"),
    ("exp(1)*exp(-1/2)", "sqrt(exp(1))"),
    ("2^pi*3^pi", "6^pi"),
    ("exp(pi*ln(2))", "2^pi"),
];

/// How formulas are written in other ways.
pub(crate) struct Disguise {
    identities: Vec<[Term; 2]>,
    constants: Vec<[Term; 2]>,
}

/// Formulas do not grow beyond this many parts.
const LARGEST: usize = 160;

impl Disguise {
    /// The tables.
    pub(crate) fn new() -> Self {
        let read = |table: &[(&str, &str)]| {
            let sides = table.iter().map(|&(a, b)| [Term::read(a), Term::read(b)]);
            sides.collect()
        };
        Self {
            identities: read(IDENTITIES),
            constants: read(CONSTANTS),
        }
    }

    /// Writes a part of `term` in another way; `any` are formulas to bring in.
    pub(crate) fn step(&self, term: &mut Term, any: &[Term], random: &mut Random) {
        if term.size() > LARGEST {
            return;
        }
        if random.once_in(6) {
            return self.constant(term, random);
        }
        // rules that fit are seldom: a few are tried
        for _ in 0..12 {
            let [left, right] = &self.identities[random.below(self.identities.len())];
            let (from, to) = if random.once_in(3) && !matches!(right, Term::Number(_)) {
                (right, left)
            } else {
                (left, right)
            };
            let fits = |part: &Term| part.matches(from, &mut Vec::new());
            let places: Vec<usize> = (term.parts().into_iter().enumerate())
                .filter(|(_, part)| fits(part))
                .map(|(index, _)| index)
                .collect();
            if places.is_empty() {
                continue;
            }
            let part = term.part_mut(places[random.below(places.len())]);
            let mut meanings = Vec::new();
            part.matches(from, &mut meanings);
            for open in ["u", "v", "w"] {
                if !meanings.iter().any(|(known, _)| known == open) {
                    let meaning = any[random.below(any.len())].clone();
                    meanings.push((open.to_owned(), meaning));
                }
            }
            debug_assert!(is_open("u"));
            *part = to.with(&meanings);
            return;
        }
    }

    /// Brings in an identity between constants: as a factor 1, or a term 0.
    fn constant(&self, term: &mut Term, random: &mut Random) {
        let [left, right] = self.constants[random.below(self.constants.len())].clone();
        let place = random.below(term.size());
        let part = term.part_mut(place);
        let own = part.clone();
        *part = match random.below(3) {
            0 => own * left / right,
            1 => own * right / left,
            _ => own + left - right,
        };
    }

    /// Two ways to write a constant.
    pub(crate) fn two_ways(&self, random: &mut Random) -> [Term; 2] {
        let mut sides = self.constants[random.below(self.constants.len())].clone();
        if random.once_in(2) {
            sides.swap(0, 1);
        }
        sides
    }
}

/// A small change, after which the formula is most probably another one.
pub(crate) fn change(term: &mut Term, names: &[&str], random: &mut Random) {
    for _ in 0..20 {
        let place = random.below(term.size());
        let part = term.part_mut(place);
        let own = part.clone();
        *part = match own {
            Term::Number(value) if random.once_in(2) => Term::Number(value + 1),
            Term::Number(value) => {
                Term::read("u + 1/1000000000").with(&[("u".into(), Term::Number(value))])
            }
            Term::Name(text) if names.contains(&text.as_str()) => {
                name(names[random.below(names.len())])
            }
            Term::Binary('+', u, v) => Term::Binary('-', u, v),
            Term::Binary('-', u, v) => Term::Binary('+', u, v),
            Term::Call(function, u) => {
                let other = match function.as_str() {
                    "sin" => "cos",
                    "cos" => "sin",
                    "sinh" => "cosh",
                    "cosh" => "sinh",
                    "asin" => "atan",
                    "tanh" => "atan",
                    _ => continue,
                };
                Term::Call(other.to_owned(), u)
            }
            _ => continue,
        };
        return;
    }
}
