//! A listing as a fragment of a LaTeX document: amsmath and nothing else, ASCII only.

use std::fmt::Write;

use super::document::{Document, Level, Part, Phrase, Piece, Row, Section};
use crate::algebra::display::latex::{self, Style};
use crate::algebra::display::text::{self, Letters};
use crate::algebra::display::{Symbol, unicode};
use crate::model::Model;

const HEAD: &str = r"% A fragment: \input it in a document that loads amsmath.
%
% Notation: x_{0} and x_{1} are the values of x at the two ends of a step, q_{[2]} is the
% element 2 of the group q, and both are q_{[2],1}. A component has its name in brackets.
% Underscores of identifiers are printed as they are, so that x\_1 is the variable `x_1` and
% never the value of `x` at the end of a step.
";

const NOTATION: &str = r"\noindent
The subscripts $0$ and $1$ mark the ends of a step, brackets in a subscript the element of a
group: $q_{[2],1}$ is the element $2$ of $q$ at the later end. A component is in brackets after
its vector or matrix. Names are printed as they were declared.\par
";

/// The style for the names of a declaration.
pub(super) fn style(model: &Model, letters: &Letters) -> Style {
    let names: Vec<Symbol> = model.variables().map(Symbol::from).collect();
    let names = names.iter().map(|symbol| &*symbol.base);
    Style::new(letters.clone(), names.chain(["t"]))
}

/// The listing of the system `name`, with equations of at most about `width` characters a line.
pub(super) fn write(name: &str, document: &Document, style: &Style, width: usize) -> String {
    let mut writer = Writer {
        document,
        style,
        width,
        text: String::from(HEAD),
    };
    let _ = writeln!(
        writer.text,
        "\\begingroup\\allowdisplaybreaks\\sloppy\n\\subsection*{{System {}}}",
        unicode::sentence(name)
    );
    writer.text.push_str(NOTATION);
    writer.declaration();
    for section in &document.sections {
        writer.section(section);
    }
    writer.text.push_str("\\endgroup\n");
    writer.text
}

struct Writer<'a> {
    document: &'a Document,
    style: &'a Style,
    width: usize,
    text: String,
}

impl Writer<'_> {
    fn declaration(&mut self) {
        self.text
            .push_str("\\paragraph*{Declaration}\\mbox{}\\par\n");
        self.text
            .push_str("{\\ttfamily\\footnotesize\\raggedright\\parskip=0pt\n");
        for line in self.document.source.trim_end().lines() {
            let indent = line.len() - line.trim_start().len();
            // spaces that do not stretch at the start, that may be broken at further on
            let words: Vec<String> = line.split_whitespace().map(unicode::verbatim).collect();
            let _ = writeln!(
                self.text,
                "\\noindent\\hangindent={}em\\hangafter=1\\mbox{{{}}}{}\\par",
                indent / 2 + 2,
                "~".repeat(indent),
                words.join(" ")
            );
        }
        self.text.push_str("}\n");
    }

    fn section(&mut self, section: &Section) {
        let heading = self.phrase(&section.heading);
        let _ = match section.level {
            Level::Part => writeln!(self.text, "\\subsubsection*{{{}}}", capitalised(&heading)),
            Level::Step => writeln!(self.text, "\\paragraph*{{{}.}}", capitalised(&heading)),
        };
        let remark = self.phrase(&section.remark);
        if !remark.is_empty() {
            let _ = writeln!(self.text, "{remark}.");
        }
        for reason in section.reasons.iter().filter(|reason| !reason.is_empty()) {
            let _ = writeln!(self.text, "{}.", self.phrase(reason));
        }
        self.rows(&section.rows);
        if !section.shared.is_empty() {
            self.text.push_str("\\noindent where\n");
            self.rows(&section.shared);
        }
        for note in section.notes.iter().filter(|note| !note.is_empty()) {
            let _ = writeln!(self.text, "\\noindent {}.", capitalised(&self.phrase(note)));
        }
        if !section.findings.is_empty() {
            self.text.push_str("\\begin{itemize}\n");
            for finding in &section.findings {
                let _ = write!(
                    self.text,
                    "\\item \\emph{{{}}}: {}",
                    finding.grounds.word(),
                    unicode::sentence(&finding.statement)
                );
                if !finding.remark.is_empty() {
                    let _ = write!(self.text, " ({})", unicode::sentence(&finding.remark));
                }
                self.text.push('\n');
            }
            self.text.push_str("\\end{itemize}\n");
        }
    }

    fn phrase(&self, phrase: &Phrase) -> String {
        phrase
            .iter()
            .map(|piece| match piece {
                Piece::Words(words) => unicode::sentence(words),
                Piece::Signs("") => String::new(),
                Piece::Signs(signs) => format!("${}$", unicode::mathematics(signs)),
                Piece::Formula(formula) => {
                    let document = self.document;
                    format!(
                        "${}$",
                        latex::write(&document.formulas, *formula, self.style)
                    )
                }
            })
            .collect()
    }

    fn left(&self, row: &Row) -> String {
        let style = self.style;
        row.left
            .iter()
            .map(|part| match part {
                Part::Sign(sign) => {
                    let latex = unicode::mathematics(sign);
                    // a command must not run into a name
                    if latex.ends_with(|letter: char| letter.is_ascii_alphabetic()) {
                        format!("{latex} ")
                    } else {
                        latex
                    }
                }
                Part::Name(name) => style.name(name),
                Part::Symbol(symbol) => latex::symbol(symbol, style),
                Part::Shared(number, in_row) => latex::shared(*number, *in_row, style),
            })
            .collect()
    }

    /// Aligned equations.
    fn rows(&mut self, rows: &[Row]) {
        if rows.is_empty() {
            return;
        }
        let lines: Vec<String> = rows.iter().map(|row| self.row(row)).collect();
        let _ = writeln!(
            self.text,
            "\\begin{{align*}}\n{}\n\\end{{align*}}",
            lines.join(" \\\\\n")
        );
    }

    fn row(&self, row: &Row) -> String {
        let style = self.style;
        let Document {
            formulas, letters, ..
        } = self.document;
        let room = self
            .width
            .saturating_sub(super::text::width_of_left(row, letters));
        // terms are as wide in LaTeX as they are as text, or narrower
        let widths = text::terms(formulas, row.right, letters);
        let widths = widths.iter().map(|term| term.chars().count());
        let mut line = 0;
        let mut written = format!("{} &= ", self.left(row));
        for (term, width) in latex::terms(formulas, row.right, style).iter().zip(widths) {
            if line > 0 && line + width > room {
                written.push_str(" \\\\\n  &\\quad");
                line = 0;
            }
            written.push_str(term);
            line += width;
        }
        if let Some((first, last)) = row.range {
            if line + 12 > room {
                written.push_str(" \\\\\n  &");
            }
            let _ = write!(
                written,
                "\\qquad ({} = {first}, \\dots, {last})",
                letters.row
            );
        }
        written
    }
}

/// A sentence with a capital at its start.
fn capitalised(sentence: &str) -> String {
    let mut letters = sentence.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters).collect()
}
