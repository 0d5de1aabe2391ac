//! Functions that compute in lanes, on processors that can.
//!
//! What is compiled for every processor of an architecture uses the least of them: x86-64 has
//! vectors of two doubles and no fused operation. So the lanes are compiled for the processors
//! since 2013 (AVX2 and FMA) besides, and used where they run on one. [`pulp`] makes that safe.

use super::kernel::Kernel;
use crate::contract::System;

/// A kernel in a region.
pub(super) struct Work<'a, Sys: System<N>, const N: usize> {
    pub(super) system: &'a Sys,
    pub(super) region: Sys::Region,
    pub(super) parameters: &'a [super::register::Wide],
    pub(super) kernel: Kernel<'a, N>,
}

impl<Sys: System<N>, const N: usize> pulp::NullaryFnOnce for Work<'_, Sys, N> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let parameters = self.parameters;
        (self.system).visit_with(self.region, |index| parameters[index], self.kernel);
    }
}

/// The right to compute in lanes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vectorised {
    #[cfg(target_arch = "x86_64")]
    level: pulp::x86::V3,
}

impl Vectorised {
    /// Whether a system allows it.
    pub(super) fn fits<Sys: System<N>, const N: usize>(system: &Sys) -> bool {
        let mut regions = system.metadata().regions.iter();
        regions.all(|region| region.conserved.len() <= N)
    }

    /// It, if the processor has what it takes.
    #[cfg(target_arch = "x86_64")]
    pub(super) fn new() -> Option<Self> {
        pulp::x86::V3::try_new().map(|level| Self { level })
    }

    /// It, if the processor has what it takes.
    #[cfg(not(target_arch = "x86_64"))]
    pub(super) fn new() -> Option<Self> {
        cfg!(target_arch = "aarch64").then_some(Self {})
    }

    /// Does the work.
    #[inline(always)]
    pub(super) fn run<Sys: System<N>, const N: usize>(self, work: Work<'_, Sys, N>) {
        #[cfg(target_arch = "x86_64")]
        self.level.vectorize(work);
        #[cfg(not(target_arch = "x86_64"))]
        pulp::NullaryFnOnce::call(work);
    }
}
