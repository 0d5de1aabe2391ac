//! Where a solution is.

use crate::arithmetic::{State, Time};

/// Where a solution is: time, state, and what is known of the mode it is in.
#[derive(Clone, Debug)]
pub struct Cursor<const N: usize> {
    /// t
    pub time: Time,
    /// x
    pub state: State<N>,
    /// The guards that the point lies on, just crossed or as the initial point: their roots there
    /// do not count.
    pub active: Active,
    /// The number of the mode, by which memories are kept.
    pub mode: usize,
    /// ψ_ref of the mode, in pairs of doubles, if a segment was stopped in it: the next one goes
    /// on from there.
    pub level: Option<Vec<[f64; 2]>>,
}

impl<const N: usize> Cursor<N> {
    /// At a point on `active` guards, where a mode is entered.
    pub fn new(time: Time, state: State<N>, mode: usize, active: Active) -> Self {
        Self {
            time,
            state,
            active,
            mode,
            level: None,
        }
    }

    /// Enters another mode, on guards.
    #[inline]
    pub fn enter(&mut self, mode: usize, active: Active) {
        self.mode = mode;
        self.active = active;
        self.level = None;
    }
}

/// There are several guards.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Several;

/// A set of guards, by their indices. One of them takes no memory but its own.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Active {
    first: Option<usize>,
    others: Vec<usize>,
}

impl Active {
    /// One guard, or none.
    #[inline]
    pub fn new(guard: Option<usize>) -> Self {
        Self {
            first: guard,
            others: Vec::new(),
        }
    }

    /// The only guard, or none; an error where there are several.
    pub fn single(&self) -> Result<Option<usize>, Several> {
        match &self.others[..] {
            [] => Ok(self.first),
            _ => Err(Several),
        }
    }

    /// Adds a guard.
    pub fn insert(&mut self, guard: usize) {
        if self.first.is_none() {
            self.first = Some(guard);
        } else if !self.contains(guard) {
            self.others.push(guard);
        }
    }

    /// No guard any more.
    #[inline]
    pub fn clear(&mut self) {
        self.first = None;
        self.others.clear();
    }

    /// Whether a guard is one of them.
    #[inline]
    pub fn contains(&self, guard: usize) -> bool {
        self.first == Some(guard) || self.others.contains(&guard)
    }

    /// The guards.
    pub fn iter(&self) -> impl Iterator<Item = usize> {
        self.first.into_iter().chain(self.others.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_holds_what_is_put_into_it() {
        let mut set = Active::new(Some(3));
        for guard in [1000, 0, 3, 1000] {
            set.insert(guard);
        }
        assert_eq!(set.iter().collect::<Vec<_>>(), [3, 1000, 0]);
        assert!(set.contains(0) && set.contains(1000) && !set.contains(1));
        assert_eq!(set.single(), Err(Several));
        assert_eq!(Active::new(Some(3)).single(), Ok(Some(3)));
        assert_eq!(Active::default().iter().count(), 0);
    }
}
