//! Formulas of the campaign: read, written, differentiated and rewritten apart from the
//! compiler.

use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A formula.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Term {
    Number(i64),
    /// A state, a parameter, `t`, `pi`, or in a rule something to be matched.
    Name(String),
    Neg(Box<Term>),
    Binary(char, Box<Term>, Box<Term>),
    Call(String, Box<Term>),
}

use Term::{Binary, Call, Name, Number};

/// A name.
pub(crate) fn name(text: &str) -> Term {
    Name(text.to_owned())
}

/// `function(of)`
pub(crate) fn call(function: &str, of: Term) -> Term {
    Call(function.to_owned(), Box::new(of))
}

impl Add for Term {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        match (&self, &other) {
            (Number(0), _) => other,
            (_, Number(0)) => self,
            _ => Binary('+', Box::new(self), Box::new(other)),
        }
    }
}

impl Sub for Term {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        match (&self, &other) {
            (Number(0), _) => -other,
            (_, Number(0)) => self,
            _ => Binary('-', Box::new(self), Box::new(other)),
        }
    }
}

impl Mul for Term {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        match (&self, &other) {
            (Number(0), _) | (_, Number(0)) => Number(0),
            (Number(1), _) => other,
            (_, Number(1)) => self,
            _ => Binary('*', Box::new(self), Box::new(other)),
        }
    }
}

impl Div for Term {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        match (&self, &other) {
            (Number(0), _) => Number(0),
            (_, Number(1)) => self,
            _ => Binary('/', Box::new(self), Box::new(other)),
        }
    }
}

impl Neg for Term {
    type Output = Self;
    fn neg(self) -> Self {
        match self {
            Number(0) => Number(0),
            Self::Neg(inner) => *inner,
            _ => Self::Neg(Box::new(self)),
        }
    }
}

impl Term {
    /// self^exponent
    pub(crate) fn power(self, exponent: Self) -> Self {
        match exponent {
            Number(0) => Number(1),
            Number(1) => self,
            _ => Binary('^', Box::new(self), Box::new(exponent)),
        }
    }

    /// Reads a formula of this module's own tables.
    pub(crate) fn read(text: &str) -> Self {
        let mut reader = Reader {
            letters: text.chars().filter(|letter| *letter != ' ').collect(),
            place: 0,
        };
        let term = reader.sum();
        assert_eq!(reader.place, reader.letters.len(), "cannot read `{text}`");
        term
    }

    /// The derivative with respect to `variable`.
    pub(crate) fn derivative(&self, variable: &str) -> Self {
        let of = |term: &Self| term.derivative(variable);
        match self {
            Number(_) => Number(0),
            Name(text) => Number(i64::from(text == variable)),
            Self::Neg(u) => -of(u),
            Binary('+', u, v) => of(u) + of(v),
            Binary('-', u, v) => of(u) - of(v),
            Binary('*', u, v) => of(u) * (**v).clone() + (**u).clone() * of(v),
            Binary('/', u, v) => {
                let quotient = (**u).clone() * of(v) / (**v).clone().power(Number(2));
                of(u) / (**v).clone() - quotient
            }
            Binary(_, u, v) => {
                let (base, exponent) = ((**u).clone(), (**v).clone());
                let less = match exponent {
                    Number(n) => Number(n - 1),
                    _ => exponent.clone() - Number(1),
                };
                let by_base = exponent * base.clone().power(less) * of(u);
                by_base + of(v) * self.clone() * call("ln", base)
            }
            Call(function, u) => {
                let inner = of(u);
                if inner == Number(0) {
                    return inner;
                }
                let outer = match function.as_str() {
                    "sqrt" => "1/(2*sqrt(u))",
                    "exp" => "exp(u)",
                    "ln" => "1/u",
                    "sin" => "cos(u)",
                    "cos" => "-sin(u)",
                    "tan" => "1 + tan(u)^2",
                    "sinh" => "cosh(u)",
                    "cosh" => "sinh(u)",
                    "tanh" => "1 - tanh(u)^2",
                    "asin" => "1/sqrt(1 - u^2)",
                    "acos" => "-1/sqrt(1 - u^2)",
                    "atan" => "1/(1 + u^2)",
                    other => panic!("no function `{other}`"),
                };
                Self::read(outer).with(&[("u".to_owned(), (**u).clone())]) * inner
            }
        }
    }

    /// With names replaced.
    pub(crate) fn with(&self, meanings: &[(String, Self)]) -> Self {
        match self {
            Number(_) => self.clone(),
            Name(text) => {
                let meaning = meanings.iter().find(|(name, _)| name == text);
                meaning.map_or_else(|| self.clone(), |(_, term)| term.clone())
            }
            Self::Neg(u) => Self::Neg(Box::new(u.with(meanings))),
            Binary(sign, u, v) => Binary(
                *sign,
                Box::new(u.with(meanings)),
                Box::new(v.with(meanings)),
            ),
            Call(function, u) => Call(function.clone(), Box::new(u.with(meanings))),
        }
    }

