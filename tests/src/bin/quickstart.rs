use dmm_runtime::{Best, Integrator, System, pws};

pws! {
    /// An oscillator whose spring is three times stiffer below y = 0.
    pub system Oscillator {
        state x, y;
        param k_above = 1, k_below = 3;
        interface rest = y;
        region above where rest > 0 {
            der(x) = y;
            der(y) = -k_above * x;
            conserved energy = (y^2 + k_above * x^2) / 2;
        }
        region below where rest < 0 {
            der(x) = y;
            der(y) = -k_below * x;
            conserved energy = (y^2 + k_below * x^2) / 2;
        }
    }
}

fn run() -> Result<(), Box<dyn std::error::Error>> {
    let oscillator = Oscillator {
        k_below: 3.0,
        ..Default::default()
    };
    let solution = Integrator::new(&oscillator, Best::tolerance(1e-12))
        .initial(0.0, [1.0, 1.0])
        .run_until(1000.0)?;
    for transition in &solution.transitions()[..3] {
        println!(
            "t = {:.6}: {:?} -> {:?}",
            transition.t, transition.from, transition.to
        );
    }
    let end = solution.last().ok_or("no solution")?;
    let energy = oscillator.conserved(end.region, end.t, &end.x)[0];
    println!(
        "t = {}: {} transitions, {:?}",
        end.t,
        solution.transitions().len(),
        end.region
    );
    println!("energy = {energy:.14}");
    println!("x(3.7) = {:.6}", solution.at(3.7)?[0]);
    Ok(())
}

fn main() -> std::process::ExitCode {
    match run() {
        Ok(()) => std::process::ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            std::process::ExitCode::FAILURE
        }
    }
}
