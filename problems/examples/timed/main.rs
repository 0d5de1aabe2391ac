//! The library's side of a comparison with other integrators: describes problems and times
//! runs, for a program that reads and writes lines. `peers/compare.py` is one.
//!
//! | request | answer, one line of JSON |
//! |---|---|
//! | `schemes` | the schemes that conserve: `name`, and whether `adaptive` (by a tolerance) |
//! | `describe PROBLEM` | states, parameters, initial value, formulas of f and g, reference |
//! | `run PROBLEM SCHEME CONTROL T_END REPEATS` | final state, steps, transitions, seconds each |
//! | `ensemble PROBLEM SCHEME CONTROL T_END FILE HOW REPEATS` | final states, seconds of all runs |
//!
//! `CONTROL` is `step=1e-3` or `tolerance=1e-9`; `FILE` is a CSV file with a run a row, whose
//! columns are states and parameters; `HOW` is `lanes` or `single`. What cannot be answered is
//! `{"error": "…"}`. A run starts from the problem's initial value, and what is timed is all of
//! it: nothing is kept from one to the next. Seconds are of the thread's processor time, which
//! other work on the machine lengthens little; what reading that clock takes is taken off.
//!
//! With the feature `compiled` there are larger systems too, for Taylor's method, and
//! `cargo run --release -p dmm-problems --features compiled --example timed -- chains` prints the time of a
//! step of chains by their number of states.

// the tests do without: its systems take most of the time to compile
#[cfg(all(feature = "compiled", not(test)))]
mod chains;
#[cfg(all(feature = "compiled", not(test)))]
mod large;
#[cfg(all(feature = "compiled", not(test)))]
mod larger;

use std::error::Error;
use std::io::{BufRead, Write};
use std::ops::ControlFlow;

use cpu_time::ThreadTime;
use dmm_compiler::algebra::{Id, to_text};
use dmm_compiler::diagnostics::Diagnostics;
use dmm_compiler::model::{Model, Sign};
use dmm_compiler::{check, syntax};
use dmm_problems::method::{Control, MethodName};
use dmm_problems::problem::{Parallelism, Problem, Run, Start};
use dmm_problems::reference::Reference;
use dmm_problems::registry;
use serde_json::{Value, json};

fn main() -> Result<(), Box<dyn Error>> {
    #[cfg(all(feature = "compiled", not(test)))]
    if std::env::args().nth(1).as_deref() == Some("chains") {
        return chains::print();
    }
    let mut out = std::io::stdout().lock();
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let words: Vec<&str> = line.split_whitespace().collect();
        let answer = answer(&words).unwrap_or_else(|error| json!({ "error": error.to_string() }));
        writeln!(out, "{answer}")?;
        out.flush()?;
    }
    Ok(())
}

fn answer(words: &[&str]) -> Result<Value, Box<dyn Error>> {
    #[cfg(all(feature = "compiled", not(test)))]
    if let Some(answer) = larger::answer(words) {
        return answer;
    }
    match words {
        ["schemes"] => Ok(schemes()),
        ["describe", name] => describe(&registry::find(name)?),
        ["run", name, scheme, control, t_end, repeats] => {
            let problem = registry::find(name)?;
            let run = request(&problem, scheme, control, t_end.parse()?)?;
            timed(&problem, &run, repeats.parse()?)
        }
        ["ensemble", name, scheme, control, t_end, file, how, repeats] => {
            let problem = registry::find(name)?;
            let run = request(&problem, scheme, control, t_end.parse()?)?;
            let starts = starts(&problem, file)?;
            ensemble(&problem, &run, &starts, *how == "lanes", repeats.parse()?)
        }
        _ => Err(format!("no such request: {}", words.join(" ")).into()),
    }
}

fn schemes() -> Value {
    let scheme = |method: &MethodName| {
        json!({
            "name": method.name(),
            "adaptive": method.control() == Control::Tolerance,
        })
    };
    MethodName::CONSERVING.iter().map(scheme).collect()
}

