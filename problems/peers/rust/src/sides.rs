//! A system's fields and switching function as the functions that an integrator asks for, of
//! the side of its interface that the solution is on.

use std::cell::Cell;

use dmm_runtime::{Dynamics, DynamicsVisitor, Guards, Side, System, Vector};

use crate::Outcome;

pub struct Sides<'a, Sys: System<N>, const N: usize> {
    system: &'a Sys,
    region: Cell<Sys::Region>,
    sign: Cell<f64>,
}

struct Field<'a, const N: usize> {
    t: f64,
    x: &'a Vector<f64, N>,
}

impl<const N: usize> DynamicsVisitor<N> for Field<'_, N> {
    type Output = Vector<f64, N>;

    #[inline(always)]
    fn visit<const M: usize, F: Dynamics<f64, N, M>>(self, dynamics: &F) -> Vector<f64, N> {
        dynamics.vector_field(self.t, self.x)
    }
}

struct Switching<'a, const N: usize> {
    t: f64,
    x: &'a Vector<f64, N>,
}

impl<const N: usize> DynamicsVisitor<N> for Switching<'_, N> {
    type Output = f64;

    #[inline(always)]
    fn visit<const M: usize, F: Dynamics<f64, N, M>>(self, dynamics: &F) -> f64 {
        dynamics.guards().switching_function(0, self.t, self.x)
    }
}

impl<'a, Sys: System<N>, const N: usize> Sides<'a, Sys, N> {
    /// From `initial` at t = 0, which is not on the interface, if there is one.
    pub fn new(system: &'a Sys, initial: &[f64; N]) -> Outcome<Self> {
        let sides = Self {
            system,
            region: Cell::new(system.region(0).ok_or("no region")?),
            sign: Cell::new(1.0),
        };
        sides.go_to(sides.switching(0.0, initial).signum());
        Ok(sides)
    }

    /// Whether there is no interface.
    pub fn is_smooth(&self) -> bool {
        self.system.metadata().interfaces.is_empty()
    }

    /// The side that the solution is on: the sign of g.
    pub fn sign(&self) -> f64 {
        self.sign.get()
    }

    /// The other side is entered.
    pub fn cross(&self) {
        self.go_to(-self.sign());
    }

    fn go_to(&self, sign: f64) {
        let is_there =
            |&region: &Sys::Region| self.system.side(region, 0).map(Side::sign) == Some(sign);
        if let Some(region) = self.system.regions().find(is_there) {
            self.region.set(region);
            self.sign.set(sign);
        }
    }

    #[inline(always)]
    pub fn field(&self, t: f64, x: &[f64; N]) -> [f64; N] {
        let x = &Vector::from(*x);
        self.system.visit(self.region.get(), Field { t, x }).into()
    }

    /// g; without an interface it never changes its sign.
    #[inline(always)]
    pub fn switching(&self, t: f64, x: &[f64; N]) -> f64 {
        if self.is_smooth() {
            return 1.0;
        }
        let x = &Vector::from(*x);
        self.system.visit(self.region.get(), Switching { t, x })
    }
}
