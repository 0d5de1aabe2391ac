//! Rounding errors of every emitted function before and after optimisation, against 120 digits.
//!
//! ```text
//! cargo bench -p dmm-compiler --bench accuracy -- [FILE | DIRECTORY]
//! ```
//!
//! Cargo runs it in the folder of the package, which relative paths begin at.
//!
//! Errors are those of all results at random points, with steps v τ, τ from 1 to 10⁻¹²: median
//! and greatest in ulp of the exact value (where a value cancels, many), and mean and greatest
//! as parts of the a-priori bound of the operations as they are written.

#[path = "../tests/accuracy/mod.rs"]
mod accuracy;
mod arguments;
mod declarations;

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use accuracy::{Errors, greatest, measure, scheme};
use arguments::arguments;

/// Points a step size.
const POINTS: usize = 10;
/// Errors that differ by more than this factor differ plainly.
const PLAINLY: f64 = 1.05;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let path = arguments().next().map(PathBuf::from);
    let path = path.unwrap_or_else(declarations::problems);
    println!(
        "{:<22} {:<14} {:<22} {:>7} | {:^31} | {:^31}",
        "system", "region", "function", "values", "as written", "optimised"
    );
    let columns = format!(
        "{:>6} {:>9} {:>7} {:>6}",
        "median", "ulp, max", "bound", "max"
    );
    println!(
        "{:<22} {:<14} {:<22} {:>7} | {columns} | {columns}",
        "", "", "", ""
    );
    let (mut functions, mut better, mut worse) = (0, 0, 0);
    let (mut largest, mut greatest) = (1.0f64, 0.0f64);
    for (file, declaration) in declarations::declarations(&path)? {
        let scheme = scheme(declaration).map_err(|error| format!("{}: {error}", file.display()))?;
        for row in measure(&scheme, POINTS) {
            let [system, region, function] = &row.function;
            println!(
                "{system:<22} {region:<14} {function:<22} {:>7} | {} | {}",
                row.written.count(),
                errors(&row.written),
                errors(&row.optimised)
            );
            let ((before, _), (after, most)) = (row.written.parts(), row.optimised.parts());
            functions += 1;
            better += usize::from(after * PLAINLY < before);
            worse += usize::from(after > PLAINLY * before);
            if before > 0.0 {
                largest = largest.max(after / before);
            }
            greatest = greatest.max(most);
        }
    }
    println!(
        "of {functions} functions optimisation makes the mean error smaller by over 5 % in {better} and larger \
         in {worse}, at most {largest:.2} times; the greatest error is {greatest:.2} of the bound of the \
         operations as written"
    );
    Ok(())
}

fn errors(errors: &Errors) -> String {
    let (median, worst) = (median(&errors.ulps), greatest(&errors.ulps));
    let (mean, greatest) = errors.parts();
    format!("{median:>6.2} {worst:>9.1} {mean:>7.3} {greatest:>6.2}")
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}
