//! The declaration as written: items in their order, names unresolved.

use proc_macro2::Ident;
use syn::{Attribute, Visibility};

use super::Expression;

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
    /// `state x, y;`
    State(Vec<Documented>),
    /// `param k = 1;`
    Parameter(Definition),
    /// `const c = 3/2;`
    Constant(Definition),
    /// `let r = sqrt(x^2 + y^2);`
    Let(Definition),
    /// `interface wall = y;`
    Interface(Definition),
    /// `region above where wall > 0 { … }`
    Region(RegionItem),
    /// `der(x) = y;`
    Derivative(Derivative),
    /// `conserved energy = y^2/2;`
    Conserved(Definition),
}

/// A name with its documentation.
#[derive(Debug, Clone)]
pub struct Documented {
    /// Documentation comments.
    pub attributes: Vec<Attribute>,
    /// The name.
    pub ident: Ident,
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

/// `der(state) = formula`
#[derive(Debug, Clone)]
pub struct Derivative {
    /// Documentation comments.
    pub attributes: Vec<Attribute>,
    /// The state whose rate is given.
    pub state: Ident,
    /// Its rate.
    pub formula: Expression,
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
    /// Its `let`, `der` and `conserved` items.
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
