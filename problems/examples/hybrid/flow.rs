//! One step of the modified midpoint rule with extrapolation (Gragg 1965; Hairer, Nørsett & Wanner,
//! §II.9), of order 10.

use crate::motion::{Motion, Systems};
use crate::plant::{MOST, State};

/// The numbers of midpoint steps are 2, 4, … twice this.
const COLUMNS: usize = 5;

/// A step is to be taken in shorter ones where its results of order 8 and 10 differ by more, as a part
/// of the state.
const MOST_ERROR: f64 = 1e-10;
/// No step is made shorter than that.
pub(crate) const SHORTEST: f64 = 1e-7;

/// The state after a time s in a motion.
pub(crate) fn flow(systems: &Systems<'_>, motion: &Motion, t: f64, x: &State, s: f64) -> State {
    checked_flow(systems, motion, t, x, s).0
}

/// The same, and whether the result of order 8 agrees with it. A field that slides has poles, where a
/// weight has one: the motion ends there, but a step over it leads to some state behind it. Its results
/// do not agree.
pub(crate) fn checked_flow(
    systems: &Systems<'_>,
    motion: &Motion,
    t: f64,
    x: &State,
    s: f64,
) -> (State, bool) {
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
    let [.., order_8, order_10] = extrapolated(table);
    let mut parts = order_8.iter().zip(&order_10);
    let size = order_10
        .iter()
        .fold(1.0_f64, |most, part| most.max(part.abs()));
    let agrees = parts.all(|(a, b)| (a - b).abs() <= MOST_ERROR * size);
    (order_10, agrees)
}

/// By the polynomial in h² through each row and all before it at h = 0 (Aitken and Neville).
fn extrapolated(mut table: [State; COLUMNS]) -> [State; COLUMNS] {
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
    table
}

fn sum(x: &State, h: f64, f: &State) -> State {
    std::array::from_fn(|i| x[i] + h * f[i])
}
