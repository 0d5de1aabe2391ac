//! A listing as aligned text.

use std::fmt::Write;

use super::document::{Document, Level, Part, Phrase, Piece, Row, Section};
use super::findings::Finding;
use crate::algebra::display::text::{self, Letters};

/// The listing in lines of `width` characters where that can be.
pub(super) fn write(document: &Document, width: usize) -> String {
    let mut writer = Writer {
        document,
        width,
        text: String::new(),
    };
    if !document.source.is_empty() {
        let _ = writeln!(writer.text, "{}", document.source.trim_end());
    }
    for section in &document.sections {
        writer.section(section);
    }
    writer.text
}

/// Characters of a left-hand side.
pub(super) fn width_of_left(row: &Row, letters: &Letters) -> usize {
    left(row, letters).chars().count()
}

fn left(row: &Row, letters: &Letters) -> String {
    row.left
        .iter()
        .map(|part| match part {
            Part::Sign(sign) => (*sign).to_owned(),
            Part::Name(name) => name.clone(),
            Part::Symbol(symbol) => text::symbol(symbol, letters),
            Part::Shared(number, in_row) => text::shared(*number, *in_row, letters),
        })
        .collect()
}

struct Writer<'a> {
    document: &'a Document,
    width: usize,
    text: String,
}

impl Writer<'_> {
    fn letters(&self) -> &Letters {
        &self.document.letters
    }

    fn section(&mut self, section: &Section) {
        let margin = match section.level {
            Level::Part => 0,
            Level::Step => 2,
        };
        let mut heading = self.phrase(&section.heading);
        if !section.remark.is_empty() {
            heading.push_str(": ");
            heading.push_str(&self.phrase(&section.remark));
        }
        self.text.push('\n');
        self.paragraph(&heading, margin);
        for reason in &section.reasons {
            self.paragraph(&self.phrase(reason), margin + 2);
        }
        self.rows(&section.rows, margin + 2);
        if !section.shared.is_empty() {
            self.paragraph("where", margin + 2);
            self.rows(&section.shared, margin + 4);
        }
        for note in &section.notes {
            self.paragraph(&self.phrase(note), margin + 2);
        }
        self.findings(&section.findings, margin + 2);
    }

    fn phrase(&self, phrase: &Phrase) -> String {
        phrase
            .iter()
            .map(|piece| match piece {
                Piece::Words(words) => words.clone(),
                Piece::Signs(signs) => (*signs).to_owned(),
                Piece::Formula(formula) => {
                    text::write_with(&self.document.formulas, *formula, self.letters())
                }
            })
            .collect()
    }

    /// A sentence in as many lines as it takes.
    fn paragraph(&mut self, sentence: &str, margin: usize) {
        let lines = wrapped(sentence, self.width.saturating_sub(margin + 2));
        for (number, line) in lines.iter().enumerate() {
            let hanging = if number == 0 { margin } else { margin + 2 };
            let _ = writeln!(self.text, "{}{line}", " ".repeat(hanging));
        }
    }

    /// Aligned equations.
    fn rows(&mut self, rows: &[Row], margin: usize) {
        let lefts: Vec<String> = rows.iter().map(|row| left(row, self.letters())).collect();
        let widths = lefts.iter().map(|left| left.chars().count());
        let column = widths.max().unwrap_or(0);
        for (row, left) in rows.iter().zip(&lefts) {
            let gap = " ".repeat(column - left.chars().count());
            let room = self.width.saturating_sub(margin + column + 3);
            let lines = self.right(row, room);
            for (number, line) in lines.iter().enumerate() {
                let start = match number {
                    0 => format!("{}{left}{gap} = ", " ".repeat(margin)),
                    _ => " ".repeat(margin + column + 3),
                };
                let _ = writeln!(self.text, "{start}{line}");
            }
        }
    }

    /// A right-hand side, broken between its terms where it has to be.
    fn right(&self, row: &Row, room: usize) -> Vec<String> {
        let letters = self.letters();
        let mut lines: Vec<String> = Vec::new();
        for term in text::terms(&self.document.formulas, row.right, letters) {
            let whole = term.chars().count() <= room;
            let pieces = if whole { vec![term] } else { pieces(&term) };
            for piece in pieces {
                match lines.last_mut() {
                    Some(line) if line.chars().count() + piece.chars().count() <= room => {
                        line.push_str(&piece);
                    }
                    _ => lines.push(piece.trim_start().to_owned()),
                }
            }
        }
        if let (Some((first, last)), Some(line)) = (row.range, lines.last_mut()) {
            let _ = write!(line, "  for {} in {first}..{}", letters.row, last + 1);
        }
        lines
    }

    fn findings(&mut self, findings: &[Finding], margin: usize) {
        let words = findings.iter().map(|finding| finding.grounds.word());
        let column = words.map(|word| word.chars().count()).max().unwrap_or(0);
        for finding in findings {
            let word = finding.grounds.word();
            let gap = " ".repeat(column - word.chars().count() + 2);
            let mut sentence = finding.statement.clone();
            if !finding.remark.is_empty() {
                let _ = write!(sentence, " ({})", finding.remark);
            }
            let hanging = margin + column + 2;
            let lines = wrapped(&sentence, self.width.saturating_sub(hanging));
            for (number, line) in lines.iter().enumerate() {
                let start = match number {
                    0 => format!("{}{word}{gap}", " ".repeat(margin)),
                    _ => " ".repeat(hanging + 2),
                };
                let _ = writeln!(self.text, "{start}{line}");
            }
        }
    }
}

/// A term with its signs, cut before each sign of a sum in it.
fn pieces(term: &str) -> Vec<String> {
    let mut pieces: Vec<String> = Vec::new();
    for word in term.split_inclusive(' ') {
        let is_sign = matches!(word, "+ " | "- ");
        match pieces.last_mut() {
            Some(piece) if !is_sign => piece.push_str(word),
            _ => pieces.push(format!(" {word}")),
        }
    }
    for piece in &mut pieces {
        piece.truncate(piece.trim_end().len());
    }
    if let (Some(first), false) = (pieces.first_mut(), term.starts_with(' ')) {
        *first = first.trim_start().to_owned();
    }
    pieces
}

/// A sentence in lines of `width` characters, broken between words.
fn wrapped(sentence: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in sentence.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
