//! The sections of interfaces and regions: f and ψ, Λ and Λ^τ, f^τ, the residual, the proofs.

use super::compose::{Composer, Entry, words};
use super::document::{Document, Level, Part, Section};
use super::findings::findings;
use super::jacobian;
use super::lister::{Lister, symbol, titled};
use super::strategy;
use crate::algebra::display::Symbol;
use crate::algebra::{Id, Name};
use crate::model::{Interface, Model, Sign, plain_text};
use crate::scheme::{Scheme, Solvability, Strategy};

/// The listing of a system for lines of `width` characters.
pub(super) fn document(scheme: &Scheme, width: usize) -> Document {
    let mut composer = Composer::new(scheme, &scheme.model.source, width);
    interfaces(&mut composer, scheme);
    for region in 0..scheme.regions.len() {
        Lister::start(&mut composer, scheme, region).list();
    }
    composer.finish()
}

/// f^τ of one region.
pub(super) fn discrete_vector_field(scheme: &Scheme, region: usize, width: usize) -> Document {
    let mut composer = Composer::new(scheme, "", width);
    let mut lister = Lister::start(&mut composer, scheme, region);
    strategy::section(&mut lister);
    composer.finish()
}

fn interfaces(composer: &mut Composer, scheme: &Scheme) {
    let dag = scheme.dag();
    for (interface, derived) in scheme.model.interfaces.iter().zip(&scheme.interfaces) {
        let mut rows = vec![(
            vec![Part::Sign("g")],
            composer.formula(dag, interface.switching_function),
        )];
        let derivatives = &derived.derivatives;
        if !dag.is_zero(derivatives.time_derivative) {
            let right = composer.formula(dag, derivatives.time_derivative);
            rows.push((vec![Part::Sign("∂g/∂t")], right));
        }
        for (state, &entry) in scheme.model.states.iter().zip(&derivatives.gradient) {
            if !dag.is_zero(entry) {
                let left = vec![Part::Sign("∂g/∂"), symbol(&state.name)];
                rows.push((left, composer.formula(dag, entry)));
            }
        }
        let section = Section {
            level: Level::Part,
            heading: words(heading(&scheme.model, interface)),
            ..Section::default()
        };
        composer.add(section, rows);
    }
}

/// What the section of an interface, or of the end of a sliding motion, is called.
fn heading(model: &Model, interface: &Interface) -> String {
    let name = |interface: &Interface| plain_text(&interface.ident);
    let Some(end) = interface.end else {
        return format!("interface {}", name(interface));
    };
    let of = name(&model.interfaces[end.interface]);
    match end.side {
        Some(side) => format!(
            "{}: end of sliding on {of}, where it goes on in {of} {} 0",
            name(interface),
            relation(side)
        ),
        None => format!(
            "{}: {of} for what may slide on it, 1 where it does",
            name(interface)
        ),
    }
}

/// How g compares with zero on a side.
fn relation(side: Sign) -> char {
    match side {
        Sign::Positive => '>',
        Sign::Negative => '<',
    }
}

