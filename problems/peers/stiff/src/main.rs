//! Stiff problems by this library and by others, timed on request: reads and writes lines, as
//! `examples/timed` of `problems` does.
//!
//! | request | answer, one line of JSON |
//! |---|---|
//! | `problems` | each with its end time, the exact state there, changes of phase |
//! | `schemes PROBLEM` | the integrators that can be asked for it |
//! | `run PROBLEM SCHEME tolerance=TOL T_END REPEATS` | final state, steps, transitions, seconds each |
//!
//! A run is from the initial value and alone: integrators are made and allocated anew.

mod cvode;
mod diffsol;
mod phases;
mod plain;
mod problems;
mod radau5;

use std::error::Error;
use std::io::{BufRead, Write};

use cpu_time::ThreadTime;
use dmm_runtime::{Best, EmbeddedRungeKutta, Integrator, Method, System};
use serde_json::{Value, json};

use phases::{End, Tolerances};
use plain::Plain;
use problems::{Hires, Robertson, Stick, VanDerPol};

type Outcome<T> = Result<T, Box<dyn Error>>;

const OURS: [&str; 2] = ["radau-iia-3", "radau-iia-5"];
const PEERS: [&str; 5] = [
    "cvode-bdf",
    "diffsol-bdf",
    "diffsol-tr-bdf2",
    "diffsol-esdirk34",
    "radau5",
];

/// At the end of the name of a peer: absolute tolerances are smaller than relative ones by `FINER`.
const FINE: &str = "-fine";
const FINER: f64 = 1e-4;

fn main() -> Outcome<()> {
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

fn answer(words: &[&str]) -> Outcome<Value> {
    match words {
        ["problems"] => Ok(json!([
            description::<Robertson, 3>("robertson"),
            description::<Hires, 8>("hires"),
            description::<VanDerPol, 2>("van_der_pol"),
            description::<Stick, 3>("stick"),
        ])),
        ["schemes", problem] => Ok(schemes(problem)),
        ["run", problem, scheme, tolerance, _, repeats] => {
            let tolerance = tolerance.strip_prefix("tolerance=").ok_or("no tolerance")?;
            let (tolerance, repeats) = (tolerance.parse()?, repeats.parse()?);
            match *problem {
                "robertson" => timed::<Robertson, 3>(scheme, tolerance, repeats),
                "hires" => timed::<Hires, 8>(scheme, tolerance, repeats),
                "van_der_pol" => timed::<VanDerPol, 2>(scheme, tolerance, repeats),
                // of the four the one whose flow is known
                "stick" if *scheme == "best" => {
                    let run = || ours::<Stick, 3>(Best::tolerance(tolerance));
                    repeated(repeats, run)
                }
                "stick" => timed::<Stick, 3>(scheme, tolerance, repeats),
                _ => Err(format!("no problem `{problem}` here").into()),
            }
        }
        _ => Err(format!("no such request: {}", words.join(" ")).into()),
    }
}

fn description<P: Plain<N>, const N: usize>(name: &str) -> Value {
    json!({
        "name": name,
        "t_end": P::T_END,
        "x": P::END.as_slice(),
        "changes": P::CHANGES,
    })
}

fn schemes(problem: &str) -> Value {
    let exact = if problem == "stick" {
        Some("best")
    } else {
        None
    };
    let ours = OURS.into_iter().chain(exact).map(str::to_owned);
    let peers = PEERS.into_iter();
    let peers = peers.flat_map(|name| [name.to_owned(), format!("{name}{FINE}")]);
    ours.chain(peers).collect()
}

fn timed<P, const N: usize>(scheme: &str, tolerance: f64, repeats: usize) -> Outcome<Value>
where
    P: Plain<N> + System<N> + Default,
{
    let radau_iia = match scheme {
        "radau-iia-3" => Some(EmbeddedRungeKutta::radau_iia::<3>()),
        "radau-iia-5" => Some(EmbeddedRungeKutta::radau_iia::<5>()),
        _ => None,
    };
    if let Some(method) = radau_iia {
        return repeated(repeats, || ours::<P, N>(method.tolerance(tolerance)));
    }
    let (peer, absolute) = match scheme.strip_suffix(FINE) {
        Some(peer) => (peer, FINER * tolerance),
        None => (scheme, tolerance),
    };
    let by = Tolerances {
        relative: tolerance,
        absolute,
    };
    repeated(repeats, || match peer {
        "cvode-bdf" => cvode::bdf::<P, N>(by),
        "diffsol-bdf" => diffsol::run::<P, N>(&diffsol::Method::Bdf, by),
        "diffsol-tr-bdf2" => diffsol::run::<P, N>(&diffsol::Method::TrBdf2, by),
        "diffsol-esdirk34" => diffsol::run::<P, N>(&diffsol::Method::Esdirk34, by),
        "radau5" => radau5::run::<P, N>(by),
        other => Err(format!("no integrator `{other}` here").into()),
    })
}

fn repeated<const N: usize>(
    repeats: usize,
    mut run: impl FnMut() -> Outcome<End<N>>,
) -> Outcome<Value> {
    let mut seconds = Vec::with_capacity(repeats);
    let mut last = None;
    for _ in 0..repeats.max(1) {
        let start = ThreadTime::now();
        let end = std::hint::black_box(run()?);
        seconds.push(start.elapsed().as_secs_f64());
        last = Some(end);
    }
    let End { x, steps, changes } = last.ok_or("nothing was run")?;
    if !x.iter().all(|x| x.is_finite()) {
        return Err("the end is not finite".into());
    }
    Ok(json!({
        "x": x.as_slice(),
        "steps": steps,
        "transitions": changes,
        "seconds": seconds,
    }))
}

/// This library.
fn ours<P, const N: usize>(method: impl Method) -> Outcome<End<N>>
where
    P: Plain<N> + System<N> + Default,
{
    let system = P::default();
    let end = Integrator::new(&system, method)
        .initial(0.0, P::INITIAL)
        .observe_until(P::T_END, &mut ())
        .map_err(|halted| halted.to_string())?;
    Ok(End {
        x: end.point.x.into(),
        steps: end.statistics.steps,
        changes: end.statistics.transitions,
    })
}
