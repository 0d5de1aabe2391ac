//! One step of the modified midpoint rule with extrapolation (Gragg 1965; Hairer, Nørsett & Wanner,
//! §II.9), of order 10.

use crate::motion::{Motion, Systems};
use crate::plant::{MOST, State};

/// The numbers of midpoint steps are 2, 4, … twice this.
const COLUMNS: usize = 5;

/// The state after a time s in a motion.
pub(crate) fn flow(systems: &Systems<'_>, motion: &Motion, t: f64, x: &State, s: f64) -> State {
    let mut table = [[0.0; MOST]; COLUMNS];
    let f0 = systems.field(motion, t, x).0;
    for (row, entry) in table.iter_mut().enumerate() {
        let count = 2 * (row + 1);
        let h = s / count as f64;
        let (mut before, mut now) = (*x, sum(x, h, &f0));
        for step in 1..count {
            let f = systems.field(motion, t + step as f64 * h, &now).0;
            (before, now) = (now, sum(&before, 2.0 * h, &f));
        }
        // without smoothing, which an even number of steps does not need
        *entry = now;
    }
    extrapolated(table)
}

/// By the polynomial in h² through all rows at h = 0 (Aitken and Neville).
fn extrapolated(mut table: [State; COLUMNS]) -> State {
    for width in 1..COLUMNS {
        for row in (width..COLUMNS).rev() {
            let ratio = (row + 1) as f64 / (row + 1 - width) as f64;
            let factor = 1.0 / (ratio * ratio - 1.0);
            let before = table[row - 1];
            for (entry, before) in table[row].iter_mut().zip(before) {
                *entry += factor * (*entry - before);
            }
        }
    }
    table[COLUMNS - 1]
}

fn sum(x: &State, h: f64, f: &State) -> State {
    std::array::from_fn(|i| x[i] + h * f[i])
}
