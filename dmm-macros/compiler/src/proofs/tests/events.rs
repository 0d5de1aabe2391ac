//! What events conserve.

use super::{messages, one};

/// A ball that bounces so.
fn ball(event: &str) -> String {
    format!(
        "state y, v; interface floor = y;
         der(y) = v; der(v) = -1; conserved energy = v^2/2 + y;
         on floor falling {{ {event} }}"
    )
}

#[test]
fn what_an_event_conserves_is_proved() {
    for event in [
        "v = -v; conserves energy;",
        // at y = 0
        "v = -v; y = -y; conserves energy;",
        "conserves energy;",
    ] {
        assert_eq!(messages(&ball(event)), Vec::<String>::new(), "{event}");
    }
    // reflected by the normal of an ellipse
    let billiard = "state x, y, u, v; param a = 2; interface wall = x^2/a^2 + y^2 - 1;
        der(x) = u; der(y) = v; der(u) = 0; der(v) = 0; conserved energy = u^2 + v^2;
        let n = x/a^2*u + y*v; let m = x^2/a^4 + y^2;
        on wall rising { u = u - 2*n*x/a^2/m; v = v - 2*n*y/m; conserves energy; }";
    assert_eq!(messages(billiard), Vec::<String>::new());
}

/// A billiard in an ellipse, with what an impact is claimed to conserve.
fn billiard(event: &str) -> String {
    format!(
        "state x, y, u, v; param a = 2, b = 1; interface wall = x^2/a^2 + y^2/b^2 - 1;
        der(x) = u; der(y) = v; der(u) = 0; der(v) = 0; conserved energy = u^2 + v^2;
        conserved momenta = (x*v - y*u)^2 - (a^2 - b^2)*v^2;
        let n = (x*u/a^2 + y*v/b^2) / (x^2/a^4 + y^2/b^4);
        on wall rising {{ {event} }}"
    )
}

#[test]
fn what_holds_on_a_curved_interface_alone_is_proved() {
    let reflection = "u = u - 2*n*x/a^2; v = v - 2*n*y/b^2; conserves energy, momenta;";
    assert_eq!(messages(&billiard(reflection)), Vec::<String>::new());
    // x y = 1 gives no state by the others here: what is true is not proved, and not refuted
    let hyperbola = "state x, y; interface branch = x*y - 1; der(x) = 1; der(y) = 1;
        conserved difference = x - y; on branch rising { x = 1/y; conserves difference; }";
    one(
        hyperbola,
        &["could not be proved that this event conserves `difference`"],
    );
}

#[test]
fn what_does_not_hold_on_a_curved_interface_is_refuted() {
    one(
        &billiard("u = -u; conserves momenta;"),
        &["this event does not conserve `momenta`, which changes by"],
    );
    let hyperbola = "state x, y; interface branch = x*y - 1; der(x) = 1; der(y) = 1;
        conserved difference = x - y; on branch rising { x = 2/y; conserves difference; }";
    one(
        hyperbola,
        &["this event does not conserve `difference`, which changes by"],
    );
}

#[test]
fn what_an_event_does_not_conserve_is_refuted() {
    one(
        &ball("v = -v/2; conserves energy;"),
        &["this event does not conserve `energy`, which changes by"],
    );
    one(
        &ball("v = -v; y = y + 1; conserves energy;"),
        &["this event does not conserve `energy`, which changes by 1"],
    );
    one(
        &ball("v = -v; conserves enery;"),
        &["did you mean `energy`?"],
    );
}
