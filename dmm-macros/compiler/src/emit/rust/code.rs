//! Straight-line code: a node used once is written where it is used, as long as the line stays
//! readable; a node used more often is computed once, by a `let`.

use std::collections::{BTreeMap, HashMap};

use egg::Language;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::expression::{Binding, Expression, constant, method};
use super::names::Names;
use super::readable::suggestion;
use crate::algebra::{Function, Id, Math};
use crate::program::{Lowered, nearest_double};

/// The most operations that are written as one expression.
const LONGEST_EXPRESSION: usize = 10;

/// The body of one emitted function.
pub(super) struct Block<'a> {
    lowered: &'a Lowered,
    /// The type of the scalars.
    scalar: TokenStream,
    names: Names,
    expressions: HashMap<Id, Expression>,
    uses: HashMap<Id, usize>,
    statements: Vec<TokenStream>,
    /// Whether sums of products are fused.
    fuses: bool,
}

impl<'a> Block<'a> {
    /// A body that evaluates `operations` for the results `roots`, in a scope where `names` are
    /// taken. `known` are the nodes with a value outside: variables, and what is stored.
    pub(super) fn new(
        lowered: &'a Lowered,
        scalar: TokenStream,
        names: Names,
        known: &BTreeMap<Id, TokenStream>,
        operations: &[Id],
        roots: &[Id],
    ) -> Self {
        let expressions: HashMap<Id, Expression> = known
            .iter()
            .map(|(&id, tokens)| (id, Expression::atom(tokens.clone())))
            .collect();
        let mut block = Self {
            lowered,
            scalar,
            names,
            expressions,
            uses: HashMap::new(),
            statements: Vec::new(),
            fuses: false,
        };
        block.count_uses(operations, roots);
        block
    }

    /// The same body with a·b + c as one operation, or not.
    pub(super) fn fusing(mut self, fuses: bool) -> Self {
        self.fuses = fuses;
        self
    }

    /// Makes the value of `id` available, with what it needs.
    pub(super) fn require(&mut self, id: Id) {
        let operations = (self.lowered).order(&[id], |id| self.expressions.contains_key(&id));
        self.compute(&operations);
    }