impl Lister<'_> {
    fn list(&mut self) {
        self.heading();
        self.declared();
        self.multipliers();
        strategy::section(self);
        self.step();
        jacobian::section(self);
        let section = Section {
            heading: words("what is known"),
            findings: findings(self.scheme, self.region, self.derived),
            ..Section::default()
        };
        self.composer.add(section, Vec::new());
    }

    fn heading(&mut self) {
        let sides: Vec<String> = self
            .region
            .sides
            .iter()
            .map(|side| {
                let interface = plain_text(&self.scheme.model.interfaces[side.interface].ident);
                format!("{interface} {} 0", relation(side.sign))
            })
            .collect();
        let kind = if self.region.slide.is_some() {
            "sliding motion"
        } else {
            "region"
        };
        let mut heading = format!("{kind} {}", plain_text(&self.region.ident));
        if !sides.is_empty() {
            heading.push_str(&format!(" where {}", sides.join(", ")));
        }
        let section = Section {
            level: Level::Part,
            heading: words(heading),
            ..Section::default()
        };
        self.composer.add(section, Vec::new());
    }

    /// f and ψ.
    fn declared(&mut self) {
        let rows = self.column("f[", &self.region.field);
        self.composer.add(titled("vector field ", "f"), rows);
        if self.region.conserved.is_empty() {
            return;
        }
        let rows = self
            .region
            .conserved
            .iter()
            .map(|one| {
                let left = vec![Part::Name(plain_text(&one.ident))];
                (left, self.composer.formula(self.scheme.dag(), one.psi))
            })
            .collect();
        self.composer
            .add(titled("conserved quantities ", "ψ"), rows);
    }

    /// Λ and ∂ₜψ, Λ^τ and ∂ₜ^τψ.
    fn multipliers(&mut self) {
        if self.region.conserved.is_empty() {
            return;
        }
        let derived = self.derived;
        let rows = self.rows(
            ["Λ[", "∂ₜψ["],
            &derived.proved.multiplier,
            &derived.proved.time_derivative,
        );
        self.composer.add(titled("multiplier ", "Λ = ∇ψ"), rows);
        let rows = self.rows(
            ["Λ^τ[", "∂ₜ^τψ["],
            &derived.discrete_multiplier,
            &derived.discrete_time_derivative,
        );
        let section = Section {
            remark: words("ψ's divided differences"),
            ..titled("discrete multiplier ", "Λ^τ")
        };
        self.composer.add(section, rows);
    }

    /// The entries of a multiplier that are not zero, and the derivatives in time.
    fn rows(&mut self, signs: [&'static str; 2], rows: &[Vec<Id>], by_time: &[Id]) -> Vec<Entry> {
        let [sign, time_sign] = signs;
        let many = self.scheme.model.states.len() > FEW_STATES;
        let mut entries = Vec::new();
        for ((conserved, row), &by_time) in self.region.conserved.iter().zip(rows).zip(by_time) {
            let name = Part::Name(plain_text(&conserved.ident));
            for (state, &entry) in self.states().zip(row) {
                if many && self.dag().is_zero(entry) {
                    continue;
                }
                let left = vec![
                    Part::Sign(sign),
                    name.clone(),
                    Part::Sign(", "),
                    symbol(state),
                    Part::Sign("]"),
                ];
                entries.push((left, self.composer.formula(self.scheme.dag(), entry)));
            }
            if !self.dag().is_zero(by_time) {
                let left = vec![Part::Sign(time_sign), name, Part::Sign("]")];
                entries.push((left, self.composer.formula(self.scheme.dag(), by_time)));
            }
        }
        entries
    }

    /// The implicit equation of a step, how it is solved, and its residual.
    fn step(&mut self) {
        let how = match self.derived.solvability {
            Solvability::Linear => {
                "linear in both ends with constant coefficients; the propagator is computed once"
            }
            Solvability::Affine => "affine in x₁; one linear solve, no iteration",
            Solvability::Nonlinear => "Newton's method on F(x₁) = 0 with its exact Jacobian",
        };
        let section = Section {
            remark: words(how),
            ..titled("step ", "x₁ = x₀ + τ f^τ")
        };
        self.composer.add(section, Vec::new());
        if self.derived.affine {
            let how = "A and b depend on parameters alone; the solution is a matrix exponential";
            let section = Section {
                remark: words(how),
                ..titled("exact flow ", "f = A x + b")
            };
            self.composer.add(section, Vec::new());
        }
        let rows = self.residual();
        let title = titled("residual ", "F(x₁) = x₁ − x₀ − τ f^τ");
        self.composer.add(title, rows);
    }

    /// F, with f^τ by its name where it would be long, or is solved for.
    fn residual(&mut self) -> Vec<Entry> {
        let explicit = match &self.derived.strategy {
            Strategy::Midpoint { field }
            | Strategy::SkewPairing { field, .. }
            | Strategy::CrossProduct { field, .. } => Some(&field.value),
            Strategy::MinimalNorm { .. } => None,
        };
        let mut entries = Vec::new();
        for (index, state) in self.states().enumerate() {
            let field = explicit.and_then(|value| value.get(index)).copied();
            let field = match field {
                Some(field) => self.composer.formula(self.scheme.dag(), field),
                None => self.named_field(state),
            };
            let field = if self.composer.is_short(field) {
                field
            } else {
                self.named_field(state)
            };
            let step = self.composer.step_size();
            let formulas = self.composer.formulas();
            let [end, start] =
                [state.at_end(), state.at_start()].map(|name| formulas.symbol(Symbol::from(&name)));
            let change = formulas.product(false, [(false, step), (false, field)]);
            let right = formulas.sum([(false, end), (true, start), (true, change)]);
            let left = vec![Part::Sign("F["), symbol(state), Part::Sign("]")];
            entries.push((left, right));
        }
        entries
    }

    fn named_field(&mut self, state: &Name) -> crate::algebra::display::FormulaId {
        let symbol = Symbol::component("f^τ", state);
        self.composer.formulas().symbol(symbol)
    }
}

/// A system of more states shows only those entries of a multiplier that are not zero.
const FEW_STATES: usize = 8;
