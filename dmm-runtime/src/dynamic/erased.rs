//! A system with its dimension hidden and its regions numbered.

use std::ops::ControlFlow;

use super::AnySystem;
use super::method::{MethodChoice, MethodVisitor};
use super::run::{
    AnyMode, AnyObserver, Arrival, Crossed, Finish, InitialValue, MemberOutcome, OutputTimes,
    Parallelism, Record, Start,
};
use crate::arithmetic::{Time, Vector};
use crate::contract::{Dynamics, DynamicsVisitor, Metadata, System};
use crate::driver::Integrator;
use crate::ensemble::{Ensemble, Member};
use crate::error::{Error, ErrorKind};
use crate::method::Method;
use crate::output::{End, Observer, Point, Transition};

/// A system as an [`AnySystem`].
#[derive(Clone, Debug)]
pub struct Erased<Sys, const N: usize> {
    system: Sys,
    defaults: Vec<f64>,
}

impl<Sys: System<N> + Default, const N: usize> Erased<Sys, N> {
    /// A system with its default parameters, whose present parameters are those of `system`.
    pub fn boxed<C: MethodChoice>(system: Sys) -> Box<dyn AnySystem<C>> {
        let defaults = Sys::default().parameters();
        Box::new(Self { system, defaults })
    }
}

impl<Sys: System<N>, const N: usize> Erased<Sys, N> {
    /// A system whose parameters are declared to be `defaults`.
    pub fn new(system: Sys, defaults: Vec<f64>) -> Self {
        Self { system, defaults }
    }

    /// How many states there are; a system that was compiled at run time may have room for more.
    fn states(&self) -> usize {
        self.system.metadata().states.len()
    }

    /// The first states of a vector.
    fn slice<'a>(&self, x: &'a Vector<f64, N>) -> &'a [f64] {
        &x.as_slice()[..self.states().min(N)]
    }

    /// A vector of the given entries; missing ones are NaN, which the runtime refuses.
    fn vector(&self, x: &[f64]) -> Vector<f64, N> {
        let states = self.states();
        Vector::from_fn(|i, _| match x.get(i) {
            Some(&entry) if i < states => entry,
            _ if i < states => f64::NAN,
            _ => 0.0,
        })
    }

    /// The same, if there are as many entries as states.
    fn start(&self, initial: &[f64]) -> Result<Vector<f64, N>, Error> {
        if initial.len() == self.states() {
            return Ok(self.vector(initial));
        }
        Err(ErrorKind::InvalidInput {
            what: "initial state",
            value: format!("{} entries", initial.len()),
            requirement: "must have as many entries as there are states",
        }
        .into())
    }

    /// An error, of the states that there are.
    fn error(&self, error: Error) -> Error {
        error.with_states(self.states())
    }

    /// A mode, with its region numbered.
    fn mode(&self, mode: Sys::Region) -> AnyMode {
        let metadata = self.system.metadata();
        let mut discrete = Sys::constants(mode);
        discrete.truncate(metadata.discrete.len());
        let sides = metadata.free.iter();
        AnyMode {
            region: Sys::index(mode),
            discrete,
            sides: sides
                .map(|&interface| self.system.side(mode, interface))
                .collect(),
        }
    }

    /// The end of a run.
    fn finish(&self, end: &End<Sys::Region, N>) -> Finish {
        Finish {
            x: self.slice(&end.point.x).to_vec(),
            remainder: self.slice(&end.remainder).to_vec(),
            statistics: end.statistics,
        }
    }
}

/// An integration that is observed.
struct Observed<'a, Sys, const N: usize> {
    erased: &'a Erased<Sys, N>,
    from: &'a InitialValue,
    observer: &'a mut dyn AnyObserver,
}

impl<Sys: System<N>, const N: usize> MethodVisitor for Observed<'_, Sys, N> {
    type Output = Result<Finish, Error>;

    fn visit<Met: Method>(self, method: Met) -> Self::Output {
        let Self {
            erased,
            from,
            observer,
        } = self;
        let mut forwarding = Forwarding {
            every: observer.record_every(),
            points: 0,
            observer,
            erased,
            output_times: &from.output_times,
            outputs: 0,
            mode: (None, AnyMode::default()),
            psi: Vec::new(),
            size: Vec::new(),
            has_entered: true,
            level: Vec::new(),
        };
        let start = erased.start(&from.initial)?;
        let problem = Integrator::new(&erased.system, method).initial(0.0, start);
        let end = problem.observe_until(from.t_end, &mut forwarding);
        Ok(erased.finish(&end.map_err(|halted| erased.error(halted.into()))?))
    }
}

