//! The model: a declaration with every name resolved and every region complete.
//!
//! Formulas are nodes of one [`Dag`] over the variables of the states, the parameters and the
//! time `t`; `const` and `let` have been replaced by what they stand for.

use proc_macro2::Ident;
use syn::{Attribute, Visibility};

use crate::algebra::{Dag, Id, Name};
use crate::diagnostics::Extent;

/// A piecewise-smooth system ẋ = fᵣ(t, x) on regions r, the sign patterns of switching
/// functions g (Hirani, Wan & Wojtalewicz, eq. 1.1).
#[derive(Debug)]
pub struct Model {
    /// Documentation comments (and nothing else) of the system.
    pub attributes: Vec<Attribute>,
    /// Visibility of what is emitted.
    pub visibility: Visibility,
    /// The system's name.
    pub name: Ident,
    /// The expressions of every formula below.
    pub dag: Dag,
    /// The N states, in the order of declaration.
    pub states: Vec<State>,
    /// The parameters, in the order of declaration.
    pub parameters: Vec<Parameter>,
    /// The interfaces g = 0.
    pub interfaces: Vec<Interface>,
    /// The discrete states: constant between events, changed by them.
    pub discrete: Vec<Discrete>,
    /// What happens in an instant.
    pub events: Vec<Event>,
    /// The regions; exactly one, without sides, if there is no interface. Behind them the sliding
    /// motions.
    pub regions: Vec<Region>,
    /// What is declared of sliding motions.
    pub sliding: Vec<Sliding>,
    /// The declaration as text, formatted for people.
    pub source: String,
}

/// A state variable.
#[derive(Debug)]
pub struct State {
    /// Documentation comments.
    pub attributes: Vec<Attribute>,
    /// Its identifier in the declaration.
    pub ident: Ident,
    /// Its index in the group `ident`; nothing for a scalar.
    pub element: Option<usize>,
    /// Its variable, `x` or `q[0]`.
    pub name: Name,
}

/// A parameter with its default.
#[derive(Debug)]
pub struct Parameter {
    /// Documentation comments.
    pub attributes: Vec<Attribute>,
    /// Its identifier in the declaration.
    pub ident: Ident,
    /// Its index in the group `ident`; nothing for a scalar. The elements of a group follow
    /// one another.
    pub element: Option<usize>,
    /// Its variable, `k` or `m[0]`.
    pub name: Name,
    /// The default: an expression without variables.
    pub default: Id,
}

/// A discrete state.
#[derive(Debug)]
pub struct Discrete {
    /// Documentation comments.
    pub attributes: Vec<Attribute>,
    /// Its identifier in the declaration.
    pub ident: Ident,
    /// Its variable.
    pub name: Name,
    /// The initial value: an expression without variables.
    pub initial: Id,
    /// Whether it counts the events of an `every`: it starts as the number of the first one behind
    /// the initial time.
    pub is_clock: bool,
}

/// An event: x and the discrete states change where a switching function changes its sign.
#[derive(Debug)]
pub struct Event {
    /// Index in [`Model::interfaces`].
    pub interface: usize,
    /// Whether it happens where g changes from − to +.
    pub rises: bool,
    /// Whether it happens where g changes from + to −.
    pub falls: bool,
    /// The region that it happens in; nothing where it happens in all of them.
    pub region: Option<Ident>,
    /// What has to be positive for it to happen.
    pub conditions: Vec<Id>,
    /// The new values of states, from the values before.
    pub states: Vec<(usize, Id)>,
    /// The new values of discrete states.
    pub discrete: Vec<(usize, Id)>,
    /// The names of quantities that do not change.
    pub conserved: Vec<Ident>,
    /// Where it stands in the declaration.
    pub span: Extent,
}

impl Event {
    /// Nothing happens where g changes its sign either way.
    pub(crate) fn new(interface: usize) -> Self {
        Self {
            interface,
            rises: true,
            falls: true,
            region: None,
            conditions: Vec::new(),
            states: Vec::new(),
            discrete: Vec::new(),
            conserved: Vec::new(),
            span: Extent::from(proc_macro2::Span::call_site()),
        }
    }
}

