//! A ball that bounces and comes to rest: events, and a run that ends where they accumulate.
//!
//! `cargo run --release -p dmm-runtime --example bouncing_ball` prints when it bounces, as CSV.

use dmm_runtime::{Best, ErrorKind, Integrator, pws};

pws! {
    /// A ball that keeps the part e of its speed where it bounces.
    system Ball {
        state y, v;
        param e = 0.5, g = 1;
        discrete bounces = 0;
        interface floor = y;
        der(y) = v;
        der(v) = -g;
        conserved energy = v^2 / 2 + g * y;
        on floor falling {
            v = -e * v;
            bounces = bounces + 1;
        }
    }
}

fn main() -> Result<(), dmm_runtime::Error> {
    let ball = Ball::default();
    let run = Integrator::new(&ball, Best::tolerance(1e-12))
        .initial(0.0, [0.5, 0.0])
        .run_until(10.0);
    let interrupted = match run {
        Ok(_) => return Ok(()),
        // what was computed until there is not lost
        Err(interrupted) => interrupted,
    };
    println!("t,bounces,speed");
    for bounce in interrupted.solution().transitions().iter().take(8) {
        let [bounces] = bounce.to.discrete;
        println!("{},{bounces},{}", bounce.t, bounce.after[1]);
    }
    let ErrorKind::Zeno {
        transitions,
        within,
        ..
    } = interrupted.error().kind
    else {
        return Err(interrupted.into());
    };
    let t = interrupted
        .error()
        .place()
        .map_or(f64::NAN, |place| place.t);
    println!("# at rest at t = {t}: {transitions} bounces within {within:.1e}");
    Ok(())
}
