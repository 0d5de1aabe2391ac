//! Right and wrong declarations in disguise, and what the compiler says of them.
//!
//! A case starts from a system that conserves a quantity by the way it was made, written in
//! other ways by random identities; a wrong one has a small change as well. What is so is
//! decided apart from the compiler's normal form ([`truth`]).

#[path = "../accuracy/arithmetic.rs"]
#[allow(dead_code, reason = "the accuracy of emitted code uses the rest")]
mod arithmetic;
mod disguise;
mod families;
#[path = "../fuzz/random.rs"]
mod random;
mod term;
pub(crate) mod truth;

use dmm_compiler::diagnostics::Diagnostics;
use dmm_compiler::model::{Conserved, Model};
use dmm_compiler::program::{Functions, Program, Quantity};
use dmm_compiler::proofs::{Conservation, DomainCondition, Proved};
use dmm_compiler::{check, proofs, scheme, syntax};

use arithmetic::doubles;
pub(crate) use disguise::Disguise;
pub(crate) use families::FAMILIES;
use random::Random;
use truth::{Truth, is_inside, is_zero, point, truth};

/// Every other case is made wrong.
const WRONG: usize = 2;
/// The most identities by which a formula is disguised.
const MOST_STEPS: usize = 4;
/// Points that are tried on the other side of a condition.
const BEYOND: usize = 24;

/// What the compiler said of a declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Answer {
    Proved,
    /// The work that a proof may take ran out.
    OutOfWork,
    /// Everything was tried.
    NotDecided,
    Refuted,
    /// Another diagnostic.
    Other,
}

/// What became of a case.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    pub(crate) family: usize,
    pub(crate) declaration: String,
    pub(crate) truth: Truth,
    pub(crate) answer: Answer,
    /// The messages, or the conditions beyond which emitted code is finite and conserves
    /// nothing.
    pub(crate) remarks: Vec<String>,
    /// Conditions of the proofs.
    pub(crate) conditions: usize,
    /// Those on whose other side emitted code was run.
    pub(crate) beyond: usize,
    /// Those on whose other side it has finite values, and the claim does not hold.
    pub(crate) unguarded: usize,
}

/// The declaration of case `index` of the run `seed`, with its family.
pub(crate) fn declaration(disguise: &Disguise, seed: u64, index: u64) -> (usize, String) {
    let random = &mut Random::of_case(seed, index);
    let family = random.below(FAMILIES.len());
    let mut system = families::system(family, disguise, random);
    let is_wrong = random.once_in(WRONG);
    let any = system.any();
    let names = system.states.clone();
    let mut formulas = system.formulas_mut();
    let steps = random.below(MOST_STEPS + 1);
    for _ in 0..steps {
        let index = random.below(formulas.len());
        disguise.step(formulas[index], &any, random);
    }
    if is_wrong {
        let index = random.below(formulas.len());
        disguise::change(formulas[index], &names, random);
    }
    for _ in 0..random.below(2) {
        let index = random.below(formulas.len());
        disguise.step(formulas[index], &any, random);
    }
    (family, system.declaration())
}

/// Case `index` of the run `seed`.
pub(crate) fn case(disguise: &Disguise, seed: u64, index: u64) -> Case {
    let (family, declaration) = declaration(disguise, seed, index);
    let random = &mut Random::of_case(!seed, index);
    judge(family, declaration, random)
}

/// What is so, and what the compiler says.
fn judge(family: usize, declaration: String, random: &mut Random) -> Case {
    let mut case = Case {
        family,
        declaration,
        truth: Truth::Open,
        answer: Answer::Other,
        remarks: Vec::new(),
        conditions: 0,
        beyond: 0,
        unguarded: 0,
    };
    let mut diagnostics = Diagnostics::new();
    let model = case.declaration.parse().ok().and_then(|tokens| {
        let declaration = syntax::parse(tokens, &mut diagnostics)?;
        if !diagnostics.is_empty() {
            return None;
        }
        check::resolve(declaration, &mut diagnostics)
    });
    let Some(model) = model else {
        case.remarks = diagnostics.messages();
        return case;
    };
    case.truth = truth_of(&model, random);
    let proved = proofs::prove(model, &mut diagnostics);
    let messages = diagnostics.messages();
    case.answer = answer(&messages);
    case.remarks = messages;
    if let Some(proved) = proved {
        beyond_conditions(proved, &mut case, random);
    }
    case
}

/// Whether all that is declared holds.
fn truth_of(model: &Model, random: &mut Random) -> Truth {
    let mut all = Truth::Holds;
    for region in &model.regions {
        for psi in &region.conserved {
            match truth(model, region, psi.psi, random) {
                Truth::Holds => {}
                Truth::Fails => return Truth::Fails,
                Truth::Open => all = Truth::Open,
            }
        }
    }
    all
}

fn answer(messages: &[String]) -> Answer {
    let is = |code: &str| messages.iter().any(|message| message.contains(code));
    if messages.is_empty() {
        Answer::Proved
    } else if is("[PWS300]") {
        Answer::Refuted
    } else if !is("[PWS301]") {
        Answer::Other
    } else if is("the work that proofs may take ran out") {
        Answer::OutOfWork
    } else {
        Answer::NotDecided
    }
}

