//! The rules at random points, goals that the optimiser has to reach, and what it must leave
//! alone.

use std::collections::BTreeMap;

use egg::{ENodeOrVar, Id, Language, PatternAst};
use rustc_hash::FxHashMap;

use super::form::Form;
use super::graph::{Facts, Graph};
use super::rules::RULES;
use super::snapshot::Snapshot;
use super::{Count, Optimiser, Source};
use crate::algebra::{Dag, Function, Math, Name, evaluate, to_text};

/// Points at which every rule is tried.
const POINTS: usize = 100;

/// Two ways to compute the same differ by rounding only; differences of terms of the order of
/// 10 leave at most this.
const ROUNDING: f64 = 1e-12;

/// A reproducible stream of numbers (Steele, Lea & Flood 2014: SplitMix).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, bound: usize) -> usize {
        (self.bits() % bound as u64) as usize
    }

    /// A number in (0.5, 2), of either sign unless it has to be positive.
    fn number(&mut self, positive: bool) -> f64 {
        let size = 0.5 + 1.5 * (self.bits() >> 11) as f64 * 2f64.powi(-53);
        if positive || self.bits().is_multiple_of(2) {
            size
        } else {
            -size
        }
    }
}

/// One side of a rule as an expression; pattern variables become variables of their name.
fn side(dag: &mut Dag, pattern: &PatternAst<Math>) -> Id {
    let mut image: Vec<Id> = Vec::new();
    for node in pattern {
        image.push(match node {
            ENodeOrVar::Var(var) => dag.variable(&Name::new(&var.to_string())),
            ENodeOrVar::ENode(node) => {
                let node = node.clone();
                dag.insert(node.map_children(|child| image[usize::from(child)]))
            }
        });
    }
    image[image.len() - 1]
}

#[test]
fn every_rule_is_an_identity() {
    let mut random = Random(1);
    for rule in RULES.iter() {
        let mut dag = Dag::new();
        let sides = [0, 1].map(|index| side(&mut dag, &rule.sides[index]));
        // the one rule about roots is about what is not negative
        let positive = rule.name == "square-root";
        for _ in 0..POINTS {
            let point: BTreeMap<Name, f64> = ["?a", "?b", "?c"]
                .map(|name| (Name::new(name), random.number(positive)))
                .into();
            let values = evaluate(&dag, &sides, &point);
            assert!(
                (values[0] - values[1]).abs() <= ROUNDING,
                "{}: {values:?} at {point:?}",
                rule.name
            );
        }
    }
}

#[test]
fn every_rule_finds_its_own_left_side() {
    for rule in RULES.iter() {
        let mut dag = Dag::new();
        let root = side(&mut dag, &rule.sides[0]);
        let source = Source {
            dag: &dag,
            is_fixed: &|_| false,
            is_atom: &|_| false,
            functions: vec![vec![root]],
        };
        let (form, results, _) = Form::new(&source, &source.functions, &FxHashMap::default());
        let mut graph = Graph::new(Facts {
            constants: form.constants,
        });
        let mut image: Vec<Id> = Vec::new();
        for node in &form.nodes {
            let node = node.map_children(|child| image[usize::from(child)]);
            image.push(graph.add(node));
        }
        graph.rebuild();
        let class = graph.find(image[usize::from(results[0][0])]);
        let snapshot = Snapshot::new(&graph);
        let mut found = Vec::new();
        for operation in snapshot.operations(class) {
            rule.search.find(&snapshot, class, operation, &mut found);
        }
        assert!(!found.is_empty(), "{}", rule.name);
    }
}

/// One function, and the same optimised. `k` is a parameter.
struct Optimised {
    given: (Dag, Vec<Id>),
    found: (Dag, Vec<Id>),
}

