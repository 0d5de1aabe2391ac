//! `pws!` may stand wherever an item may: under whatever name the runtime has, through whatever
//! crate it comes, and among whatever names. Each test integrates what it declares.

#![deny(warnings)]

/// The runtime under another name in `Cargo.toml`.
mod renamed {
    use ode::{pws, Best, Integrator};

    pws! {
        /// A rotation.
        system Rotation {
            state x, y;
            der(x) = y;
            der(y) = -x;
            conserved radius = x^2 + y^2;
        }
    }

    #[test]
    fn the_runtime_may_have_another_name() {
        let solution = Integrator::new(&Rotation::default(), Best::tolerance(1e-12))
            .initial(0.0, [1.0, 0.0])
            .run_until(1.0)
            .unwrap();
        assert!((solution.last().unwrap().x[0] - 1.0_f64.cos()).abs() < 1e-12);
    }
}

/// The macro through a crate that re-exports it, which is the only one in sight here.
mod re_exported {
    use dmm_facade::{Best, Integrator, System};

    dmm_facade::pws! {
        /// A decay that is slower below one.
        pub(crate) system Decay {
            state x;
            interface one = x - 1;
            region fast where one > 0 { der(x) = -2*x; }
            region slow where one < 0 { der(x) = -x; }
        }
    }

    #[test]
    fn the_macro_may_come_through_another_crate() {
        let solution = Integrator::new(&Decay::default(), Best::tolerance(1e-12))
            .initial(0.0, [2.0])
            .run_until(1.0)
            .unwrap();
        let crossing = 2.0_f64.ln() / 2.0;
        assert!((solution.transitions()[0].t - crossing).abs() < 1e-12);
        assert!((solution.last().unwrap().x[0] - (crossing - 1.0).exp()).abs() < 1e-12);
        assert_eq!(Decay::default().metadata().name, "Decay");
    }
}

/// Within a function, beside variables and generics of it.
mod local {
    use ode::{pws, Best, Integrator};

    fn last<S: Into<f64>>(x: S) -> f64 {
        pws! {
            system Growth {
                state x;
                param k = 1;
                der(x) = k*x;
            }
        }
        let growth = Growth { k: 2.0 };
        Integrator::new(&growth, Best::tolerance(1e-12))
            .initial(0.0, [x.into()])
            .run_until(1.0)
            .unwrap()
            .last()
            .unwrap()
            .x[0]
    }

    #[test]
    fn a_system_may_be_declared_in_a_function() {
        assert!((last(1.0_f32) - 2.0_f64.exp()).abs() < 1e-11);
    }

    #[test]
    fn a_system_may_be_declared_in_a_block() {
        let solution = {
            pws! { system Fall { state h, v; der(h) = v; der(v) = -1; conserved e = v^2/2 + h; } }
            Integrator::new(&Fall {}, Best::tolerance(1e-12))
                .initial(0.0, [1.0, 0.0])
                .run_until(1.0)
                .unwrap()
        };
        assert!((solution.last().unwrap().x[0] - 0.5).abs() < 1e-14);
    }
}

/// Several systems in one module, with regions and interfaces of the same names.
mod several {
    use ode::{pws, Best, Integrator};

    pws! {
        system First {
            state x, y;
            interface wall = x;
            region right where wall > 0 { der(x) = y; der(y) = -x; conserved e = x^2 + y^2; }
            region left where wall < 0 { der(x) = y; der(y) = -4*x; conserved e = 4*x^2 + y^2; }
        }
    }

    pws! {
        system Second {
            state x, y;
            interface wall = x;
            region right where wall > 0 { der(x) = y; der(y) = -x; conserved e = x^2 + y^2; }
            region left where wall < 0 { der(x) = y; der(y) = -9*x; conserved e = 9*x^2 + y^2; }
        }
    }

