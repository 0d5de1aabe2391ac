//! Declarations of systems as texts, and as types.

/// Declares a system: its text, `DECLARATION`, which is compiled when a program runs, and with the
/// feature `types` what the macro of the runtime makes of it.
macro_rules! pws {
    ($($declaration:tt)*) => {
        /// The declaration.
        pub const DECLARATION: &str = stringify!($($declaration)*);

        #[cfg(feature = "types")]
        dmm_runtime::pws! { $($declaration)* }
    };
}
