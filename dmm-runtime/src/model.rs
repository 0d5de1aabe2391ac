//! Systems that are compiled at run time.

use std::error::Error as StdError;
use std::fmt;
use std::sync::Arc;

use dmm_compiler::diagnostics::Diagnostics;
use dmm_compiler::emit;
use dmm_compiler::program::Program;
use dmm_compiler::text::{self, Message};

use crate::contract::{Metadata, System};
use crate::dynamic::{AnySystem, Erased, MethodChoice};
use crate::error::{Error, ErrorKind};
use crate::tape::{SystemCode, Tape};

/// A system that is compiled at run time, from a declaration in the language of
/// [`pws!`](crate::pws): all methods, transitions, proofs and messages are those of a system that is
/// compiled with the program, at some times its cost.
///
/// ```
/// use dmm_runtime::dynamic::{AnySystem, InitialValue, MethodChoice, MethodVisitor, Unobserved};
/// use dmm_runtime::{Best, Model};
///
/// /// `Best`, by a tolerance.
/// struct Tolerance(f64);
///
/// impl MethodChoice for Tolerance {
///     fn visit<V: MethodVisitor>(&self, visitor: V) -> V::Output {
///         visitor.visit(Best::tolerance(self.0))
///     }
/// }
///
/// let mut ball = Model::compile(
///     "system Ball {
///         state x, v;
///         param k = 4;
///         interface spring = x;
///         region free where spring > 0 {
///             der(x) = v; der(v) = -1;
///             conserved energy = v^2/2 + x;
///         }
///         region pressed where spring < 0 {
///             der(x) = v; der(v) = -1 - k*x;
///             conserved energy = v^2/2 + x + k*x^2/2;
///         }
///     }",
/// )?;
/// ball.set("k", 9.0)?;
/// let ball: Box<dyn AnySystem<Tolerance>> = ball.into_any()?;
/// let from = InitialValue::new(vec![1.0, 0.0], 100.0);
/// let end = ball.integrate(&Tolerance(1e-12), &from, &mut Unobserved)?;
/// assert!(end.statistics.transitions > 30);
/// let region = usize::from(end.x[0] < 0.0);
/// assert!((ball.conserved(region, 100.0, &end.x)[0] - 1.0).abs() < 1e-12);
///
/// let wrong = Model::compile("system Ball { state x; der(x) = y; }").unwrap_err();
/// assert!(wrong.to_string().starts_with("1:33: "), "{wrong}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Model {
    code: Arc<SystemCode>,
    parameters: Vec<f64>,
    warnings: Arc<[Message]>,
}

/// What is done with a model as a system of a size that is known at compile time.
pub trait ModelVisitor {
    /// The result.
    type Output;

    /// Does it, for a system with room for N states. Those beyond the model's are zero.
    fn visit<Sys: System<N>, const N: usize>(self, system: Sys) -> Self::Output;
}

/// The sizes that methods are compiled for: states and quantities.
macro_rules! sizes {
    ($model:ident, $visitor:ident: $(($states:literal, $quantities:literal))*) => {
        $(
            let tape = Tape::<$states, $quantities>::new(&$model.code, &$model.parameters);
            if let Some(tape) = tape {
                return Ok($visitor.visit(tape));
            }
        )*
    };
}

impl Model {
    /// Compiles the declaration of one system: `system Name { … }`, or Rust with one `pws!` in it.
    ///
    /// # Errors
    /// What is wrong with it, by lines and columns.
    pub fn compile(declaration: &str) -> Result<Self, ModelError> {
        let one = |message| ModelError {
            messages: vec![message],
        };
        let mut declarations = text::declarations(declaration).map_err(one)?.into_iter();
        let (Some(first), None) = (declarations.next(), declarations.next()) else {
            return Err(one(Message {
                line: 1,
                column: 1,
                text: "more than one system is declared".to_owned(),
            }));
        };
        let mut diagnostics = Diagnostics::new();
        let Some(scheme) = dmm_compiler::read_with(first, &mut diagnostics) else {
            return Err(ModelError {
                messages: text::messages(&diagnostics),
            });
        };
        let code = SystemCode::new(&Program::new(&scheme), emit::listing(&scheme));
        Ok(Self {
            parameters: code.defaults.clone(),
            code: Arc::new(code),
            warnings: text::warnings(&diagnostics).into(),
        })
    }