impl Optimised {
    fn new(build: impl FnOnce(&mut Dag) -> Vec<Id>) -> Self {
        let mut dag = Dag::new();
        let roots = build(&mut dag);
        let source = Source {
            dag: &dag,
            is_fixed: &|id| is_fixed(&dag, id),
            is_atom: &|_| false,
            functions: vec![roots.clone()],
        };
        let mut found = Dag::new();
        let images = Optimiser::default().optimise(&source, &mut |node| found.insert(node));
        Self {
            found: (found, images.concat()),
            given: (dag, roots),
        }
    }

    fn counts(&self) -> [Count; 2] {
        [&self.given, &self.found]
            .map(|(dag, roots)| Count::shared(dag, roots, |id| is_fixed(dag, id)))
    }

    fn texts(&self) -> Vec<String> {
        let (dag, roots) = &self.found;
        roots.iter().map(|&root| to_text(dag, root)).collect()
    }
}

fn is_fixed(dag: &Dag, id: Id) -> bool {
    dag.variables([id]).iter().all(|name| name.as_str() == "k")
}

fn variables<const N: usize>(dag: &mut Dag, names: [&str; N]) -> [Id; N] {
    names.map(|name| dag.variable(&Name::new(name)))
}

fn mul(dag: &mut Dag, a: Id, b: Id) -> Id {
    dag.insert(Math::Mul([a, b]))
}

#[test]
fn the_elliptic_scheme_takes_seven_operations() {
    let optimised = Optimised::new(|dag| {
        let [x0, x1, y0, y1, k] = variables(dag, ["x₀", "x₁", "y₀", "y₁", "k"]);
        let [first, second, third] = [(x1, x1), (x0, x1), (x0, x0)].map(|(a, b)| mul(dag, a, b));
        let (two, sum) = (dag.integer(2), dag.add(y1, y0));
        let twice = mul(dag, two, x1);
        vec![sum, dag.sum([first, second, third, k]), dag.add(twice, x0)]
    });
    assert_eq!(optimised.counts().map(|count| count.operations), [9, 7]);
}

#[test]
fn divisions_are_shared() {
    let optimised = Optimised::new(|dag| {
        let [x, y, z] = variables(dag, ["x", "y", "z"]);
        vec![dag.div(x, z), dag.div(y, z)]
    });
    assert_eq!(optimised.counts().map(|count| count.weighted), [8, 6]);
    assert_eq!(optimised.texts().len(), 2);
}

#[test]
fn what_depends_on_parameters_alone_is_free() {
    let optimised = Optimised::new(|dag| {
        let [x, k] = variables(dag, ["x", "k"]);
        let (half, three) = (dag.fraction(1, 2), dag.integer(3));
        let product = mul(dag, half, x);
        let product = mul(dag, k, product);
        vec![mul(dag, three, product)]
    });
    assert_eq!(optimised.counts().map(|count| count.operations), [3, 1]);
}

#[test]
fn the_square_of_a_root_is_its_argument_where_that_is_not_negative() {
    let square_of_root = |of_squares: bool| {
        Optimised::new(move |dag| {
            let [x, y] = variables(dag, ["x", "y"]);
            let [a, b] = if of_squares {
                [(x, x), (y, y)].map(|(a, b)| mul(dag, a, b))
            } else {
                [x, y]
            };
            let sum = dag.add(a, b);
            let root = dag.call(Function::Sqrt, sum);
            vec![mul(dag, root, root)]
        })
    };
    assert_eq!(square_of_root(true).counts()[1].weighted, 3);
    // where x + y is negative there is no root, and none must come out
    let [given, found] = square_of_root(false).counts();
    assert_eq!(given, found);
}

