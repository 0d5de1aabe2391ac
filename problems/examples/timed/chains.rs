//! The time of a step of chains by their number of states.

use std::error::Error;

use dmm_problems::fit::fitted_order;
use dmm_problems::problem::Description;
use dmm_runtime::System;

use crate::large::{Visitor, visit};
use crate::larger::{Finish, integrate};

/// Prints the time of a step of chains by their number of states N, and the exponent p of N^p that fits
/// best.
pub(crate) fn print() -> Result<(), Box<dyn Error>> {
    const CHAINS: [&str; 5] = ["chain_4", "chain_8", "chain_16", "chain_32", "chain_64"];
    println!("tolerance  states  steps  ns a step  ns a step and state");
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let (mut sizes, mut times) = (Vec::new(), Vec::new());
        for chain in CHAINS {
            let Step {
                states,
                steps,
                nanoseconds,
            } = visit(chain, Steps { tolerance }).ok_or("no such chain")??;
            let size = states as f64;
            let a_state = nanoseconds / size;
            println!("{tolerance:9e} {states:7} {steps:6} {nanoseconds:10.0} {a_state:20.1}");
            sizes.push(size);
            times.push(nanoseconds);
        }
        let exponent = fitted_order(&sizes, &times);
        println!("{tolerance:9e} exponent {exponent:.2}");
    }
    Ok(())
}

/// Measures a step of a chain at a tolerance.
struct Steps {
    tolerance: f64,
}

/// What a step takes.
struct Step {
    states: usize,
    steps: u64,
    nanoseconds: f64,
}

impl Visitor for Steps {
    type Output = Result<Step, dmm_runtime::Error>;

    fn visit<Sys: System<N> + Default, const N: usize>(
        self,
        _: &Description,
        initial: [f64; N],
    ) -> Self::Output {
        const T_END: f64 = 1000.0;
        const RUNS: usize = 9;
        let runs = (0..RUNS).map(|_| integrate::<Sys, N>(initial, self.tolerance, T_END));
        let runs = runs.collect::<Result<Vec<_>, _>>()?;
        let a_step = |run: &Finish<N>| 1e9 * run.seconds / run.steps as f64;
        Ok(Step {
            states: N,
            steps: runs[0].steps,
            nanoseconds: runs.iter().map(a_step).fold(f64::INFINITY, f64::min),
        })
    }
}
