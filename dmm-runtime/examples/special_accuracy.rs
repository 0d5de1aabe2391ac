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
        "{:<14} {:<28} {:>7} {:>8} {:>9} {:>9}   worst at",
        "function", "range", "samples", "max ulp", "mean ulp", "within 2"
    );
    let mut exceeded = 0;
    for case in accuracy::cases() {
        let measured = case.measure(samples);
        let is_within = measured.max <= accuracy::BOUND;
        exceeded += usize::from(!is_within);
        println!(
            "{:<14} {:<28} {:>7} {:>8.2} {:>9.3} {:>9}   {:e}, {:e}",
            case.name,
            case.range,
            measured.samples,
            measured.max,
            measured.mean,
            if is_within { "yes" } else { "NO" },
            measured.worst.0,
            measured.worst.1,
        );
    }
    println!("ranges above 2 ulp: {exceeded}");
}
