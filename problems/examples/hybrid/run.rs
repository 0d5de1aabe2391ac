//! Runs by the library, told in the numbers of the reference.

use std::ops::ControlFlow;

use dmm_runtime::{
    Best, Composed, Error, Integrator, Method, Model, ModelVisitor, Observer, System, Taylor,
    Transition, TransitionKind, Vector,
};

use crate::motion::Systems;
use crate::plant::{MOST, State};
use crate::reference::{Kind, Passed};

/// A scheme at a setting.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Scheme {
    Taylor,
    Best,
    Composed,
}

impl Scheme {
    pub(crate) const ALL: [Self; 3] = [Self::Taylor, Self::Best, Self::Composed];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Taylor => "Taylor 1e-12",
            Self::Best => "Best 1e-12",
            Self::Composed => "Composed<6> 1e-9",
        }
    }

    /// Every how many systems it is run.
    pub(crate) fn every(self) -> usize {
        match self {
            Self::Taylor => 1,
            Self::Best => 4,
            Self::Composed => 16,
        }
    }

    /// The error that may be expected where errors do not grow.
    pub(crate) fn error(self) -> f64 {
        match self {
            Self::Taylor | Self::Best => 1e-8,
            Self::Composed => 1e-5,
        }
    }
}

/// What a run has told.
#[derive(Debug)]
pub(crate) struct Told {
    pub(crate) passed: Vec<Passed>,
    pub(crate) t: f64,
    pub(crate) x: State,
    pub(crate) error: Option<Error>,
}

/// A run.
pub(crate) struct Run<'a> {
    pub(crate) systems: Systems<'a>,
    pub(crate) scheme: Scheme,
    pub(crate) x0: State,
    pub(crate) t_end: f64,
    /// It is stopped behind so many transitions.
    pub(crate) most: usize,
}

impl Run<'_> {
    /// Makes it.
    pub(crate) fn of(self, model: &Model) -> Result<Told, Error> {
        model.visit(self)?
    }
}

impl ModelVisitor for Run<'_> {
    type Output = Result<Told, Error>;

    fn visit<Sys: System<N>, const N: usize>(self, system: Sys) -> Self::Output {
        match self.scheme {
            Scheme::Taylor => self.by(&system, Taylor::tolerance(1e-12)),
            Scheme::Best => self.by(&system, Best::tolerance(1e-12)),
            Scheme::Composed => self.by(&system, Composed::<6>::tolerance(1e-9)),
        }
    }
}

impl Run<'_> {
    fn by<Sys: System<N>, const N: usize>(
        self,
        system: &Sys,
        method: impl Method,
    ) -> Result<Told, Error> {
        let mut listener = Listener {
            passed: Vec::new(),
            interfaces: self.interfaces(system),
            system,
            most: self.most,
        };
        let x0 = &self.x0[..self.systems.plant.states];
        let run = Integrator::new(system, method).initial(0.0, x0);
        let ended = run.observe_until(self.t_end, &mut listener);
        let (t, x, error) = match ended {
            Ok(end) => (end.point.t, state(&end.point.x), None),
            Err(stopped) => {
                let error = Error::from(stopped);
                let place = error.place();
                let x = place.map_or([0.0; MOST], |place| padded(&place.x));
                (place.map_or(0.0, |place| place.t), x, Some(error))
            }
        };
        Ok(Told {
            passed: listener.passed,
            t,
            x,
            error,
        })
    }

    /// The number in the reference of each interface of the system: the one whose g is the same.
    fn interfaces<Sys: System<N>, const N: usize>(&self, system: &Sys) -> Vec<Option<usize>> {
        let points = [0.3, 1.1, 2.3].map(|t: f64| {
            let x: State = std::array::from_fn(|i| (t * (i + 1) as f64).sin());
            (t, x)
        });
        let own = 0..self.systems.plant.interfaces.len();
        let all = 0..system.metadata().interfaces.len();
        all.map(|interface| {
            own.clone().find(|&k| {
                points.iter().all(|(t, x)| {
                    let mut vector = Vector::<f64, N>::zeros();
                    let states = vector.iter_mut().zip(x).take(self.systems.plant.states);
                    states.for_each(|(entry, part)| *entry = *part);
                    let g = system.switching_function(interface, *t, &vector);
                    let expected = self.systems.g(k, *t, x);
                    g.is_some_and(|g| (g - expected).abs() < 1e-12)
                })
            })
        })
        .collect()
    }
}

/// Listens to a run.
struct Listener<'a, Sys> {
    passed: Vec<Passed>,
    interfaces: Vec<Option<usize>>,
    system: &'a Sys,
    most: usize,
}

impl<Sys: System<N>, const N: usize> Observer<Sys::Region, N> for Listener<'_, Sys> {
    fn transition(&mut self, one: &Transition<Sys::Region, N>) -> ControlFlow<()> {
        let numbers = self.interfaces.iter().enumerate();
        let slid = numbers.filter(|(own, _)| self.system.slides_on(one.to, *own));
        let mut slid: Vec<usize> = slid.filter_map(|(_, number)| *number).collect();
        slid.sort_unstable();
        self.passed.push(Passed {
            t: one.t,
            interface: self.interfaces.get(one.interface).copied().flatten(),
            kind: match one.kind {
                TransitionKind::Jumped => Kind::Jumped,
                TransitionKind::BeganToSlide => Kind::Began,
                TransitionKind::LeftSlide => Kind::Left,
                _ => Kind::Crossed,
            },
            slid,
            after: state(&one.after),
        });
        if self.passed.len() < self.most {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    }
}

fn state<const N: usize>(x: &Vector<f64, N>) -> State {
    padded(x.as_slice())
}

fn padded(x: &[f64]) -> State {
    std::array::from_fn(|i| x.get(i).copied().unwrap_or_default())
}
