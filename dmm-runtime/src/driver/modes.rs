//! The numbers of modes, by which methods keep what they have prepared.

use crate::contract::System;

/// So many modes have numbers at a time.
const MOST: usize = 64;

/// The modes that have numbers, where they are more than regions.
#[derive(Clone, Debug)]
pub(crate) struct Modes<R> {
    seen: Vec<R>,
    given_anew: bool,
}

impl<R> Default for Modes<R> {
    fn default() -> Self {
        Self {
            seen: Vec::new(),
            given_anew: false,
        }
    }
}

impl<R: Copy + PartialEq> Modes<R> {
    /// The number of a mode. Where all are used up they are given anew.
    #[inline(always)]
    pub(crate) fn number<Sys, const N: usize>(&mut self, system: &Sys, mode: R) -> usize
    where
        Sys: System<N, Region = R>,
    {
        if !system.metadata().has_constants() {
            return Sys::index(mode);
        }
        if let Some(number) = self.seen.iter().position(|&one| one == mode) {
            return number;
        }
        if self.seen.len() == MOST {
            self.seen.clear();
            self.given_anew = true;
        }
        self.seen.push(mode);
        self.seen.len() - 1
    }

    /// Whether numbers were given anew since this was asked last: what a method has prepared by them
    /// is that of other modes.
    #[inline(always)]
    pub(crate) fn are_given_anew(&mut self) -> bool {
        std::mem::take(&mut self.given_anew)
    }
}
