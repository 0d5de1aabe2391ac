//! Declarations of systems, as a program that compiles them when it runs needs them, and as types.

/// Declares a system: its text, `DECLARATION`, and with the feature `types` what `pws!` makes of it.
macro_rules! declaration {
    ($($declaration:tt)*) => {
        /// The declaration.
        pub const DECLARATION: &str = stringify!($($declaration)*);

        #[cfg(feature = "types")]
        dmm_runtime::pws! { $($declaration)* }
    };
}
