//! A system declared by `pws!` as a [`Problem`]: its dimension hidden, its regions numbered.

use std::ops::ControlFlow;

use dmm_runtime::{
    Dynamics, DynamicsVisitor, End, Ensemble, Error, Guards, Integrator, Member, Method, Observer,
    Point, Statistics, System, Time, Transition, Vector,
};

use crate::method::MethodVisitor;
use crate::problem::{
    Arrival, Crossed, Description, Finish, MemberOutcome, OutputTimes, Parallelism, Problem,
    Record, Run, Sink, Start,
};

/// A system with its description.
#[derive(Clone, Debug)]
pub struct Entry<Sys, const N: usize> {
    description: &'static Description,
    system: Sys,
}

impl<Sys: System<N> + Default, const N: usize> Entry<Sys, N> {
    /// The problem of `description`.
    pub fn boxed(description: &'static Description) -> Box<dyn Problem> {
        Box::new(Self {
            description,
            system: Sys::default(),
        })
    }

    fn region(&self, index: usize) -> Option<Sys::Region> {
        self.system.region(index)
    }

    /// A vector of the first N entries; missing ones are NaN, which the runtime refuses.
    fn vector(x: &[f64]) -> Vector<f64, N> {
        Vector::from_fn(|i, _| x.get(i).copied().unwrap_or(f64::NAN))
    }

    fn observe<Met: Method>(
        &self,
        run: &Run,
        method: Met,
        sink: &mut dyn Sink,
    ) -> Result<Finish, Error> {
        let mut forwarding = Forwarding {
            wants_records: sink.wants_records(),
            sink,
            system: &self.system,
            output_times: &run.output_times,
            outputs: 0,
            psi: Vec::new(),
            size: Vec::new(),
            level: Vec::new(),
        };
        let problem =
            Integrator::new(&self.system, method).initial(0.0, Self::vector(&run.initial));
        Ok(finish(problem.observe_until(run.t_end, &mut forwarding)?))
    }
}

/// The end of a run, whatever its dimension.
fn finish<R, const N: usize>(end: End<R, N>) -> Finish {
    Finish {
        x: end.point.x.as_slice().to_vec(),
        statistics: end.statistics,
    }
}

/// An integration that a sink observes.
struct Observed<'a, Sys, const N: usize> {
    entry: &'a Entry<Sys, N>,
    run: &'a Run,
    sink: &'a mut dyn Sink,
}

impl<Sys: System<N> + Default, const N: usize> MethodVisitor for Observed<'_, Sys, N> {
    type Output = Result<Finish, Error>;

    fn visit<Met: Method>(self, method: Met) -> Self::Output {
        self.entry.observe(self.run, method, self.sink)
    }
}

/// Ignores everything.
struct NoSink;

impl Sink for NoSink {
    fn wants_records(&self) -> bool {
        false
    }
}

/// An integration that is not observed.
struct Silent<'a, Sys, const N: usize> {
    entry: &'a Entry<Sys, N>,
    run: &'a Run,
}

impl<Sys: System<N> + Default, const N: usize> MethodVisitor for Silent<'_, Sys, N> {
    type Output = Result<Finish, Error>;

    fn visit<Met: Method>(self, method: Met) -> Self::Output {
        let initial = Entry::<Sys, N>::vector(&self.run.initial);
        let problem = Integrator::new(&self.entry.system, method).initial(0.0, initial);
        Ok(finish(problem.observe_until(self.run.t_end, &mut ())?))
    }
}

/// Tells a [`Sink`] what the runtime tells its observer.
struct Forwarding<'a, Sys> {
    sink: &'a mut dyn Sink,
    wants_records: bool,
    system: &'a Sys,
    output_times: &'a OutputTimes,
    /// How many of them there were so far.
    outputs: usize,
    psi: Vec<f64>,
    size: Vec<f64>,
    /// ψ on entry to the region; empty until then.
    level: Vec<f64>,
}

