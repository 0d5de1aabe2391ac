//! Transitions that accumulate.

use dmm_runtime::{Best, Composed, ErrorKind, Method, Symmetric, Taylor, pws};
use dmm_tests::run;

pws! {
    /// Fuller's problem: the switching curve x + c v|v| leads to the origin by ever shorter arcs.
    pub system Fuller {
        state x, v;
        param c = 0.444_623_560_311_059;
        interface curve = x + c*v*sqrt(v^2);
        region right where curve > 0 { der(x) = v; der(v) = -1; }
        region left where curve < 0 { der(x) = v; der(v) = 1; }
    }
}

fn accumulates(scheme: impl Method) {
    let halted = run(&Fuller::default(), scheme, [1.0, 0.0], 100.0).unwrap_err();
    let end = halted.end().unwrap();
    // near the origin, where nothing is determined any more
    assert!(end.point.x.norm() < 1e-5, "{end:?}");
    assert!(end.statistics.transitions > 5, "{end:?}");
    assert!(
        matches!(
            halted.error().kind,
            ErrorKind::Zeno { .. }
                | ErrorKind::Undecided { .. }
                | ErrorKind::Sliding { .. }
                | ErrorKind::Tangential { .. }
                | ErrorKind::LocationFailed { .. }
        ),
        "{halted}"
    );
}

#[test]
fn an_accumulation_is_told() {
    accumulates(Taylor::tolerance(1e-12));
    accumulates(Best::tolerance(1e-12));
    accumulates(Composed::<6>::tolerance(1e-9));
    accumulates(Symmetric::step_size(1e-2));
}