fn request(
    problem: &Problem,
    scheme: &str,
    control: &str,
    t_end: f64,
) -> Result<Run, Box<dyn Error>> {
    let (kind, value) = control.split_once('=').ok_or("no control")?;
    let value: f64 = value.parse()?;
    let method = MethodName::find(scheme, kind == "tolerance").ok_or("unknown scheme")?;
    let fits = match method.control() {
        Control::Tolerance => kind == "tolerance",
        Control::StepSize { .. } => kind == "step",
    };
    if !fits {
        return Err(format!("{scheme} does not take a {kind}").into());
    }
    Ok(Run {
        method,
        step_size: value,
        tolerance: value,
        t_end,
        ..problem.default_run()
    })
}

fn timed(problem: &Problem, run: &Run, repeats: usize) -> Result<Value, Box<dyn Error>> {
    let mut seconds = Vec::with_capacity(repeats);
    let mut finish = None;
    let nothing = time_of_nothing();
    for _ in 0..repeats.max(1) {
        let start = ThreadTime::now();
        let finished = std::hint::black_box(problem.integrate_silently(run)?);
        seconds.push((start.elapsed().as_secs_f64() - nothing).max(0.0));
        finish = Some(finished);
    }
    let finish = finish.ok_or("nothing was run")?;
    Ok(json!({
        "x": finish.x,
        "steps": finish.statistics.steps,
        "transitions": finish.statistics.transitions,
        "seconds": seconds,
    }))
}

/// The least time that the clock shows of nothing.
fn time_of_nothing() -> f64 {
    const ATTEMPTS: usize = 100;
    let attempts = (0..ATTEMPTS).map(|_| ThreadTime::now().elapsed().as_secs_f64());
    attempts.fold(f64::INFINITY, f64::min)
}

/// Where the runs of a file start.
fn starts(problem: &Problem, file: &str) -> Result<Vec<Start>, Box<dyn Error>> {
    let mut reader = csv::Reader::from_path(file)?;
    let names = reader.headers()?.clone();
    let (states, parameters) = (problem.states(), problem.parameters());
    let mut starts = Vec::new();
    for row in reader.records() {
        let mut start = problem.default_start();
        for (name, value) in names.iter().zip(&row?) {
            let state = states.iter().position(|state| *state == name);
            let parameter = parameters.iter().position(|(other, _)| *other == name);
            let place = match (state, parameter) {
                (Some(index), _) => start.initial.get_mut(index),
                (None, Some(index)) => start.parameters.get_mut(index),
                (None, None) => return Err(format!("no state or parameter `{name}`").into()),
            };
            *place.ok_or("a problem without its own initial value")? = value.parse()?;
        }
        starts.push(start);
    }
    Ok(starts)
}

/// All runs on one core.
fn ensemble(
    problem: &Problem,
    run: &Run,
    starts: &[Start],
    lanes: bool,
    repeats: usize,
) -> Result<Value, Box<dyn Error>> {
    let parallelism = Parallelism {
        threads: Some(1),
        lanes,
    };
    let mut seconds = Vec::with_capacity(repeats);
    let mut states = Vec::new();
    for _ in 0..repeats.max(1) {
        states.clear();
        let mut error = None;
        let start = ThreadTime::now();
        problem.integrate_all(
            run,
            parallelism,
            &mut starts.iter().cloned(),
            &mut |outcome| {
                match outcome.arrival {
                    Some(arrival) if outcome.error.is_none() => states.push(arrival.x),
                    _ => error = outcome.error,
                }
                ControlFlow::Continue(())
            },
        );
        seconds.push(start.elapsed().as_secs_f64());
        if let Some(error) = error {
            return Err(error.into());
        }
    }
    if states.len() == starts.len() {
        Ok(json!({ "x": states, "seconds": seconds }))
    } else {
        Err("ensembles are not integrated by this scheme".into())
    }
}

