//! Text with mathematical signs → LaTeX in ASCII.
//!
//! A text is read as units, a base with its accent and scripts (`f̄`, `∂ₜ^τ`, `x₁`, `k_below`).
//! As mathematics every unit is written as one; in a sentence those are that have scripts or
//! are signs, and the others stay words.

use std::fmt::Write;
use std::iter::Peekable;
use std::str::Chars;

/// A text in LaTeX's mathematical mode.
pub fn mathematics(text: &str) -> String {
    let mut latex = String::new();
    for unit in units(text) {
        unit.write_mathematics(&mut latex);
    }
    latex
}

/// A sentence in LaTeX.
pub fn sentence(text: &str) -> String {
    let mut latex = String::new();
    let mut formula = String::new();
    let mut gap = String::new();
    for unit in units(text) {
        if unit.is_mathematics() {
            formula.push_str(&std::mem::take(&mut gap));
            unit.write_mathematics(&mut formula);
        } else if unit.base == " " && !formula.is_empty() {
            gap.push(' ');
        } else {
            close(&mut latex, &mut formula);
            latex.push_str(&std::mem::take(&mut gap));
            latex.push_str(&escaped(&unit.base));
        }
    }
    close(&mut latex, &mut formula);
    latex.push_str(&gap);
    latex
}

fn close(latex: &mut String, formula: &mut String) {
    if !formula.is_empty() {
        let _ = write!(latex, "${}$", formula.trim());
        formula.clear();
    }
}

/// A text as it stands, in LaTeX outside formulas.
pub fn verbatim(text: &str) -> String {
    let mut latex = String::new();
    for letter in text.chars() {
        match letter {
            ' ' => latex.push('~'),
            // no ligatures
            '-' | '<' | '>' | '\'' | '`' | ',' | '"' => {
                let _ = write!(latex, "{{{}}}", escaped(&letter.to_string()));
            }
            _ if letter.is_ascii() => latex.push_str(&escaped(&letter.to_string())),
            _ => latex.push_str(&sentence(&letter.to_string())),
        }
    }
    latex
}

/// A base with what is attached to it.
#[derive(Debug, Default)]
struct Unit {
    base: String,
    accent: Option<&'static str>,
    superscript: String,
    subscript: String,
}

impl Unit {
    fn is_mathematics(&self) -> bool {
        let attached =
            self.accent.is_some() || !self.superscript.is_empty() || !self.subscript.is_empty();
        let mut letters = self.base.chars();
        let is_sign = match (letters.next(), letters.next()) {
            (Some(only), None) => sign(only).is_some() || "<>|=".contains(only),
            _ => false,
        };
        attached || is_sign
    }

    fn write_mathematics(&self, latex: &mut String) {
        let mut letters = self.base.chars();
        let base = match (letters.next(), letters.next()) {
            (Some('*'), None) => r"\,".to_owned(),
            (Some(only), None) => match sign(only) {
                Some(command) => command.to_owned(),
                None => escaped(&self.base),
            },
            _ if self
                .base
                .starts_with(|letter: char| letter.is_ascii_digit()) =>
            {
                self.base.clone()
            }
            _ => format!(r"\mathit{{{}}}", escaped(&self.base)),
        };
        let base = match self.accent {
            Some(accent) => format!("{accent}{{{base}}}"),
            None => base,
        };
        append(latex, &base);
        if !self.subscript.is_empty() {
            let _ = write!(latex, "_{{{}}}", self.subscript);
        }
        if !self.superscript.is_empty() {
            let _ = write!(latex, "^{{{}}}", self.superscript);
        }
    }
}

/// Adds `next`, apart from a command that would run into it.
fn append(latex: &mut String, next: &str) {
    if ends_in_command(latex) && next.starts_with(|letter: char| letter.is_ascii_alphabetic()) {
        latex.push(' ');
    }
    latex.push_str(next);
}

fn ends_in_command(latex: &str) -> bool {
    let head = latex.trim_end_matches(|letter: char| letter.is_ascii_alphabetic());
    head.len() < latex.len() && head.ends_with('\\')
}

/// The units of a text.
fn units(text: &str) -> Vec<Unit> {
    let mut units: Vec<Unit> = Vec::new();
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        if let Some(mark) = accent(letter) {
            if let Some(last) = units.last_mut() {
                last.accent = Some(mark);
            }
        } else if let Some(script) = superscript(letter) {
            append(&mut attach(&mut units).superscript, script);
        } else if let Some(script) = subscript(letter) {
            append(&mut attach(&mut units).subscript, script);
        } else if letter == '^' {
            let script = raised(&mut letters);
            append(&mut attach(&mut units).superscript, &script);
        } else if letter.is_ascii_alphanumeric() {
            units.push(Unit {
                base: word(letter, &mut letters),
                ..Unit::default()
            });
        } else {
            let (base, accent) = match with_accent(letter) {
                Some((base, accent)) => (base.to_string(), Some(accent)),
                None => (letter.to_string(), None),
            };
            units.push(Unit {
                base,
                accent,
                ..Unit::default()
            });
        }
    }
    units
}