#[test]
fn differences_of_the_ends_stay() {
    let optimised = Optimised::new(|dag| {
        let [x0, x1, y] = variables(dag, ["x₀", "x₁", "y"]);
        let difference = dag.sub(x1, x0);
        let sinc = dag.call(Function::Sinc, difference);
        // x₁ − x₀ + x₀ would be one operation less, and wrong in its last digits
        let sum = dag.add(difference, x0);
        let scaled = mul(dag, y, difference);
        vec![sinc, sum, scaled, dag.add(scaled, y)]
    });
    let (dag, roots) = &optimised.found;
    let Math::Call(Function::Sinc, argument) = dag[roots[0]] else {
        panic!("{:?}", optimised.texts());
    };
    assert_eq!(to_text(dag, argument), "x₁ - x₀");
    assert!(dag.reachable([roots[1]]).contains(&argument));
    assert!(dag.reachable([roots[2]]).contains(&argument));
}

/// Random sums, products, quotients and roots over three variables and a parameter.
fn random_operations(dag: &mut Dag, random: &mut Random) -> Vec<Id> {
    let mut nodes = variables(dag, ["x", "y", "z", "k"]).to_vec();
    nodes.extend([dag.integer(2), dag.fraction(1, 2), dag.fraction(-3, 7)]);
    for _ in 0..3 + random.below(25) {
        let operands = [0, 0].map(|_| nodes[random.below(nodes.len())]);
        let node = match random.below(9) {
            0 | 1 => Math::Add(operands),
            2 | 3 => Math::Sub(operands),
            4..=6 => Math::Mul(operands),
            7 => Math::Neg(operands[0]),
            _ => Math::Div(operands),
        };
        nodes.push(dag.insert(node));
    }
    let square = nodes[nodes.len() - 1];
    let square = mul(dag, square, square);
    nodes.push(dag.call(Function::Sqrt, square));
    (0..4).map(|_| nodes[random.below(nodes.len())]).collect()
}

#[test]
fn random_functions_keep_their_values_and_never_cost_more() {
    let mut random = Random(2);
    for case in 0..60 {
        let optimised = Optimised::new(|dag| random_operations(dag, &mut random));
        let [given, found] = optimised.counts();
        assert!(found.weighted <= given.weighted, "case {case}");
        for _ in 0..5 {
            let point: BTreeMap<Name, f64> = ["x", "y", "z", "k"]
                .map(|name| (Name::new(name), random.number(true)))
                .into();
            let (dag, roots) = &optimised.given;
            let bounded = crate::algebra::evaluate_bounded(dag, roots, &point);
            let values = evaluate(&optimised.found.0, &optimised.found.1, &point);
            for ((expected, error), value) in bounded.into_iter().zip(values) {
                // a division by what should be zero has no value to compare
                let comparable = error.is_finite() && error <= 1e-6 * expected.abs();
                assert!(
                    !comparable || (value - expected).abs() <= 100.0 * error,
                    "case {case}: {value} instead of {expected} ± {error}"
                );
            }
        }
    }
}

#[test]
fn the_same_function_gives_the_same_result() {
    let run = || {
        let mut random = Random(3);
        Optimised::new(|dag| random_operations(dag, &mut random)).texts()
    };
    assert_eq!(run(), run());
}

#[test]
fn a_chain_is_optimised_cluster_by_cluster() {
    const MASSES: usize = 60;
    let optimised = Optimised::new(|dag| {
        let q: Vec<Id> = (0..MASSES)
            .map(|i| dag.variable(&Name::new(&format!("q{i}"))))
            .collect();
        let forces: Vec<Id> = q
            .windows(2)
            .map(|pair| {
                // r + r² + r³, in products
                let r = dag.sub(pair[1], pair[0]);
                let square = mul(dag, r, r);
                let cube = mul(dag, square, r);
                dag.sum([r, square, cube])
            })
            .collect();
        forces
            .windows(2)
            .map(|pair| dag.sub(pair[1], pair[0]))
            .collect()
    });
    let [given, found] = optimised.counts();
    // r·(1 + r·(1 + r)) saves nothing, r + r²·(1 + r) nothing either: shared forces stay so
    assert_eq!(
        given.operations,
        5 * (MASSES as u64 - 1) + MASSES as u64 - 2
    );
    assert!(found.operations <= given.operations);
}