    /// Makes the values of `operations` available.
    pub(super) fn compute(&mut self, operations: &[Id]) {
        for &id in operations {
            let mut expression = self.expression(id);
            let leaf = self.lowered.is_leaf(id);
            let used_again = self.uses.get(&id).is_some_and(|&uses| uses > 1);
            if !leaf && (used_again || expression.operations > LONGEST_EXPRESSION) {
                let name = self.name(id);
                let value = &expression.tokens;
                self.statements.push(quote!(let #name = #value;));
                expression = Expression::atom(quote!(#name));
            }
            self.expressions.insert(id, expression);
        }
    }

    /// Gives `id` the value of `tokens`, under a name.
    pub(super) fn define(&mut self, id: Id, tokens: &TokenStream) {
        let name = self.name(id);
        self.statements.push(quote!(let #name = #tokens;));
        self.expressions.insert(id, Expression::atom(quote!(#name)));
    }

    /// Gives `id` the value of `tokens`, which are no operation.
    pub(super) fn set_value(&mut self, id: Id, tokens: TokenStream) {
        self.expressions.insert(id, Expression::atom(tokens));
    }

    /// Whether the value of `id` is there, or what it is made of.
    pub(super) fn has_value(&self, id: Id) -> bool {
        self.expressions.contains_key(&id)
    }

    /// Gives the value of `id` a name, if it has none.
    pub(super) fn name_value(&mut self, id: Id) {
        self.require(id);
        let expression = &self.expressions[&id];
        if expression.operations > 0 {
            let tokens = expression.tokens.clone();
            self.define(id, &tokens);
        }
    }

    /// The value of a root that was computed.
    pub(super) fn value(&self, root: Id) -> TokenStream {
        self.expressions
            .get(&root)
            .map(|expression| expression.tokens.clone())
            .unwrap_or_default()
    }

    /// A name that nothing has yet.
    pub(super) fn unused_name(&mut self, stem: &str) -> Ident {
        self.names.number(stem)
    }

    /// Appends `statement`.
    pub(super) fn push(&mut self, statement: TokenStream) {
        self.statements.push(statement);
    }

    /// The statements so far.
    pub(super) fn statements(self) -> TokenStream {
        self.statements.into_iter().collect()
    }

    fn count_uses(&mut self, operations: &[Id], roots: &[Id]) {
        for &id in operations {
            self.lowered.dag()[id].for_each(|child| *self.uses.entry(child).or_default() += 1);
        }
        for &root in roots {
            *self.uses.entry(root).or_default() += 1;
        }
    }

    /// A node from the expressions of its children.
    fn expression(&self, id: Id) -> Expression {
        let scalar = &self.scalar;
        if let Some(fused) = self.fused(id) {
            return fused;
        }
        let of = |id: &Id| &self.expressions[id];
        let (tokens, binding, children) = match &self.lowered.dag()[id] {
            Math::Constant(value) => {
                return Expression::atom(constant(scalar, nearest_double(value)));
            }
            // lowering leaves no π, and every variable is known
            Math::Pi => return Expression::atom(constant(scalar, std::f64::consts::PI)),
            Math::Variable(name) => {
                let name = Literal::string(name.as_str());
                return Expression::atom(quote!(compile_error!(#name)));
            }
            Math::Add([a, b]) => {
                let (left, right) = (of(a).at(Binding::Sum), of(b).at(Binding::Product));
                (quote!(#left + #right), Binding::Sum, vec![a, b])
            }
            Math::Sub([a, b]) => {
                let (left, right) = (of(a).at(Binding::Sum), of(b).at(Binding::Product));
                (quote!(#left - #right), Binding::Sum, vec![a, b])
            }
            Math::Mul([a, b]) => {
                let (left, right) = (of(a).at(Binding::Product), of(b).at(Binding::Sign));
                (quote!(#left * #right), Binding::Product, vec![a, b])
            }
            Math::Div([a, b]) => {
                let (left, right) = (of(a).at(Binding::Product), of(b).at(Binding::Sign));
                (quote!(#left / #right), Binding::Product, vec![a, b])
            }
            Math::Neg(a) => {
                let operand = of(a).at(Binding::Sign);
                (quote!(-#operand), Binding::Sign, vec![a])
            }
            _ => return self.call(id),
        };
        self.of_operands(tokens, binding, &children)
    }

    /// An operation on expressions.
    fn of_operands(&self, tokens: TokenStream, binding: Binding, operands: &[&Id]) -> Expression {
        let operands = operands.iter().map(|id| &self.expressions[id]);
        Expression {
            tokens,
            binding,
            operations: 1 + operands.map(|one| one.operations).sum::<usize>(),
        }
    }

    /// A power or a function from the expressions of its operands.
    fn call(&self, id: Id) -> Expression {
        let scalar = &self.scalar;
        let of = |id: &Id| self.expressions[id].at(Binding::Sum);
        let (tokens, operands) = match &self.lowered.dag()[id] {
            Math::Pow([a, b]) => {
                let (base, exponent) = (of(a), of(b));
                let power = match self.lowered.dag().as_integer(*b).map(i32::try_from) {
                    Some(Ok(n)) => {
                        let n = Literal::i32_unsuffixed(n);
                        quote!(#scalar::powi(#base, #n))
                    }
                    _ => quote!(#scalar::powf(#base, #exponent)),
                };
                (power, vec![a, b])
            }
            Math::Call(function, a) => {
                let is_exp = *function == Function::Exp;
                let call = match self.lowered.secular(*a).filter(|_| is_exp) {
                    Some((negative, p, q)) => {
                        let (first, second) = (self.expressions[&p].at(Binding::Sign), of(&q));
                        let sign = negative.then(|| quote!(-));
                        quote!(#scalar::exp_product(#sign #first, #second))
                    }
                    None => {
                        let (method, argument) = (method(function.name()), of(a));
                        quote!(#scalar::#method(#argument))
                    }
                };
                (call, vec![a])
            }
            Math::Pair(function, [a, b]) => {
                let (method, first, second) = (method(function.name()), of(a), of(b));
                (quote!(#scalar::#method(#first, #second)), vec![a, b])
            }
            _ => (TokenStream::new(), Vec::new()),
        };
        self.of_operands(tokens, Binding::Atom, &operands)
    }

    /// a·b + c, a·b − c or c − a·b as one operation. The difference of two products stays as
    /// it is: it is zero where they are equal, and of a fused one a rounding error is left.
    fn fused(&self, id: Id) -> Option<Expression> {
        let dag = self.lowered.dag();
        let (first, second, is_sum) = match dag[id] {
            Math::Add([a, b]) => (a, b, true),
            Math::Sub([a, b]) => (a, b, false),
            _ => return None,
        };
        let is_product = |id: &Id| matches!(dag[*id], Math::Mul(_));
        if !self.fuses || (!is_sum && is_product(&first) && is_product(&second)) {
            return None;
        }
        // one that is computed for itself anyway gains nothing
        let is_free =
            |id: &Id| self.uses.get(id) == Some(&1) && self.expressions[id].operations > 0;
        let product = [second, first]
            .into_iter()
            .find(|id| is_product(id) && is_free(id))?;
        let Math::Mul([a, b]) = dag[product] else {
            return None;
        };
        let other = if product == second { first } else { second };
        let [a, b, c] = [a, b, other].map(|id| &self.expressions[&id]);
        let scalar = &self.scalar;
        let operations = 1 + a.operations + b.operations + c.operations;
        let (minus_a, minus_c) = if is_sum {
            (false, false)
        } else if product == second {
            (true, false)
        } else {
            (false, true)
        };
        let term = |expression: &Expression, minus: bool| {
            if minus {
                let operand = expression.at(Binding::Sign);
                quote!(-#operand)
            } else {
                expression.at(Binding::Sum)
            }
        };
        let (a, b, c) = (term(a, minus_a), term(b, false), term(c, minus_c));
        Some(Expression {
            operations,
            ..Expression::atom(quote!(#scalar::fused(#a, #b, #c)))
        })
    }

    /// A readable name for a shared node.
    fn name(&mut self, id: Id) -> Ident {
        match suggestion(self.lowered, id) {
            // in lower case, which no constant around the declaration is
            Some(wish) => self.names.take(&wish.to_lowercase()),
            None => self.names.number("u"),
        }
    }
}

#[cfg(test)]
mod tests;
