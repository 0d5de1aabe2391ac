//! The legend of a panel: a strip below it, as high as its entries need.

use std::borrow::Cow;

use kuva::render::render::{PathData, Primitive, TextAnchor};

use super::{Curve, Stroke};

/// Of the text, in pixels.
const SIZE: u32 = 12;
/// Between two lines of entries.
const LINE_HEIGHT: f64 = 18.0;
/// Of the piece of the curve before a text.
const SAMPLE: f64 = 26.0;
/// Around a text.
const SPACE: f64 = 8.0;
/// Of the strip on both sides.
const MARGIN: f64 = 12.0;

/// About the width of a letter in the usual fonts, rather more than less.
fn letter_width(letter: char) -> f64 {
    let width = match letter {
        'm' | 'w' | 'M' | 'W' | '%' | '@' | '…' => 1.0,
        'f' | 'i' | 'j' | 'l' | 'r' | 't' | 'I' => 0.42,
        ' ' | '.' | ',' | ':' | ';' | '\'' | '|' | '(' | ')' | '[' | ']' => 0.42,
        'A'..='Z' | '<' | '>' | '=' | '+' | '−' => 0.84,
        _ => 0.66,
    };
    f64::from(SIZE) * width
}

fn text_width(text: &str) -> f64 {
    text.chars().map(letter_width).sum()
}

/// A text that is no wider than `room`, the end of a longer one left out.
fn fitted(text: &str, room: f64) -> Cow<'_, str> {
    if text_width(text) <= room {
        return text.into();
    }
    let mut width = letter_width('…');
    let fits = |letter: &char| {
        width += letter_width(*letter);
        width <= room
    };
    let kept: String = text.chars().take_while(fits).collect();
    format!("{}…", kept.trim_end()).into()
}

/// The curves with an entry, how many of them stand side by side, and how far from one another.
fn arranged(curves: &[Curve], width: f64) -> (Vec<(&Curve, Cow<'_, str>)>, usize, f64) {
    let room = width - 2.0 * MARGIN - SAMPLE - 2.0 * SPACE;
    let labelled = curves.iter();
    let labelled: Vec<(&Curve, Cow<'_, str>)> = labelled
        .filter_map(|curve| Some((curve, fitted(curve.label.as_deref()?, room))))
        .collect();
    let widths = labelled.iter().map(|(_, label)| text_width(label));
    let column = SAMPLE + 2.0 * SPACE + widths.fold(0.0, f64::max);
    let columns = ((width - 2.0 * MARGIN) / column).floor().max(1.0) as usize;
    let columns = columns.min(labelled.len().max(1));
    (labelled, columns, column)
}

/// The height of the strip.
pub(super) fn height(curves: &[Curve], width: f64) -> f64 {
    let (labelled, columns, _) = arranged(curves, width);
    labelled.len().div_ceil(columns) as f64 * LINE_HEIGHT
}

/// The strip, from its upper left corner.
pub(super) fn entries(curves: &[Curve], width: f64) -> Vec<Primitive> {
    let (labelled, columns, column) = arranged(curves, width);
    let left = 0.5 * (width - columns as f64 * column);
    let mut primitives = Vec::new();
    for (k, (curve, label)) in labelled.into_iter().enumerate() {
        let x = left + (k % columns) as f64 * column;
        let y = ((k / columns) as f64 + 0.5) * LINE_HEIGHT;
        primitives.extend(sample(curve, x, y));
        primitives.push(Primitive::Text {
            x: x + SAMPLE + SPACE,
            y: y + 0.35 * f64::from(SIZE),
            content: label.into_owned(),
            size: SIZE,
            anchor: TextAnchor::Start,
            rotate: None,
            bold: false,
            color: None,
        });
    }
    primitives
}

/// A piece of the curve.
fn sample(curve: &Curve, x: f64, y: f64) -> Vec<Primitive> {
    let colour = || curve.look.colour.as_ref().into();
    let line =
        |x1: f64, y1: f64, x2: f64, y2: f64, width: f64, dashes: Option<String>| Primitive::Line {
            x1,
            y1,
            x2,
            y2,
            stroke: colour(),
            stroke_width: width,
            stroke_dasharray: dashes,
        };
    let dashes = || curve.look.line.style().dasharray();
    let across = |width: f64| line(x, y, x + SAMPLE, y, width, dashes());
    let middle = x + 0.5 * SAMPLE;
    let dot = |r: f64| Primitive::Circle {
        cx: middle,
        cy: y,
        r,
        fill: colour(),
        fill_opacity: None,
        stroke: None,
        stroke_width: None,
    };
    let shape = |corners: &[(f64, f64)]| {
        let corners = corners.iter();
        let corners = corners.map(|(right, down)| format!("{},{}", middle + right, y + down));
        Primitive::Path(Box::new(PathData {
            d: format!("M{} Z", corners.collect::<Vec<_>>().join(" L")),
            fill: Some(colour()),
            stroke: colour(),
            stroke_width: 0.5,
            opacity: None,
            stroke_dasharray: None,
        }))
    };
    match curve.stroke {
        Stroke::Solid => vec![across(1.8)],
        Stroke::Thin | Stroke::Fine => vec![across(1.2)],
        Stroke::Marked => vec![across(1.8), dot(3.5)],
        Stroke::Circles => vec![dot(5.0)],
        Stroke::Squares => vec![Primitive::Rect {
            x: middle - 4.5,
            y: y - 4.5,
            width: 9.0,
            height: 9.0,
            fill: colour(),
            stroke: None,
            stroke_width: None,
            opacity: None,
        }],
        Stroke::Triangles => vec![shape(&[(0.0, -5.0), (4.5, 4.0), (-4.5, 4.0)])],
        Stroke::Diamonds => vec![shape(&[(0.0, -5.0), (5.0, 0.0), (0.0, 5.0), (-5.0, 0.0)])],
        Stroke::Crosses => [-4.0, 4.0]
            .map(|half| line(middle - 4.0, y - half, middle + 4.0, y + half, 1.5, None))
            .into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every text ends before the panel does, however many and long the entries are.
    #[test]
    fn entries_stand_inside() {
        for (count, letters) in [(1, 5), (9, 30), (40, 3), (3, 50), (2, 200)] {
            let curve = || Curve {
                label: Some("m".repeat(letters)),
                points: Vec::new(),
                stroke: Stroke::Marked,
                look: super::super::Look::nth(0),
            };
            let curves: Vec<Curve> = (0..count).map(|_| curve()).collect();
            let (width, height) = (700.0, height(&curves, 700.0));
            let texts = entries(&curves, width).into_iter();
            let places = texts.filter_map(|primitive| match primitive {
                Primitive::Text { x, y, content, .. } => Some((x, y, content.chars().count())),
                _ => None,
            });
            let places: Vec<(f64, f64, usize)> = places.collect();
            assert_eq!(places.len(), count);
            for (x, y, shown) in places {
                assert!(shown == letters || letters > 50, "{shown} of {letters}");
                let end = x + 0.974 * f64::from(SIZE) * shown as f64;
                assert!(x >= 0.0 && end <= width, "{letters}: {x}");
                assert!(y <= height);
            }
        }
    }
}