/// Runs the emitted operations on the other side of the conditions of the proofs.
fn beyond_conditions(proved: Proved, case: &mut Case, random: &mut Random) {
    let mut diagnostics = Diagnostics::new();
    let Some(scheme) = scheme::derive(proved, &mut diagnostics) else {
        case.answer = Answer::Other;
        case.remarks = diagnostics.messages();
        return;
    };
    let program = Program::new(&scheme);
    for (index, region) in scheme.model.regions.iter().enumerate() {
        let functions = &program.dynamics[index].functions;
        for (quantity, psi) in region.conserved.iter().enumerate() {
            let evidence = &scheme.regions[index].proved.evidence[quantity];
            let Conservation::Proved(conditions) = evidence else {
                continue;
            };
            for &condition in conditions {
                case.conditions += 1;
                match run_beyond(&scheme.model, index, psi, condition, functions, random) {
                    Beyond::NoPoint => {}
                    Beyond::Right => case.beyond += 1,
                    Beyond::Wrong(place) => {
                        case.beyond += 1;
                        let checked = &scheme.regions[index].checked;
                        if checked.iter().any(|one| {
                            one.condition == condition && one.quantities.contains(&quantity)
                        }) {
                            continue;
                        }
                        case.unguarded += 1;
                        let statement = condition.statement(&scheme.model.dag);
                        case.remarks.push(format!("beyond {statement}: {place:?}"));
                    }
                }
            }
        }
    }
}

/// What emitted code does on the other side of a condition.
enum Beyond {
    /// None of the points lies there.
    NoPoint,
    /// Its values are not finite, or the claim holds.
    Right,
    /// Its values are finite, and the claim does not hold.
    Wrong(truth::Point),
}

fn run_beyond(
    model: &Model,
    index: usize,
    psi: &Conserved,
    condition: DomainCondition,
    functions: &Functions,
    random: &mut Random,
) -> Beyond {
    let region = &model.regions[index];
    let mut seen = false;
    for _ in 0..BEYOND {
        let point = point(model, random);
        if !is_violated(model, condition, &point) || !is_inside(model, region, &point) {
            continue;
        }
        seen = true;
        let is_finite = |quantity: Quantity| {
            functions.get(quantity).is_none_or(|function| {
                let roots = function.results.roots();
                let values = doubles(functions.lowered.dag(), &roots, &point);
                values.iter().all(|value| value.is_finite())
            })
        };
        let at_point = [
            Quantity::VectorField,
            Quantity::Conserved,
            Quantity::Multiplier,
        ];
        let runs = at_point.into_iter().all(is_finite);
        if runs && is_zero(model, region, psi.psi, &point) == Some(false) {
            return Beyond::Wrong(point);
        }
    }
    if seen { Beyond::Right } else { Beyond::NoPoint }
}

/// Whether a point lies clearly on the other side. Where a condition has no value, it is not
/// the one to look at.
fn is_violated(model: &Model, condition: DomainCondition, point: &truth::Point) -> bool {
    let value = |u| doubles(&model.dag, &[u], point)[0];
    match condition {
        DomainCondition::Positive(u) | DomainCondition::NotNegative(u) => value(u) < -1e-9,
        // zeros are not met by chance
        DomainCondition::NonZero(_) => false,
        DomainCondition::WithinOne(u) => value(u).abs() > 1.0 + 1e-9,
    }
}

/// The identities between constants that do not hold, or that the compiler cannot prove.
#[allow(dead_code, reason = "the example leaves this to the test")]
pub(crate) fn constants_agree() -> Vec<String> {
    let mut wrong = Vec::new();
    for (left, right) in disguise::CONSTANTS {
        let declaration = format!(
            "system S {{ state x, y; der(x) = y*(({left}) - ({right})); der(y) = 1; conserved a = x; }}"
        );
        let case = judge(0, declaration, &mut Random::of_case(1, 0));
        if (case.truth, case.answer) != (Truth::Holds, Answer::Proved) && !DIFFICULT.contains(left)
        {
            wrong.push(format!(
                "{left} = {right}: {:?}, {:?}",
                case.truth, case.answer
            ));
        }
    }
    wrong
}

/// Constants whose relations are not seen.
const DIFFICULT: [&str; 0] = [];

/// The identities between formulas that do not hold where both sides have values.
#[allow(dead_code, reason = "the example leaves this to the test")]
pub(crate) fn identities_agree() -> Vec<String> {
    let mut wrong = Vec::new();
    for (left, right) in disguise::IDENTITIES {
        let formula = format!("({left}) - ({right})");
        let declared: Vec<&str> = ["u", "v", "w", "k"]
            .into_iter()
            .filter(|name| term::Term::read(&formula).mentions(name))
            .collect();
        let rates: String = declared
            .iter()
            .map(|name| format!(" der({name}) = 1 + {name}^2/7;"))
            .collect();
        let declaration = format!(
            "system S {{ state {}, last; {rates} der(last) = {formula}; conserved a = last; }}",
            declared.join(", ")
        );
        let case = judge(0, declaration, &mut Random::of_case(1, 0));
        if case.truth != Truth::Holds || case.answer == Answer::Refuted {
            wrong.push(format!(
                "{left} = {right}: {:?}, {:?}",
                case.truth, case.answer
            ));
        }
    }
    wrong
}
