//! Answers about the larger systems, which are integrated by Taylor's method alone.

use std::error::Error;

use cpu_time::ThreadTime;
use dmm_problems::method::Run;
use dmm_problems::problem::{Description, Problem};
use dmm_runtime::{End, Integrator, Model, System, Taylor, Vector};
use serde_json::{Value, json};

use crate::large::{Visitor, visit};

/// The answer to what is asked of a larger system, if it is one.
pub(crate) fn answer(words: &[&str]) -> Option<Result<Value, Box<dyn Error>>> {
    match *words {
        ["describe", name] => visit(name, Describe),
        ["run", name, scheme, control, t_end, repeats] => {
            let request = Request {
                scheme,
                control,
                t_end,
                repeats,
            };
            visit(name, request)
        }
        _ => None,
    }
}

struct Describe;

impl Visitor for Describe {
    type Output = Result<Value, Box<dyn Error>>;

    fn visit<Sys: System<N> + Default, const N: usize>(
        self,
        description: &Description,
        _: [f64; N],
    ) -> Self::Output {
        let model = Model::compile(Sys::default().declaration())?;
        crate::describe(&Problem::new(*description, model.into_any::<Run>()?))
    }
}

/// A run, as it is asked for.
struct Request<'a> {
    scheme: &'a str,
    control: &'a str,
    t_end: &'a str,
    repeats: &'a str,
}

impl Visitor for Request<'_> {
    type Output = Result<Value, Box<dyn Error>>;

    fn visit<Sys: System<N> + Default, const N: usize>(
        self,
        _: &Description,
        initial: [f64; N],
    ) -> Self::Output {
        if self.scheme != "taylor" {
            return Err("no problem for this scheme: it is integrated by taylor".into());
        }
        let tolerance = self.control.strip_prefix("tolerance=");
        let tolerance = tolerance.ok_or("no tolerance")?.parse()?;
        let t_end = self.t_end.parse()?;
        let repeats = self.repeats.parse::<usize>()?.max(1);
        let runs = (0..repeats).map(|_| integrate::<Sys, N>(initial, tolerance, t_end));
        let runs = runs.collect::<Result<Vec<_>, _>>()?;
        let last = runs.last().ok_or("nothing was run")?;
        Ok(json!({
            "x": last.x.as_slice(),
            "steps": last.steps,
            "transitions": 0,
            "seconds": runs.iter().map(|run| run.seconds).collect::<Vec<f64>>(),
        }))
    }
}

/// The end of a run.
pub(crate) struct Finish<const N: usize> {
    /// x(t_end)
    x: [f64; N],
    /// How many steps it took.
    pub(crate) steps: u64,
    /// How long it took.
    pub(crate) seconds: f64,
}

/// A run from the start.
pub(crate) fn integrate<Sys: System<N> + Default, const N: usize>(
    initial: [f64; N],
    tolerance: f64,
    t_end: f64,
) -> Result<Finish<N>, dmm_runtime::Error> {
    let start = ThreadTime::now();
    let system = Sys::default();
    let end: End<_, N> = Integrator::new(&system, Taylor::tolerance(tolerance))
        .initial(0.0, Vector::from(initial))
        .observe_until(t_end, &mut ())?;
    Ok(Finish {
        seconds: start.elapsed().as_secs_f64(),
        x: end.point.x.into(),
        steps: end.statistics.steps,
    })
}
