//! Prints the errors of `dmm_runtime::special` against arbitrary precision.
//!
//! ```text
//! cargo run --release -p dmm-runtime --example special_accuracy [SAMPLES]
//! ```

#[path = "../tests/accuracy/mod.rs"]
mod accuracy;

fn main() {
    let samples = std::env::args()
        .nth(1)
        .and_then(|argument| argument.parse().ok())
        .unwrap_or(2000);
    println!(
        "{:<14} {:<28} {:>7} {:>8} {:>9}   worst at",
        "function", "range", "samples", "max ulp", "mean ulp"
    );
    for case in accuracy::cases() {
        let measured = case.measure(samples);
        println!(
            "{:<14} {:<28} {:>7} {:>8.2} {:>9.3}   {:e}, {:e}{}",
            case.name,
            case.range,
            measured.samples,
            measured.max,
            measured.mean,
            measured.worst.0,
            measured.worst.1,
            if measured.max > case.bound {
                "  above the bound"
            } else {
                ""
            },
        );
    }
}
