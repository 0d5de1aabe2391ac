//! The rules of derivatives and of divided differences as rewrites, and their agreement with
//! the structural functions.
//!
//! The language of declarations gets the operators d (derivative in a variable), Δ (difference
//! of the two ends), μ (mean of the two ends), and the values at either end.

use egg::{
    Analysis, CostFunction, EGraph, Extractor, Id, Language, RecExpr, Rewrite, Runner, Var,
    define_language, rewrite,
};

use super::formula::formula;
use crate::algebra::{
    Dag, Function, Math, Name, PairFunction, Rational, Verdict, at_end, at_start, decide_zero,
    differentiate, divided_difference, to_text,
};

define_language! {
    enum Calculus {
        "d" = Derivative([Id; 2]),
        "delta" = Difference(Id),
        "mean" = Mean(Id),
        "start" = Start(Id),
        "end" = End(Id),
        "pi" = Pi,
        "+" = Add([Id; 2]),
        "-" = Sub([Id; 2]),
        "*" = Mul([Id; 2]),
        "/" = Div([Id; 2]),
        "neg" = Neg(Id),
        "^" = Pow([Id; 2]),
        Constant(Rational),
        Call(Function, Id),
        Pair(PairFunction, [Id; 2]),
        Variable(Name),
    }
}

fn derivative_rules() -> Vec<Rewrite<Calculus, ()>> {
    vec![
        rewrite!("d-constant";      "(d ?x ?c)"         => "0" if is_other_leaf("?x", "?c")),
        rewrite!("d-variable";      "(d ?x ?x)"         => "1"),
        rewrite!("d-negative";      "(d ?x (neg ?u))"   => "(neg (d ?x ?u))"),
        rewrite!("d-sum";           "(d ?x (+ ?u ?v))"  => "(+ (d ?x ?u) (d ?x ?v))"),
        rewrite!("d-difference";    "(d ?x (- ?u ?v))"  => "(- (d ?x ?u) (d ?x ?v))"),
        rewrite!("d-product";       "(d ?x (* ?u ?v))"  => "(+ (* ?u (d ?x ?v)) (* ?v (d ?x ?u)))"),
        rewrite!("d-quotient";      "(d ?x (/ ?u ?v))"  => "(/ (- (* ?v (d ?x ?u)) (* ?u (d ?x ?v))) (^ ?v 2))"),
        rewrite!("d-power";         "(d ?x (^ ?u ?n))"  => "(* (* ?n (^ ?u (- ?n 1))) (d ?x ?u))" if is_constant("?n")),
        rewrite!("d-general-power"; "(d ?x (^ ?u ?v))"  => "(* (^ ?u ?v) (d ?x (* ?v (ln ?u))))" if is_not_constant("?v")),
        rewrite!("d-root";          "(d ?x (sqrt ?u))"  => "(/ (d ?x ?u) (* 2 (sqrt ?u)))"),
        rewrite!("d-exponential";   "(d ?x (exp ?u))"   => "(* (exp ?u) (d ?x ?u))"),
        rewrite!("d-logarithm";     "(d ?x (ln ?u))"    => "(/ (d ?x ?u) ?u)"),
        rewrite!("d-sine";          "(d ?x (sin ?u))"   => "(* (cos ?u) (d ?x ?u))"),
        rewrite!("d-cosine";        "(d ?x (cos ?u))"   => "(neg (* (sin ?u) (d ?x ?u)))"),
        rewrite!("d-tangent";       "(d ?x (tan ?u))"   => "(/ (d ?x ?u) (^ (cos ?u) 2))"),
        rewrite!("d-sinh";          "(d ?x (sinh ?u))"  => "(* (cosh ?u) (d ?x ?u))"),
        rewrite!("d-cosh";          "(d ?x (cosh ?u))"  => "(* (sinh ?u) (d ?x ?u))"),
        rewrite!("d-tanh";          "(d ?x (tanh ?u))"  => "(* (- 1 (^ (tanh ?u) 2)) (d ?x ?u))"),
        rewrite!("d-arc-sine";      "(d ?x (asin ?u))"  => "(/ (d ?x ?u) (sqrt (- 1 (^ ?u 2))))"),
        rewrite!("d-arc-cosine";    "(d ?x (acos ?u))"  => "(neg (/ (d ?x ?u) (sqrt (- 1 (^ ?u 2)))))"),
        rewrite!("d-arc-tangent";   "(d ?x (atan ?u))"  => "(/ (d ?x ?u) (+ 1 (^ ?u 2)))"),
        rewrite!("d-sinc";          "(d ?x (sinc ?u))"  => "(d ?x (/ (sin ?u) ?u))"),
        rewrite!("d-sinhc";         "(d ?x (sinhc ?u))" => "(d ?x (/ (sinh ?u) ?u))"),
        rewrite!("d-ln-dd";   "(d ?x (ln_dd ?a ?b))"    => "(d ?x (/ (- (ln ?b) (ln ?a)) (- ?b ?a)))"),
        rewrite!("d-asin-dd"; "(d ?x (asin_dd ?a ?b))"  => "(d ?x (/ (- (asin ?b) (asin ?a)) (- ?b ?a)))"),
        rewrite!("d-atan-dd"; "(d ?x (atan_dd ?a ?b))"  => "(d ?x (/ (- (atan ?b) (atan ?a)) (- ?b ?a)))"),
    ]
}

