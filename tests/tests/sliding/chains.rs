//! Many switches that slide independently.

use super::{Failure, assert_close, taylor};

/// Blocks on a belt, coupled by springs, with dry friction on each.
fn blocks(count: usize) -> String {
    format!(
        "system Blocks {{
            state x[{count}], v[{count}];
            param speed = 0.2, force = 0.4, k = 1.3;
            fn friction(i) = -force*(1 + i/50)*(if v[i] > speed sliding {{ 1 }} else {{ -1 }});
            for i in 0..{count} {{ der(x[i]) = v[i]; }}
            der(v[0]) = -x[0] - k*(x[0] - x[1]) + friction(0);
            for i in 1..{count} - 1 {{
                der(v[i]) = -x[i] + k*(x[i-1] - 2*x[i] + x[i+1]) + friction(i);
            }}
            der(v[{count} - 1]) = -x[{count} - 1] - k*(x[{count} - 1] - x[{count} - 2]) + friction({count} - 1);
        }}"
    )
}

#[test]
fn twenty_blocks_stick_and_slip() -> Result<(), Failure> {
    let count = 20;
    let declaration = blocks(count);
    // all of them stick at first: twenty interfaces at once
    let mut x0 = vec![0.0; 2 * count];
    for (index, entry) in x0.iter_mut().enumerate() {
        *entry = if index < count {
            0.01 * index as f64
        } else {
            0.2
        };
    }
    let way = taylor(&declaration, &[], &x0, 10.0)?;
    assert!(way.passed.len() > count, "{}", way.passed.len());
    // backwards in the order of the blocks it is the same system but for the friction: no order of
    // declaration may matter, so an even force gives a mirror image
    let even = declaration.replace("(1 + i/50)*", "");
    let mirror = |x: &[f64]| -> Vec<f64> {
        let (places, speeds) = x.split_at(count);
        places
            .iter()
            .rev()
            .chain(speeds.iter().rev())
            .copied()
            .collect()
    };
    let one = taylor(&even, &[], &x0, 10.0)?;
    let other = taylor(&even, &[], &mirror(&x0), 10.0)?;
    assert_eq!(one.passed.len(), other.passed.len());
    for (value, expected) in one.end.iter().zip(mirror(&other.end)) {
        assert_close(*value, expected, 1e-12);
    }
    Ok(())
}

/// Plates that lie on one another, with friction between neighbours and a force on the lowest one.
const PLATES: &str = "system Plates {
    const n = 6;
    state v[n];
    param force = 1.5, friction = 1;
    fn mass(i) = 1 + i/4;
    fn grip(i) = 5*friction*(if v[i - 1] - v[i] > 0 sliding { 1 } else { -1 });
    der(v[0]) = (force - grip(1))/mass(0);
    for i in 1..n - 1 { der(v[i]) = (grip(i) - grip(i + 1))/mass(i); }
    der(v[n - 1]) = grip(n - 1)/mass(n - 1);
}";

#[test]
fn plates_that_stick_together_move_as_one() -> Result<(), Failure> {
    // five interfaces that depend on one another, from rest
    let way = taylor(PLATES, &[], &[0.0; 6], 2.0)?;
    assert!(way.passed.is_empty(), "{way:?}");
    let mass: f64 = (0..6).map(|i| 1.0 + f64::from(i) / 4.0).sum();
    for &speed in &way.end {
        assert_close(speed, 1.5 * 2.0 / mass, 1e-15);
    }
    // a force that is too much for the grip of the first: only it slips, and the others follow as one
    let way = taylor(PLATES, &[("force", 30.0)], &[0.0; 6], 2.0)?;
    let rest = mass - 1.0;
    assert_close(way.end[0], 2.0 * (30.0 - 5.0), 1e-14);
    for &speed in &way.end[1..] {
        assert_close(speed, 2.0 * 5.0 / rest, 1e-14);
    }
    Ok(())
}

#[test]
fn a_block_on_a_block_on_the_ground_is_driven() -> Result<(), Failure> {
    // while the lower one rests, its velocity and the even derivatives of that are zero
    let declaration = "system Stacked {
        state x, y, u, v;
        let rubs = 0.4*(if u - v > 0 sliding { 1 } else { -1 });
        der(x) = u;
        der(y) = v;
        der(u) = 0.9*cos(0.7*t) - x - rubs;
        der(v) = 0.6*sin(0.4*t) - 1.3*y + rubs - 0.3*(if v > 0 sliding { 1 } else { -1 });
    }";
    let way = taylor(declaration, &[], &[0.3, -0.2, 0.0, 0.1], 100.0)?;
    assert_eq!(way.passed.len(), 70);
    // as by the compositions of order 4 and 6, which agree to 2e-9
    assert_close(way.end[0], 1.084_879_19, 1e-8);
    assert_close(way.end[1], 0.666_279_460, 1e-8);
    assert_close(way.end[2], -0.524_830_488, 1e-8);
    assert_close(way.end[3], way.end[2], 1e-15);
    Ok(())
}
