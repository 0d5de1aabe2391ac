//! The numbers of modes, by which methods keep what they have prepared.

use crate::contract::System;
use crate::method::Method;

/// So many modes have numbers at a time.
const MOST: usize = 64;

/// The modes that have numbers, where they are more than regions.
#[derive(Clone, Debug)]
pub(crate) struct Modes<R> {
    seen: Vec<R>,
}

impl<R> Default for Modes<R> {
    fn default() -> Self {
        Self { seen: Vec::new() }
    }
}

impl<R: Copy + PartialEq> Modes<R> {
    /// The number of a mode. Where all are used up, the memory forgets what it has prepared, and they
    /// are given anew.
    #[inline(always)]
    pub(crate) fn number<Sys, Met, const N: usize>(
        &mut self,
        system: &Sys,
        mode: R,
        method: &Met,
        memory: &mut Met::Memory<N>,
    ) -> usize
    where
        Sys: System<N, Region = R>,
        Met: Method,
    {
        if !system.metadata().has_constants() {
            return Sys::index(mode);
        }
        if let Some(number) = self.seen.iter().position(|&one| one == mode) {
            return number;
        }
        if self.seen.len() == MOST {
            self.seen.clear();
            method.forget_modes(memory);
        }
        self.seen.push(mode);
        self.seen.len() - 1
    }
}
