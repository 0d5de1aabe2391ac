//! Affine systems with an affine interface: the exact flows of `Best` beside `Taylor`. Where
//! the two differ, or one is stopped, both are compared with the reference solution.

use crate::families::{Family, Plane, Scales, Space};
use crate::judge::Class;
use crate::reference::distance;
use crate::schemes::{Run, SETTINGS, Setting, run};
use crate::study::Case;
use crate::tally::Tally;
use dmm_problems::random::Random;
use dmm_problems::stress::{Extent, Observe, Row, Verdict};

/// `Taylor` and `Best`, each to 10⁻¹².
const PAIR: [Setting; 2] = [SETTINGS[0], SETTINGS[1]];
/// What is less of a difference, relative to the scales, is no other itinerary: errors of 10⁻¹²
/// may grow.
const CLOSE: f64 = 1e-8;

/// The study.
pub(crate) fn study(extent: Extent, observer: &mut dyn Observe) {
    let count = extent.of(20_000, 200);
    family::<Plane, 2>(count, observer);
    family::<Space, 3>(count, observer);
}

fn family<Sys: Family<N>, const N: usize>(count: usize, observer: &mut dyn Observe) {
    let mut tallies = [Tally::default(), Tally::default()];
    let mut differences = 0;
    for index in 0..count {
        let mut random = Random::new("affine", 0, index);
        let (system, initial) = Sys::draw(&mut random, Scales { l: 1.0, s: 1.0 });
        let t_end = random.between(8.0, 20.0);
        let runs = PAIR.map(|setting| run(&setting, &system, 1.0, initial, t_end));
        if agree(&runs) {
            for tally in &mut tallies {
                tally.count(Class::Same, String::new);
            }
            continue;
        }
        differences += 1;
        let Some(case) = Case::of(system, initial, t_end) else {
            continue;
        };
        let t_end = case.own_end();
        for (setting, tally) in PAIR.iter().zip(&mut tallies) {
            let run = run(setting, &case.system, 1.0, initial, t_end);
            let class = case.truth(t_end).judge(setting, &run);
            tally.count(class, || case.describe(index, t_end));
        }
    }
    for (setting, tally) in PAIR.iter().zip(&tallies) {
        let row = tally.row(Sys::TITLE, setting.name);
        let finding = format!("{differences} looked at more closely; {}", row.finding);
        let verdict = if tally.tells_of_sliding() {
            Verdict::Wrong
        } else {
            row.verdict
        };
        observer.ended(Row {
            verdict,
            finding,
            ..row
        });
    }
}

/// Whether two runs came to their ends by the same itinerary.
fn agree([a, b]: &[Run; 2]) -> bool {
    let ends = a.points.last().zip(b.points.last());
    a.error.is_none()
        && b.error.is_none()
        && a.crossings.len() == b.crossings.len()
        && a.crossings
            .iter()
            .zip(&b.crossings)
            .all(|(a, b)| a.to_positive == b.to_positive && (a.t - b.t).abs() < CLOSE)
        && ends.is_some_and(|(a, b)| a.0 == b.0 && distance(&a.1, &b.1, 1.0) < CLOSE)
}
