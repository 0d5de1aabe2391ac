//! A system as data: interfaces, fields and jumps as sums of products with coefficients. Its
//! declaration is written from it, and the reference evaluates it.

use dmm_problems::random::Random;

/// The most states.
pub(crate) const MOST: usize = 6;
/// A state; entries behind the last state are zero.
pub(crate) type State = [f64; MOST];

/// A factor of a term.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Factor {
    /// xᵢ
    State(usize),
    /// sin(c t)
    Wave(usize),
    /// The discrete state u, 1 or −1.
    Discrete,
    /// 1/(1 + c (xᵢ − d)²) by the numbers of c and d
    Weakening(usize, usize, usize),
}

/// A coefficient, by its number, times factors.
#[derive(Clone, Debug)]
pub(crate) struct Term {
    pub(crate) coefficient: usize,
    pub(crate) factors: Vec<Factor>,
}

/// A sum of terms.
pub(crate) type Sum = Vec<Term>;

/// What an interface does.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Role {
    /// It bounds regions.
    Border,
    /// A formula switches its sign there: the field has the term ±Fₖ.
    Switch,
    /// Events happen there.
    Events,
}

/// An interface.
#[derive(Clone, Debug)]
pub(crate) struct Interface {
    pub(crate) g: Sum,
    pub(crate) slides: bool,
    pub(crate) role: Role,
    /// Fₖ of a switch, by state.
    pub(crate) switched: Vec<Sum>,
}

/// A region: the sides of the borders, and the field.
#[derive(Clone, Debug)]
pub(crate) struct Region {
    /// Whether g > 0; nothing where the interface does not bound it.
    pub(crate) pattern: Vec<Option<bool>>,
    pub(crate) field: Vec<Sum>,
}

/// What happens where an interface is crossed.
#[derive(Clone, Debug)]
pub(crate) struct Event {
    pub(crate) interface: usize,
    pub(crate) falls: bool,
    pub(crate) rises: bool,
    /// Whether u has to be positive or negative for it.
    pub(crate) only_if: Option<bool>,
    pub(crate) jump: Jump,
}

/// New values, all from the values before.
#[derive(Clone, Default, Debug)]
pub(crate) struct Jump {
    pub(crate) sets: Vec<(usize, Sum)>,
    /// Whether u becomes −u.
    pub(crate) flips: bool,
}

/// A system.
#[derive(Clone, Default, Debug)]
pub(crate) struct Plant {
    pub(crate) states: usize,
    pub(crate) interfaces: Vec<Interface>,
    pub(crate) regions: Vec<Region>,
    pub(crate) events: Vec<Event>,
    /// A jump at all multiples of a coefficient.
    pub(crate) clock: Option<(usize, Jump)>,
    /// Between what numbers each coefficient is drawn.
    pub(crate) ranges: Vec<[f64; 2]>,
}

impl Plant {
    /// A new coefficient.
    pub(crate) fn coefficient(&mut self, lower: f64, upper: f64) -> usize {
        self.ranges.push([lower, upper]);
        self.ranges.len() - 1
    }

    /// A term with a new coefficient.
    pub(crate) fn term(&mut self, lower: f64, upper: f64, factors: &[Factor]) -> Term {
        Term {
            coefficient: self.coefficient(lower, upper),
            factors: factors.to_vec(),
        }
    }

    /// Values of all coefficients.
    pub(crate) fn draw(&self, random: &mut Random) -> Vec<f64> {
        let ranges = self.ranges.iter();
        ranges
            .map(|&[lower, upper]| random.between(lower, upper))
            .collect()
    }

    /// Whether anything depends on the discrete state or changes it.
    pub(crate) fn has_discrete(&self) -> bool {
        let depends = |sum: &Sum| {
            let mut factors = sum.iter().flat_map(|term| &term.factors);
            factors.any(|factor| matches!(factor, Factor::Discrete))
        };
        let mut fields = self.regions.iter().flat_map(|region| &region.field);
        let mut events = self.events.iter();
        let flips = |jump: &Jump| jump.flips;
        fields.any(depends)
            || events.any(|event| flips(&event.jump) || event.only_if.is_some())
            || self.clock.as_ref().is_some_and(|(_, jump)| flips(jump))
    }
}

/// The value of a sum.
pub(crate) fn value(sum: &Sum, c: &[f64], t: f64, x: &State, u: f64) -> f64 {
    let mut all = 0.0;
    for term in sum {
        let mut product = c[term.coefficient];
        for &factor in &term.factors {
            product *= factor_value(factor, c, t, x, u);
        }
        all += product;
    }
    all
}

fn factor_value(factor: Factor, c: &[f64], t: f64, x: &State, u: f64) -> f64 {
    match factor {
        Factor::State(i) => x[i],
        Factor::Wave(rate) => (c[rate] * t).sin(),
        Factor::Discrete => u,
        Factor::Weakening(i, strength, center) => {
            1.0 / (1.0 + c[strength] * (x[i] - c[center]).powi(2))
        }
    }
}

/// The gradient by x and the derivative by t of a sum of states and waves.
pub(crate) fn slopes(sum: &Sum, c: &[f64], t: f64, x: &State) -> (State, f64) {
    let (mut gradient, mut by_time) = ([0.0; MOST], 0.0);
    for term in sum {
        for (place, &factor) in term.factors.iter().enumerate() {
            let others = term.factors.iter().enumerate();
            let others = others.filter(|(other, _)| *other != place);
            let rest = others.fold(c[term.coefficient], |product, (_, &other)| {
                product * factor_value(other, c, t, x, 1.0)
            });
            match factor {
                Factor::State(i) => gradient[i] += rest,
                Factor::Wave(rate) => by_time += rest * c[rate] * (c[rate] * t).cos(),
                Factor::Discrete | Factor::Weakening(..) => {}
            }
        }
    }
    (gradient, by_time)
}
