//! Methods that are chosen at run time.

use crate::method::Method;

/// What is done with a method of whatever type.
pub trait MethodVisitor {
    /// The result.
    type Output;

    /// Does it.
    fn visit<Met: Method>(self, method: Met) -> Self::Output;
}

/// A choice of one of some methods, with its settings.
pub trait MethodChoice {
    /// Hands the method to `visitor`.
    fn visit<V: MethodVisitor>(&self, visitor: V) -> V::Output;

    /// The same for runs that are not observed, and for ensembles. What is compiled for them as well
    /// takes its time to compile: a choice may leave methods out, which then run as if they were
    /// observed, and not in ensembles.
    fn visit_unobserved<V: MethodVisitor>(&self, visitor: V) -> Option<V::Output> {
        Some(self.visit(visitor))
    }
}
