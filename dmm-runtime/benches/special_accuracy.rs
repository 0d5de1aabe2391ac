//! Prints the errors of `dmm_runtime::special` against arbitrary precision.
//!
//! ```text
//! cargo bench -p dmm-runtime --bench special_accuracy -- [SAMPLES]
//! ```

#[path = "../tests/accuracy/mod.rs"]
mod accuracy;

fn main() {
    let samples = std::env::args()
        .nth(1)
        .and_then(|argument| argument.parse().ok())
        .unwrap_or(2000);
    println!(
        "{:<14} {:<28} {:>7} {:>8} {:>9} {:>6} {:>7}   worst at",
        "function", "range", "samples", "max ulp", "mean ulp", "bound", "within"
    );
    let mut exceeded = 0;
    for case in accuracy::cases() {
        let measured = case.measure(samples);
        let is_within = measured.max <= case.bound;
        exceeded += usize::from(!is_within);
        println!(
            "{:<14} {:<28} {:>7} {:>8.2} {:>9.3} {:>6} {:>7}   {:e}, {:e}",
            case.name,
            case.range,
            measured.samples,
            measured.max,
            measured.mean,
            case.bound,
            if is_within { "yes" } else { "NO" },
            measured.worst.0,
            measured.worst.1,
        );
    }
    println!("ranges above their bound: {exceeded}");
}