/// An integration that is not observed.
struct Silent<'a, Sys, const N: usize> {
    erased: &'a Erased<Sys, N>,
    from: &'a InitialValue,
}

impl<Sys: System<N>, const N: usize> MethodVisitor for Silent<'_, Sys, N> {
    type Output = Result<Finish, Error>;

    fn visit<Met: Method>(self, method: Met) -> Self::Output {
        let Self { erased, from } = self;
        let start = erased.start(&from.initial)?;
        let problem = Integrator::new(&erased.system, method).initial(0.0, start);
        let end = problem.observe_until(from.t_end, &mut ());
        Ok(erased.finish(&end.map_err(|halted| erased.error(halted.into()))?))
    }
}

/// Tells a [`AnyObserver`] what the runtime tells its observer.
struct Forwarding<'a, Sys: System<N>, const N: usize> {
    observer: &'a mut dyn AnyObserver,
    /// One of so many points is recorded.
    every: u64,
    /// How many there were so far.
    points: u64,
    erased: &'a Erased<Sys, N>,
    output_times: &'a OutputTimes,
    /// How many of them there were so far.
    outputs: usize,
    /// The mode of the last record, as the system has it and with its region numbered.
    mode: (Option<Sys::Region>, AnyMode),
    psi: Vec<f64>,
    size: Vec<f64>,
    /// Whether nothing was recorded since the entry to the region.
    has_entered: bool,
    /// ψ on entry to the region.
    level: Vec<f64>,
}

impl<Sys: System<N>, const N: usize> Forwarding<'_, Sys, N> {
    fn record(&mut self, point: &Point<Sys::Region, N>, is_output: bool) -> ControlFlow<()> {
        let Point { t, time, x, region } = *point;
        let (psi, size) = (&mut self.psi, &mut self.size);
        let system = &self.erased.system;
        system.visit(region, Conserved { time, x, psi, size });
        if std::mem::take(&mut self.has_entered) {
            self.level.clone_from(&self.psi);
        }
        if self.mode.0 != Some(region) {
            self.mode = (Some(region), self.erased.mode(region));
        }
        self.observer.record(&Record {
            t,
            x: self.erased.slice(&x),
            mode: &self.mode.1,
            psi: &self.psi,
            size: &self.size,
            level: &self.level,
            is_output,
        })
    }
}

impl<Sys: System<N>, const N: usize> Observer<Sys::Region, N> for Forwarding<'_, Sys, N> {
    fn point(&mut self, point: &Point<Sys::Region, N>) -> ControlFlow<()> {
        self.points += 1;
        if self.every > 0 && (self.has_entered || self.points.is_multiple_of(self.every)) {
            self.record(point, false)
        } else {
            ControlFlow::Continue(())
        }
    }

    fn transition(&mut self, transition: &Transition<Sys::Region, N>) -> ControlFlow<()> {
        self.has_entered = true;
        self.size.clear();
        self.observer.transition(&Crossed {
            t: transition.t,
            x: self.erased.slice(&transition.x).to_vec(),
            after: self.erased.slice(&transition.after).to_vec(),
            kind: transition.kind,
            interface: transition.interface,
            from: self.erased.mode(transition.from),
            to: self.erased.mode(transition.to),
            rate_from: transition.rate_from,
            rate_to: transition.rate_to,
        })
    }

    fn next_output(&self) -> Option<f64> {
        self.output_times.get(self.outputs)
    }

    fn output(&mut self, point: &Point<Sys::Region, N>) {
        self.outputs += 1;
        self.observer.output(point.t, self.erased.slice(&point.x));
        if self.every > 0 {
            // who wants to stop here stops at the end of the step
            let _ = self.record(point, true);
        }
    }
}

/// ψ and the largest size of its terms so far.
struct Conserved<'a, const N: usize> {
    time: Time,
    x: Vector<f64, N>,
    psi: &'a mut Vec<f64>,
    size: &'a mut Vec<f64>,
}

impl<const N: usize> DynamicsVisitor<N> for Conserved<'_, N> {
    type Output = ();

    fn visit<const M: usize, F: Dynamics<f64, N, M>>(self, dynamics: &F) {
        let Time { value, remainder } = self.time;
        let mut psi = dynamics.conserved(value, &self.x);
        if remainder != 0.0 && !dynamics.is_autonomous() {
            // the digits of the time that a double cannot hold: ∂ₜψ = −∇ψ·f
            let (_, multiplier) = dynamics.multiplier(value, &self.x);
            psi -= multiplier * dynamics.vector_field(value, &self.x) * remainder;
        }
        let quantities = dynamics.quantities();
        self.psi.clear();
        self.psi.extend(psi.iter().take(quantities));
        self.size.resize(quantities, 0.0);
        let size = dynamics.conserved_size(value, &self.x);
        for (largest, now) in self.size.iter_mut().zip(size.iter()) {
            *largest = largest.max(*now);
        }
    }
}

