//! Where sliding begins and ends, and what is refused.

use super::{Failure, assert_close, story, taylor};

#[test]
fn the_four_cases_of_example_3() -> Result<(), Failure> {
    // Nurkanović, Sperl, Albrecht & Diehl (2024), Example 3
    let crossing = "system A { state x; der(x) = 2 - (if x > 0 sliding { 1 } else { -1 }); }";
    let way = taylor(crossing, &[], &[-1.0], 1.0)?;
    assert_eq!(story(&way), ["crosses x"]);
    assert_close(way.passed[0].t, 1.0 / 3.0, 1e-15);
    assert_close(way.end[0], 2.0 / 3.0, 1e-15);

    let sliding = "system B { state x; der(x) = -(if x > 0 sliding { 1 } else { -1 }); }";
    for x0 in [1.0, -1.0, 0.0] {
        let way = taylor(sliding, &[], &[x0], 2.0)?;
        assert_eq!(way.passed.len(), usize::from(x0 != 0.0));
        assert_eq!(way.end, [0.0]);
    }

    let leaving = "system C { state x; der(x) = t - (if x > 0 sliding { 1 } else { -1 }); }";
    let way = taylor(leaving, &[], &[0.0], 2.0)?;
    assert_eq!(story(&way), ["leaves x"]);
    assert_close(way.passed[0].t, 1.0, 1e-15);
    assert_close(way.end[0], 0.5, 1e-15);

    let spontaneous = "system D { state x; der(x) = if x > 0 sliding { 1 } else { -1 }; }";
    let text = taylor(spontaneous, &[], &[0.0], 1.0)
        .unwrap_err()
        .to_string();
    assert!(
        text.contains("everywhere (x > 0)`, `everywhere (x < 0)"),
        "{text}"
    );
    Ok(())
}

#[test]
fn sliding_that_is_not_declared_is_an_error() {
    let declaration = "system S { state x; der(x) = -sign(x); }";
    let text = taylor(declaration, &[], &[1.0], 2.0)
        .unwrap_err()
        .to_string();
    assert!(text.contains("sliding"), "{text}");
    assert!(text.contains("-1") && text.contains('1'), "{text}");
}

#[test]
fn a_refuge_keeps_the_prey_at_its_threshold() -> Result<(), Failure> {
    // Křivan: predators see the prey above a threshold only
    let declaration = include_str!("../../../problems/hybrid/refuge.pws");
    let way = taylor(declaration, &[], &[0.5, 2.0], 20.0)?;
    assert_eq!(story(&way), ["leaves refuge"]);
    assert_close(way.passed[0].t, 3.0_f64.ln(), 1e-14);
    assert_close(way.passed[0].x[1], 1.0, 1e-14);
    // the cycle that touches the threshold: its period
    let period = 6.487_039_933_69;
    let later = taylor(declaration, &[], &[0.5, 2.0], 3.0_f64.ln() + 0.7)?;
    let again = taylor(declaration, &[], &[0.5, 2.0], 3.0_f64.ln() + 0.7 + period)?;
    assert_eq!(again.passed.len(), 1);
    for (value, expected) in again.end.iter().zip(&later.end) {
        assert_close(*value, *expected, 1e-10);
    }
    Ok(())
}

#[test]
fn a_sliding_solution_crosses_another_interface() -> Result<(), Failure> {
    // along x = 0 upwards until the wind turns at y = 1, which blows the solution off at y = 1.5
    let declaration = "system Wind {
        state x, y;
        interface line = x, sliding;
        interface height = y - 1;
        region left where line < 0 { der(x) = 1; der(y) = 1; }
        region right where line > 0 and height < 0 { der(x) = -1; der(y) = 0; }
        region turned where line > 0 and height > 0 { der(x) = 2*(y - 1.5); der(y) = 1; }
    }";
    let way = taylor(declaration, &[], &[-0.25, 0.0], 4.0)?;
    assert_eq!(
        story(&way),
        ["slides on line", "crosses height", "leaves line"]
    );
    assert_close(way.passed[0].t, 0.25, 1e-15);
    // y' = 1/2 on the line
    assert_close(way.passed[1].t, 1.75, 1e-15);
    assert_close(way.passed[2].t, 2.25, 1e-14);
    assert_close(way.end[0], 1.75 * 1.75, 1e-13);
    Ok(())
}

#[test]
fn a_start_at_the_end_of_sliding_goes_where_the_field_turns() -> Result<(), Failure> {
    // at x = 1/2 the force of the spring is that of friction; further out it is stronger
    let declaration = "system Mass {
        state x, v;
        der(x) = v;
        der(v) = -x - (if v > 0.25 sliding { 1/2 } else { -1/2 });
    }";
    // it slips at once: a circle about 1/2
    let way = taylor(declaration, &[], &[0.5, 0.25], 1.0)?;
    assert!(way.passed.is_empty(), "{way:?}");
    assert_close(way.end[0], 0.5 + 0.25 * 1.0_f64.sin(), 1e-15);
    assert_close(way.end[1], 0.25 * 1.0_f64.cos(), 1e-15);
    // at −1/2 it sticks, and is carried to 1/2
    let way = taylor(declaration, &[], &[-0.5, 0.25], 5.0)?;
    assert_eq!(story(&way), ["leaves v - 0.25".replace("0.25", "1/4")]);
    assert_close(way.passed[0].t, 4.0, 1e-15);
    Ok(())
}