/// The unit that a script belongs to.
fn attach(units: &mut Vec<Unit>) -> &mut Unit {
    if units.last().is_none_or(|unit| unit.base == " ") {
        units.push(Unit {
            base: "{}".into(),
            ..Unit::default()
        });
    }
    let last = units.len() - 1;
    &mut units[last]
}

/// What follows `^`: one sign, or a number or name.
fn raised(letters: &mut Peekable<Chars<'_>>) -> String {
    match letters.next() {
        Some(letter) if letter.is_ascii_alphanumeric() => escaped(&word(letter, letters)),
        Some(letter) => match sign(letter) {
            Some(command) => command.to_owned(),
            None => escaped(&letter.to_string()),
        },
        None => String::new(),
    }
}

/// A number or an identifier.
fn word(first: char, letters: &mut Peekable<Chars<'_>>) -> String {
    let mut word = String::from(first);
    while let Some(letter) =
        letters.next_if(|letter| letter.is_ascii_alphanumeric() || *letter == '_')
    {
        word.push(letter);
    }
    word
}

/// Text with the characters replaced that LaTeX gives a meaning to, or does not know.
pub fn escaped(text: &str) -> String {
    let mut latex = String::new();
    for letter in text.chars() {
        match letter {
            '_' | '%' | '&' | '#' | '$' | '{' | '}' if text != "{}" => latex.extend(['\\', letter]),
            '\\' => latex.push_str(r"\textbackslash{}"),
            '~' => latex.push_str(r"\textasciitilde{}"),
            '^' => latex.push_str(r"\textasciicircum{}"),
            ' '..='\x7f' => latex.push(letter),
            _ => match prose(letter) {
                Some(command) => latex.push_str(command),
                None => {
                    let _ = write!(latex, "[U+{:04X}]", u32::from(letter));
                }
            },
        }
    }
    latex
}

/// A combining accent.
fn accent(letter: char) -> Option<&'static str> {
    Some(match letter {
        '\u{302}' => r"\hat",
        '\u{303}' => r"\tilde",
        '\u{304}' | '\u{305}' => r"\bar",
        '\u{307}' => r"\dot",
        '\u{308}' => r"\ddot",
        '\u{20d7}' => r"\vec",
        _ => return None,
    })
}

/// A letter with a dot, as for a derivative in time.
fn with_accent(letter: char) -> Option<(char, &'static str)> {
    const DOTTED: &str = "ẋxẏyżzṗpḟfġgḣhṁmṅnṙrṡsṫtẇwċcėeḃbḋd";
    let mut pairs = DOTTED.chars();
    while let (Some(dotted), Some(base)) = (pairs.next(), pairs.next()) {
        if dotted == letter {
            return Some((base, r"\dot"));
        }
    }
    let bars = [('ā', 'a'), ('ē', 'e'), ('ī', 'i'), ('ō', 'o'), ('ū', 'u')];
    let base = bars.iter().find(|(barred, _)| *barred == letter)?.1;
    Some((base, r"\bar"))
}

fn superscript(letter: char) -> Option<&'static str> {
    Some(match letter {
        '⁰' => "0",
        '¹' => "1",
        '²' => "2",
        '³' => "3",
        '⁴' => "4",
        '⁵' => "5",
        '⁶' => "6",
        '⁷' => "7",
        '⁸' => "8",
        '⁹' => "9",
        '⁺' => "+",
        '⁻' => "-",
        'ⁿ' => "n",
        'ʲ' => "j",
        'ᵏ' => "k",
        'ᵐ' => "m",
        'ᵀ' => "T",
        'ᵘ' => "u",
        'ˣ' => "x",
        '°' => r"\circ",
        '′' => r"\prime",
        _ => return None,
    })
}

fn subscript(letter: char) -> Option<&'static str> {
    Some(match letter {
        '₀' => "0",
        '₁' => "1",
        '₂' => "2",
        '₃' => "3",
        '₄' => "4",
        '₅' => "5",
        '₆' => "6",
        '₇' => "7",
        '₈' => "8",
        '₉' => "9",
        '₊' => "+",
        '₋' => "-",
        'ₜ' => "t",
        'ᵢ' => "i",
        'ⱼ' => "j",
        'ₖ' => "k",
        'ₘ' => "m",
        'ₙ' => "n",
        'ᵣ' => "r",
        'ₛ' => "s",
        'ₓ' => "x",
        _ => return None,
    })
}