/// Integrations from many starts.
struct Together<'a, Sys, const N: usize> {
    erased: &'a Erased<Sys, N>,
    t_end: f64,
    parallelism: Parallelism,
    starts: &'a mut dyn Iterator<Item = Start>,
    sink: &'a mut dyn FnMut(MemberOutcome) -> ControlFlow<()>,
}

impl<Sys: System<N>, const N: usize> MethodVisitor for Together<'_, Sys, N> {
    type Output = ();

    fn visit<Met: Method>(self, method: Met) {
        let erased = self.erased;
        let member = |start: Start| {
            let mut system = erased.system.clone();
            for (index, value) in start.parameters.into_iter().enumerate() {
                if let Some(parameter) = system.parameter_mut(index) {
                    *parameter = value;
                }
            }
            Member::new(system, 0.0, erased.vector(&start.initial))
        };
        let arrival = |end: End<Sys::Region, N>| Arrival {
            t: end.point.t,
            x: erased.slice(&end.point.x).to_vec(),
            mode: erased.mode(end.point.region),
            statistics: end.statistics,
        };
        let ensemble = Ensemble::new(method).lanes(self.parallelism.lanes);
        let ensemble = match self.parallelism.threads {
            Some(threads) => ensemble.threads(threads),
            None => ensemble,
        };
        ensemble.run_until(self.t_end, self.starts.map(member), |_, outcome| {
            let (end, error) = match outcome {
                Ok(end) => (Some(end), None),
                Err(halted) => {
                    let (error, end) = halted.into_parts();
                    (end, Some(erased.error(error)))
                }
            };
            (self.sink)(MemberOutcome {
                arrival: end.map(arrival),
                error,
            })
        });
    }
}

impl<C: MethodChoice, Sys: System<N>, const N: usize> AnySystem<C> for Erased<Sys, N> {
    fn metadata(&self) -> &'static Metadata {
        self.system.metadata()
    }

    fn declaration(&self) -> &str {
        self.system.declaration()
    }

    fn listing(&self) -> &str {
        self.system.listing()
    }

    fn parameters(&self) -> Vec<f64> {
        self.system.parameters()
    }

    fn defaults(&self) -> &[f64] {
        &self.defaults
    }

    fn set_parameter(&mut self, name: &str, value: f64) -> bool {
        let mut names = self.system.metadata().parameters.iter();
        let index = names.position(|&parameter| parameter == name);
        let parameter = index.and_then(|index| self.system.parameter_mut(index));
        parameter.map(|parameter| *parameter = value).is_some()
    }

    fn vector_field(&self, region: usize, t: f64, x: &[f64]) -> Vec<f64> {
        let region = self.system.region(region);
        let field = region.map(|region| self.system.vector_field(region, t, &self.vector(x)));
        let field = field.map(|field| self.slice(&field).to_vec());
        field.unwrap_or_default()
    }

    fn switching_function(&self, interface: usize, t: f64, x: &[f64]) -> f64 {
        let value = (self.system).switching_function(interface, t, &self.vector(x));
        value.unwrap_or(f64::NAN)
    }

    fn conserved(&self, region: usize, t: f64, x: &[f64]) -> Vec<f64> {
        let region = self.system.region(region);
        let psi = region.map(|region| self.system.conserved(region, t, &self.vector(x)));
        psi.unwrap_or_default()
    }

    fn integrate(
        &self,
        method: &C,
        from: &InitialValue,
        observer: &mut dyn AnyObserver,
    ) -> Result<Finish, Error> {
        let erased = self;
        method.visit(Observed {
            erased,
            from,
            observer,
        })
    }

    fn integrate_silently(&self, method: &C, from: &InitialValue) -> Result<Finish, Error> {
        let erased = self;
        let finish = method.visit_unobserved(Silent { erased, from });
        finish.unwrap_or_else(|| {
            let observer = &mut super::Unobserved;
            method.visit(Observed {
                erased,
                from,
                observer,
            })
        })
    }

    fn integrate_all(
        &self,
        method: &C,
        t_end: f64,
        parallelism: Parallelism,
        starts: &mut dyn Iterator<Item = Start>,
        sink: &mut dyn FnMut(MemberOutcome) -> ControlFlow<()>,
    ) {
        method.visit_unobserved(Together {
            erased: self,
            t_end,
            parallelism,
            starts,
            sink,
        });
    }

    fn duplicate(&self) -> Box<dyn AnySystem<C>> {
        Box::new(self.clone())
    }
}