fn difference_rules() -> Vec<Rewrite<Calculus, ()>> {
    vec![
        rewrite!("delta-constant";    "(delta ?c)"          => "0" if is_constant("?c")),
        rewrite!("delta-negative";    "(delta (neg ?u))"    => "(neg (delta ?u))"),
        rewrite!("delta-sum";         "(delta (+ ?u ?v))"   => "(+ (delta ?u) (delta ?v))"),
        rewrite!("delta-difference";  "(delta (- ?u ?v))"   => "(- (delta ?u) (delta ?v))"),
        rewrite!("delta-product";     "(delta (* ?u ?v))"   => "(+ (* (mean ?u) (delta ?v)) (* (mean ?v) (delta ?u)))"),
        rewrite!("delta-quotient";    "(delta (/ ?u ?v))"   => "(/ (- (* (mean ?v) (delta ?u)) (* (mean ?u) (delta ?v))) (* (start ?v) (end ?v)))"),
        rewrite!("delta-square";      "(delta (^ ?u 2))"    => "(* (+ (end ?u) (start ?u)) (delta ?u))"),
        rewrite!("delta-cube";        "(delta (^ ?u 3))"    => "(* (+ (+ (^ (end ?u) 2) (* (end ?u) (start ?u))) (^ (start ?u) 2)) (delta ?u))"),
        rewrite!("delta-fourth";      "(delta (^ ?u 4))"    => "(* (+ (^ (end ?u) 2) (^ (start ?u) 2)) (delta (^ ?u 2)))"),
        rewrite!("delta-inverse";     "(delta (^ ?u -1))"   => "(neg (/ (delta ?u) (* (start ?u) (end ?u))))"),
        rewrite!("delta-three-halves"; "(delta (^ ?u 3/2))" => "(delta (^ (sqrt ?u) 3))"),
        rewrite!("delta-root";        "(delta (sqrt ?u))"   => "(/ (delta ?u) (+ (sqrt (end ?u)) (sqrt (start ?u))))"),
        rewrite!("delta-exponential"; "(delta (exp ?u))"    => "(* (* (exp (mean ?u)) (sinhc (/ (delta ?u) 2))) (delta ?u))"),
        rewrite!("delta-logarithm";   "(delta (ln ?u))"     => "(* (ln_dd (start ?u) (end ?u)) (delta ?u))"),
        rewrite!("delta-sine";        "(delta (sin ?u))"    => "(* (* (cos (mean ?u)) (sinc (/ (delta ?u) 2))) (delta ?u))"),
        rewrite!("delta-cosine";      "(delta (cos ?u))"    => "(neg (* (* (sin (mean ?u)) (sinc (/ (delta ?u) 2))) (delta ?u)))"),
        rewrite!("delta-tangent";     "(delta (tan ?u))"    => "(* (/ (sinc (delta ?u)) (* (cos (start ?u)) (cos (end ?u)))) (delta ?u))"),
        rewrite!("delta-sinh";        "(delta (sinh ?u))"   => "(* (* (cosh (mean ?u)) (sinhc (/ (delta ?u) 2))) (delta ?u))"),
        rewrite!("delta-cosh";        "(delta (cosh ?u))"   => "(* (* (sinh (mean ?u)) (sinhc (/ (delta ?u) 2))) (delta ?u))"),
        rewrite!("delta-tanh";        "(delta (tanh ?u))"   => "(* (/ (sinhc (delta ?u)) (* (cosh (start ?u)) (cosh (end ?u)))) (delta ?u))"),
        rewrite!("delta-arc-sine";    "(delta (asin ?u))"   => "(* (asin_dd (start ?u) (end ?u)) (delta ?u))"),
        rewrite!("delta-arc-cosine";  "(delta (acos ?u))"   => "(neg (* (asin_dd (start ?u) (end ?u)) (delta ?u)))"),
        rewrite!("delta-arc-tangent"; "(delta (atan ?u))"   => "(* (atan_dd (start ?u) (end ?u)) (delta ?u))"),
        rewrite!("delta-power";       "(delta (^ ?u ?v))"   => "(delta (exp (* ?v (ln ?u))))" if is_not_constant("?v")),
    ]
}