/// A mathematical sign.
fn sign(letter: char) -> Option<&'static str> {
    Some(match letter {
        'α' => r"\alpha",
        'β' => r"\beta",
        'γ' => r"\gamma",
        'δ' => r"\delta",
        'ε' => r"\varepsilon",
        'ζ' => r"\zeta",
        'η' => r"\eta",
        'θ' => r"\theta",
        'ι' => r"\iota",
        'κ' => r"\kappa",
        'λ' => r"\lambda",
        'μ' | 'µ' => r"\mu",
        'ν' => r"\nu",
        'ξ' => r"\xi",
        'π' => r"\pi",
        'ρ' => r"\rho",
        'σ' => r"\sigma",
        'τ' => r"\tau",
        'υ' => r"\upsilon",
        'φ' | 'ϕ' => r"\varphi",
        'χ' => r"\chi",
        'ψ' => r"\psi",
        'ω' => r"\omega",
        'Γ' => r"\Gamma",
        'Δ' => r"\Delta",
        'Θ' => r"\Theta",
        'Λ' => r"\Lambda",
        'Ξ' => r"\Xi",
        'Π' => r"\Pi",
        'Σ' => r"\Sigma",
        'Φ' => r"\Phi",
        'Ψ' => r"\Psi",
        'Ω' => r"\Omega",
        '∂' => r"\partial",
        '∇' => r"\nabla",
        '∫' => r"\int",
        '√' => r"\surd",
        '∞' => r"\infty",
        '−' => "-",
        '·' | '⋅' => r"\cdot",
        '×' => r"\times",
        '±' => r"\pm",
        '∓' => r"\mp",
        '≤' => r"\le",
        '≥' => r"\ge",
        '≠' => r"\ne",
        '≈' => r"\approx",
        '≡' => r"\equiv",
        '≪' => r"\ll",
        '≫' => r"\gg",
        '∈' => r"\in",
        '→' => r"\to",
        '←' => r"\leftarrow",
        '↦' => r"\mapsto",
        '⇒' => r"\Rightarrow",
        '…' => r"\dots",
        '⟂' | '⊥' => r"\perp",
        '½' => r"\tfrac12",
        'ℝ' => r"\mathbf{R}",
        'ℓ' => r"\ell",
        _ => return None,
    })
}

/// A letter or a mark of running text.
fn prose(letter: char) -> Option<&'static str> {
    Some(match letter {
        'à' => r"\`a",
        'á' => r"\'a",
        'â' => r"\^a",
        'ä' => r#"\"a"#,
        'å' => r"\aa{}",
        'ç' => r"\c{c}",
        'è' => r"\`e",
        'é' => r"\'e",
        'ê' => r"\^e",
        'ë' => r#"\"e"#,
        'í' => r"\'{\i}",
        'ñ' => r"\~n",
        'ó' => r"\'o",
        'ô' => r"\^o",
        'ö' => r#"\"o"#,
        'ø' => r"\o{}",
        'ú' => r"\'u",
        'ü' => r#"\"u"#,
        'ý' => r"\'y",
        'ß' => r"\ss{}",
        'ć' => r"\'c",
        'č' => r"\v{c}",
        'ř' => r"\v{r}",
        'š' => r"\v{s}",
        'ž' => r"\v{z}",
        'É' => r"\'E",
        'Ö' => r#"\"O"#,
        'Ü' => r#"\"U"#,
        '–' => "--",
        '—' => "---",
        '‘' | '’' => "'",
        '“' => "``",
        '”' => "''",
        '§' => r"\S{}",
        '\u{a0}' => "~",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_accents_and_scripts() {
        for (text, expected) in [
            ("Λ^τ", r"\Lambda^{\tau}"),
            ("∂ₜ^τψ", r"\partial_{t}^{\tau}\psi"),
            ("f̄ − Λ^τᵀ λ", r"\bar{f} - \Lambda^{\tau T} \lambda"),
            ("x₀ + τ f^τ", r"x_{0} + \tau f^{\tau}"),
            ("∂F", r"\partial F"),
            ("k_below₁²", r"\mathit{k\_below}_{1}^{2}"),
        ] {
            assert_eq!(mathematics(text), expected);
        }
    }

    #[test]
    fn sentences_keep_their_words() {
        for (text, expected) in [
            ("ψ's divided differences", r"$\psi$'s divided differences"),
            ("where f is 50 % & #1_a", r"where f is 50 \% \& \#1\_a"),
            (
                "d energy/dt = 0 at x₁ > 0",
                r"d energy/dt $=$ 0 at $x_{1} >$ 0",
            ),
            ("Pöschl–Teller § 3", r#"P\"oschl--Teller \S{} 3"#),
            ("{a} 中", r"\{a\} [U+4E2D]"),
        ] {
            assert_eq!(sentence(text), expected);
        }
    }
}
