//! Events as they are written.

use super::item_messages;

#[test]
fn one_precise_message_for_a_wrong_event() {
    for (event, message) in [
        ("on floor falling { v == 0; }", "write `v = …` with one `=`"),
        (
            "on floor falling { v += 1; }",
            "nothing is added up: write the whole formula",
        ),
        (
            "on floor down { v = 0; }",
            "expected `rising`, `falling`, `where …` or the block",
        ),
        (
            "on floor > 0 { v = 0; }",
            "an event has a direction instead of a sign",
        ),
        (
            "on floor falling where v <= 0 { v = 0; }",
            "write `>` or `<`",
        ),
        ("on floor falling where v { v = 0; }", "expected `>` or `<`"),
        (
            "on floor falling { der(v) = 0; }",
            "an event changes states, not how they go on",
        ),
        ("on floor falling;", "expected a block of what changes"),
        (
            "on where v > 0 { v = 0; }",
            "expected the name of an interface",
        ),
        ("every { v = 0; }", "a formula has no block"),
        (
            "on floor falling { conserves 2; }",
            "a name does not begin with a digit",
        ),
    ] {
        let messages = item_messages(event);
        assert_eq!(messages.len(), 1, "{event}: {messages:?}");
        assert!(messages[0].contains(message), "{event}: {messages:?}");
    }
}