type Graph<A> = EGraph<Calculus, A>;

fn var(name: &str) -> Var {
    name.parse().expect("a pattern variable")
}

fn is_constant_class<A: Analysis<Calculus>>(graph: &Graph<A>, id: Id) -> bool {
    graph[id]
        .iter()
        .any(|node| matches!(node, Calculus::Constant(_) | Calculus::Pi))
}

fn is_constant(name: &str) -> impl Fn(&mut Graph<()>, Id, &egg::Subst) -> bool + use<> {
    let var = var(name);
    move |graph, _, subst| is_constant_class(graph, subst[var])
}

fn is_not_constant(name: &str) -> impl Fn(&mut Graph<()>, Id, &egg::Subst) -> bool + use<> {
    let var = var(name);
    move |graph, _, subst| !is_constant_class(graph, subst[var])
}

/// Whether c is a constant or a variable other than x.
fn is_other_leaf(x: &str, c: &str) -> impl Fn(&mut Graph<()>, Id, &egg::Subst) -> bool + use<> {
    let (x, c) = (var(x), var(c));
    move |graph, _, subst| {
        graph[subst[c]].iter().any(|node| node.is_leaf())
            && graph.find(subst[x]) != graph.find(subst[c])
    }
}

/// Counts nodes; operators that the rules eliminate are not to be extracted.
struct Eliminated;

impl CostFunction<Calculus> for Eliminated {
    type Cost = f64;

    fn cost<C: FnMut(Id) -> f64>(&mut self, node: &Calculus, costs: C) -> f64 {
        let mut costs = costs;
        let own = match node {
            Calculus::Derivative(_) => f64::INFINITY,
            // only Δ of a variable stays
            Calculus::Difference(u) if costs(*u) > 1.0 => f64::INFINITY,
            _ => 1.0,
        };
        node.fold(own, |sum, child| sum + costs(child))
    }
}

/// Saturates with `rules` and returns what is left of `root`.
fn rewritten(root: &RecExpr<Calculus>, rules: &[Rewrite<Calculus, ()>]) -> RecExpr<Calculus> {
    let runner = Runner::<Calculus, ()>::default()
        .with_expr(root)
        .with_iter_limit(30)
        .with_node_limit(20_000)
        .run(rules);
    let (cost, best) = Extractor::new(&runner.egraph, Eliminated).find_best(runner.roots[0]);
    assert!(cost.is_finite(), "the rules do not cover {root}");
    best
}

/// `root` of the DAG in the larger language.
fn lifted(dag: &Dag, root: Id) -> RecExpr<Calculus> {
    let mut expression = RecExpr::default();
    lift(dag, root, &mut expression);
    expression
}

fn lift(dag: &Dag, root: Id, into: &mut RecExpr<Calculus>) -> Id {
    let mut child = |id: Id| lift(dag, id, into);
    let node = match dag[root].clone() {
        Math::Pi => Calculus::Pi,
        Math::Constant(value) => Calculus::Constant(value),
        Math::Variable(name) => Calculus::Variable(name),
        Math::Neg(u) => Calculus::Neg(child(u)),
        Math::Add(both) => Calculus::Add(both.map(child)),
        Math::Sub(both) => Calculus::Sub(both.map(child)),
        Math::Mul(both) => Calculus::Mul(both.map(child)),
        Math::Div(both) => Calculus::Div(both.map(child)),
        Math::Pow(both) => Calculus::Pow(both.map(child)),
        Math::Call(function, u) => Calculus::Call(function, child(u)),
        Math::Pair(function, both) => Calculus::Pair(function, both.map(child)),
    };
    into.add(node)
}

