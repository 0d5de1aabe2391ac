//! What is derived from a declaration.

super::codes! {
    IDENTITY = 400, "a derived scheme violates an identity that it rests on",
        "An error of the compiler, not of the declaration.",
        "Report it with the declaration.";
}