/// An interface: the zero set of a switching function g(t, x).
#[derive(Debug)]
pub struct Interface {
    /// Documentation comments.
    pub attributes: Vec<Attribute>,
    /// Its identifier in the declaration.
    pub ident: Ident,
    /// The formula that it is, of an interface that a formula switches at.
    pub label: Option<String>,
    /// The variable that is 1 where g > 0 and 0 where g < 0.
    pub side: Name,
    /// Whether formulas switch at it.
    pub is_switch: bool,
    /// Whether a solution may slide on it.
    pub slides: bool,
    /// What its zero means, if it is no interface but belongs to a sliding motion.
    pub end: Option<SlideEnd>,
    /// g
    pub switching_function: Id,
    /// Where g stands in the declaration.
    pub span: Extent,
}

/// The zero of a function of a sliding motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SlideEnd {
    /// The interface that it belongs to.
    pub interface: usize,
    /// The side on which the solution leaves that interface; nothing where it crosses the interface
    /// while it slides on others.
    pub side: Option<Sign>,
}

impl Interface {
    /// What it is called.
    pub fn name(&self) -> String {
        self.label
            .clone()
            .unwrap_or_else(|| plain_text(&self.ident))
    }
}

/// A region: a sign pattern of the switching functions, with its vector field.
#[derive(Debug)]
pub struct Region {
    /// Documentation comments.
    pub attributes: Vec<Attribute>,
    /// Its identifier in the declaration; `everywhere` where the system has no interface.
    pub ident: Ident,
    /// The interfaces that bound it.
    pub sides: Vec<Side>,
    /// f, by state.
    pub field: Vec<Id>,
    /// Where each component of f stands in the declaration.
    pub field_spans: Vec<Extent>,
    /// The conserved quantities ψ, those shared by all regions first.
    pub conserved: Vec<Conserved>,
    /// The canonical pairs of a `hamiltonian`, as indices of states (q, p): q̇ = ∂H/∂p and
    /// ṗ = −∂H/∂q by construction.
    pub canonical: Vec<(usize, usize)>,
    /// What it slides on, if it is no part of the space but a motion on interfaces.
    pub slide: Option<Slide>,
}

/// A motion on interfaces, along the mean of the fields on their sides that stays on them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Slide {
    /// The interfaces that it slides on as long as it lasts.
    pub on: Vec<usize>,
    /// The switches that it may slide on or not, each with the function that takes the place of its
    /// switching function: 1 while it slides there.
    pub switches: Vec<(usize, usize)>,
}

/// What is declared of the motion on an interface.
#[derive(Debug)]
pub struct Sliding {
    /// The interface.
    pub interface: usize,
    /// What is conserved while a solution slides on it.
    pub conserved: Vec<Conserved>,
}

/// On which side of an interface a region lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Side {
    /// Index in [`Model::interfaces`].
    pub interface: usize,
    /// g > 0 or g < 0.
    pub sign: Sign,
}

/// The sign of a switching function.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sign {
    /// g < 0
    Negative,
    /// g > 0
    Positive,
}

impl Sign {
    /// The other one.
    pub fn opposite(self) -> Self {
        match self {
            Self::Negative => Self::Positive,
            Self::Positive => Self::Negative,
        }
    }
}

/// The switching functions of a region's sides, each with its sign in the region.
pub fn sides(interfaces: &[Interface], region: &Region) -> Vec<(Id, Sign)> {
    let side = |side: &Side| {
        let interface = interfaces.get(side.interface)?;
        Some((interface.switching_function, side.sign))
    };
    region.sides.iter().filter_map(side).collect()
}

/// The functions g or −g that are positive on sides.
pub fn positive(dag: &mut Dag, sides: &[(Id, Sign)]) -> Vec<Id> {
    let functions = sides.iter().map(|&(g, sign)| match sign {
        Sign::Positive => g,
        Sign::Negative => dag.neg(g),
    });
    functions.collect()
}

/// A conserved quantity ψ(t, x): ∂ₜψ + ∇ψ·f = 0.
#[derive(Debug, Clone)]
pub struct Conserved {
    /// Documentation comments.
    pub attributes: Vec<Attribute>,
    /// Its identifier in the declaration.
    pub ident: Ident,
    /// ψ
    pub psi: Id,
    /// Where ψ's formula stands in the declaration.
    pub span: Extent,
    /// On what grounds it is declared.
    pub claim: Claim,
}

