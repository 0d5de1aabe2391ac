//! The legend of a panel: a strip below it, as high as its entries need.

use kuva::render::render::{Primitive, TextAnchor};

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

/// About the width of a text in the usual fonts, rather more than less.
fn text_width(text: &str) -> f64 {
    let widths = text.chars().map(|letter| match letter {
        'm' | 'w' | 'M' | 'W' | '%' | '@' => 1.0,
        'f' | 'i' | 'j' | 'l' | 'r' | 't' | 'I' => 0.42,
        ' ' | '.' | ',' | ':' | ';' | '\'' | '|' | '(' | ')' | '[' | ']' => 0.42,
        'A'..='Z' | '<' | '>' | '=' | '+' | '−' => 0.84,
        _ => 0.66,
    });
    f64::from(SIZE) * widths.sum::<f64>()
}

/// The curves with an entry, and how many of them stand side by side.
fn arranged(curves: &[Curve], width: f64) -> (Vec<(&Curve, &str)>, usize, f64) {
    let labelled = curves.iter();
    let labelled: Vec<(&Curve, &str)> = labelled
        .filter_map(|curve| Some((curve, curve.label.as_deref()?)))
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
            content: label.to_owned(),
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
        for (count, letters) in [(1, 5), (9, 30), (40, 3), (3, 50)] {
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
                Primitive::Text { x, y, .. } => Some((x, y)),
                _ => None,
            });
            let places: Vec<(f64, f64)> = places.collect();
            assert_eq!(places.len(), count);
            for (x, y) in places {
                let end = x + 0.974 * f64::from(SIZE) * letters as f64;
                assert!(x >= 0.0 && end <= width, "{letters}: {x}");
                assert!(y <= height);
            }
        }
    }
}
