//! The declaration as written: items in their order, names unresolved.

use proc_macro2::Ident;
use syn::{Attribute, Visibility};

use super::Expression;
use crate::diagnostics::Extent;

/// `system Name { … }`
#[derive(Debug, Clone)]
pub struct Declaration {
    /// Documentation comments.
    pub attributes: Vec<Attribute>,
    /// Visibility of what is emitted.
    pub visibility: Visibility,
    /// The system's name.
    pub name: Ident,
    /// What is declared, in the order of the source.
    pub items: Vec<Item>,
}

/// One statement, or one of the definitions of a list.
#[derive(Debug, Clone)]
pub enum Item {
    /// `state x, q[3];`
    State(Vec<Group>),
    /// `param k = 1;`, `param m[3] = 1;`, `param m[3] = [1, 2, 3];`
    Parameter(ParameterItem),
    /// `const c = 3/2;`
    Constant(Definition),
    /// `let r = sqrt(x^2 + y^2);`
    Let(Definition),
    /// `fn V(q) = q^2/2;`
    Function(FunctionItem),
    /// `discrete u = 1;`
    Discrete(Definition),
    /// `interface wall = y;`, `interface belt = v - 1, sliding;`
    Interface(InterfaceItem),
    /// `sliding belt { conserved … }`
    Sliding(SlidingItem),
    /// `on wall falling { v = -v; }`, `every 2 { … }`, `at 3 { … }`
    Event(EventItem),
    /// `region above where wall > 0 { … }`
    Region(RegionItem),
    /// `der(x) = y;`, `der(q[i]) = p[i];`
    Derivative(Derivative),
    /// `hamiltonian H = p^2/2 + V(q) in (q, p);`
    Hamiltonian(HamiltonianItem),
    /// `conserved energy = y^2/2;`, `assume conserved energy = …;`
    Conserved(ConservedItem),
    /// `for i in 0..3 { … }`
    For(ForItem),
}

/// A name with its documentation, and the number of its elements if it is a group `q[3]`.
#[derive(Debug, Clone)]
pub struct Group {
    /// Documentation comments.
    pub attributes: Vec<Attribute>,
    /// The name.
    pub ident: Ident,
    /// The number of elements; nothing for a scalar.
    pub length: Option<Expression>,
}

/// A parameter or a group of parameters.
#[derive(Debug, Clone)]
pub struct ParameterItem {
    /// Its name and length.
    pub group: Group,
    /// The defaults: one for all, or one an element.
    pub defaults: Defaults,
}

/// The defaults of a parameter or of a group of them.
#[derive(Debug, Clone)]
pub enum Defaults {
    /// `= formula`: of the parameter, or of every element alike.
    Same(Expression),
    /// `= [formula, formula]`: an element each. Only a group has it.
    Each(Vec<Expression>, Extent),
}

/// `name = formula`, or `name = formula, sliding`
#[derive(Debug, Clone)]
pub struct InterfaceItem {
    /// Its name and switching function.
    pub definition: Definition,
    /// Whether a solution may slide on it.
    pub slides: bool,
}

/// `sliding belt { … }`: what holds of the motion on an interface.
#[derive(Debug, Clone)]
pub struct SlidingItem {
    /// The interface's name.
    pub interface: Ident,
    /// `conserved` items.
    pub items: Vec<Item>,
}

/// `name = formula`
#[derive(Debug, Clone)]
pub struct Definition {
    /// Documentation comments.
    pub attributes: Vec<Attribute>,
    /// The name that is defined.
    pub ident: Ident,
    /// What it stands for.
    pub formula: Expression,
}

/// `fn name(arguments) = formula`. Arguments may be used as indices too.
#[derive(Debug, Clone)]
pub struct FunctionItem {
    /// The function's name and formula.
    pub definition: Definition,
    /// The names of its arguments, one at least.
    pub arguments: Vec<Ident>,
}

/// A state, or an element of a group of them: `x`, `q[i+1]`.
#[derive(Debug, Clone)]
pub struct Target {
    /// The name.
    pub ident: Ident,
    /// The index; nothing for a scalar, and where the whole group is meant.
    pub index: Option<Expression>,
    /// Where it stands.
    pub extent: Extent,
}