impl<Sys> Forwarding<'_, Sys> {
    fn record<const N: usize>(
        &mut self,
        point: &Point<Sys::Region, N>,
        is_output: bool,
    ) -> ControlFlow<()>
    where
        Sys: System<N>,
    {
        let Point { t, time, x, region } = *point;
        let (psi, size) = (&mut self.psi, &mut self.size);
        self.system.visit(region, Conserved { time, x, psi, size });
        if self.level.is_empty() {
            self.level.clone_from(&self.psi);
        }
        self.sink.record(&Record {
            t,
            x: x.as_slice(),
            region: Sys::index(region),
            psi: &self.psi,
            size: &self.size,
            level: &self.level,
            is_output,
        })
    }
}

impl<Sys: System<N>, const N: usize> Observer<Sys::Region, N> for Forwarding<'_, Sys> {
    fn point(&mut self, point: &Point<Sys::Region, N>) -> ControlFlow<()> {
        if self.wants_records {
            self.record(point, false)
        } else {
            ControlFlow::Continue(())
        }
    }

    fn transition(&mut self, transition: &Transition<Sys::Region, N>) -> ControlFlow<()> {
        self.level.clear();
        self.size.clear();
        self.sink.transition(&Crossed {
            t: transition.t,
            x: transition.x.as_slice().to_vec(),
            interface: transition.interface,
            from: Sys::index(transition.from),
            to: Sys::index(transition.to),
            rate_from: transition.rate_from,
            rate_to: transition.rate_to,
        })
    }

    fn next_output(&self) -> Option<f64> {
        self.output_times.get(self.outputs)
    }

    fn output(&mut self, point: &Point<Sys::Region, N>) {
        self.outputs += 1;
        self.sink.output(point.t, point.x.as_slice());
        if self.wants_records {
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
        self.psi.clear();
        self.psi.extend(psi.iter());
        self.size.resize(M, 0.0);
        let size = dynamics.conserved_size(value, &self.x);
        for (largest, now) in self.size.iter_mut().zip(size.iter()) {
            *largest = largest.max(*now);
        }
    }
}

/// f
struct Field<const N: usize> {
    t: f64,
    x: Vector<f64, N>,
}

impl<const N: usize> DynamicsVisitor<N> for Field<N> {
    type Output = Vec<f64>;

    fn visit<const M: usize, F: Dynamics<f64, N, M>>(self, dynamics: &F) -> Vec<f64> {
        dynamics.vector_field(self.t, &self.x).as_slice().to_vec()
    }
}

/// g
struct Switching<const N: usize> {
    interface: usize,
    t: f64,
    x: Vector<f64, N>,
}

impl<const N: usize> DynamicsVisitor<N> for Switching<N> {
    type Output = f64;

    fn visit<const M: usize, F: Dynamics<f64, N, M>>(self, dynamics: &F) -> f64 {
        dynamics
            .guards()
            .switching_function(self.interface, self.t, &self.x)
    }
}

/// A run from many starts.
struct Together<'a, Sys, const N: usize> {
    entry: &'a Entry<Sys, N>,
    run: &'a Run,
    parallelism: Parallelism,
    starts: &'a mut dyn Iterator<Item = Start>,
    sink: &'a mut dyn FnMut(MemberOutcome) -> ControlFlow<()>,
}

impl<Sys: System<N> + Default, const N: usize> MethodVisitor for Together<'_, Sys, N> {
    type Output = ();

    fn visit<Met: Method>(self, method: Met) {
        let member = |start: Start| {
            let mut system = self.entry.system.clone();
            for (index, value) in start.parameters.into_iter().enumerate() {
                if let Some(parameter) = system.parameter_mut(index) {
                    *parameter = value;
                }
            }
            Member::new(system, 0.0, Entry::<Sys, N>::vector(&start.initial))
        };
        let arrival = |end: End<Sys::Region, N>| Arrival {
            t: end.point.t,
            x: end.point.x.as_slice().to_vec(),
            region: Sys::index(end.point.region),
            statistics: end.statistics,
        };
        let ensemble = Ensemble::new(method).lanes(self.parallelism.lanes);
        let ensemble = match self.parallelism.threads {
            Some(threads) => ensemble.threads(threads),
            None => ensemble,
        };
        ensemble.run_until(self.run.t_end, self.starts.map(member), |_, outcome| {
            let (end, error) = match outcome {
                Ok(end) => (Some(end), None),
                Err(halted) => {
                    let (error, end) = halted.into_parts();
                    (end, Some(error))
                }
            };
            (self.sink)(MemberOutcome {
                arrival: end.map(arrival),
                error,
            })
        });
    }
}

