//! Formulas in the notation of declarations, for tests to read like mathematics.

use crate::algebra::{Dag, Function, Id, Name, PairFunction, Rational};

/// Parses `text`; panics where it is not a formula.
pub(super) fn formula(dag: &mut Dag, text: &str) -> Id {
    let characters: Vec<char> = text.chars().filter(|c| !c.is_whitespace()).collect();
    let mut parser = Parser {
        dag,
        characters: &characters,
        position: 0,
    };
    let id = parser.sum();
    assert_eq!(
        parser.position,
        characters.len(),
        "cannot read all of `{text}`"
    );
    id
}

struct Parser<'a> {
    dag: &'a mut Dag,
    characters: &'a [char],
    position: usize,
}

impl Parser<'_> {
    fn peek(&self) -> Option<char> {
        self.characters.get(self.position).copied()
    }

    fn eat(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        self.position += usize::from(found);
        found
    }

    fn word(&mut self, belongs: impl Fn(char) -> bool) -> String {
        let start = self.position;
        while self.peek().is_some_and(&belongs) {
            self.position += 1;
        }
        self.characters[start..self.position].iter().collect()
    }

    fn sum(&mut self) -> Id {
        let mut sum = self.product();
        loop {
            if self.eat('+') {
                let term = self.product();
                sum = self.dag.add(sum, term);
            } else if self.eat('-') {
                let term = self.product();
                sum = self.dag.sub(sum, term);
            } else {
                return sum;
            }
        }
    }

    fn product(&mut self) -> Id {
        let mut product = self.unary();
        loop {
            if self.eat('*') {
                let factor = self.unary();
                product = self.dag.mul(product, factor);
            } else if self.eat('/') {
                let divisor = self.unary();
                product = self.dag.div(product, divisor);
            } else {
                return product;
            }
        }
    }

    fn unary(&mut self) -> Id {
        if self.eat('-') {
            let operand = self.unary();
            return self.dag.neg(operand);
        }
        let base = self.primary();
        if self.eat('^') {
            let exponent = self.unary();
            return self.dag.pow(base, exponent);
        }
        base
    }

    fn primary(&mut self) -> Id {
        if self.eat('(') {
            let inner = self.sum();
            assert!(self.eat(')'), "a parenthesis is not closed");
            return inner;
        }
        let digits = self.word(|c| c.is_ascii_digit());
        if !digits.is_empty() {
            return self
                .dag
                .constant(digits.parse::<Rational>().expect("digits"));
        }
        let word = self.word(|c| c.is_alphanumeric() || c == '_');
        assert!(!word.is_empty(), "an operand is missing");
        if !self.eat('(') {
            return match word.as_str() {
                "pi" => self.dag.pi(),
                _ => self.dag.variable(&Name::new(&word)),
            };
        }
        let first = self.sum();
        let id = if self.eat(',') {
            let second = self.sum();
            let function: PairFunction = word.parse().expect("a function of two arguments");
            self.dag.pair(function, first, second)
        } else {
            let function: Function = word.parse().expect("a function");
            self.dag.call(function, first)
        };
        assert!(self.eat(')'), "a call is not closed");
        id
    }
}
