//! The reference solution against closed forms.

use std::f64::consts::PI;

use dmm_problems::stress::{Extent, Observe, Row, Verdict};

use crate::formula::Formulas;
use crate::reference::{Ending, Growth, Problem, accurate};

/// ẋ = v, v̇ = −x on both sides.
fn oscillator(switching: Formulas, initial: [f64; 2]) -> Problem {
    let field = Formulas::of(|w| {
        let [x, v] = w.state();
        vec![v, -x]
    });
    Problem {
        fields: vec![field.clone(), field],
        switching,
        initial: initial.to_vec(),
        size: 1.0,
        rate: 1.0,
    }
}

/// Times to the rounding of a double.
fn times_agree(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found - expected).abs() <= 4e-15 * expected,
            "{found} {expected}"
        );
    }
}

fn times(problem: &Problem, t_end: f64) -> Vec<f64> {
    let solution = accurate(problem, t_end, 1000);
    assert_eq!(solution.ending, Ending::Time);
    solution
        .crossings
        .iter()
        .map(|crossing| crossing.t)
        .collect()
}

#[test]
fn an_oscillator_crosses_lines_and_waves() {
    // x = sin t
    let line = Formulas::of(|w| {
        let [x, _] = w.state();
        vec![x - 0.5]
    });
    let expected: Vec<f64> = (0..6)
        .map(|k| match k % 2 {
            0 => PI / 6.0 + PI * f64::from(k),
            _ => PI * f64::from(k) - PI / 6.0,
        })
        .collect();
    times_agree(&times(&oscillator(line, [0.0, 1.0]), 18.0), &expected);
    // sin 200x = 0 where x = kπ/200
    let wave = Formulas::of(|w| {
        let [x, _] = w.state();
        vec![(x * 200.0).sin()]
    });
    let rising: Vec<f64> = (1..=63)
        .map(|k| (f64::from(k) * PI / 200.0).asin())
        .collect();
    let falling = rising.iter().rev().map(|t| PI - t);
    let expected = rising.iter().copied().chain(falling);
    let found = times(&oscillator(wave, [1e-3, (1.0_f64 - 1e-6).sqrt()]), 3.13);
    assert_eq!(found.len(), 126);
    for (found, expected) in found.iter().zip(expected) {
        let found = found + 1e-3_f64.asin();
        // the arcsine of a double near 1
        assert!((found - expected).abs() < 1e-14, "{found} {expected}");
    }
}

#[test]
fn free_flight_leaves_a_disc() {
    let field = Formulas::of(|w| {
        let [_, _] = w.state();
        vec![w.number(1.0), w.number(0.3)]
    });
    let problem = Problem {
        fields: vec![field.clone(), field],
        switching: Formulas::of(|w| {
            let [x, y] = w.state();
            vec![(x.square() + y.square()).sqrt() - 1.0]
        }),
        initial: vec![0.1, 0.2],
        size: 1.0,
        rate: 1.0,
    };
    // 1.09 t² + 0.32 t − 0.95 = 0
    let t = (-0.32 + (0.32_f64.powi(2) + 4.0 * 1.09 * 0.95).sqrt()) / 2.18;
    times_agree(&times(&problem, 6.0), &[t]);
}

#[test]
fn constant_acceleration_meets_a_clock() {
    // v̇ = ±1 with the sign of sin(t + 0.1)
    let field = |a: f64| {
        Formulas::of(move |w| {
            let [_, v] = w.state();
            vec![v, w.number(a)]
        })
    };
    let problem = Problem {
        fields: vec![field(-1.0), field(1.0)],
        switching: Formulas::of(|w| vec![(w.time() + 0.1).sin()]),
        initial: vec![0.0, 0.0],
        size: 100.0,
        rate: 1.0,
    };
    let expected: Vec<f64> = (1..=31).map(|k| f64::from(k) * PI - 0.1).collect();
    times_agree(&times(&problem, 100.0), &expected);
    let (mut t, mut x, mut v, mut a) = (0.0, 0.0, 0.0, 1.0);
    for end in expected.into_iter().chain([100.0]) {
        let tau: f64 = end - t;
        x += v * tau + a * tau * tau / 2.0;
        v += a * tau;
        (t, a) = (end, -a);
    }
    let found = accurate(&problem, 100.0, 1000).state(100.0);
    assert!(
        (found[0] - x).abs() < 1e-11 && (found[1] - v).abs() < 1e-12,
        "{found:?} {x} {v}"
    );
}