    #[test]
    fn systems_stand_beside_each_other() {
        let method = Best::tolerance(1e-12);
        let first = Integrator::new(&First {}, method)
            .initial(0.0, [1.0, 0.0])
            .run_until(4.0)
            .unwrap();
        let second = Integrator::new(&Second {}, method)
            .initial(0.0, [1.0, 0.0])
            .run_until(4.0)
            .unwrap();
        assert_eq!(first.transitions()[0].from, FirstRegion::Right);
        assert_eq!(second.transitions()[0].to, SecondRegion::Left);
        // half a period on the left
        let half = |solution: f64, from: f64| solution - from;
        let pi = std::f64::consts::PI;
        assert!(
            (half(first.transitions()[1].t, first.transitions()[0].t) - pi / 2.0).abs() < 1e-11
        );
        assert!(
            (half(second.transitions()[1].t, second.transitions()[0].t) - pi / 3.0).abs() < 1e-11
        );
    }
}

/// Names that Rust's prelude has mean something else here, and emitted code does not care.
#[allow(
    clippy::all,
    dead_code,
    non_camel_case_types,
    non_snake_case,
    unused_macros
)]
mod hostile {
    use ode::pws;

    pub(super) mod core {}
    pub(super) mod std {}
    pub(super) mod dmm {}
    pub(super) mod dmm_runtime {}
    pub(super) struct f64;
    pub(super) struct usize;
    pub(super) struct u32;
    pub(super) struct str;
    pub(super) struct bool;
    pub(super) struct Vec;
    pub(super) struct String;
    pub(super) enum Option {
        Some,
        None,
    }
    pub(super) struct Result;
    pub(super) fn Some() {}
    pub(super) struct None;
    pub(super) struct Ok;
    pub(super) struct Err;
    pub(super) struct Guards;
    pub(super) struct System;
    pub(super) trait Default {}
    pub(super) trait Clone {}
    pub(super) trait Copy {}
    pub(super) trait Debug {}
    pub(super) trait PartialEq {}
    pub(super) trait Eq {}
    pub(super) trait Hash {}
    pub(super) trait Fn {}
    pub(super) trait FnMut {}
    pub(super) trait Into {}
    pub(super) trait From {}
    pub(super) trait Iterator {}
    // a pattern would match these instead of binding a name
    pub(super) const G: i8 = 1;
    pub(super) const G_2: i8 = 1;
    pub(super) const COUNT: i8 = 1;
    pub(super) static P: i8 = 1;
    /// Methods that everything has.
    pub(super) trait Everywhere {
        fn new(&self) {}
        fn get(&self) {}
        fn abs(&self) {}
        fn from_f64(&self) {}
        fn metadata(&self) {}
        fn visit(&self) {}
    }
    impl<T> Everywhere for T {}

    macro_rules! vec {
        ($($token:tt)*) => {
            compile_error!("the wrong macro")
        };
    }
    macro_rules! matches {
        ($($token:tt)*) => {
            compile_error!("the wrong macro")
        };
    }

    pws! {
        /// A pendulum with drag above the height G.
        pub(super) system Pendulum {
            state x, G;
            param c = 1/10, k[2] = [1, 2], unused_f64 = 3;
            let height = 1 - cos(x);
            interface level = height - 1/2 + 0*unused_f64;
            region above where level > 0 {
                der(x) = G;
                der(G) = -k[0]*sin(x) - c*G;
            }
            region below where level < 0 {
                hamiltonian energy = G^2/2 + k[0]*height in (x, G);
            }
        }
    }

    pws! {
        /// A rotation with its angle, and with an energy that a driven clock has.
        pub(super) system Clock {
            state x, P, angle_;
            param K = 2;
            der(x) = -P;
            der(P) = x;
            der(angle_) = cos(K*t);
            conserved angle = atan(P/x) - t;
            conserved drift = angle_ - sin(K*t)/K;
        }
    }
}

/// Systems with the names of what generated code is generic over.
mod short {
    use ode::pws;

