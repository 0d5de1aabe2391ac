//! The coefficients of the roots multiplied by a scale, together with the constant factors of
//! the roots, so that the scale costs nothing.

use std::collections::{BTreeSet, HashMap};

use super::super::lower::Lowered;
use super::choice::Choice;
use super::recurrence::{Place, Shifted, Sum};
use crate::algebra::{Id, Math};

/// The coefficient of a node times a scale.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Scaled {
    /// A node that is constant in time, times the scale; zero above order zero.
    Constant(Id),
    /// The coefficient of a node, times the scale.
    Node(Id),
    /// A multiple of another one, whose scale is multiplied by the factor.
    Multiple(Factor, Box<Scaled>),
    /// ±u ± c, c constant in time.
    Shifted {
        /// Whether u is subtracted.
        is_negative: bool,
        /// u
        moving: Box<Scaled>,
        /// Whether c is subtracted, and c.
        fixed: (bool, Id),
    },
    /// u², by twice the scale and half of the sum of products.
    Square {
        /// u²
        node: Id,
        /// u
        of: Place,
    },
}

impl Scaled {
    /// The square in it, if there is one.
    fn squared(&self) -> Option<Place> {
        match self {
            Self::Constant(_) | Self::Node(_) => None,
            Self::Multiple(_, of) | Self::Shifted { moving: of, .. } => of.squared(),
            Self::Square { of, .. } => Some(*of),
        }
    }

    /// The sum that it takes of the orders below.
    pub(super) fn sum(&self) -> Option<Sum> {
        self.squared().map(Sum::Half)
    }
}

/// What a node is multiplied by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Factor {
    /// −1
    Minus,
    /// A node that is constant in time.
    Node(Id),
}

/// The operand and the factor of a node that is a multiple of another one.
pub fn multiple(lowered: &Lowered, id: Id) -> Option<(Id, Factor)> {
    let is_moving = |id: Id| !lowered.is_fixed(id);
    match lowered.dag()[id] {
        Math::Mul([c, u]) | Math::Mul([u, c]) if !is_moving(c) && is_moving(u) => {
            Some((u, Factor::Node(c)))
        }
        Math::Neg(u) if is_moving(u) => Some((u, Factor::Minus)),
        _ => None,
    }
}

/// Of a root that is a multiple of a state, ẋᵢ = c xⱼ, coefficient k + 2 of xᵢ: from what the new
/// coefficient of xⱼ is made from, so that the chain of recurrences does not pass through xⱼ.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Later {
    /// c, where it is not 1.
    pub factor: Option<Factor>,
    /// The coefficient of ẋⱼ, to be multiplied by c/((k + 1)(k + 2)).
    pub value: Scaled,
}

/// Takes roots apart.
pub(super) struct Scaling<'a> {
    choice: &'a Choice<'a>,
    roots: &'a [Id],
    /// How often a node is an operand or a root.
    uses: HashMap<Id, usize>,
    /// The nodes that exist only as factors of a root's scale.
    pub(super) folded: BTreeSet<Id>,
}

impl<'a> Scaling<'a> {
    /// `uses` are how often a node is an operand or one of the `roots`.
    pub(super) fn new(choice: &'a Choice<'a>, uses: HashMap<Id, usize>, roots: &'a [Id]) -> Self {
        let mut scaling = Self {
            choice,
            roots,
            uses,
            folded: BTreeSet::new(),
        };
        for &root in roots {
            scaling.fold(root);
        }
        scaling
    }

    fn multiple(&self, id: Id) -> Option<(Id, Factor)> {
        multiple(self.choice.lowered, id)
    }

    /// u of a square u².
    fn square(&self, id: Id) -> Option<Id> {
        match self.choice.lowered.dag()[id] {
            Math::Mul([a, b]) if a == b => Some(a),
            _ => None,
        }
    }

    /// Marks what [`Scaling::scaled`] takes apart.
    fn fold(&mut self, id: Id) {
        let has_slot = self.choice.slots.number(id).is_some();
        let is_shared = self.uses.get(&id).is_some_and(|&uses| uses > 1);
        if has_slot || is_shared || !self.choice.is_moving(id) {
            return;
        }
        let inner = match (self.multiple(id), self.choice.shifted(id)) {
            (Some((u, _)), _) => Some(u),
            (None, Some(shifted)) => Some(shifted.moving.1),
            (None, None) => None,
        };
        if inner.is_some() || self.square(id).is_some() {
            self.folded.insert(id);
        }
        if let Some(inner) = inner {
            self.fold(inner);
        }
    }

    /// The coefficient of a node times a scale.
    pub(super) fn scaled(&self, id: Id) -> Scaled {
        if !self.choice.is_moving(id) {
            return Scaled::Constant(id);
        }
        if !self.folded.contains(&id) {
            return Scaled::Node(id);
        }
        if let Some((u, factor)) = self.multiple(id) {
            return Scaled::Multiple(factor, Box::new(self.scaled(u)));
        }
        if let Some(Shifted { moving, fixed }) = self.choice.shifted(id) {
            return Scaled::Shifted {
                is_negative: moving.0,
                moving: Box::new(self.scaled(moving.1)),
                fixed,
            };
        }
        match self.square(id) {
            Some(of) => Scaled::Square {
                node: id,
                of: self.choice.node(of),
            },
            None => Scaled::Node(id),
        }
    }

    /// What follows on the result of `root`.
    pub(super) fn a_step_later(&self, root: Id) -> Option<Later> {
        let slots = &self.choice.slots;
        let (state, factor) = match self.multiple(root) {
            Some((u, factor)) => (slots.state(u)?, Some(factor)),
            None => (slots.state(root)?, None),
        };
        let source = *self.roots.get(state)?;
        self.choice.is_moving(source).then(|| Later {
            factor,
            value: self.scaled(source),
        })
    }
}
