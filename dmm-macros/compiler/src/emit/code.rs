//! Straight-line code: a node used once is written where it is used, as long as the line stays
//! readable; a node used more often is computed once, by a `let`.

use std::collections::{BTreeMap, HashMap};

use egg::Language;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::constant::nearest_double;
use super::lower::Lowered;
use super::names::Names;
use super::readable::suggestion;
use crate::algebra::{Function, Id, Math};

/// The most operations that are written as one expression.
const LONGEST_EXPRESSION: usize = 10;

/// How tightly an expression binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Sign,
    Atom,
}

/// An expression of emitted code.
#[derive(Clone)]
struct Expression {
    tokens: TokenStream,
    binding: Binding,
    operations: usize,
}

impl Expression {
    fn atom(tokens: TokenStream) -> Self {
        Self {
            tokens,
            binding: Binding::Atom,
            operations: 0,
        }
    }

    /// In parentheses if it binds less tightly than its place asks for.
    fn at(&self, place: Binding) -> TokenStream {
        let tokens = &self.tokens;
        if self.binding < place {
            quote!((#tokens))
        } else {
            tokens.clone()
        }
    }
}

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
    /// A body that evaluates `roots`, in a scope where `names` are taken. `known` are the nodes
    /// with a value outside: variables, and what was computed before.
    pub(super) fn new(
        lowered: &'a Lowered,
        scalar: TokenStream,
        names: Names,
        known: &BTreeMap<Id, TokenStream>,
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
        block.count_uses(roots);
        block
    }

    /// The same body with a·b + c as one operation, for functions that are evaluated in every
    /// iteration. It takes 2 % (elliptic curve) to 15 % (Hénon–Heiles) off a step's iterations
    /// where the processor has the instruction, and changes nothing where it has not.
    pub(super) fn fusing(mut self) -> Self {
        self.fuses = true;
        self
    }

    /// Makes the values of `roots` available.
    pub(super) fn compute(&mut self, roots: &[Id]) {
        for id in self.unknown(roots) {
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

    /// Whether a node has more than one use.
    pub(super) fn is_shared(&self, id: Id) -> bool {
        self.uses.get(&id).is_some_and(|&uses| uses > 1)
    }

    /// Gives `id` the value of `tokens`, under a name.
    pub(super) fn define(&mut self, id: Id, tokens: &TokenStream) {
        let name = self.name(id);
        self.statements.push(quote!(let #name = #tokens;));
        self.expressions.insert(id, Expression::atom(quote!(#name)));
    }

    /// Gives the value of `id` a name, if it has none.
    pub(super) fn name_value(&mut self, id: Id) {
        self.compute(&[id]);
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
    pub(super) fn fresh(&mut self, stem: &str) -> Ident {
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

    /// The nodes that `roots` need and that have no value yet, children before parents.
    fn unknown(&self, roots: &[Id]) -> Vec<Id> {
        let mut nodes = std::collections::BTreeSet::new();
        let mut stack = roots.to_vec();
        while let Some(id) = stack.pop() {
            if !self.expressions.contains_key(&id) && nodes.insert(id) {
                self.lowered.dag()[id].for_each(|child| stack.push(child));
            }
        }
        nodes.into_iter().collect()
    }

    fn count_uses(&mut self, roots: &[Id]) {
        for id in self.unknown(roots) {
            let children: Vec<Id> = self.lowered.dag()[id].children().to_vec();
            for child in children {
                *self.uses.entry(child).or_default() += 1;
            }
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
            Math::Pow([a, b]) => {
                let (base, exponent) = (of(a).at(Binding::Sum), of(b).at(Binding::Sum));
                let power = match self.lowered.dag().as_integer(*b).map(i32::try_from) {
                    Some(Ok(n)) => {
                        let n = Literal::i32_unsuffixed(n);
                        quote!(#scalar::powi(#base, #n))
                    }
                    _ => quote!(#scalar::powf(#base, #exponent)),
                };
                (power, Binding::Atom, vec![a, b])
            }
            Math::Call(Function::Exp, a) if let Some(factors) = self.lowered.secular(*a) => {
                let (negative, p, q) = factors;
                let (first, second) = (of(&p).at(Binding::Sign), of(&q).at(Binding::Sum));
                let sign = negative.then(|| quote!(-));
                (
                    quote!(#scalar::exp_product(#sign #first, #second)),
                    Binding::Atom,
                    vec![a],
                )
            }
            Math::Call(function, a) => {
                let (method, argument) = (method(function.name()), of(a).at(Binding::Sum));
                (quote!(#scalar::#method(#argument)), Binding::Atom, vec![a])
            }
            Math::Pair(function, [a, b]) => {
                let method = method(function.name());
                let (first, second) = (of(a).at(Binding::Sum), of(b).at(Binding::Sum));
                (
                    quote!(#scalar::#method(#first, #second)),
                    Binding::Atom,
                    vec![a, b],
                )
            }
        };
        let operations = 1 + children
            .into_iter()
            .map(|child| of(child).operations)
            .sum::<usize>();
        Expression {
            tokens,
            binding,
            operations,
        }
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
        let (minus_a, minus_c) = match (is_sum, product == second) {
            (true, _) => (false, false),
            (false, true) => (true, false),
            (false, false) => (false, true),
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
            Some(wish) => self.names.take(&wish),
            None => self.names.number("u"),
        }
    }
}

fn method(name: &str) -> Ident {
    quote::format_ident!("{name}")
}

/// The scalar nearest to `value`.
pub(super) fn constant(scalar: &TokenStream, value: f64) -> TokenStream {
    let value = double(value);
    quote!(#scalar::from_f64(#value))
}

/// A double as an expression.
pub(super) fn double(value: f64) -> TokenStream {
    let magnitude = if value.is_finite() {
        let literal = Literal::f64_unsuffixed(value.abs());
        quote!(#literal)
    } else {
        quote!(f64::INFINITY)
    };
    if value < 0.0 {
        quote!(-#magnitude)
    } else {
        magnitude
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parentheses_only_where_they_matter() {
        let mut source = crate::algebra::Dag::new();
        let [a, b, c] =
            ["a", "b", "c"].map(|name| source.variable(&crate::algebra::Name::new(name)));
        let sum = source.add(a, b);
        let product = source.mul(sum, c);
        let difference = source.sub(a, sum);
        let difference = source.sub(difference, product);
        let mut lowered = Lowered::new(Vec::new());
        let root = lowered.lower(&source, difference);
        let known: BTreeMap<Id, TokenStream> = [("a", a), ("b", b), ("c", c)]
            .map(|(name, id)| {
                let ident = quote::format_ident!("{name}");
                (lowered.lower(&source, id), quote!(#ident))
            })
            .into();
        let mut block = Block::new(&lowered, quote!(S), Names::default(), &known, &[root]);
        block.compute(&[root]);
        let value = block.value(root);
        let statements = block.statements();
        assert_eq!(
            quote!(#statements #value).to_string(),
            "let u1 = a + b ; a - u1 - c * u1"
        );
    }

    /// The code of `formula` in a, b, c and d where sums of products are fused.
    fn fused(formula: impl FnOnce(&mut crate::algebra::Dag, [Id; 4]) -> Id) -> String {
        let mut source = crate::algebra::Dag::new();
        let variables =
            ["a", "b", "c", "d"].map(|name| source.variable(&crate::algebra::Name::new(name)));
        let root = formula(&mut source, variables);
        let mut lowered = Lowered::new(Vec::new());
        let root = lowered.lower(&source, root);
        let known: BTreeMap<Id, TokenStream> = ["a", "b", "c", "d"]
            .into_iter()
            .zip(variables)
            .map(|(name, id)| {
                let ident = quote::format_ident!("{name}");
                (lowered.lower(&source, id), quote!(#ident))
            })
            .collect();
        let block = Block::new(&lowered, quote!(S), Names::default(), &known, &[root]);
        let mut block = block.fusing();
        block.compute(&[root]);
        let value = block.value(root);
        let statements = block.statements();
        quote!(#statements #value).to_string()
    }

    #[test]
    fn sums_of_products_are_fused() {
        let sum = fused(|dag, [a, b, c, _]| {
            let product = dag.mul(a, b);
            dag.add(product, c)
        });
        assert_eq!(sum, "S :: fused (a , b , c)");
        let difference = fused(|dag, [a, b, c, _]| {
            let product = dag.mul(a, b);
            dag.sub(c, product)
        });
        assert_eq!(difference, "S :: fused (- a , b , c)");
    }

    #[test]
    fn a_difference_of_products_and_a_product_with_a_name_are_not_fused() {
        let difference = fused(|dag, [a, b, c, d]| {
            let (first, second) = (dag.mul(a, b), dag.mul(c, d));
            dag.sub(first, second)
        });
        assert_eq!(difference, "a * b - c * d");
        let shared = fused(|dag, [a, b, c, _]| {
            let product = dag.mul(a, b);
            let sum = dag.add(product, c);
            dag.div(sum, product)
        });
        assert_eq!(shared, "let u1 = a * b ; (u1 + c) / u1");
    }

    #[test]
    fn functions_are_called_by_the_name_of_the_scalar() {
        assert_eq!(
            method(crate::algebra::Function::Sinc.name()).to_string(),
            "sinc"
        );
    }
}