#[test]
fn contacts_tell_how_near_a_solution_came() {
    // x = sin t, which stays 10⁻⁹ below the wall, or crosses it by as much
    for (wall, crossings) in [(1.0 + 1e-9, 0), (1.0 - 1e-9, 2)] {
        let line = Formulas::of(move |w| {
            let [x, _] = w.state();
            vec![x - wall]
        });
        let solution = accurate(&oscillator(line, [0.0, 1.0]), 4.0, 1000);
        assert_eq!(solution.crossings.len(), crossings);
        let least = solution.contacts.iter().map(|contact| contact.margin);
        let least = least.fold(f64::INFINITY, f64::min);
        // what lies beyond a wall is sampled
        assert!((least - 1e-9).abs() < 1e-11, "{least:e}");
    }
}

#[test]
fn a_flat_bell_is_left_and_entered_far_from_any_contact() {
    // for x > 0.4 the bell is 10⁻³⁰⁰ and less: its slope underflows
    let bell = Formulas::of(|w| {
        let [x, _] = w.state();
        vec![((x + 1.0).square() * -400.0).exp() - 1e-30]
    });
    let solution = accurate(&oscillator(bell, [0.0, 1.0]), 20.0, 1000);
    assert_eq!(solution.crossings.len(), 6);
    let least = solution.contacts.iter().map(|contact| contact.margin);
    let least = least.fold(f64::INFINITY, f64::min);
    assert!(least > 1e-3, "{least:e}");
}

#[test]
fn sliding_and_accumulation_end_a_solution() {
    let field = |a: f64| {
        Formulas::of(move |w| {
            let [_, v] = w.state();
            vec![v, w.number(a)]
        })
    };
    let mut problem = Problem {
        fields: vec![field(1.0), field(-1.0)],
        switching: Formulas::of(|w| {
            let [_, v] = w.state();
            vec![v - 1.0]
        }),
        initial: vec![0.0, 0.0],
        size: 1.0,
        rate: 1.0,
    };
    let solution = accurate(&problem, 6.0, 1000);
    assert_eq!(solution.ending, Ending::Sliding);
    assert!((solution.t_end - 1.0).abs() < 1e-15);
    // Fuller's problem: switching on the curve x = −c v|v|
    problem.switching = Formulas::of(|w| {
        let [x, v] = w.state();
        vec![x + v * (v.square()).sqrt() * 0.444_623_560_3]
    });
    problem.initial = vec![1.0, 0.0];
    let solution = accurate(&problem, 20.0, 1000);
    assert_eq!(solution.ending, Ending::Accumulation);
}

#[test]
fn growth_is_that_of_the_flow() {
    let unstable = Formulas::of(|w| {
        let [x, y] = w.state();
        vec![x, -y]
    });
    let problem = Problem {
        fields: vec![unstable.clone(), unstable],
        switching: Formulas::of(|w| {
            let [x, _] = w.state();
            vec![x - 100.0]
        }),
        initial: vec![0.1, 1.0],
        size: 1.0,
        rate: 1.0,
    };
    let solution = accurate(&problem, 6.0, 1000);
    let growth = Growth::measure(&problem, &solution, 1e-7);
    let expected = 6.0_f64.exp();
    assert!(
        (growth.until(6.0) / expected - 1.0).abs() < 0.3,
        "{}",
        growth.until(6.0)
    );
    assert!((growth.last_below(20.0) - 20.0_f64.ln()).abs() < 0.3);
}

/// Keeps what was wrong.
#[derive(Default)]
struct Wrong {
    cases: usize,
    wrong: Vec<Row>,
}

impl Observe for Wrong {
    fn ended(&mut self, row: Row) {
        self.cases += 1;
        if row.verdict == Verdict::Wrong {
            self.wrong.push(row);
        }
    }
}

#[test]
fn nothing_differs_in_silence() {
    let mut seen = Wrong::default();
    crate::study::study(Extent::Brief, &mut seen);
    crate::affine::study(Extent::Brief, &mut seen);
    assert!(seen.cases > 100);
    assert_eq!(seen.wrong, []);
}
