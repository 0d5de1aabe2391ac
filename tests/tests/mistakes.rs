//! Mistakes that a newcomer makes with the integrators, and what they say.
//!
//! Those with the language are in the compiler's tests (`dmm-macros/compiler/tests/mistakes`).

use std::fmt::{Display, Write as _};

use dmm_runtime::dynamic::{
    AnySystem, Erased, InitialValue, MethodChoice, MethodVisitor, Unobserved,
};
use dmm_runtime::{Best, Integrator, Method, Model, Symmetric, Taylor, pws};
use insta::assert_snapshot;

pws! {
    /// An oscillator that is stiffer below y = 0.
    pub system Oscillator {
        state x, y;
        param k = 3;
        interface rest = y;
        region above where rest > 0 { der(x) = y; der(y) = -x; conserved e = x^2 + y^2; }
        region below where rest < 0 { der(x) = y; der(y) = -k*x; conserved e = k*x^2 + y^2; }
    }
}

pws! {
    /// A growth that has no value where x < 0.
    pub system Logarithmic {
        state x;
        der(x) = -1 - ln(x)^2;
    }
}

pws! {
    /// A block that a wall pushes back as strongly as it is pushed there.
    pub system Block {
        state x;
        param forth = 1, back = -1;
        interface wall = x;
        region left where wall < 0 { der(x) = forth; }
        region right where wall > 0 { der(x) = back; }
    }
}

/// `Best`, by a tolerance.
struct Tolerance(f64);

impl MethodChoice for Tolerance {
    fn visit<V: MethodVisitor>(&self, visitor: V) -> V::Output {
        visitor.visit(Best::tolerance(self.0))
    }
}

/// The names of mistakes with what was said to them.
#[derive(Default)]
struct Said(String);

impl Said {
    /// Takes note of what is said to a mistake, of which there has to be something.
    fn to<T>(&mut self, mistake: &str, outcome: Result<T, impl Display>) {
        let error = outcome
            .err()
            .unwrap_or_else(|| panic!("{mistake}: nothing is said"));
        writeln!(self.0, "== {mistake}\n\nerror: {error}\n").expect("text");
    }
}

/// What a run from (1, 0) until t = 10 says.
fn run(method: impl Method) -> Result<(), impl Display> {
    let oscillator = Oscillator::default();
    let run = Integrator::new(&oscillator, method)
        .initial(0.0, [1.0, 0.5])
        .run_until(10.0);
    run.map(drop)
}

#[test]
fn errors_say_what_to_do() {
    let mut said = Said::default();
    settings(&mut said);
    starts(&mut said);
    outputs(&mut said);
    models(&mut said);
    assert_eq!(said.0.matches("== ").count(), 19);
    assert_snapshot!("errors", said.0);
}

fn settings(said: &mut Said) {
    said.to(
        "tolerance zero: as exact as possible",
        run(Best::tolerance(0.0)),
    );
    said.to(
        "negative tolerance: an exponent was meant",
        run(Taylor::tolerance(-12.0)),
    );
    said.to(
        "tolerance that is no number",
        run(Symmetric::tolerance(f64::NAN)),
    );
    said.to(
        "step size zero: chosen by itself",
        run(Symmetric::step_size(0.0)),
    );
    said.to(
        "negative step size: backwards in time",
        run(Symmetric::step_size(-0.1)),
    );
    said.to("step size below the rounding error of the time", {
        let oscillator = Oscillator::default();
        let run = Integrator::new(&oscillator, Symmetric::step_size(1e-9))
            .initial(1e9, [1.0, 0.5])
            .run_until(1e9 + 1.0);
        run.map(drop)
    });
}

fn starts(said: &mut Said) {
    let oscillator = Oscillator::default();
    let from = |t0: f64, x0: [f64; 2], t_end: f64| {
        let run = Integrator::new(&oscillator, Best::tolerance(1e-12)).initial(t0, x0);
        run.run_until(t_end).map(drop)
    };
    said.to(
        "end before the start: backwards in time",
        from(0.0, [1.0, 0.5], -10.0),
    );
    said.to(
        "end at infinity: for ever",
        from(0.0, [1.0, 0.5], f64::INFINITY),
    );
    said.to(
        "start at infinity",
        from(f64::NEG_INFINITY, [1.0, 0.5], 10.0),
    );
    said.to(
        "initial state that is no number: 0/0",
        from(0.0, [1.0, f64::NAN], 10.0),
    );
    let wrong = Oscillator { k: f64::NAN };
    said.to("parameter that is no number", {
        let run = Integrator::new(&wrong, Best::tolerance(1e-12)).initial(0.0, [1.0, 0.5]);
        run.run_until(10.0).map(drop)
    });
    said.to("wrong region to start in", {
        let run = Integrator::new(&oscillator, Best::tolerance(1e-12))
            .initial(0.0, [1.0, 0.5])
            .region(OscillatorRegion::Below);
        run.run_until(10.0).map(drop)
    });
    said.to("start outside of the domain: ln of a negative number", {
        let run = Integrator::new(&Logarithmic {}, Taylor::tolerance(1e-9)).initial(0.0, [-1.0]);
        run.run_until(1.0).map(drop)
    });
    said.to("fields that push at each other", {
        let block = Block::default();
        let run = Integrator::new(&block, Best::tolerance(1e-9)).initial(0.0, [-1.0]);
        run.run_until(3.0).map(drop)
    });
}

fn outputs(said: &mut Said) {
    let oscillator = Oscillator::default();
    let run = || Integrator::new(&oscillator, Best::tolerance(1e-12)).initial(0.0, [1.0, 0.5]);
    said.to("output behind the end", {
        run().output_times([1.0, 20.0]).run_until(10.0).map(drop)
    });
    said.to("output times in descending order", {
        run().output_times([2.0, 1.0]).run_until(10.0).map(drop)
    });
    let solution = run()
        .run_until(10.0)
        .unwrap_or_else(|error| panic!("{error}"));
    said.to("solution behind its end: extrapolation", solution.at(11.0));
}

fn models(said: &mut Said) {
    let declaration = "system S { state x, y; param k = 1; der(x) = y; der(y) = -k*x; }";
    let mut model = Model::compile(declaration).unwrap_or_else(|error| panic!("{error}"));
    said.to("parameter that is not there", model.set("stiffness", 2.0));
    let system: Box<dyn AnySystem<Tolerance>> = Erased::boxed(Oscillator::default());
    said.to(
        "initial state of another system: three numbers for two states",
        {
            let from = InitialValue::new(vec![1.0, 0.0, 0.0], 10.0);
            system.integrate(&Tolerance(1e-12), &from, &mut Unobserved)
        },
    );
}
