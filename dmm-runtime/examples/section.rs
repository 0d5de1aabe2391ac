//! The section of a chaotic trajectory (Poincaré section): Hénon & Heiles, *The applicability of the
//! third integral of motion*, Astron. J. 69 (1964), 73–79, where x = 0 is crossed upwards.
//!
//! `cargo run --release -p dmm-runtime --example section > section.csv` writes its points (y, v).

use std::ops::ControlFlow;

use dmm_runtime::{Integrator, Taylor, on_transition, pws};

pws! {
    /// A star in the field of a galaxy, with the plane of the section as an interface that changes
    /// nothing.
    system Galaxy {
        state x, y, u, v;
        interface plane = x;
        let h = (u^2 + v^2 + x^2 + y^2) / 2 + x^2 * y - y^3 / 3;
        region before where plane < 0 {
            hamiltonian energy = h in (x, u), (y, v);
        }
        region behind where plane > 0 {
            hamiltonian energy = h in (x, u), (y, v);
        }
    }
}

/// The points that are written.
const POINTS: usize = 1000;

fn main() -> Result<(), dmm_runtime::Error> {
    let (y, v, energy) = (0.1_f64, 0.0_f64, 0.125_f64);
    let u = (2.0 * energy - y * y + 2.0 * y.powi(3) / 3.0 - v * v).sqrt();
    println!("y,v");
    let mut written = 0;
    let mut section = on_transition(|crossing| {
        if crossing.to == GalaxyRegion::Behind {
            println!("{},{}", crossing.x[1], crossing.x[3]);
            written += 1;
        }
        match written {
            POINTS => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        }
    });
    Integrator::new(&Galaxy {}, Taylor::tolerance(1e-12))
        .initial(0.0, [0.0, y, u, v])
        .observe_until(1e6, &mut section)?;
    Ok(())
}