impl<Sys: System<N> + Default, const N: usize> Problem for Entry<Sys, N> {
    fn description(&self) -> &Description {
        self.description
    }

    fn system_name(&self) -> &'static str {
        self.system.metadata().name
    }

    fn declaration(&self) -> &str {
        self.system.declaration()
    }

    fn listing(&self) -> &str {
        self.system.listing()
    }

    fn states(&self) -> &'static [&'static str] {
        self.system.metadata().states
    }

    fn interfaces(&self) -> &'static [&'static str] {
        self.system.metadata().interfaces
    }

    fn regions(&self) -> Vec<&'static str> {
        let regions = self.system.metadata().regions.iter();
        regions.map(|region| region.name).collect()
    }

    fn conserved_names(&self, region: usize) -> &'static [&'static str] {
        let regions = self.system.metadata().regions;
        regions.get(region).map_or(&[], |region| region.conserved)
    }

    fn region_on_side(&self, sign: f64) -> Option<usize> {
        let mut regions = self.system.metadata().regions.iter();
        regions.position(|region| {
            let side = region.sides.first();
            side.is_some_and(|side| side.sign() == sign)
        })
    }

    fn parameters(&self) -> Vec<(&'static str, f64)> {
        let names = self.system.metadata().parameters.iter().copied();
        names.zip(self.system.parameters()).collect()
    }

    fn set_parameter(&mut self, name: &str, value: f64) -> bool {
        let mut names = self.system.metadata().parameters.iter();
        names
            .position(|&parameter| parameter == name)
            .and_then(|index| self.system.parameter_mut(index))
            .map(|parameter| *parameter = value)
            .is_some()
    }

    fn has_default_parameters(&self) -> bool {
        self.system.parameters() == Sys::default().parameters()
    }

    fn vector_field(&self, region: usize, t: f64, x: &[f64]) -> Vec<f64> {
        let x = Self::vector(x);
        self.region(region)
            .map(|region| self.system.visit(region, Field { t, x }))
            .unwrap_or_default()
    }

    fn switching_function(&self, interface: usize, t: f64, x: &[f64]) -> f64 {
        let x = Self::vector(x);
        self.region(0).map_or(f64::NAN, |region| {
            self.system.visit(region, Switching { interface, t, x })
        })
    }

    fn integrate(&self, run: &Run, sink: &mut dyn Sink) -> Result<Statistics, Error> {
        let observed = Observed {
            entry: self,
            run,
            sink,
        };
        Ok(run.visit_method(observed)?.statistics)
    }

    fn integrate_silently(&self, run: &Run) -> Result<Finish, Error> {
        let silent = Silent { entry: self, run };
        run.visit_unobserved(silent).unwrap_or_else(|| {
            run.visit_method(Observed {
                entry: self,
                run,
                sink: &mut NoSink,
            })
        })
    }

    fn integrate_all(
        &self,
        run: &Run,
        parallelism: Parallelism,
        starts: &mut dyn Iterator<Item = Start>,
        sink: &mut dyn FnMut(MemberOutcome) -> ControlFlow<()>,
    ) {
        // a scheme that is not compiled for ensembles has been refused
        run.visit_unobserved(Together {
            entry: self,
            run,
            parallelism,
            starts,
            sink,
        });
    }

    fn duplicate(&self) -> Box<dyn Problem> {
        Box::new(self.clone())
    }
}