/// On what grounds a quantity is declared to be conserved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Claim {
    /// `conserved`: it has to be proved.
    Conserved,
    /// `assume conserved`: what cannot be proved is accepted, what is refuted is not.
    Assumed,
    /// It is the H of a `hamiltonian`.
    Hamiltonian,
    /// Every field that a sliding motion is a mean of conserves it, or it is the switching function
    /// that the mean keeps at zero.
    Mean,
}

impl Model {
    /// The variable of the time, `t`.
    pub fn time() -> Name {
        Name::new("t")
    }

    /// The variables of the states, in the order of declaration.
    pub fn state_names(&self) -> Vec<Name> {
        self.states.iter().map(|state| state.name.clone()).collect()
    }

    /// The variable of the side of an interface.
    pub(crate) fn side_of(ident: &Ident) -> Name {
        // no identifier of a declaration has a space
        Name::new(&format!("side of {ident}"))
    }

    /// The interfaces whose side is part of a mode whether they bound its region or not: those that
    /// formulas switch at, and those with events.
    pub fn free_interfaces(&self) -> Vec<usize> {
        let has_event = |index: usize| self.events.iter().any(|event| event.interface == index);
        let interfaces = self.interfaces.iter().enumerate();
        let free = interfaces.filter(|(index, one)| one.is_switch || has_event(*index));
        free.map(|(index, _)| index).collect()
    }

    /// The variable that is 1 while a solution slides on an interface, and 0 elsewhere.
    pub(crate) fn slide_of(interface: &Interface) -> Name {
        Name::new(&format!("slide on {}", interface.ident))
    }

    /// The interfaces, without the ends of sliding motions behind them.
    pub fn real_interfaces(&self) -> impl Iterator<Item = &Interface> {
        self.interfaces.iter().filter(|one| one.end.is_none())
    }

    /// The variables of the sides of what formulas switch at.
    pub fn switches(&self) -> impl Iterator<Item = &Name> {
        let switches = self.interfaces.iter().filter(|one| one.is_switch);
        switches.map(|one| &one.side)
    }

    /// The variables that are constant in a mode, besides the parameters: the discrete states, then
    /// a number for each of the [free interfaces](Self::free_interfaces), 1 where g > 0 and 0 where
    /// g < 0, and if solutions slide on switches another one for each, 1 while they slide there.
    pub fn constants(&self) -> Vec<Name> {
        let discrete = self.discrete.iter().map(|one| one.name.clone());
        let free = self.free_interfaces();
        let free = || free.iter().filter_map(|&index| self.interfaces.get(index));
        let sides = free().map(|one| one.side.clone());
        let slides = free().filter(|_| self.switches_slide());
        discrete
            .chain(sides)
            .chain(slides.map(Self::slide_of))
            .collect()
    }

    /// Whether there are motions that slide on switches.
    pub fn switches_slide(&self) -> bool {
        let mut slides = self.regions.iter().filter_map(|one| one.slide.as_ref());
        slides.any(|slide| !slide.switches.is_empty())
    }

    /// The variables of the states, then those of the parameters.
    pub fn variables(&self) -> impl Iterator<Item = &Name> {
        let states = self.states.iter().map(|state| &state.name);
        states.chain(self.parameters.iter().map(|parameter| &parameter.name))
    }
}

/// An identifier as people read it.
pub fn plain_text(ident: &Ident) -> String {
    ident.to_string().trim_start_matches("r#").to_owned()
}

/// A region's name in `snake_case` as `CamelCase`, the variant that it becomes.
pub fn camel_case(text: &str) -> String {
    let camel: String = text
        .trim_start_matches("r#")
        .split('_')
        .flat_map(|word| {
            let mut letters = word.chars();
            let first = letters.next().into_iter().flat_map(char::to_uppercase);
            first.chain(letters).collect::<Vec<char>>()
        })
        .collect();
    if syn::parse_str::<Ident>(&camel).is_ok() {
        camel
    } else {
        format!("Region{camel}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regions_become_variants() {
        assert_eq!(camel_case("above"), "Above");
        assert_eq!(camel_case("far_left"), "FarLeft");
        assert_eq!(camel_case("r#type"), "Type");
        assert_eq!(camel_case("_1"), "Region1");
    }
}