fn describe(problem: &Problem) -> Result<Value, Box<dyn Error>> {
    let model = model(problem)?;
    let formula = |id: Id| -> Result<String, Box<dyn Error>> {
        let text = to_text(&model.dag, id);
        if text.contains('…') {
            Err("a formula is too long to be written out".into())
        } else {
            Ok(text)
        }
    };
    let regions = model.regions.iter().map(|region| {
        let sides = region.sides.iter().map(|side| match side.sign {
            Sign::Negative => -1,
            Sign::Positive => 1,
        });
        let field = region.field.iter().map(|id| formula(*id));
        Ok(json!({
            "name": region.ident.to_string(),
            "sides": sides.collect::<Vec<i32>>(),
            "field": field.collect::<Result<Vec<_>, Box<dyn Error>>>()?,
        }))
    });
    let interfaces = model.interfaces.iter();
    let interfaces = interfaces.map(|interface| formula(interface.switching_function));
    let parameters: Vec<Value> = problem.parameters().iter().map(|p| json!(p)).collect();
    Ok(json!({
        "name": problem.description().name,
        "states": problem.states(),
        "parameters": parameters,
        "initial": problem.description().initial,
        "regions": regions.collect::<Result<Vec<_>, Box<dyn Error>>>()?,
        "interfaces": interfaces.collect::<Result<Vec<_>, _>>()?,
        "samples": samples(problem)?,
    }))
}

/// The names resolved, from the declaration.
fn model(problem: &Problem) -> Result<Model, Box<dyn Error>> {
    let mut diagnostics = Diagnostics::new();
    let model = syntax::parse(problem.declaration().parse()?, &mut diagnostics)
        .and_then(|declaration| check::resolve(declaration, &mut diagnostics));
    model.ok_or_else(|| diagnostics.messages().join("; ").into())
}

fn samples(problem: &Problem) -> Result<Vec<Value>, Box<dyn Error>> {
    let samples = Reference::of(problem)?.map_or_else(Vec::new, |reference| reference.samples);
    let sample = |sample: &dmm_problems::reference::Sample| {
        json!({
            "t": sample.t,
            "x": sample.x,
            "crossings": sample.crossings_before,
        })
    };
    Ok(samples.iter().map(sample).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_problem_is_described_by_its_formulas() {
        let described = answer(&["describe", "elliptic"]).unwrap();
        assert_eq!(described["states"], json!(["x", "y"]));
        assert_eq!(described["interfaces"], json!(["x^2 + y^2 - 1"]));
        assert_eq!(described["parameters"][1], json!(["a_outside", -2.0]));
        let outside = &described["regions"][1];
        assert_eq!(outside["field"], json!(["2*y", "3*x^2 + a_outside"]));
        assert_eq!(outside["sides"], json!([1]));
        assert!(described["samples"].as_array().unwrap().len() > 5);
    }

    #[test]
    fn a_run_is_timed_as_often_as_is_asked() {
        let words = ["run", "harmonic", "taylor", "tolerance=1e-12", "10", "3"];
        let run = answer(&words).unwrap();
        assert_eq!(run["transitions"], json!(4));
        assert_eq!(run["seconds"].as_array().unwrap().len(), 3);
        let x = run["x"][0].as_f64().unwrap();
        assert!((x - 1.085_120_554_086_237_1).abs() < 1e-11, "{x}");
    }

    #[test]
    fn an_ensemble_is_read_from_a_file() {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(&file, "x,k_below\n1,3\n1.5,2\n").unwrap();
        let path = file.path().to_str().unwrap();
        let words = [
            "ensemble",
            "harmonic",
            "taylor",
            "tolerance=1e-12",
            "10",
            path,
            "single",
            "1",
        ];
        let runs = answer(&words).unwrap();
        let alone = answer(&["run", "harmonic", "taylor", "tolerance=1e-12", "10", "1"]).unwrap();
        assert_eq!(runs["x"][0], alone["x"]);
        assert!(runs["x"][1] != alone["x"]);
        let lanes = words.map(|word| if word == "single" { "lanes" } else { word });
        let x = |runs: &Value| runs["x"][1][0].as_f64().unwrap();
        assert!((x(&answer(&lanes).unwrap()) - x(&runs)).abs() < 1e-11);
        std::fs::write(&file, "z\n1\n").unwrap();
        assert!(answer(&words).is_err());
    }

    #[test]
    fn what_cannot_be_answered_is_said() {
        for words in [
            &["run", "harmonic", "taylor", "step=1e-3", "10", "1"][..],
            &["run", "harmonic", "leapfrog", "step=1e-3", "10", "1"],
            &["run", "harmonic", "taylor", "tolerance=2", "10", "1"],
            &["describe", "nosuch"],
            &["sing"],
        ] {
            assert!(answer(words).is_err(), "{words:?}");
        }
    }
}