    /// Whether it is of the form `pattern`, whose names `u`, `v` stand for anything; what they
    /// stand for is added to `meanings`.
    pub(crate) fn matches(&self, pattern: &Self, meanings: &mut Vec<(String, Self)>) -> bool {
        match (pattern, self) {
            (Name(text), _) if is_open(text) => {
                match meanings.iter().find(|(name, _)| name == text) {
                    Some((_, known)) => known == self,
                    None => {
                        meanings.push((text.clone(), self.clone()));
                        true
                    }
                }
            }
            (Self::Neg(p), Self::Neg(u)) => u.matches(p, meanings),
            (Binary(s, p, q), Binary(t, u, v)) => {
                s == t && u.matches(p, meanings) && v.matches(q, meanings)
            }
            (Call(f, p), Call(g, u)) => f == g && u.matches(p, meanings),
            _ => pattern == self,
        }
    }

    fn children(&self) -> Vec<&Self> {
        match self {
            Number(_) | Name(_) => Vec::new(),
            Self::Neg(u) | Call(_, u) => vec![u],
            Binary(_, u, v) => vec![u, v],
        }
    }

    fn children_mut(&mut self) -> Vec<&mut Self> {
        match self {
            Number(_) | Name(_) => Vec::new(),
            Self::Neg(u) | Call(_, u) => vec![u],
            Binary(_, u, v) => vec![u, v],
        }
    }

    /// The number of its parts, itself among them.
    pub(crate) fn size(&self) -> usize {
        1 + self.children().into_iter().map(Self::size).sum::<usize>()
    }

    /// All parts, itself first.
    pub(crate) fn parts(&self) -> Vec<&Self> {
        let mut parts = vec![self];
        for child in self.children() {
            parts.extend(child.parts());
        }
        parts
    }

    /// Part number `index` in the order of [`parts`](Self::parts).
    pub(crate) fn part_mut(&mut self, index: usize) -> &mut Self {
        if index == 0 {
            return self;
        }
        let mut left = index - 1;
        for child in self.children_mut() {
            let size = child.size();
            if left < size {
                return child.part_mut(left);
            }
            left -= size;
        }
        panic!("no part {index}")
    }

    /// Whether `text` is among its names.
    pub(crate) fn mentions(&self, text: &str) -> bool {
        self.parts().contains(&&name(text))
    }

    fn precedence(&self) -> u8 {
        match self {
            Binary('+' | '-', ..) => 1,
            Self::Neg(_) => 2,
            Number(value) if *value < 0 => 2,
            Binary('*' | '/', ..) => 3,
            Binary(..) => 4,
            Number(_) | Name(_) | Call(..) => 5,
        }
    }

    fn write(&self, f: &mut fmt::Formatter<'_>, least: u8) -> fmt::Result {
        if self.precedence() < least {
            f.write_str("(")?;
            self.write(f, 0)?;
            return f.write_str(")");
        }
        match self {
            Number(value) => write!(f, "{value}"),
            Name(text) => f.write_str(text),
            Self::Neg(u) => {
                f.write_str("-")?;
                u.write(f, 3)
            }
            Binary(sign, u, v) => {
                let (left, right) = match sign {
                    '+' => (1, 2),
                    '-' => (1, 3),
                    '*' => (3, 4),
                    '/' => (3, 4),
                    _ => (5, 5),
                };
                u.write(f, left)?;
                match sign {
                    '+' | '-' => write!(f, " {sign} ")?,
                    _ => write!(f, "{sign}")?,
                }
                v.write(f, right)
            }
            Call(function, u) => {
                write!(f, "{function}(")?;
                u.write(f, 0)?;
                f.write_str(")")
            }
        }
    }
}

impl fmt::Display for Term {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(f, 0)
    }
}

/// Whether a name in a rule stands for anything.
pub(crate) fn is_open(name: &str) -> bool {
    matches!(name, "u" | "v" | "w")
}

struct Reader {
    letters: Vec<char>,
    place: usize,
}

impl Reader {
    fn peek(&self) -> Option<char> {
        self.letters.get(self.place).copied()
    }

    fn eat(&mut self, letter: char) -> bool {
        let found = self.peek() == Some(letter);
        self.place += usize::from(found);
        found
    }

    fn sum(&mut self) -> Term {
        let mut left = self.product();
        loop {
            left = if self.eat('+') {
                Binary('+', Box::new(left), Box::new(self.product()))
            } else if self.eat('-') {
                Binary('-', Box::new(left), Box::new(self.product()))
            } else {
                return left;
            };
        }
    }

    fn product(&mut self) -> Term {
        let mut left = self.signed();
        loop {
            left = if self.eat('*') {
                Binary('*', Box::new(left), Box::new(self.signed()))
            } else if self.eat('/') {
                Binary('/', Box::new(left), Box::new(self.signed()))
            } else {
                return left;
            };
        }
    }

    fn signed(&mut self) -> Term {
        if self.eat('-') {
            return Term::Neg(Box::new(self.signed()));
        }
        let base = self.operand();
        if self.eat('^') {
            return Binary('^', Box::new(base), Box::new(self.signed()));
        }
        base
    }

    fn operand(&mut self) -> Term {
        if self.eat('(') {
            let inner = self.sum();
            assert!(self.eat(')'), "a `)` is missing");
            return inner;
        }
        let start = self.place;
        while self.peek().is_some_and(char::is_alphanumeric) {
            self.place += 1;
        }
        let word: String = self.letters[start..self.place].iter().collect();
        if let Ok(value) = word.parse() {
            return Number(value);
        }
        assert!(!word.is_empty(), "an operand is missing at {start}");
        if self.eat('(') {
            let inner = self.sum();
            assert!(self.eat(')'), "a `)` is missing");
            return call(&word, inner);
        }
        name(&word)
    }
}
