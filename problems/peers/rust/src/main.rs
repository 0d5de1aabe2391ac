//! Integrators in Rust on the problems of this repository, timed on request as the library is:
//! see `examples/timed` in `problems` for the protocol, of which `schemes` and `run` are
//! answered.

mod differential_equations;
mod diffsol;
#[path = "../../../examples/timed/large.rs"]
mod large;
mod sides;
mod sundials;

use std::error::Error;
use std::ffi::CStr;
use std::io::{BufRead, Write};

use cpu_time::ThreadTime;
use dmm_problems::problem::Description;
use dmm_problems::systems::*;
use dmm_runtime::System;
use serde_json::{Value, json};

use sides::Sides;

/// How a run ended.
pub struct End<const N: usize> {
    x: [f64; N],
    steps: u64,
    crossings: u64,
}

type Outcome<T> = Result<T, Box<dyn Error>>;

/// The integrators.
const PEERS: [&str; 5] = [
    "diffsol-tsit45",
    "differential-equations-rkv989e",
    "cvode-adams",
    "arkode-verner-9",
    "arkode-dormand-prince-5",
];

fn main() -> Outcome<()> {
    let mut out = std::io::stdout().lock();
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let words: Vec<&str> = line.split_whitespace().collect();
        let answer = match words.as_slice() {
            ["schemes"] => Ok(schemes()),
            ["run", problem, peer, tolerance, t_end, repeats] => {
                run(problem, peer, tolerance, t_end, repeats)
            }
            _ => Err(format!("no such request: {line}").into()),
        };
        let answer = answer.unwrap_or_else(|error| json!({ "error": error.to_string() }));
        writeln!(out, "{answer}")?;
        out.flush()?;
    }
    Ok(())
}

fn schemes() -> Value {
    let scheme = |name: &&str| json!({ "name": name, "adaptive": true });
    PEERS.iter().map(scheme).collect()
}

fn run(problem: &str, peer: &str, tolerance: &str, t_end: &str, repeats: &str) -> Outcome<Value> {
    let tolerance = tolerance.strip_prefix("tolerance=");
    let task = Task {
        peer,
        tolerance: tolerance.ok_or("no tolerance")?.parse()?,
        t_end: t_end.parse()?,
        repeats: repeats.parse()?,
    };
    match problem {
        "harmonic" => task.timed(Harmonic::default(), &harmonic::DESCRIPTION),
        "elliptic" => task.timed(Elliptic::default(), &elliptic::DESCRIPTION),
        "pendulum" => task.timed(Pendulum::default(), &pendulum::DESCRIPTION),
        "lotka_volterra_periodic" => task.timed(
            LotkaVolterra::default(),
            &lotka_volterra_periodic::DESCRIPTION,
        ),
        "damped" => task.timed(Damped::default(), &damped::DESCRIPTION),
        "spiral" => task.timed(Spiral::default(), &spiral::DESCRIPTION),
        "rigid_body" => task.timed(RigidBody::default(), &rigid_body::DESCRIPTION),
        "kepler_refraction" => {
            task.timed(KeplerRefraction::default(), &kepler_refraction::DESCRIPTION)
        }
        "henon_heiles" => task.timed(HenonHeiles::default(), &henon_heiles::DESCRIPTION),
        "toda" => task.timed(Toda::default(), &toda::DESCRIPTION),
        "relativistic_oscillator" => task.timed(
            RelativisticOscillator::default(),
            &relativistic_oscillator::DESCRIPTION,
        ),
        "poschl_teller" => task.timed(PoschlTeller::default(), &poschl_teller::DESCRIPTION),
        "double_pendulum" => task.timed(DoublePendulum::default(), &double_pendulum::DESCRIPTION),
        "three_body" => task.timed(ThreeBody::default(), &three_body::DESCRIPTION),
        _ => large::visit(problem, task)
            .unwrap_or_else(|| Err(format!("no problem `{problem}` here").into())),
    }
}

impl large::Visitor for Task<'_> {
    type Output = Outcome<Value>;

    fn visit<Sys: System<N> + Default, const N: usize>(
        self,
        description: &Description,
        _: [f64; N],
    ) -> Outcome<Value> {
        self.timed(Sys::default(), description)
    }
}

struct Task<'a> {
    peer: &'a str,
    tolerance: f64,
    t_end: f64,
    repeats: usize,
}

impl Task<'_> {
    fn arkode<Sys: System<N>, const N: usize>(
        &self,
        sides: &Sides<'_, Sys, N>,
        initial: [f64; N],
        table: &CStr,
    ) -> Outcome<End<N>> {
        sundials::explicit(sides, initial, self.t_end, self.tolerance, table)
    }

    fn timed<Sys: System<N>, const N: usize>(
        &self,
        system: Sys,
        description: &Description,
    ) -> Outcome<Value> {
        let initial: [f64; N] = description.initial.try_into()?;
        let mut seconds = Vec::new();
        let mut last = None;
        for _ in 0..self.repeats.max(1) {
            let sides = Sides::new(&system, &initial)?;
            let start = ThreadTime::now();
            let end = match self.peer {
                "diffsol-tsit45" => diffsol::tsit45(&sides, initial, self.t_end, self.tolerance)?,
                "differential-equations-rkv989e" => {
                    differential_equations::rkv989e(&sides, initial, self.t_end, self.tolerance)?
                }
                "cvode-adams" => sundials::adams(&sides, initial, self.t_end, self.tolerance)?,
                "arkode-verner-9" => self.arkode(&sides, initial, c"ARKODE_VERNER_16_8_9")?,
                "arkode-dormand-prince-5" => {
                    self.arkode(&sides, initial, c"ARKODE_DORMAND_PRINCE_7_4_5")?
                }
                other => return Err(format!("no integrator `{other}` here").into()),
            };
            seconds.push(start.elapsed().as_secs_f64());
            last = Some(end);
        }
        let End {
            x,
            steps,
            crossings,
        } = last.ok_or("nothing was run")?;
        Ok(json!({
            "x": x.as_slice(),
            "steps": steps,
            "transitions": crossings,
            "seconds": seconds,
        }))
    }
}