    /// What is declared and has no effect: the line, the column and the text of every warning.
    ///
    /// ```
    /// use dmm_runtime::Model;
    ///
    /// let model = Model::compile("system Ball { state x; param k = 1; der(x) = 1; }")?;
    /// let (line, column, text) = model.warnings().next().ok_or("no warning")?;
    /// assert_eq!((line, column), (1, 30));
    /// assert!(text.starts_with("warning: the parameter `k` is never used"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn warnings(&self) -> impl Iterator<Item = (usize, usize, &str)> {
        let warnings = self.warnings.iter();
        warnings.map(|warning| (warning.line, warning.column, warning.text.as_str()))
    }

    /// Names, and where the regions lie. Names are kept as long as the program runs.
    pub fn metadata(&self) -> &'static Metadata {
        self.code.metadata
    }

    /// The parameters, in the order of [`Metadata::parameters`].
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// Sets a parameter.
    ///
    /// # Errors
    /// A name that no parameter has.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), Error> {
        let mut names = self.code.metadata.parameters.iter();
        let index = names.position(|&parameter| parameter == name);
        match index.and_then(|index| self.parameters.get_mut(index)) {
            Some(parameter) => *parameter = value,
            None => {
                return Err(ErrorKind::InvalidInput {
                    what: "parameter",
                    value: name.to_owned(),
                    requirement: "must be one of the system",
                }
                .into());
            }
        }
        Ok(())
    }

    /// Hands the model to `visitor` as a [`System`] with room for its states.
    ///
    /// # Errors
    /// More than 128 states, or more than 8 conserved quantities.
    pub fn visit<V: ModelVisitor>(&self, visitor: V) -> Result<V::Output, Error> {
        sizes!(self, visitor:
            (2, 1) (4, 3) (8, 6) (16, 8) (64, 4) (128, 8));
        Err(ErrorKind::InvalidInput {
            what: "system",
            value: format!("{} states", self.code.metadata.states.len()),
            requirement: "must have at most 128 states, and at most 8 conserved quantities",
        }
        .into())
    }

    /// The model as an [`AnySystem`].
    ///
    /// # Errors
    /// As of [`Model::visit`].
    pub fn into_any<C: MethodChoice>(self) -> Result<Box<dyn AnySystem<C>>, Error> {
        self.visit(Any {
            defaults: self.code.defaults.clone(),
            choice: std::marker::PhantomData,
        })
    }
}

/// Hides the size.
struct Any<C> {
    defaults: Vec<f64>,
    choice: std::marker::PhantomData<C>,
}

impl<C: MethodChoice> ModelVisitor for Any<C> {
    type Output = Box<dyn AnySystem<C>>;

    fn visit<Sys: System<N>, const N: usize>(self, system: Sys) -> Self::Output {
        Box::new(Erased::new(system, self.defaults))
    }
}

/// What is wrong with a declaration.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ModelError {
    messages: Vec<Message>,
}

impl ModelError {
    /// The line, the column and the text of every message.
    pub fn messages(&self) -> impl Iterator<Item = (usize, usize, &str)> {
        let messages = self.messages.iter();
        messages.map(|message| (message.line, message.column, message.text.as_str()))
    }
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, message) in self.messages.iter().enumerate() {
            if index > 0 {
                writeln!(f)?;
            }
            write!(f, "{message}")?;
        }
        Ok(())
    }
}

impl StdError for ModelError {}