/// `der(target) = formula`
#[derive(Debug, Clone)]
pub struct Derivative {
    /// Documentation comments.
    pub attributes: Vec<Attribute>,
    /// The state whose rate is given.
    pub target: Target,
    /// Its rate.
    pub formula: Expression,
}

/// `hamiltonian H = formula in (q, p), …`: q̇ = ∂H/∂p, ṗ = −∂H/∂q.
#[derive(Debug, Clone)]
pub struct HamiltonianItem {
    /// The name and formula of H.
    pub definition: Definition,
    /// The canonical pairs (q, p): states, elements, or whole groups of the same length.
    pub pairs: Vec<(Target, Target)>,
}

/// `conserved name = formula`
#[derive(Debug, Clone)]
pub struct ConservedItem {
    /// The name and formula of ψ.
    pub definition: Definition,
    /// Whether it is written `assume conserved`: accepted even if it cannot be proved.
    pub assumed: bool,
}

/// `for i in start..end { … }`
#[derive(Debug, Clone)]
pub struct ForItem {
    /// The name that counts.
    pub variable: Ident,
    /// What it counts through.
    pub range: Range,
    /// `der`, `conserved` and `for` items.
    pub items: Vec<Item>,
}

/// `start..end`: the integers from `start` up to and without `end`.
#[derive(Debug, Clone)]
pub struct Range {
    /// The first.
    pub start: Expression,
    /// One more than the last.
    pub end: Expression,
}

/// `region name where … { … }`
#[derive(Debug, Clone)]
pub struct RegionItem {
    /// Documentation comments.
    pub attributes: Vec<Attribute>,
    /// The region's name.
    pub ident: Ident,
    /// The sign pattern.
    pub conditions: Vec<Condition>,
    /// Its items: everything but `state`, `param`, `const`, `fn`, `interface` and `region`.
    pub items: Vec<Item>,
}

/// `interface > 0` or `interface < 0`
#[derive(Debug, Clone)]
pub struct Condition {
    /// The interface's name.
    pub interface: Ident,
    /// How its switching function compares with zero.
    pub relation: Relation,
}

/// `on wall falling where v < 0 { v = -e * v; conserves momentum; }`
#[derive(Debug, Clone)]
pub struct EventItem {
    /// Documentation comments.
    pub attributes: Vec<Attribute>,
    /// When it happens.
    pub trigger: Trigger,
    /// What has to hold then.
    pub conditions: Vec<Comparison>,
    /// What changes, all from the values before.
    pub assignments: Vec<Assignment>,
    /// The names of the quantities that do not change.
    pub conserved: Vec<Ident>,
    /// Where its head stands.
    pub extent: Extent,
}

/// When an event happens.
#[derive(Debug, Clone)]
pub enum Trigger {
    /// `on interface`: where its function changes its sign.
    On {
        /// The interface's name.
        interface: Ident,
        /// Which way.
        direction: Direction,
    },
    /// `every period`: at the times 0, ± period, ± 2 period …
    Every(Expression),
    /// `at time`
    At(Expression),
}

/// Which way a switching function changes its sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// From − to +.
    Rising,
    /// From + to −.
    Falling,
    /// Either way.
    Both,
}

impl Direction {
    /// The word of the language; nothing for both.
    pub fn word(self) -> Option<&'static str> {
        match self {
            Self::Rising => Some("rising"),
            Self::Falling => Some("falling"),
            Self::Both => None,
        }
    }
}

/// `left < right`
#[derive(Debug, Clone)]
pub struct Comparison {
    /// What is compared.
    pub left: Expression,
    /// How.
    pub relation: Relation,
    /// What it is compared with.
    pub right: Expression,
}

/// `target = formula`
#[derive(Debug, Clone)]
pub struct Assignment {
    /// The state or discrete state that changes.
    pub target: Target,
    /// Its new value.
    pub formula: Expression,
}

/// A strict comparison with zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Relation {
    /// `<`
    Less,
    /// `>`
    Greater,
}

impl Relation {
    /// `<` or `>`
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Less => "<",
            Self::Greater => ">",
        }
    }
}