/// An expression of the larger language in the DAG, ends and means carried out.
fn lowered(dag: &mut Dag, expression: &RecExpr<Calculus>, root: Id, states: &[Name]) -> Id {
    let mut lower = |id: Id| lowered(dag, expression, id, states);
    match expression[root].clone() {
        Calculus::Derivative(_) => panic!("a derivative is left"),
        Calculus::Difference(u) => {
            let u = lower(u);
            let (end, start) = (at_end(dag, u, states), at_start(dag, u, states));
            dag.sub(end, start)
        }
        Calculus::Mean(u) => {
            let u = lower(u);
            let (end, start) = (at_end(dag, u, states), at_start(dag, u, states));
            dag.mean(end, start)
        }
        Calculus::Start(u) => {
            let u = lower(u);
            at_start(dag, u, states)
        }
        Calculus::End(u) => {
            let u = lower(u);
            at_end(dag, u, states)
        }
        Calculus::Pi => dag.pi(),
        Calculus::Constant(value) => dag.constant(value),
        Calculus::Variable(name) => dag.variable(&name),
        Calculus::Neg(u) => {
            let u = lower(u);
            dag.neg(u)
        }
        Calculus::Add(both) => {
            let [u, v] = both.map(lower);
            dag.add(u, v)
        }
        Calculus::Sub(both) => {
            let [u, v] = both.map(lower);
            dag.sub(u, v)
        }
        Calculus::Mul(both) => {
            let [u, v] = both.map(lower);
            dag.mul(u, v)
        }
        Calculus::Div(both) => {
            let [u, v] = both.map(lower);
            dag.div(u, v)
        }
        Calculus::Pow(both) => {
            let [u, v] = both.map(lower);
            dag.pow(u, v)
        }
        Calculus::Call(function, u) => {
            let u = lower(u);
            dag.call(function, u)
        }
        Calculus::Pair(function, both) => {
            let [u, v] = both.map(lower);
            dag.pair(function, u, v)
        }
    }
}

/// Checks that ∂`text`/∂x is the same both ways.
fn derivatives_agree(text: &str) {
    let mut dag = Dag::new();
    let root = formula(&mut dag, text);
    let mut goal = lifted(&dag, root);
    let expression = goal.root();
    let x = goal.add(Calculus::Variable(Name::new("x")));
    goal.add(Calculus::Derivative([x, expression]));
    let rewritten = rewritten(&goal, &derivative_rules());
    let by_rules = lowered(&mut dag, &rewritten, rewritten.root(), &[]);
    let by_structure = differentiate(&mut dag, root, &Name::new("x"));
    let difference = dag.sub(by_rules, by_structure);
    assert_eq!(
        decide_zero(&mut dag, difference),
        Verdict::Proved,
        "{text}: {} and {}",
        to_text(&dag, by_rules),
        to_text(&dag, by_structure)
    );
}

/// Checks that Δ`text` is the same both ways; x and y vary.
fn differences_agree(text: &str) {
    let states = ["x", "y"].map(Name::new);
    let mut dag = Dag::new();
    let root = formula(&mut dag, text);
    let mut goal = lifted(&dag, root);
    let expression = goal.root();
    goal.add(Calculus::Difference(expression));
    let rewritten = rewritten(&goal, &difference_rules());
    let by_rules = lowered(&mut dag, &rewritten, rewritten.root(), &states);
    let mut by_structure = dag.integer(0);
    for (name, coefficient) in states
        .iter()
        .zip(divided_difference(&mut dag, root, &states))
    {
        let end = dag.variable(&name.at_end());
        let start = dag.variable(&name.at_start());
        let difference = dag.sub(end, start);
        let term = dag.mul(coefficient, difference);
        by_structure = dag.add(by_structure, term);
    }
    let difference = dag.sub(by_rules, by_structure);
    assert_eq!(
        decide_zero(&mut dag, difference),
        Verdict::Proved,
        "{text}: {} and {}",
        to_text(&dag, by_rules),
        to_text(&dag, by_structure)
    );
}

/// Formulas that meet every rule, most with an inner function.
const FORMULAS: &[&str] = &[
    "pi*x - 3/4",
    "-(x + y)*(x - 2*y)",
    "x/(1 + x*y)",
    "(x - y)^2",
    "(x*y + 1)^3",
    "x^4 - y^4",
    "(x + y)^(-1)",
    "(x^2 + y)^(3/2)",
    "sqrt(1 + x^2)",
    "exp(2*x - y)",
    "x*ln(x + y)",
    "sin(x*y)",
    "cos(2*x + y)",
    "tan(x)",
    "sinh(x - y)",
    "cosh(x)*y",
    "tanh(x + y)",
    "asin(x)*y",
    "acos(x*y)",
    "atan(x/y)",
    "x^y",
    "y^2 - x^3 - 2*x",
    "(x^2 + y^2)/2 + x^2*y - y^3/3",
];

#[test]
fn derivatives_by_rules_agree_with_derivatives_by_structure() {
    for text in FORMULAS {
        derivatives_agree(text);
    }
    for text in [
        "sinc(x*y)",
        "sinhc(x + y)",
        "ln_dd(x, y + 1)",
        "ln_dd(y, x^2)",
        "asin_dd(x, y)",
        "atan_dd(x*y, x)",
    ] {
        derivatives_agree(text);
    }
}

#[test]
fn differences_by_rules_agree_with_differences_by_structure() {
    for text in FORMULAS {
        differences_agree(text);
    }
}
