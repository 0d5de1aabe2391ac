//! What tells the curves of a panel apart: colour, line, marks.

use std::borrow::Cow;

use kuva::plot::line::LineStyle;

/// Colours that differ in lightness too (Okabe & Ito).
const COLOURS: [&str; 7] = [
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#222222",
];
/// For lines of comparison.
pub const GREY: &str = "#888888";
/// For what is not told apart.
pub const LIGHT_GREY: &str = "#BBBBBB";
/// From the first to the last of many curves in an order.
const SHADES: [[f64; 3]; 5] = [
    [68.0, 1.0, 84.0],
    [59.0, 82.0, 139.0],
    [33.0, 145.0, 140.0],
    [94.0, 201.0, 98.0],
    [210.0, 190.0, 30.0],
];

/// How a curve is drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Stroke {
    /// A line.
    Solid,
    /// A thin line.
    Thin,
    /// Points so small that many make a line.
    Fine,
    /// Points joined by a line.
    Marked,
    /// Circles alone.
    Circles,
    /// Squares alone.
    Squares,
    /// Crosses alone.
    Crosses,
    /// Triangles alone.
    Triangles,
    /// Diamonds alone.
    Diamonds,
}

/// Whether a line is broken, and how.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Line {
    /// It is not.
    Whole,
    /// Dashes.
    Dashed,
    /// Dots.
    Dotted,
    /// Both in turn.
    DashDotted,
}

impl Line {
    const ALL: [Self; 4] = [Self::Whole, Self::Dashed, Self::Dotted, Self::DashDotted];

    pub(super) fn style(self) -> LineStyle {
        match self {
            Self::Whole => LineStyle::Solid,
            Self::Dashed => LineStyle::Custom("7 4".to_owned()),
            Self::Dotted => LineStyle::Custom("2 3".to_owned()),
            Self::DashDotted => LineStyle::Custom("8 3 2 3".to_owned()),
        }
    }
}

/// Colour and line of a curve.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Look {
    /// As `#RRGGBB`.
    pub colour: Cow<'static, str>,
    /// Its line.
    pub line: Line,
}

impl Look {
    /// How many there are.
    pub const COUNT: usize = COLOURS.len() * Line::ALL.len();

    /// The k-th of [`Look::COUNT`]: all colours with whole lines first, then with broken ones.
    pub fn nth(k: usize) -> Self {
        let line = Line::ALL[k / COLOURS.len() % Line::ALL.len()];
        let colour = Cow::Borrowed(COLOURS[k % COLOURS.len()]);
        Self { colour, line }
    }

    /// The k-th of `count` curves in an order: neighbours look alike.
    pub fn shade(k: usize, count: usize) -> Self {
        let last = SHADES.len() - 1;
        let place = k as f64 / count.saturating_sub(1).max(1) as f64 * last as f64;
        let below = (place as usize).min(last - 1);
        let share = place - below as f64;
        let mixed = |i: usize| {
            let (a, b) = (SHADES[below][i], SHADES[below + 1][i]);
            (a + share * (b - a)).round() as u8
        };
        let colour = format!("#{:02X}{:02X}{:02X}", mixed(0), mixed(1), mixed(2));
        Self {
            colour: Cow::Owned(colour),
            line: Line::Whole,
        }
    }
}

impl From<&'static str> for Look {
    fn from(colour: &'static str) -> Self {
        Self {
            colour: Cow::Borrowed(colour),
            line: Line::Whole,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn looks_differ() {
        let looks: Vec<Look> = (0..Look::COUNT).map(Look::nth).collect();
        let shades: Vec<Look> = (0..64).map(|k| Look::shade(k, 64)).collect();
        for looks in [looks, shades] {
            for (k, look) in looks.iter().enumerate() {
                assert!(!looks[..k].contains(look), "{k}");
            }
        }
        assert_eq!(Look::shade(0, 1).colour, "#440154");
        assert_eq!(Look::shade(4, 5).colour, "#D2BE1E");
    }
}
