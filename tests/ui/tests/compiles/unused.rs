//! What is not used is a warning, which can be silenced: of a name, and of a declaration.
#![deny(warnings)]

use dmm_runtime::{System, pws};

pws! {
    /// What is meant to be unused begins with `_`.
    pub system Meant {
        state x;
        param _k = 1;
        interface _wall = x;
        der(x) = 1;
    }
}

#[allow(deprecated)]
mod silenced {
    use dmm_runtime::pws;

    pws! {
        /// An interface without regions changes nothing.
        pub system Silenced {
            state x;
            param k = 1;
            interface wall = x;
            der(x) = 1;
        }
    }
}

#[test]
fn compiles() {
    assert_eq!(Meant { _k: 2.0 }, Meant { _k: 2.0 });
    assert_eq!(silenced::Silenced::default().k, 1.0);
    assert!(
        silenced::Silenced::default()
            .metadata()
            .interfaces
            .is_empty()
    );
}
