//! Discrete states and events.

use super::{messages, model, one};

/// A ball with these items.
fn ball(items: &str) -> String {
    format!("state y, v; param k = 1; interface floor = y; der(y) = v; der(v) = -k; {items}")
}

#[test]
fn events_are_read() {
    let model = model(&format!(
        "system S {{ {} }}",
        ball(
            "discrete n = 0;
         on floor falling where v < 0 and n < 3 { v = -v; n = n + 1; }
         on floor rising { n = 0; }
         every 2*k { v = 0; }
         at 3 { y = 1; }",
        )
    ));
    let directions: Vec<(usize, bool, bool)> = (model.events.iter())
        .map(|event| (event.interface, event.rises, event.falls))
        .collect();
    assert_eq!(
        directions,
        [
            (0, false, true),
            (0, true, false),
            (1, true, false),
            (2, true, false)
        ]
    );
    assert_eq!(model.events[0].conditions.len(), 2);
    assert_eq!(model.events[0].discrete.len(), 1);
    assert_eq!(model.free_interfaces(), [0, 1, 2]);
    // the second counts the periods
    assert_eq!(model.discrete.len(), 2);
    assert!(model.discrete[1].is_clock);
}

#[test]
fn what_is_wrong_with_an_event_is_told_where_it_is() {
    for (items, message) in [
        (
            "on flor falling { v = 0; }",
            "there is no interface `flor`; did you mean `floor`?",
        ),
        (
            "on y falling { v = 0; }",
            "`y` is a state, not an interface: declare `interface name = y;`",
        ),
        (
            "on floor falling { w = 0; }",
            "there is no state `w`: declare `discrete w = …;`",
        ),
        (
            "on floor falling { k = 2; }",
            "`k` is a parameter, and an event changes states",
        ),
        (
            "on floor falling { v = 0; v = 1; }",
            "`v` is given two values",
        ),
        (
            "every y { v = 0; } on floor { v = 0; }",
            "depends on parameters and constants alone",
        ),
        (
            "every 0 { v = 0; } on floor { v = 0; }",
            "the time between events is positive",
        ),
        (
            "discrete n = y; on floor { n = 0; }",
            "the initial value of a discrete state cannot depend on the state `y`",
        ),
        (
            "discrete v = 0; on floor { y = 0; }",
            "`v` is already declared as a state",
        ),
    ] {
        one(&ball(items), message);
    }
    assert_eq!(
        messages(&ball("on floor { v = v + y; }")),
        Vec::<String>::new()
    );
}

#[test]
fn an_interface_of_a_region_may_have_events_too() {
    let model = model(
        "system S { state x, v; interface wall = x;
         region left where wall < 0 { der(x) = v; der(v) = 0; on wall rising { v = v/2; } }
         region right where wall > 0 { der(x) = v; der(v) = -1; } }",
    );
    let region = model.events[0].region.as_ref().map(ToString::to_string);
    assert_eq!(region.as_deref(), Some("left"));
}