    pws! {
        pub(super) system P {
            state x, y;
            interface level = y;
            der(x) = y;
            region above where level > 0 { der(y) = -sin(x); }
            region below where level < 0 { der(y) = -3*x; }
        }
    }

    pws! {
        pub(super) system K { state x; der(x) = -x^2; }
    }

    pws! {
        pub(super) system S { state x; der(x) = exp(-x); }
    }
}

#[test]
fn a_system_may_have_any_name() {
    use ode::{Integrator, Taylor};

    let rotated = Integrator::new(&short::P {}, Taylor::tolerance(1e-12))
        .initial(0.0, [1.0, 0.5])
        .run_until(2.0)
        .unwrap();
    assert_eq!(rotated.transitions()[0].to, short::PRegion::Below);
    // 1/(1 + t) and ln(1 + t)
    let fallen = Integrator::new(&short::K {}, Taylor::tolerance(1e-14))
        .initial(0.0, [1.0])
        .run_until(1.0)
        .unwrap();
    assert!((fallen.last().unwrap().x[0] - 0.5).abs() < 1e-12);
    let risen = Integrator::new(&short::S {}, Taylor::tolerance(1e-14))
        .initial(0.0, [0.0])
        .run_until(1.0)
        .unwrap();
    assert!((risen.last().unwrap().x[0] - 2.0_f64.ln()).abs() < 1e-12);
}

#[test]
fn names_around_a_declaration_change_nothing() {
    use ode::{Integrator, Symmetric, System, Taylor};

    let pendulum = hostile::Pendulum::default();
    assert_eq!(pendulum.k, [1.0, 2.0]);
    assert_eq!(System::parameters(&pendulum), [0.1, 1.0, 2.0, 3.0]);
    let start = [1.5, 0.0];
    let one = Integrator::new(&pendulum, Taylor::tolerance(1e-10))
        .initial(0.0, start)
        .run_until(5.0)
        .unwrap();
    assert_eq!(one.transitions()[0].to, hostile::PendulumRegion::Below);
    let other = Integrator::new(&pendulum, Symmetric::step_size(1e-3))
        .initial(0.0, start)
        .run_until(5.0)
        .unwrap();
    let (one, other) = (one.last().unwrap().x, other.last().unwrap().x);
    assert!((one[0] - other[0]).abs() < 1e-5);

    let clock = hostile::Clock::default();
    let end = Integrator::new(&clock, Symmetric::step_size(1e-3))
        .initial(0.0, [1.0, 0.5, 0.0])
        .run_until(1.0)
        .unwrap();
    let end = end.last().unwrap().x;
    assert!((end[2] - 2.0_f64.sin() / 2.0).abs() < 1e-14);
}

/// A macro of one's own that declares a system: what it was given stands in the declaration.
mod by_macro {
    use ode::{pws, Best, Integrator};

    macro_rules! oscillator {
        ($name:ident, $state:ident, $stiffness:literal, $force:expr) => {
            pws! {
                system $name {
                    state $state, v;
                    der($state) = v;
                    der(v) = -$stiffness*$state + $force;
                }
            }
        };
    }

    oscillator!(Soft, x, 1, 0);
    oscillator!(Stiff, y, 4, 2 + 2);

    #[test]
    fn a_declaration_may_come_from_a_macro() {
        let method = Best::tolerance(1e-12);
        let soft = Integrator::new(&Soft {}, method)
            .initial(0.0, [1.0, 0.0])
            .run_until(1.0)
            .unwrap();
        let stiff = Integrator::new(&Stiff {}, method)
            .initial(0.0, [2.0, 0.0])
            .run_until(1.0)
            .unwrap();
        assert!((soft.last().unwrap().x[0] - 1.0_f64.cos()).abs() < 1e-12);
        assert!((stiff.last().unwrap().x[0] - 1.0 - 2.0_f64.cos()).abs() < 1e-12);
    }
}
